#include "tactile_net/lab/pad_signal.hpp"

#include <algorithm>
#include <cmath>

namespace tactile_net::lab {

void PadSignal::apply(double time, std::span<double> readings) {
  const bool again = time_ == time && std::equal(readings.begin(), readings.end(), pure_.begin());
  if (!again) record(time, readings);
  std::copy(recorded_.begin(), recorded_.end(), readings.begin());
}

void PadSignal::record(double time, std::span<const double> pure) {
  const bool goes_on = time_ && time > *time_;
  if (!goes_on) path_ = make_path_();
  double since = goes_on ? time - *time_ : 0.0;
  if (aperture_ > 0.0 && aperture_ < since) {  // it opens between the two moments
    recorded_.resize(pure.size());
    for (std::size_t i = 0; i < pure.size(); ++i)
      recorded_[i] = std::lerp(pure[i], pure_[i], aperture_ / since);
    path_.apply(
        {.time = time - aperture_, .since = since - aperture_, .recorded = false, .opens = true},
        recorded_);
    since = aperture_;
  }
  time_ = time;
  pure_.assign(pure.begin(), pure.end());
  recorded_ = pure_;
  path_.apply({.time = time, .since = since, .recorded = true}, recorded_);
}

}  // namespace tactile_net::lab
