#include "frame_files.hpp"

#include "failure.hpp"
#include "npy.hpp"

namespace tactile_net::tool {

std::unique_ptr<FrameSink> make_sink(OutputFile& file, const std::string& path,
                                     std::span<const std::string> columns, bool with_time) {
  if (!is_npy_name(path)) return std::make_unique<CsvSink>(file.stream(), columns, with_time);
  if (file.is_direct())
    throw CannotCreate(path + ": error: a .npy file cannot go to a pipe or a device");
  return std::make_unique<NpySink>(file.stream(), columns.size());
}

}  // namespace tactile_net::tool
