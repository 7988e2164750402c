/// @file
/// A skin inside somebody else's simulation, moment by moment, as `SimulatedPad` is for lines.
///
///     const auto model = std::make_shared<const lab::SkinPadModel>(skin_scene);
///     lab::SimulatedSkinPad pad(model);
///     pad.read(time, skin_loads(points, model->scene.material, 1e-3), readings);
#pragma once

#include <memory>
#include <span>

#include "tactile_net/lab/pad_signal.hpp"
#include "tactile_net/scene/skin_scene.hpp"
#include "tactile_net/skin/forward.hpp"

namespace tactile_net::lab {

/// What all pads of a scene share. Its contacts, [time] and [forward] are not looked at.
struct SkinPadModel {
  /// @throw std::invalid_argument  as `ExactSkinModel`
  explicit SkinPadModel(SkinScene of)
      : scene(std::move(of)), forward(scene.sensor, scene.material) {}

  SkinScene scene;
  ExactSkinModel forward;
};

/// One skin and what it remembers. Not thread-safe.
class SimulatedSkinPad {
 public:
  explicit SimulatedSkinPad(std::shared_ptr<const SkinPadModel> model);

  /// What the skin records at a moment, through all of the scene's effects: as `PadSignal`.
  ///
  /// @param time      [s]
  /// @param readings  in the order of the skin's readings
  /// @throw as `ExactSkinModel::readings`
  void read(double time, std::span<const SkinLoad> loads, std::span<double> readings);

 private:
  std::shared_ptr<const SkinPadModel> model_;
  PadSignal signal_;
};

}  // namespace tactile_net::lab
