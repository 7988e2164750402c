/// @file
/// The way of a reading from the pad to the file, through the effects that a scene names.
///
///     SignalPath path = signal_path(scene);  // scene/scene.hpp; or stage by stage:
///     std::vector<std::unique_ptr<SensorEffect>> stages;
///     stages.push_back(make_effect(NoiseModel{.rms = {{Quantity::stress_x, 2.0}}}, array));
///     SignalPath noisy(std::move(stages), readings.size());
///     noisy.apply(Instant{}, readings);      // what the sensor makes of one frame
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

/// Stages one after the other; a path without stages changes nothing and costs nothing.
class SignalPath {
 public:
  /// A path without stages.
  SignalPath() = default;

  /// The sensor is at rest: it has been unloaded for ever.
  ///
  /// @param stages    in the order in which a reading passes them; null ones are left out
  /// @param readings  how many a moment has: channels x count
  SignalPath(std::vector<std::unique_ptr<SensorEffect>> stages, std::size_t readings);

  /// One moment's readings, channels x count, are replaced by what the sensor makes of them. At a
  /// moment that is not recorded only what a memory needs is computed, and the readings hold
  /// nothing of use.
  void apply(const Instant& at, std::span<double> readings);

  /// True if moments between frames matter.
  [[nodiscard]] bool has_memory() const noexcept { return remembering_ > 0; }
  [[nodiscard]] std::size_t stages() const noexcept { return stages_.size(); }
  /// The stages' notes on the frame last taken, in the order of the stages.
  [[nodiscard]] std::vector<CutOffNote> notes() const;

 private:
  std::vector<std::unique_ptr<SensorEffect>> stages_;
  std::size_t remembering_ = 0;  // stages up to the last one with a memory
};

}  // namespace tactile_net
