#include "frames/calibrated_frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "frames/missing_hint.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::frames {

CalibratedFrames::CalibratedFrames(std::unique_ptr<FrameSource> source, std::string file,
                                   Calibration calibration, const WantedColumns& wanted)
    : source_(std::move(source)),
      file_(std::move(file)),
      calibration_(std::move(calibration)),
      unread_(wanted.unread),
      accept_missing_(wanted.accept_missing) {}

/// The other source's next frame, codes for missing values as these are.
bool CalibratedFrames::read(std::span<double> values) {
  if (!source_->next(values)) return false;
  if (calibration_.missing.empty()) return true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if ((i < unread_.size() && unread_[i]) || !is_missing(calibration_, values[i])) continue;
    if (!accept_missing_)
      source_->refuse("'" + source_->columns()[i] + "' is " + shortest(values[i]) +
                          ", which calibration.missing says is not a value",
                      missing_hint());
    values[i] = std::numeric_limits<double>::quiet_NaN();
  }
  return true;
}

void CalibratedFrames::find_baseline() {
  const auto [first, last] = *std::exchange(calibration_.baseline_frames, std::nullopt);
  const std::size_t readings = source_->columns().size();
  std::vector<std::size_t> counts(readings);
  for (std::size_t frame = 0; frame <= last; ++frame) {
    Kept kept{{}, {}, std::vector<double>(readings)};
    if (!read(kept.values))
      throw InputError(
          {{.file = file_,
            .message = "ends after " + std::to_string(frame) + (frame == 1 ? " frame" : " frames") +
                       ", and calibration.baseline_frames reach to frame " + std::to_string(last),
            .hint = "the first frame is frame 0"}});
    kept.time = source_->time();
    kept.seconds = source_->seconds();
    if (frame >= first)
      for (std::size_t i = 0; i < readings; ++i) {
        if (std::isnan(kept.values[i])) continue;
        // The mean so far: a sum of large numbers might overflow.
        double& mean = calibration_.baseline[i];
        mean += (kept.values[i] - mean) / static_cast<double>(++counts[i]);
      }
    kept_.push_back(std::move(kept));
  }
  for (std::size_t i = 0; i < readings; ++i)
    if (counts[i] == 0)
      throw InputError({{.file = file_,
                         .message = "has no '" + source_->columns()[i] +
                                    "' in any frame of calibration.baseline_frames",
                         .hint = "name other frames, or give calibration.baseline"}});
}

bool CalibratedFrames::next(std::span<double> values) {
  if (calibration_.baseline_frames) find_baseline();
  if (!kept_.empty()) {
    last_ = std::move(kept_.front());
    kept_.pop_front();
    std::copy(last_->values.begin(), last_->values.end(), values.begin());
  } else {
    last_.reset();
    if (!read(values)) return false;
  }
  ++handed_out_;
  calibrate(calibration_, values);
  for (std::size_t i = 0; i < unread_.size(); ++i)
    if (unread_[i]) values[i] = 0.0;
  return true;
}

InputError CalibratedFrames::refusal(const std::string& message, const std::string& hint) const {
  if (!last_) return source_->refusal(message, hint);
  return InputError({{.file = file_,
                      .message = "frame " + std::to_string(handed_out_ - 1) + ": " + message,
                      .hint = hint}});
}

std::span<const std::string> CalibratedFrames::columns() const noexcept {
  return source_->columns();
}
bool CalibratedFrames::has_time() const noexcept { return source_->has_time(); }
std::string_view CalibratedFrames::time() const noexcept {
  return last_ ? std::string_view(last_->time) : source_->time();
}
std::optional<double> CalibratedFrames::seconds() const {
  return last_ ? last_->seconds : source_->seconds();
}
bool CalibratedFrames::time_unit_known() const noexcept { return source_->time_unit_known(); }
std::span<const std::string> CalibratedFrames::ignored() const noexcept {
  return source_->ignored();
}
std::span<const std::string> CalibratedFrames::opening_notes() const noexcept {
  return source_->opening_notes();
}
std::vector<std::string> CalibratedFrames::closing_notes() const {
  return source_->closing_notes();
}
std::size_t CalibratedFrames::bytes_read() const noexcept { return source_->bytes_read(); }
std::optional<std::size_t> CalibratedFrames::frames() const noexcept { return source_->frames(); }

}  // namespace tactile_net::frames
