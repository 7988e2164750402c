/// @file
/// What the rules for alpha ask of a large skin (target tactile_net::spectral).
///
/// Rules ask for sums F = u' phi(A A') u, A = W K L^-1, with u the frame, and for traces of such
/// functions. A run of Golub and Kahan's bidiagonalisation from u gives nodes and weights that
/// stand for the spectrum of A A' as u sees it, for every alpha at once (Gauss quadrature; Golub
/// and Meurant, Matrices, Moments and Quadrature, 2010). Traces are means over probes of random
/// signs (Hutchinson 1990), always the same: equal input, equal bytes.
///
/// A run ends where the frame's fit stands still to 1e-3 for eight decades of alpha; a trace has
/// the deviation of its probes. The tests hold alpha to 15 % of that of all singular values, and
/// the tractions to 3 %.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/inverse/active_face.hpp"
#include "tactile_net/inverse/filter_frame.hpp"
#include "tactile_net/skin/large/tikhonov.hpp"

namespace tactile_net {

class LargeSkinFamily {
 public:
  /// Runs the probes: up to 300 products with K and its transposed for each.
  ///
  /// @param probes  >= 1
  explicit LargeSkinFamily(const std::shared_ptr<LargeSkinSystem>& system, std::size_t probes = 4);
  explicit LargeSkinFamily(const LargeSkinTikhonov& solver, std::size_t probes = 4);
  /// The family on a face of the friction cones: directions that the face holds are no unknowns.
  /// @throw std::invalid_argument  the face leaves nothing free, or is of another problem
  LargeSkinFamily(const std::shared_ptr<LargeSkinSystem>& system, const ActiveFace& face,
                  std::size_t probes = 4);
  /// Reuses the probes of `like`, the same skin before these taxels died; needs no product. Traces
  /// err by about the fraction of dead taxels; some hundredths are less than the probes' own
  /// deviation.
  LargeSkinFamily(const std::shared_ptr<LargeSkinSystem>& system, const LargeSkinFamily& like);
  ~LargeSkinFamily();
  LargeSkinFamily(LargeSkinFamily&&) noexcept;
  LargeSkinFamily& operator=(LargeSkinFamily&&) noexcept;

  /// The frame for the rules for alpha, with `shares` and `powers`: nodes of the probes, then of
  /// the frame. Costs one run.
  /// @throw std::invalid_argument  readings have the wrong size or are not finite
  [[nodiscard]] FilterFrame analyse(std::span<const double> readings) const;

  /// tr H: degrees of freedom that the tractions of one alpha use up, estimated by the probes.
  [[nodiscard]] double degrees_of_freedom(double alpha) const noexcept;
  /// Standard deviation of `degrees_of_freedom`, from the spread of the probes; 0 with one probe.
  [[nodiscard]] double degrees_deviation(double alpha) const noexcept;

  /// Upper bound of `TikhonovFamily::condition`, with the largest node for the largest singular
  /// value.
  [[nodiscard]] double condition(double alpha) const noexcept;
  /// Upper bound of `TikhonovFamily::stacked_condition`, with the largest node for the largest
  /// singular value.
  [[nodiscard]] double stacked_condition(double alpha) const noexcept;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace tactile_net
