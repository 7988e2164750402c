/// @file
/// A network's equations once the nodes that nothing drives have followed its amplifiers. Private.
#pragma once

#include "numeric/eigen.hpp"
#include "tactile_net/network/reduction.hpp"

namespace tactile_net {

/// Rows and columns are the amplifiers', in the order of their rows in `Equations`: their inputs
/// have voltages s with inertia s = -stiffness x + ..., and x' = 2 pi bandwidth s.
struct AmplifierEquations {
  Eigen::MatrixXd stiffness{};  ///< [S]
  Eigen::MatrixXd inertia{};    ///< [S]
  /// Of the nodes that follow: their own conductances, what the amplifiers' inputs add to them, and
  /// what they add to the amplifiers' rows; empty where there are none.
  Eigen::MatrixXd followers{}, from_inputs{}, into_rows{};
};

[[nodiscard]] AmplifierEquations amplifier_equations(const Reduction& reduction,
                                                     const Equations& equations);

}  // namespace tactile_net
