/// @file
/// Bands of a large skin (target tactile_net::spectral): as skin/covariance.hpp, without a
/// decomposition of the whole.
///
/// Sums over cells, such as a contact's force, are exact, by one solve each, and none where they
/// follow from sums before: with x = P^-1 weights their variance is |W K x|^2 + alpha^2 /
/// prior_alpha |L x|^2. The deviation of a single cell
/// depends on what lies within a few depths: it is taken from a smaller skin of the same taxels, at
/// the same distance from the nearest ends: an estimate, which the tests hold to be at most 2 % too
/// wide and 10 % too narrow. A cell whose nearest taxel is dead gets the prior's deviation, which
/// is more than it has.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/skin/cell_window.hpp"
#include "tactile_net/skin/family.hpp"
#include "tactile_net/skin/large/tikhonov.hpp"

namespace tactile_net {

/// What covariances of one solver share, whatever their prior: solves that have been made, and the
/// smaller skin's family.
class LargeSkinBands {
 public:
  /// @param solver   kept by reference; its buffers are used
  /// @param options  as the solver's
  LargeSkinBands(LargeSkinTikhonov& solver, const SkinArray& skin, const Material& material,
                 const SkinProblemOptions& options);
  ~LargeSkinBands();
  LargeSkinBands(const LargeSkinBands&) = delete;
  LargeSkinBands& operator=(const LargeSkinBands&) = delete;

 private:
  friend class LargeSkinCovariance;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

class LargeSkinCovariance final : public CellCovariance {
 public:
  /// Of the solver's alpha as it is now; another one starts anew.
  ///
  /// @param bands               kept by reference
  /// @param prior_alpha         > 0
  /// @param degrees_of_freedom  tr H, by `LargeSkinFamily`
  /// @throw std::invalid_argument  prior_alpha is not > 0 and finite
  LargeSkinCovariance(LargeSkinBands& bands, double prior_alpha, double degrees_of_freedom);

  [[nodiscard]] std::vector<double> deviations() const override;
  /// Estimates as `deviations`; a window that a dead taxel's cell is in gets the prior's.
  [[nodiscard]] std::vector<double> window_deviations(const SkinGrid& grid,
                                                      const CellWindow& window) const override;
  /// Of weights in a single cell as `deviations`.
  [[nodiscard]] double deviation(std::span<const double> weights) const override;
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override;
  [[nodiscard]] double degrees_of_freedom() const noexcept override { return degrees_; }

 private:
  /// Of a traction of the smaller skin, that nothing reads.
  [[nodiscard]] double prior_deviation(std::size_t of_piece) const;

  LargeSkinBands& bands_;
  double prior_alpha_;
  double degrees_;
};

}  // namespace tactile_net
