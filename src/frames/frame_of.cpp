#include "tactile_net/frames/frame_of.hpp"

#include <fstream>
#include <string>

#include "tactile_net/frames/open.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::frames {
namespace {

/// Frame `number` of a source, from 0.
std::vector<double> frame_at(FrameSource& source, const std::string& file, std::size_t values,
                             std::size_t number) {
  std::vector<double> frame(values);
  std::size_t frames = 0;
  while (source.next(frame))
    if (frames++ == number) return frame;
  throw InputError(
      {{.file = file,
        .message = "has no frame " + std::to_string(number),
        .hint = "it has " + std::to_string(frames) + " frames; the first is frame 0"}});
}

/// The columns of tractions that a CSV file's header names; of the normal one at least the first.
std::vector<std::string> columns_of(const std::string& path) {
  std::ifstream file = open_frames(path);
  std::string header;
  std::getline(file, header);
  for (char& c : header)
    if (c == ' ' || c == '\t' || c == '"' || c == '\r') c = ',';
  header = ',' + header + ',';
  const auto has = [&](const std::string& name) {
    return header.find(',' + name + ',') != std::string::npos;
  };
  std::size_t count = 1;
  while (has("normal_" + std::to_string(count))) ++count;
  return traction_columns(count, has("tangential_0"));
}

}  // namespace

std::vector<double> readings_of_frame(const std::filesystem::path& file, const Scene& scene,
                                      std::size_t number) {
  FrameFile readings(file.string(), scene);
  return frame_at(readings.source(), file.string(), reading_columns(scene.sensor).size(), number);
}

TractionField tractions_of_frame(const std::filesystem::path& file, std::size_t number) {
  const std::string path = file.string();
  const std::vector<std::string> columns = columns_of(path);
  std::ifstream stream = open_frames(path);
  CsvFrames frames(stream, path, columns, std::vector<bool>(columns.size()));
  TractionField field{.normal = frame_at(frames, path, columns.size(), number)};
  if (columns.back().starts_with("tangential")) {
    const auto middle = field.normal.begin() + std::ssize(columns) / 2;
    field.tangential.assign(middle, field.normal.end());
    field.normal.erase(middle, field.normal.end());
  }
  return field;
}

}  // namespace tactile_net::frames
