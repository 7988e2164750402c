#include "tactile_net/frames/open.hpp"

#include <filesystem>
#include <istream>

#include "tactile_net/frames/csv.hpp"
#include "tactile_net/frames/npy.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::frames {
namespace {

/// Which columns hold readings of dead taxels.
std::vector<bool> unread_columns(const Scene& scene) {
  std::vector<bool> unread(reading_count(scene.sensor));
  for (std::size_t i = 0; i < unread.size(); ++i)
    for (const std::size_t taxel : scene.dead_taxels)
      if (i % scene.sensor.count == taxel) unread[i] = true;
  return unread;
}

}  // namespace

std::ifstream open_frames(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError({{.file = path, .message = "is a folder, not a file of readings"}});
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw InputError({{.file = path,
                       .message = "cannot be opened",
                       .hint = "readings are a CSV or .npy file, or - for standard input"}});
  return file;
}

ReadingsFile::ReadingsFile(const std::string& path, const Scene& scene,
                           std::istream* standard_input)
    : live_(path == "-" && standard_input != nullptr), name_(live_ ? "<stdin>" : path) {
  if (!live_) file_ = open_frames(path);
  if (!live_ && (is_npy_name(path) || begins_like_npy(file_)))
    source_ = std::make_unique<NpyFrames>(file_, name_, reading_columns(scene.sensor),
                                          unread_columns(scene));
  else
    source_ = std::make_unique<CsvFrames>(live_ ? *standard_input : file_, name_,
                                          reading_columns(scene.sensor), unread_columns(scene));
}

std::unique_ptr<FrameSink> make_sink(OutputFile& file, const std::string& path,
                                     std::span<const std::string> columns, bool with_time) {
  if (!is_npy_name(path)) return std::make_unique<CsvSink>(file.stream(), columns, with_time);
  if (file.is_direct())
    throw CannotCreate(path + ": error: a .npy file cannot go to a pipe or a device");
  return std::make_unique<NpySink>(file.stream(), columns.size());
}

}  // namespace tactile_net::frames
