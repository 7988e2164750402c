/// @file
/// Raw numbers on their way to readings. Private.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "tactile_net/frames/source.hpp"
#include "tactile_net/sensing/calibration.hpp"

namespace tactile_net::frames {

/// Another source's frames as readings in SI. Where the baseline is the mean of the first frames,
/// these are read, and kept, before the first is handed out.
class CalibratedFrames final : public FrameSource {
 public:
  /// @param file    name for messages
  /// @param wanted  of the other source: what is unread stays as it is, codes for missing values
  ///                are accepted as those are
  CalibratedFrames(std::unique_ptr<FrameSource> source, std::string file, Calibration calibration,
                   const WantedColumns& wanted);

  /// @throw InputError  too few frames for the baseline, or a reading is missing in all of them
  [[nodiscard]] bool next(std::span<double> values) override;
  [[nodiscard]] InputError refusal(const std::string& message,
                                   const std::string& hint) const override;

  [[nodiscard]] std::span<const std::string> columns() const noexcept override;
  [[nodiscard]] bool has_time() const noexcept override;
  [[nodiscard]] std::string_view time() const noexcept override;
  [[nodiscard]] std::optional<double> seconds() const override;
  [[nodiscard]] bool time_unit_known() const noexcept override;
  [[nodiscard]] std::span<const std::string> ignored() const noexcept override;
  [[nodiscard]] std::span<const std::string> opening_notes() const noexcept override;
  [[nodiscard]] std::vector<std::string> closing_notes() const override;
  [[nodiscard]] std::size_t bytes_read() const noexcept override;
  [[nodiscard]] std::optional<std::size_t> frames() const noexcept override;

  [[nodiscard]] const Calibration& calibration() const noexcept { return calibration_; }

 private:
  struct Kept {
    std::string time;
    std::optional<double> seconds;
    std::vector<double> values;
  };
  bool read(std::span<double> values);
  void find_baseline();

  std::unique_ptr<FrameSource> source_;
  std::string file_;
  Calibration calibration_;
  std::vector<bool> unread_;
  bool accept_missing_;
  std::deque<Kept> kept_{};     // read for the baseline, not handed out yet
  std::optional<Kept> last_{};  // handed out last, where it was kept
  std::size_t handed_out_ = 0;
};

}  // namespace tactile_net::frames
