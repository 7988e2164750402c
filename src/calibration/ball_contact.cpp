#include "tactile_net/calibration/ball_contact.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "calibration/layered_contact.hpp"
#include "calibration/surface_compliance.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/dual.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

/// phi at Gauss' points and, last, at the edge.
LayerFactor ball_layer_factor(Base base, double nu, double ratio) {
  constexpr Eigen::Index size = 21;
  constexpr Eigen::Index edge = size - 1;
  Eigen::VectorXd t(size);
  Eigen::VectorXd weight(size);
  Eigen::Index point = 0;
  each_point(0.0, 1.0, [&](double at, double share) {
    t(point) = at;
    weight(point++) = share;
  });
  t(edge) = 1.0;
  weight(edge) = 0.0;

  Eigen::MatrixXd kernel = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd by_ratio = kernel;
  Eigen::MatrixXd by_nu = kernel;
  each_changed_wave(base, nu, [&](double H, double share, const Dual<1>& change) {
    const double step = 2.0 * share / std::numbers::pi;
    const Eigen::VectorXd cosine = (H * ratio * t).array().cos();
    const Eigen::VectorXd slope = -(H * t).array() * (H * ratio * t).array().sin();
    const Eigen::MatrixXd both = cosine * cosine.transpose();
    const Eigen::MatrixXd turned = slope * cosine.transpose();
    kernel += step * ratio * change.value * both;
    by_nu += step * ratio * change.slope[0] * both;
    by_ratio += step * change.value * (both + ratio * (turned + turned.transpose()));
  });
  const auto weighted = [&](const Eigen::MatrixXd& rows) {
    return Eigen::MatrixXd(rows * weight.asDiagonal());
  };
  const Lu lu(Eigen::MatrixXd(Eigen::MatrixXd::Identity(size, size) + weighted(kernel)));
  // phi = d one - square, and d such that it ends at the edge.
  const Eigen::VectorXd one = lu.solve(Eigen::VectorXd(Eigen::VectorXd::Ones(size)));
  const Eigen::VectorXd square = lu.solve(Eigen::VectorXd(t.cwiseAbs2()));
  const Eigen::VectorXd phi = square(edge) / one(edge) * one - square;
  return factor_of_solution(lu, phi, weighted(by_ratio), weighted(by_nu),
                            [&](const Eigen::VectorXd& change) {
                              return 1.5 * weight.dot(change - change(edge) / one(edge) * one);
                            });
}

}  // namespace

ContactForce ball_force(const Material& material, double contact_radius, double radius) {
  const double nu = material.poisson_ratio;
  ContactForce force;
  force.log_force = std::log(4.0 * contact_radius * contact_radius / radius * contact_radius *
                             material.youngs_modulus / (3.0 * (1.0 - nu * nu)));
  force.by_log_half_width = 3.0;
  force.by_poisson_ratio = 2.0 * nu / (1.0 - nu * nu);
  if (!material.layer) return force;
  add_layer(force, *material.layer, nu, contact_radius, ball_layer_factor);
  return force;
}

double ball_contact_radius(const Material& material, double force, double radius) {
  const double nu = material.poisson_ratio;
  const double log_a =
      std::log(3.0 * force * radius * (1.0 - nu * nu) / (4.0 * material.youngs_modulus)) / 3.0;
  return width_under(force, log_a, [&](double a) { return ball_force(material, a, radius); });
}

}  // namespace tactile_net
