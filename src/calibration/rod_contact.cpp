#include "tactile_net/calibration/rod_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "calibration/layered_contact.hpp"
#include "calibration/surface_compliance.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/dual.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

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

}  // namespace tactile_net
