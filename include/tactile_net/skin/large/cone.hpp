/// @file
/// A large skin's tractions under what contact allows (target tactile_net::spectral): the minimum
/// of inverse/cone_tikhonov.hpp without its matrix.
///
/// Accelerated projected gradients (Nesterov 1983; Beck and Teboulle 2009) that start anew where
/// they would go uphill (O'Donoghue and Candes 2015), with a step that is shortened until it holds:
/// a product with K and one with its transposed a step, and no inner solve. Small alphas take many.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/skin/large/system.hpp"

namespace tactile_net {

class LargeSkinCone {
 public:
  /// @throw std::invalid_argument  alpha is not > 0; friction_limit is not > 0, or there is one
  ///                               component only
  LargeSkinCone(std::shared_ptr<LargeSkinSystem> system, double alpha,
                const Constraints& constraints);
  ~LargeSkinCone();
  LargeSkinCone(LargeSkinCone&&) noexcept;
  LargeSkinCone& operator=(LargeSkinCone&&) noexcept;

  /// One frame, from 0, whatever was solved before. Uses the system's buffers: not for two threads
  /// at once. `too_large` if any weighted reading or traction would not be finite.
  ///
  /// @param iteration_limit  steps after which the best so far is returned, with its verdict
  /// @param enough           `ConeSolution::residual` at which the iteration ends
  /// @param explained        |W (K f - g)|_2 at which the iteration ends too, with the verdict `ok`
  [[nodiscard]] ConeSolution solve(std::span<const double> readings,
                                   std::size_t iteration_limit = 2000, double enough = 1e-6,
                                   double explained = 0.0) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tactile_net
