/// @file
/// A skin inside somebody else's simulation, moment by moment, as `SimulatedPad` is for lines.
///
///     const auto model = std::make_shared<const lab::SkinPadModel>(skin_scene);
///     lab::SimulatedSkinPad pad(model);
///     pad.read(time, skin_patches(points, model->scene().material, 1e-3, model->grid()),
///     readings);
#pragma once

#include <array>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/elasticity/space/skin_kernel.hpp"
#include "tactile_net/lab/pad_signal.hpp"
#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/scene/skin_scene.hpp"
#include "tactile_net/skin/load.hpp"

namespace tactile_net::lab {

/// What all pads of a scene share. Its contacts, [time], [forward] and [reconstruct] are not looked
/// at.
///
/// Readings are made cell by cell from a table: of cells a third of the least depth wide, or as
/// wide as a table of 256 MB takes, that reach three depths beyond the taxels. A cell's force
/// counts as a point load's; of a Hertzian contact two depths wide that is right to a per cent.
class SkinPadModel {
 public:
  using Patch = SampledPatch;

  /// @throw std::invalid_argument  as `make_problem`; or cells as wide as the least depth would
  ///                               still take more
  explicit SkinPadModel(SkinScene scene);

  [[nodiscard]] const SkinScene& scene() const noexcept { return scene_; }
  /// Of the table.
  [[nodiscard]] const SurfaceGrid& grid() const noexcept { return grid_; }

  /// What patches on cells of `grid`, and of its continuation, cause before all effects.
  ///
  /// @param readings  in the order of the skin's readings
  void readings(std::span<const SampledPatch> patches, std::span<double> readings) const;
  [[nodiscard]] SignalPath path() const { return signal_path(scene_); }
  [[nodiscard]] double aperture() const noexcept { return aperture_of(scene_); }

 private:
  void add_beyond(double y, double z, const std::array<double, 3>& tractions,
                  std::span<double> readings) const;

  SkinScene scene_;
  SurfaceGrid grid_;
  Matrix table_;  // (three components x cells) x readings
  std::vector<Site> sites_;
  std::map<double, SkinKernel> kernels_{};  // of each depth
};

using SimulatedSkinPad = SimulatedPadOf<SkinPadModel>;

}  // namespace tactile_net::lab
