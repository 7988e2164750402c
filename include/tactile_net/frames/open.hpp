/// @file
/// Files of frames, CSV or .npy, by name.
#pragma once

#include <cstddef>
#include <fstream>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/frames/source.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net::frames {

class CalibratedFrames;

/// @throw InputError  a folder, or it cannot be opened
[[nodiscard]] std::ifstream open_frames(const std::string& path);

/// How a recording is read, beside what the scene says.
struct ReadingsOptions {
  std::string columns{};        ///< where the readings stand, as `WantedColumns::places`
  bool accept_missing = false;  ///< values that are missing are NaN, in place of an error
};

/// Recorded readings of a scene's sensor: CSV or .npy by what the file begins with, standard input
/// for "-". Values of dead taxels are not read. What the scene has as [calibration] and [units] is
/// applied here: `source` gives readings in SI.
class ReadingsFile {
 public:
  /// @param standard_input  must live as long as this; null: the path is a file's whatever it is
  /// @throw InputError  cannot be opened, or as `CsvFrames` and `NpyFrames`
  /// @throw std::invalid_argument  `options.columns` does not fit the file
  ReadingsFile(const std::string& path, const Scene& scene, std::istream* standard_input = nullptr,
               const ReadingsOptions& options = {});

  /// The same of a skin, whose .npy may also have the shape (frames, rows, columns, channels).
  ReadingsFile(const std::string& path, const SkinScene& scene,
               std::istream* standard_input = nullptr, const ReadingsOptions& options = {});

  [[nodiscard]] FrameSource& source() noexcept { return *source_; }
  /// For messages.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// From standard input: each frame may be waited for.
  [[nodiscard]] bool live() const noexcept { return live_; }
  /// How much of the file was read so far, 0 to 1; nothing where its length is not known: of CSV
  /// from a pipe.
  [[nodiscard]] std::optional<double> share_read() const noexcept;
  /// The scene's calibration; from the first frame on with its baseline, where that is the mean of
  /// frames. Null: the file's numbers are the readings.
  [[nodiscard]] const Calibration* calibration() const noexcept;

 private:
  ReadingsFile(const std::string& path, std::istream* standard_input, WantedColumns wanted,
               const std::optional<Calibration>& calibration);

  bool live_;
  std::string name_;
  std::ifstream file_;
  std::size_t bytes_ = 0;  // of a regular file
  std::unique_ptr<FrameSource> source_;
  const CalibratedFrames* calibrated_ = nullptr;  // the source, if it is one
};

/// @param path  as given to `file`: ending in .npy makes one, without a column of times
/// @throw CannotCreate  .npy and a file that cannot be gone back in: a pipe
[[nodiscard]] std::unique_ptr<FrameSink> make_sink(OutputFile& file, const std::string& path,
                                                   std::span<const std::string> columns,
                                                   bool with_time);

}  // namespace tactile_net::frames
