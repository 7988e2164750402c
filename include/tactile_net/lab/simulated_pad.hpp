/// @file
/// A scene's sensor inside somebody else's simulation, moment by moment.
///
///     const auto model = std::make_shared<const lab::PadModel>(read_scene("pad.toml"));
///     lab::SimulatedPad pad(model);
///     pad.read(time, contact_patches(points, model->scene.material, widths).loads, readings);
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tactile_net/elasticity/patch_kernel.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/sensing/patch_model.hpp"

namespace tactile_net::lab {

/// What all pads of a scene share. Its contacts, [time] and [forward] are not looked at.
struct PadModel {
  /// @throw std::invalid_argument  as `PatchModel`
  explicit PadModel(Scene of) : scene(std::move(of)), forward(scene.sensor, scene.material) {}

  Scene scene;
  PatchModel forward;
};

/// One sensor and what it remembers. Not thread-safe.
class SimulatedPad {
 public:
  explicit SimulatedPad(std::shared_ptr<const PadModel> model) : model_(std::move(model)) {}

  /// What the sensor records at a moment, through all of the scene's effects.
  ///
  /// Between two moments every reading is a straight line. A moment that is not later than the last
  /// one begins anew, with a sensor that has been unloaded for ever; only the last moment itself,
  /// under the same loads, reads as it did. What is read thus follows from the loads since then
  /// alone, noise included.
  ///
  /// @param time      [s]
  /// @param readings  channels x count
  void read(double time, std::span<const LoadPatch> patches, std::span<double> readings);

 private:
  void record(double time, std::span<const double> pure);

  std::shared_ptr<const PadModel> model_;
  SignalPath path_{};
  std::optional<double> time_{};    // of the last moment; absent: at rest
  std::vector<double> pure_{};      // at that time, before the effects
  std::vector<double> recorded_{};  // after them
};

}  // namespace tactile_net::lab
