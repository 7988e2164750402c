#include "tactile_net/frames/frame_of.hpp"

#include <algorithm>
#include <fstream>
#include <string>

#include "tactile_net/frames/csv.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::frames {
namespace {

/// Frame `number` of a source that has not been read yet, from 0.
std::vector<double> frame_at(FrameSource& source, const std::string& file, std::size_t number) {
  std::vector<double> frame(source.columns().size());
  std::size_t frames = 0;
  while (source.next(frame))
    if (frames++ == number) return frame;
  throw InputError({{.file = file,
                     .message = "has no frame " + std::to_string(number),
                     .hint = "it has " + counted(frames, "frame") + "; the first is frame 0"}});
}

/// The columns of tractions that a header names; of the normal ones at least the first.
std::vector<std::string> tractions_in(std::span<const std::string> header) {
  const auto has = [&](const std::string& name) {
    return std::find(header.begin(), header.end(), name) != header.end();
  };
  std::size_t count = 1;
  while (has("normal_" + std::to_string(count))) ++count;
  return traction_columns(count, has("tangential_0"));
}

}  // namespace

std::vector<double> readings_of_frame(const std::filesystem::path& file, const Scene& scene,
                                      std::size_t number, const ReadingsOptions& options) {
  ReadingsFile readings(file.string(), scene, nullptr, options);
  return frame_at(readings.source(), file.string(), number);
}

std::vector<double> readings_of_frame(const std::filesystem::path& file, const SkinScene& scene,
                                      std::size_t number, const ReadingsOptions& options) {
  ReadingsFile readings(file.string(), scene, nullptr, options);
  return frame_at(readings.source(), file.string(), number);
}

TractionField tractions_of_frame(const std::filesystem::path& file, std::size_t number) {
  const std::string path = file.string();
  std::ifstream stream = open_frames(path);
  CsvFrames frames(stream, path, tractions_in);
  TractionField field{.normal = frame_at(frames, path, number)};
  if (frames.columns().back().starts_with("tangential")) {
    const auto middle = field.normal.begin() + std::ssize(field.normal) / 2;
    field.tangential.assign(middle, field.normal.end());
    field.normal.erase(middle, field.normal.end());
  }
  return field;
}

}  // namespace tactile_net::frames
