/// @file
/// The way of a reading from the pad to the file, through the effects that a scene names.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

/// Stages in the order in which they were added; one without stages changes nothing and costs
/// nothing.
class SignalPath {
 public:
  /// @param stage  none: nothing is added
  void add(std::unique_ptr<SensorEffect> stage);

  /// Puts the sensor at rest. Call once, after the last `add`; required only if a stage has a
  /// memory.
  ///
  /// @param readings  how many
  void begin(std::size_t readings);

  /// One moment's readings, channels x count, are replaced by what the sensor makes of them. At a
  /// moment that is not recorded only what a memory needs is computed, and the readings hold
  /// nothing of use.
  void apply(const Instant& at, std::span<double> readings);

  /// Whether moments between frames matter.
  [[nodiscard]] bool has_memory() const noexcept { return remembering_ > 0; }
  [[nodiscard]] std::size_t stages() const noexcept { return stages_.size(); }
  /// What the stages have to say of the frame last taken, in their order.
  [[nodiscard]] std::vector<CutOffNote> notes() const;

 private:
  std::vector<std::unique_ptr<SensorEffect>> stages_;
  std::size_t remembering_ = 0;  // stages up to the last one with a memory
};

}  // namespace tactile_net
