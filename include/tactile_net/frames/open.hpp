/// @file
/// Files of frames: CSV or .npy.
#pragma once

#include <fstream>
#include <memory>
#include <span>
#include <string>

#include "tactile_net/frames/csv.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::frames {

/// @throw InputError  a folder, or it cannot be opened
[[nodiscard]] std::ifstream open_frames(const std::string& path);

/// Recorded readings of a scene's sensor: CSV or .npy by what the file begins with, CSV from
/// standard input for "-".
class FrameFile {
 public:
  /// @throw InputError  cannot be opened, or as `CsvFrames` and `NpyFrames`
  FrameFile(const std::string& path, const Scene& scene);

  [[nodiscard]] FrameSource& source() noexcept { return *source_; }
  /// For messages.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

 private:
  std::string name_;
  std::ifstream file_;
  std::unique_ptr<FrameSource> source_;
};

/// @param path  as given to `file`: ending in .npy makes one, without a column of times
/// @throw CannotCreate  .npy and a file that cannot be gone back in: a pipe
[[nodiscard]] std::unique_ptr<FrameSink> make_sink(OutputFile& file, const std::string& path,
                                                   std::span<const std::string> columns,
                                                   bool with_time);

}  // namespace tactile_net::frames
