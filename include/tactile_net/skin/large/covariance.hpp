/// @file
/// Bands of a large skin (target tactile_net::spectral): as inverse/covariance.hpp, without
/// a decomposition of the whole.
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
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/skin/large/tikhonov.hpp"

namespace tactile_net {

/// Relative error of estimated deviations, estimate / solved - 1, over tractions whose deviation
/// was solved for; negative: the estimate is too narrow.
struct BandError {
  std::size_t tractions = 0;  ///< how many were compared
  double least = 0.0;
  double most = 0.0;
};

/// What the covariances of one solver share, whatever their prior: the solves made so far, and the
/// family of the smaller skin.
class LargeSkinBands {
 public:
  /// @param solver   kept by reference; its buffers are used
  /// @param options  as the solver's
  LargeSkinBands(LargeSkinTikhonov& solver, const SkinArray& skin, const Material& material,
                 const SkinProblemOptions& options);
  /// Shares the smaller skin's family with `like`, the bands of a skin of the same taxels, of which
  /// others may be dead.
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
  /// The covariance at the solver's present alpha; the solver returns to it for whatever is asked.
  ///
  /// @param bands               kept by reference
  /// @param prior_alpha         > 0
  /// @param degrees_of_freedom  tr H, by `LargeSkinFamily`
  /// @throw std::invalid_argument  prior_alpha is not > 0 and finite
  LargeSkinCovariance(LargeSkinBands& bands, double prior_alpha, double degrees_of_freedom);

  [[nodiscard]] std::vector<double> deviations() const override;
  /// Estimated as `deviations` are; a window that holds the cell of a dead taxel gets the deviation
  /// of the prior.
  [[nodiscard]] std::vector<double> window_deviations(const SurfaceGrid& grid,
                                                      const CellWindow& window) const override;
  /// Error of `deviations`, measured by four to six solves at the nearest alphas that are a power
  /// of two from a size of the skin; alphas near these share the result.
  [[nodiscard]] BandError error() const;
  /// Exact, by one solve; for weights in a single cell estimated, as `deviations`.
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
