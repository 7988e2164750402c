/// @file
/// What a skin reads under loads: exactly, and by the kernels of a grid's cells.
///
///     const ExactSkinModel model(skin, silicone);
///     model.readings(loads);                               // without discretisation
///     sampled_readings(skin, silicone, grid, cell_means(loads, grid));  // K times unknowns
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/space/skin_kernel.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/grid.hpp"
#include "tactile_net/skin/load.hpp"

namespace tactile_net {

class CurvedReadings;

/// The forward model without discretisation: a test that uses it commits no inverse crime.
///
/// Contacts are read to 1e-10 of about the largest reading of their kind at that depth: of
///
///     3 / (2 pi) (F / r^2 + |torsion| / r^3),  r^2 = a b + depth^2,  F = |force| (1 + |friction|)
///
/// for stresses, times (1 + nu) / E for strains, and times r for displacements; in a layer
/// `SkinKernel::error_bound` times F comes to it. Where that holds is checked at every taxel, by
/// two rules that must agree, and else refused.
///
/// Circles, pushed and dragged, slipping or not, are sources at imaginary depth
/// (elasticity/space/disc.hpp) in a half space, from depths of radius / 64 on. Ellipses, twists,
/// and what a layer's base adds, are point loads summed over rings (docs/internals/space.md):
/// some thousand where the distance to the nearest singularity, the depth, or of the base 2
/// thickness - depth, is about a radius, and radius / distance times as many where it is less;
/// depths of 1e-4 radii are refused. Patches are sums of `SkinKernel`'s rectangles.
///
/// Of a curved skin loads lie on its chart, where their forces are exact, and readings are sums
/// over cells of two spacings, whose fourth power is left: some 1e-4 of the largest reading.
class ExactSkinModel {
 public:
  /// Makes the model; in a layer that takes some milliseconds for each depth, and 0.1 s once in a
  /// process.
  ///
  /// @throw std::invalid_argument  the skin or the material is out of range, a taxel lies below the
  ///                               base
  ExactSkinModel(const SkinArray& skin, const Material& material);

  /// Readings of all taxels, channel after channel: the sum over the loads; no load: zeros. Const
  /// and without state: threads may share a model.
  ///
  /// @throw std::invalid_argument  a load is out of range, or causes a reading that has no value
  ///                               (`check_quantity`)
  /// @throw std::runtime_error     a taxel lies so near below a contact that the rules do not agree
  [[nodiscard]] std::vector<double> readings(std::span<const SkinLoad> loads) const;

 private:
  /// What is read at one place.
  struct Place {
    double y, z;
    std::size_t taxel;
    std::vector<Quantity> quantities{};
    std::vector<std::size_t> targets{};  // of each quantity, which reading it is
  };
  struct Depth {
    double depth;
    SkinKernel kernel;
    std::vector<Place> places{};
  };
  class Summation;

  SkinArray skin_;
  Material material_;
  std::vector<Depth> depths_;
  std::shared_ptr<const CurvedReadings> curved_{};  // null: the skin is flat
};

/// Readings by an `ExactSkinModel` that is made for this call alone.
[[nodiscard]] std::vector<double> exact_readings(const SkinArray& skin, const Material& material,
                                                 std::span<const SkinLoad> loads);

/// The readings that the tractions of a grid's cells cause, K times tractions, by the sum itself.
/// Kernels are computed once; a frame costs its products.
///
///     const SampledSkinModel model(skin, silicone, grid, 3);
///     model.readings(cell_means(loads, grid));
class SampledSkinModel {
 public:
  /// @param components  1: normal tractions alone; 3: all of them
  /// @throw std::invalid_argument  the skin or the material is out of range, a reading has no value
  ///                               under one of the components (`check_quantity`), or taxels beside
  ///                               the grid's lattice take more than `most_kernel_entries` numbers
  SampledSkinModel(const SkinArray& skin, const Material& material, const SurfaceGrid& grid,
                   std::size_t components);

  /// Readings of all taxels, channel after channel. Const and without state: threads may share a
  /// model.
  ///
  /// @param tractions  grid.count() values of each component
  /// @throw std::invalid_argument  the number of tractions does not fit
  [[nodiscard]] std::vector<double> readings(std::span<const double> tractions) const;

 private:
  struct Kernels;
  std::shared_ptr<const Kernels> kernels_;
};

/// Readings by a `SampledSkinModel` that is made for this call alone.
///
/// @param tractions  grid.count() values of each component: one component, normal, or all three
/// @throw std::invalid_argument  as `SampledSkinModel`
[[nodiscard]] std::vector<double> sampled_readings(const SkinArray& skin, const Material& material,
                                                   const SurfaceGrid& grid,
                                                   std::span<const double> tractions);

}  // namespace tactile_net
