/// @file
/// Files of frames, CSV or .npy, by name.
#pragma once

#include <fstream>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>

#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/frames/source.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::frames {

/// @throw InputError  a folder, or it cannot be opened
[[nodiscard]] std::ifstream open_frames(const std::string& path);

/// Recorded readings of a scene's sensor: CSV or .npy by what the file begins with, CSV from
/// standard input for "-". Values of dead taxels are not read.
class ReadingsFile {
 public:
  /// @param standard_input  must live as long as this; null: the path is a file's whatever it is
  /// @throw InputError  cannot be opened, or as `CsvFrames` and `NpyFrames`
  ReadingsFile(const std::string& path, const Scene& scene, std::istream* standard_input = nullptr);

  [[nodiscard]] FrameSource& source() noexcept { return *source_; }
  /// For messages.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// From standard input: each frame may be waited for.
  [[nodiscard]] bool live() const noexcept { return live_; }

 private:
  bool live_;
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
