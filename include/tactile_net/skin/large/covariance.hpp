/// @file
/// Bands of a large skin (target tactile_net::spectral): as skin/covariance.hpp, without a
/// decomposition of the whole.
///
/// Sums over cells, such as a contact's force, are exact, by one solve each, and none where they
/// follow from sums before; their bits do not depend on what was asked for before. With x = P^-1
/// weights their variance is |W K x|^2 + alpha^2 / prior_alpha |L x|^2. The deviation of a single
/// cell depends on what lies within a few depths: it is taken from a smaller skin of the same
/// taxels, at the same distance from the nearest ends and dead taxels. That is an estimate, and how
/// far it is off is measured: signs at tractions that lie far apart are solved for at once, which
/// gives the deviation of each (probing; Tang and Saad 2012). The tests hold all cells to what is
/// said.
#pragma once

#include <cstddef>
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

/// How far estimated deviations are off: of so many tractions whose deviation was solved for, the
/// estimate over it, less 1; negative where it is too narrow.
struct BandError {
  std::size_t tractions = 0;
  double least = 0.0;
  double most = 0.0;
};

/// What covariances of one solver share, whatever their prior: solves that have been made, and the
/// smaller skin's family.
class LargeSkinBands {
 public:
  /// @param solver   kept by reference; its buffers are used
  /// @param options  as the solver's
  LargeSkinBands(LargeSkinTikhonov& solver, const SkinArray& skin, const Material& material,
                 const SkinProblemOptions& options);
  /// With the smaller skin of another's, of the same taxels, of which others may be dead.
  LargeSkinBands(LargeSkinTikhonov& solver, const LargeSkinBands& like);
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
  /// Of the solver's alpha as it is now, which the solver takes again for whatever is asked for.
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
  /// Of `deviations`, measured by four to six solves at the nearest alphas that are a power of two
  /// from a size of the skin; of other alphas near these what it was there.
  [[nodiscard]] BandError error() const;
  /// Of weights in a single cell as `deviations`.
  [[nodiscard]] double deviation(std::span<const double> weights) const override;
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override;
  [[nodiscard]] double degrees_of_freedom() const noexcept override { return degrees_; }

 private:
  [[nodiscard]] const std::vector<double>& estimates() const;

  LargeSkinBands& bands_;
  double alpha_;
  double prior_alpha_;
  double degrees_;
  mutable std::vector<double> estimates_{};
};

}  // namespace tactile_net
