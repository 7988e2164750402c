/// @file
/// What a sensor makes of its readings inside somebody else's simulation, moment by moment, with
/// what it remembers: the same for lines and skins.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tactile_net/scene/sensor_effects.hpp"
#include "tactile_net/sensing/signal_path.hpp"

namespace tactile_net::lab {

/// Not thread-safe.
class PadSignal {
 public:
  /// @param path      makes the sensor's effects, at rest: once for every beginning
  /// @param aperture  of the sampling window [s]; 0: readings are taken in a moment
  PadSignal(std::function<SignalPath()> path, double aperture)
      : make_path_(std::move(path)), aperture_(aperture) {}

  /// Replaces a moment's readings by what is recorded.
  ///
  /// Between two moments every reading is a straight line. A moment that is not later than the last
  /// one begins anew, with a sensor that has been unloaded for ever; only the last moment itself,
  /// with the same readings, is recorded as it was. What is recorded thus follows from the readings
  /// since then alone, noise included.
  ///
  /// @param time      [s]
  /// @param readings  before the effects; as many as ever
  void apply(double time, std::span<double> readings);

 private:
  void record(double time, std::span<const double> pure);

  std::function<SignalPath()> make_path_;
  double aperture_;
  SignalPath path_{};
  std::optional<double> time_{};    // of the last moment; absent: at rest
  std::vector<double> pure_{};      // at that time, before the effects
  std::vector<double> recorded_{};  // after them
};

/// One sensor of a scene and what it remembers. Not thread-safe.
///
/// @tparam Model  what all sensors of the scene share: `PadModel`, `SkinPadModel`
template <typename Model>
class SimulatedPadOf {
 public:
  explicit SimulatedPadOf(std::shared_ptr<const Model> model)
      : model_(std::move(model)),
        signal_([shared = model_] { return shared->path(); }, model_->aperture()) {}

  /// What the sensor records at a moment, through all of the scene's effects: as `PadSignal`.
  ///
  /// @param time      [s]
  /// @param readings  in the sensor's order
  void read(double time, std::span<const typename Model::Patch> patches,
            std::span<double> readings) {
    model_->readings(patches, readings);
    signal_.apply(time, readings);
  }

 private:
  std::shared_ptr<const Model> model_;
  PadSignal signal_;
};

/// The sampling window [s]; 0: readings are taken in a moment.
[[nodiscard]] inline double aperture_of(const SensorEffects& effects) noexcept {
  return effects.sampling ? effects.sampling->aperture : 0.0;
}

}  // namespace tactile_net::lab
