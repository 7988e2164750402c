#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "calibration/wave_nodes.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/dual.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/calibration/ball_contact.hpp"
#include "tactile_net/calibration/rod_contact.hpp"

namespace tactile_net {
namespace {

constexpr double largest_ratio = 3.0;  // a / h

/// H = k h up to which what follows counts: it is exp(-2 H) H^2 there.
constexpr double largest_compliance_wave = 20.0;

/// Compliance of the layer over that of the half space, minus 1: the formulas of rod_contact.hpp.
/// Plane strain and space have the same. With its slope by nu.
Dual<1> compliance_change(Base base, const Dual<1>& nu, double H) {
  const double decay = std::exp(-2.0 * H);  // of cosh 2H and sinh 2H, both times it
  const double cosh = 0.5 * (1.0 + decay * decay);
  const double sinh = -0.5 * std::expm1(-4.0 * H);
  if (base == Base::frictionless)
    return (cosh - decay - sinh - 2.0 * H * decay) / (sinh + 2.0 * H * decay);
  const Dual<1> kappa = 3.0 - 4.0 * nu;
  const Dual<1> below = kappa * cosh + (2.0 * H * H + 5.0 - 12.0 * nu + 8.0 * nu * nu) * decay;
  return (kappa * sinh - 2.0 * H * decay) / below - 1.0;
}

/// Calls of(H, weight, change of the compliance) for the waves that a layer changes.
template <class Of>
void each_changed_wave(Base base, double nu, const Of& of) {
  constexpr int panels = 5;
  constexpr double width = largest_compliance_wave / panels;
  for (int panel = 0; panel < panels; ++panel)
    each_point(panel * width, width, [&](double H, double weight) {
      of(H, weight, compliance_change(base, Dual<1>::seed(nu, 0), H));
    });
}

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

constexpr std::size_t series_terms = 8;

/// J_0 ... J_last at z by the recurrence downwards.
std::vector<double> bessel(std::size_t last, double z) {
  std::vector<double> j(last + 1);
  if (z < 1e-12) {
    j[0] = 1.0;
    if (last > 0) j[1] = 0.5 * z;
    return j;
  }
  const auto start = 2 * ((std::max(last, static_cast<std::size_t>(z)) + 40) / 2);
  double above = 0.0;
  double here = 1e-300;
  double sum = 0.0;  // J_0 + 2 (J_2 + J_4 + ...) = 1
  for (std::size_t n = start; n > 0; --n) {
    const double below = 2.0 * static_cast<double>(n) / z * here - above;
    above = here;
    here = below;
    if (n - 1 <= last) j[n - 1] = here;
    if ((n - 1) % 2 == 0) sum += (n == 1 ? 1.0 : 2.0) * here;
    if (std::abs(here) > 1e200) {
      here *= 1e-200;
      above *= 1e-200;
      sum *= 1e-200;
      for (double& value : j) value *= 1e-200;
    }
  }
  for (double& value : j) value /= sum;
  return j;
}

/// b_0 and its derivatives by a/h and by nu.
LayerFactor rod_layer_factor(Base base, double nu, double ratio) {
  constexpr auto size = static_cast<Eigen::Index>(series_terms);
  std::array<double, series_terms> t{};
  Eigen::MatrixXd system(size, size);
  Eigen::MatrixXd by_ratio(size, size);
  Eigen::MatrixXd by_nu(size, size);
  Eigen::VectorXd right(size);
  for (std::size_t i = 0; i < series_terms; ++i) {
    const double angle = std::numbers::pi * (2.0 * static_cast<double>(i) + 1.0) /
                         (4.0 * static_cast<double>(series_terms));
    t[i] = std::cos(angle);
    right(static_cast<Eigen::Index>(i)) = t[i];
    for (std::size_t m = 0; m < series_terms; ++m)
      system(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(m)) =
          std::cos((2.0 * static_cast<double>(m) + 1.0) * angle);
  }
  by_ratio.setZero();
  by_nu.setZero();
  each_changed_wave(base, nu, [&](double H, double weight, const Dual<1>& change) {
    const std::vector<double> j = bessel(2 * series_terms, H * ratio);
    for (std::size_t m = 0; m < series_terms; ++m) {
      const double order = 2.0 * static_cast<double>(m) + 1.0;
      const double share = (m % 2 == 0 ? order : -order) * weight / H;
      const double load = share * j[2 * m + 1];
      const double slope = share * 0.5 * (j[2 * m] - j[2 * m + 2]) * H;  // by the ratio
      for (std::size_t i = 0; i < series_terms; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const auto column = static_cast<Eigen::Index>(m);
        const double sine = std::sin(H * ratio * t[i]);
        const double cosine = std::cos(H * ratio * t[i]);
        system(row, column) += change.value * load * sine;
        by_nu(row, column) += change.slope[0] * load * sine;
        by_ratio(row, column) += change.value * (slope * sine + load * H * t[i] * cosine);
      }
    }
  });
  const Lu lu(system);
  return factor_of_solution(lu, lu.solve(right), by_ratio, by_nu,
                            [](const Eigen::VectorXd& b) { return b(0); });
}

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

ContactForce rod_force(const Material& material, double half_width, double radius) {
  const double nu = material.poisson_ratio;
  ContactForce force;
  force.log_force = std::log(std::numbers::pi * half_width / radius * half_width *
                             material.youngs_modulus / (4.0 * (1.0 - nu * nu)));
  force.by_poisson_ratio = 2.0 * nu / (1.0 - nu * nu);
  if (!material.layer) return force;
  add_layer(force, *material.layer, nu, half_width, rod_layer_factor);
  return force;
}

double rod_half_width(const Material& material, double force, double radius) {
  const double nu = material.poisson_ratio;
  const double log_a = 0.5 * std::log(4.0 * force * radius * (1.0 - nu * nu) /
                                      (std::numbers::pi * material.youngs_modulus));
  return width_under(force, log_a, [&](double a) { return rod_force(material, a, radius); });
}

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
