#include "tactile_net/lab/simulated_pad.hpp"

#include <algorithm>
#include <cmath>

namespace tactile_net::lab {

void SimulatedPad::read(double time, std::span<const LoadPatch> patches,
                        std::span<double> readings) {
  model_->forward.readings(patches, readings);
  const bool again = time_ == time && std::equal(readings.begin(), readings.end(), pure_.begin());
  if (!again) record(time, readings);
  std::copy(recorded_.begin(), recorded_.end(), readings.begin());
}

void SimulatedPad::record(double time, std::span<const double> pure) {
  const Scene& scene = model_->scene;
  const bool goes_on = time_ && time > *time_;
  if (!goes_on) path_ = signal_path(scene);
  double since = goes_on ? time - *time_ : 0.0;
  const double window = scene.sampling ? scene.sampling->aperture : 0.0;
  if (window > 0.0 && window < since) {  // it opens between the two moments
    recorded_.resize(pure.size());
    for (std::size_t i = 0; i < pure.size(); ++i)
      recorded_[i] = std::lerp(pure[i], pure_[i], window / since);
    path_.apply({.time = time - window, .since = since - window, .recorded = false, .opens = true},
                recorded_);
    since = window;
  }
  time_ = time;
  pure_.assign(pure.begin(), pure.end());
  recorded_ = pure_;
  path_.apply({.time = time, .since = since, .recorded = true}, recorded_);
}

}  // namespace tactile_net::lab
