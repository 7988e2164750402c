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
  using Patch = LoadPatch;

  /// @throw std::invalid_argument  as `PatchModel`
  explicit PadModel(Scene of) : scene(std::move(of)), forward(scene.sensor, scene.material) {}

  void readings(std::span<const LoadPatch> patches, std::span<double> readings) const {
    forward.readings(patches, readings);
  }
  [[nodiscard]] SignalPath path() const { return signal_path(scene); }
  [[nodiscard]] double aperture() const noexcept { return aperture_of(scene); }

  Scene scene;
  PatchModel forward;
};

using SimulatedPad = SimulatedPadOf<PadModel>;

}  // namespace tactile_net::lab
