/// @file
/// The forward model for loads that change at every moment: no integral, no allocation.
///
///     const PatchModel model(array, silicone);
///     model.readings(patches, g);  // some microseconds
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/patch_kernel.hpp"
#include "tactile_net/sensing/aperture.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

class PatchModel {
 public:
  /// @throw std::invalid_argument  the array or the material is out of range, or does not hold it
  PatchModel(const SensorArray& array, const Material& material);

  /// Readings under patches: the sum over them, by `PatchKernel`; no patch: zeros. Const: threads
  /// may share a model.
  ///
  /// @param readings  channels x count, as many as the array has
  void readings(std::span<const LoadPatch> patches, std::span<double> readings) const noexcept;

 private:
  /// Taxels at one depth, of one width, that read the same quantities.
  struct Kind {
    PatchKernel kernel;
    Aperture aperture;
    std::size_t quantities;
    std::vector<double> y{};             // of each of them
    std::vector<std::size_t> targets{};  // of each and each quantity, which reading it is
  };
  std::vector<Kind> kinds_;
};

}  // namespace tactile_net
