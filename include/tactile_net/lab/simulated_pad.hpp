/// @file
/// A scene's sensor inside somebody else's simulation, moment by moment.
///
///     const auto model = std::make_shared<const lab::PadModel>(read_scene("pad.toml"));
///     lab::SimulatedPad pad(model);
///     pad.read(time, contact_patches(points, model->scene.material, widths).loads, readings);
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "tactile_net/elasticity/patch_kernel.hpp"
#include "tactile_net/lab/pad_signal.hpp"
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
  explicit SimulatedPad(std::shared_ptr<const PadModel> model);

  /// What the sensor records at a moment, through all of the scene's effects: as `PadSignal`.
  ///
  /// @param time      [s]
  /// @param readings  channels x count
  void read(double time, std::span<const LoadPatch> patches, std::span<double> readings);

 private:
  std::shared_ptr<const PadModel> model_;
  PadSignal signal_;
};

}  // namespace tactile_net::lab
