/// @file
/// The search for tractions inside friction's cones, and the same without some taxels by what has
/// been factored with them. Private; cone.hpp says what is solved, and how.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "tactile_net/skin/cone.hpp"

namespace tactile_net {

class ConeSystem;

/// Const, so threads may share one. A copy shares all that was factored.
class ConeSearch {
 public:
  /// @throw std::invalid_argument  as `SkinCone`
  ConeSearch(const SkinProblem& problem, double alpha, const Constraints& constraints);

  /// All readings' of another alpha: what does not depend on it is shared, and tractions are those
  /// of a search made anew, to the last bit.
  /// @throw std::invalid_argument  alpha is not > 0 and finite
  [[nodiscard]] ConeSearch with_alpha(double alpha) const;

  /// The same with these taxels' readings left out, as if they had been dead: one solve with what
  /// has been factored for each of their readings.
  [[nodiscard]] ConeSearch without(std::span<const std::size_t> taxels) const;

  /// The same under another limit of friction: what has been factored is shared.
  /// @pre  > 0 and finite, and there are tangential tractions
  [[nodiscard]] ConeSearch with_friction(double limit) const;

  /// Asked after 100 steps, 200, 400, 800 ... whether these tractions [Pa], the last found, say
  /// that more steps are in vain.
  using Hopeless = std::function<bool(std::span<const double> tractions)>;

  /// As `SkinCone::solve`.
  /// @param hopeless  absent: it never is; where it is the verdict is `iteration_limit`
  /// @param nearby    tractions [Pa] that obey the constraints, from which fewer steps lead to the
  ///                  same; none: steps begin with nothing pressed
  [[nodiscard]] SkinConeSolution solve(std::span<const double> readings,
                                       std::size_t iteration_limit, double enough,
                                       const Hopeless& hopeless = {},
                                       std::span<const double> nearby = {}) const;

 private:
  struct LeftOut;
  std::shared_ptr<const ConeSystem> system_{};
  std::shared_ptr<const LeftOut> left_out_{};  // absent: nothing is
  Constraints constraints_{};                  // of tractions as the system scales them
};

}  // namespace tactile_net
