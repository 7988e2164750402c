/// @file
/// Where frames go: CSV or .npy, by the file's name.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "frames.hpp"
#include "output.hpp"

namespace tactile_net::tool {

/// @param path  as given to `file`: ending in .npy makes one, without a column of times
/// @throw CannotCreate  .npy and a file that cannot be gone back in: a pipe
[[nodiscard]] std::unique_ptr<FrameSink> make_sink(OutputFile& file, const std::string& path,
                                                   std::span<const std::string> columns,
                                                   bool with_time);

}  // namespace tactile_net::tool
