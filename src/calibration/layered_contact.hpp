/// @file
/// What the contact of a rod and that of a ball with a layer share. Private.
#pragma once

#include <algorithm>
#include <cmath>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/calibration/rod_contact.hpp"

namespace tactile_net {

constexpr double largest_ratio = 3.0;  // a / h

/// How many times the force of a half space a layer takes, and the derivatives by a/h and by nu.
struct LayerFactor {
  double value = 1.0, by_ratio = 0.0, by_nu = 0.0;
};

/// Of the solution x of A x = b, where the factor is linear in x and A alone depends on a/h and nu.
///
/// @param by_ratio, by_nu  dA
template <class FactorOf>
LayerFactor factor_of_solution(const Lu& a, const Eigen::VectorXd& x,
                               const Eigen::MatrixXd& by_ratio, const Eigen::MatrixXd& by_nu,
                               const FactorOf& factor_of) {
  const auto slope = [&](const Eigen::MatrixXd& by) {
    return factor_of(Eigen::VectorXd(-a.solve(Eigen::VectorXd(by * x))));
  };
  return {factor_of(x), slope(by_ratio), slope(by_nu)};
}

/// A half space's force made that of the layer.
///
/// @param factor_of  base, nu and a/h, at most `largest_ratio`: a `LayerFactor`
template <class FactorOf>
void add_layer(ContactForce& force, const Layer& layer, double nu, double half_width,
               const FactorOf& factor_of) {
  const double ratio = half_width / layer.thickness;
  const LayerFactor b = factor_of(layer.base, nu, std::min(ratio, largest_ratio));
  const double by_log_ratio = ratio < largest_ratio ? b.by_ratio * ratio / b.value : 0.0;
  force.log_force += std::log(b.value);
  force.by_log_half_width += by_log_ratio;
  force.by_log_thickness = -by_log_ratio;
  force.by_poisson_ratio += b.by_nu / b.value;
}

/// The a under a force. Its logarithm of log a is smooth, convex and at least as steep as the half
/// space's: Newton from there converges.
///
/// @param log_a     of the half space
/// @param force_of  a: a `ContactForce`
template <class ForceOf>
double width_under(double force, double log_a, const ForceOf& force_of) {
  for (int step = 0; step < 50; ++step) {
    const ContactForce at = force_of(std::exp(log_a));
    const double change = (std::log(force) - at.log_force) / at.by_log_half_width;
    log_a += change;
    if (std::abs(change) < 1e-14) break;
  }
  return std::exp(log_a);
}

}  // namespace tactile_net
