#include "tactile_net/calibration/ball_contact.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "calibration/layered_contact.hpp"
#include "calibration/surface_compliance.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/dual.hpp"
#include "numeric/eigen.hpp"
#include "numeric/gauss_rule.hpp"

namespace tactile_net {
namespace {

/// phi at Gauss' points and, last, at the edge.
LayerFactor ball_layer_factor(Base base, double nu, double ratio) {
  const GaussRule rule = gauss_rule<20>();
  constexpr int panels = 5;
  constexpr Eigen::Index size = 21;
  constexpr Eigen::Index edge = size - 1;
  Eigen::VectorXd t(size);
  Eigen::VectorXd weight(size);
  Eigen::Index point = 0;
  for (std::size_t i = 0; i < rule.abscissa.size(); ++i)
    for (const double sign : {-1.0, 1.0}) {
      t(point) = 0.5 + 0.5 * sign * rule.abscissa[i];
      weight(point++) = 0.5 * rule.weights[i];
    }
  t(edge) = 1.0;
  weight(edge) = 0.0;

  Eigen::MatrixXd kernel = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd by_ratio = kernel;
  Eigen::MatrixXd by_nu = kernel;
  const double width = largest_compliance_wave / panels;
  for (int panel = 0; panel < panels; ++panel)
    for (std::size_t i = 0; i < rule.abscissa.size(); ++i)
      for (const double sign : {-1.0, 1.0}) {
        const double H = (panel + 0.5 + 0.5 * sign * rule.abscissa[i]) * width;
        const double step = width * rule.weights[i] / std::numbers::pi;  // 2/pi, half a panel
        const Dual<1> change = compliance_change(base, Dual<1>::seed(nu, 0), H);
        const Eigen::VectorXd cosine = (H * ratio * t).array().cos();
        const Eigen::VectorXd slope = -(H * t).array() * (H * ratio * t).array().sin();
        const Eigen::MatrixXd both = cosine * cosine.transpose();
        const Eigen::MatrixXd turned = slope * cosine.transpose();
        kernel += step * ratio * change.value * both;
        by_nu += step * ratio * change.slope[0] * both;
        by_ratio += step * change.value * (both + ratio * (turned + turned.transpose()));
      }
  const auto weighted = [&](const Eigen::MatrixXd& rows) {
    return Eigen::MatrixXd(rows * weight.asDiagonal());
  };
  const Lu lu(Eigen::MatrixXd(Eigen::MatrixXd::Identity(size, size) + weighted(kernel)));
  // phi = d one - square, and d such that it ends at the edge.
  const Eigen::VectorXd one = lu.solve(Eigen::VectorXd(Eigen::VectorXd::Ones(size)));
  const Eigen::VectorXd square = lu.solve(Eigen::VectorXd(t.cwiseAbs2()));
  const double d = square(edge) / one(edge);
  const Eigen::VectorXd phi = d * one - square;
  const auto slope = [&](const Eigen::MatrixXd& by) {
    const Eigen::VectorXd change = -lu.solve(Eigen::VectorXd(weighted(by) * phi));
    return 1.5 * weight.dot(change - change(edge) / one(edge) * one);
  };
  return {1.5 * weight.dot(phi), slope(by_ratio), slope(by_nu)};
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
