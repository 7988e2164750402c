/// @file
/// The search for tractions inside friction's cones, and the same without some taxels by what has
/// been factored with them. Private; cone.hpp says what is solved, and how.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "tactile_net/inverse/cone_tikhonov.hpp"

namespace tactile_net {

class ConeSystem;

/// Const, so threads may share one. A copy shares all that was factored.
class ConeSearch {
 public:
  /// @throw std::invalid_argument  as `ConeTikhonov`
  ConeSearch(const LinearProblem& problem, double alpha, const Constraints& constraints);

  /// The search with another alpha, no taxel left out: shares what does not depend on alpha; the
  /// tractions have the same bits as those of a new search.
  /// @throw std::invalid_argument  alpha is not > 0 and finite
  [[nodiscard]] ConeSearch with_alpha(double alpha) const;

  /// The search without these taxels' readings, as if the taxels were dead: one solve with the
  /// shared factors for each of their readings.
  [[nodiscard]] ConeSearch without(std::span<const std::size_t> taxels) const;

  /// The search under another limit of friction; shares the factors.
  /// @pre  limit > 0 and finite, and there are tangential tractions
  [[nodiscard]] ConeSearch with_friction(double limit) const;

  using EarlyStop = ConeTikhonov::EarlyStop;

  /// As `ConeTikhonov::solve`.
  /// @param nearby      tractions [Pa] that obey the constraints, from which fewer steps lead to
  ///                    the same solution; none: steps begin with nothing pressed
  [[nodiscard]] ConeSolution solve(std::span<const double> readings, std::size_t iteration_limit,
                                   double enough, const EarlyStop& stop_early = {},
                                   std::span<const double> nearby = {}) const;

 private:
  struct LeftOut;
  std::shared_ptr<const ConeSystem> system_{};
  std::shared_ptr<const LeftOut> left_out_{};  // absent: nothing is
  Constraints constraints_{};                  // of tractions as the system scales them
};

}  // namespace tactile_net
