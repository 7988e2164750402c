/// @file
/// What cells cause at taxels on their lattice, by FFT (target tactile_net::spectral).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/grid.hpp"

namespace tactile_net {

/// K times one vector of tractions after another: a two-dimensional convolution, on a plane of
/// twice as many rows and columns, in which nothing meets what it should not.
///
/// A frame takes one transform for each component, and one back for each channel. One object per
/// thread; the constructor plans.
class SpectralSkinModel {
 public:
  /// @throw std::invalid_argument  the skin or the material is out of range, the taxels do not lie
  ///                               on the grid's lattice, or a reading has no value under tractions
  ///                               of `components`
  /// @param components  1 (normal) or 3
  SpectralSkinModel(const SkinArray& skin, const Material& material, const SurfaceGrid& grid,
                    std::size_t components = 3);
  ~SpectralSkinModel();
  SpectralSkinModel(SpectralSkinModel&&) noexcept;
  SpectralSkinModel& operator=(SpectralSkinModel&&) noexcept;

  /// The readings of `sampled_readings`; each component's share is equal to it within 1e-13 of
  /// max|kernel| * sum|traction|.
  ///
  /// @param tractions  components * grid.count() values
  /// @throw std::invalid_argument  the number of tractions does not fit
  [[nodiscard]] std::vector<double> readings(std::span<const double> tractions);

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace tactile_net
