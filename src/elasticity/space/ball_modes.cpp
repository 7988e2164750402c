#include "elasticity/space/ball_modes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tactile_net {
namespace {

/// One solution at one radius r.
struct BallSolution {
  double radial, along, stress, shear, slope;  // U, V, S, T, U'
};

/// Of phi = (r / a)^(m - 1) r Y, a solid harmonic of degree m whose face is at r = a.
struct SolidHarmonic {
  double nu;
  double m;
  double size;  // of the degree

  /// grad phi, over the degree.
  [[nodiscard]] BallSolution first(double r, double power) const noexcept {
    const double p = power / size;
    const double slope = m * (m - 1.0) * p / r;
    return {m * p, p, 2.0 * slope, 2.0 * (m - 1.0) * p / r, slope};
  }

  /// D (r^2 - a^2) grad phi + N phi r e_r, over the degree.
  ///
  /// @param rise  r^2 - a^2
  [[nodiscard]] BallSolution second(double r, double power, double rise) const noexcept {
    const double d = m + 5.0 - 4.0 * nu;
    const double n = -2.0 * (2.0 * nu * m + (3.0 * m + 1.0) * (1.0 - 2.0 * nu));
    const double p = power / size;
    const double rr = r * r;
    const double slope = (m * d * (2.0 * rr + (m - 1.0) * rise) + n * (m + 1.0) * rr) * p / r;
    return {(m * d * rise + n * rr) * p, d * rise * p,
            2.0 * slope - 4.0 * nu * (2.0 * m + 3.0) * (m + 1.0) * r * p,
            (2.0 * d * (rr + (m - 1.0) * rise) + n * rr) * p / r, slope};
  }
};

/// Rows of a 4 x 4 system with two right sides, solved in place.
using BallSystem = std::array<std::array<double, 6>, 4>;

void eliminate(BallSystem& rows) noexcept {
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 4; ++i)
      if (std::abs(rows[i][k]) > std::abs(rows[pivot][k])) pivot = i;
    std::swap(rows[k], rows[pivot]);
    for (std::size_t i = 0; i < 4; ++i) {
      if (i == k) continue;
      const double factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j < 6; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 4; j < 6; ++j) rows[k][j] /= rows[k][k];
}

}  // namespace

BallModes::BallModes(double nu, double curvature, double depth) noexcept
    : nu_(nu),
      core_(1.0 - curvature),
      log_core_(std::log1p(-curvature)),
      log_place_(std::log1p(-curvature * depth)),
      place_(1.0 - curvature * depth),
      core_rise_(-curvature * (2.0 - curvature)),
      place_rise_(-curvature * depth * (2.0 - curvature * depth)),
      place_rest_(curvature * (1.0 - depth) * (2.0 - curvature * (1.0 + depth))) {}

std::size_t BallModes::degrees() const noexcept {
  return 8 + static_cast<std::size_t>(std::ceil(40.0 / std::abs(log_place_)));
}

BallMode BallModes::breathing() const noexcept {
  const double ratio = std::exp(3.0 * (log_core_ - log_place_));
  const double m = 1.0 - 2.0 * nu_;
  const double scale = 1.0 / (2.0 * (1.0 + nu_) + 4.0 * m * core_ * core_ * core_);
  const double stretch = m * -std::expm1(3.0 * (log_core_ - log_place_)) * scale;  // U / r
  const double stress = (2.0 * (1.0 + nu_) + 4.0 * m * ratio) * scale;
  const double slope = m * (1.0 + 2.0 * ratio) * scale;
  return {.normal = {.radial = stretch * place_,
                     .stress = stress,
                     .mean_along = 2.0 * stretch + stress - 2.0 * slope}};
}

BallMode BallModes::operator()(std::size_t degree) const noexcept {
  if (degree == 0) return breathing();
  const auto n = static_cast<double>(degree);
  const bool cup = log_core_ > 0.0;
  // Of the surface's face and of the core's: the one grows with r, the other falls.
  const SolidHarmonic outer{nu_, cup ? -n - 1.0 : n, n};
  const SolidHarmonic inner{nu_, cup ? n : -n - 1.0, n};
  const double outer_at_place = std::exp((outer.m - 1.0) * log_place_);
  const double outer_at_core = std::exp((outer.m - 1.0) * log_core_);
  const double inner_at_place = std::exp((inner.m - 1.0) * (log_place_ - log_core_));
  const double inner_at_surface = std::exp((1.0 - inner.m) * log_core_);

  const std::array at_surface = {outer.first(1.0, 1.0), outer.second(1.0, 1.0, 0.0),
                                 inner.first(1.0, inner_at_surface),
                                 inner.second(1.0, inner_at_surface, -core_rise_)};
  const std::array at_core = {outer.first(core_, outer_at_core),
                              outer.second(core_, outer_at_core, core_rise_),
                              inner.first(core_, 1.0), inner.second(core_, 1.0, 0.0)};
  BallSystem rows{};
  for (std::size_t j = 0; j < 4; ++j) {
    rows[0][j] = at_surface[j].stress / n;
    rows[1][j] = at_surface[j].shear;
    rows[2][j] = at_core[j].radial;
    rows[3][j] = at_core[j].along * n;
  }
  rows[0][4] = 1.0 / n;
  rows[1][5] = 1.0;
  eliminate(rows);

  const std::array at_place = {
      outer.first(place_, outer_at_place), outer.second(place_, outer_at_place, place_rise_),
      inner.first(place_, inner_at_place), inner.second(place_, inner_at_place, place_rest_)};
  const auto spheroidal = [&](std::size_t load) {
    BallMode::Spheroidal sum;
    double slope = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
      const double weight = rows[j][4 + load];
      sum.radial += weight * at_place[j].radial;
      sum.along += weight * at_place[j].along;
      sum.stress += weight * at_place[j].stress;
      sum.shear += weight * at_place[j].shear;
      slope += weight * at_place[j].slope;
    }
    sum.mean_along =
        (2.0 * sum.radial - n * (n + 1.0) * sum.along) / place_ + sum.stress - 2.0 * slope;
    return sum;
  };
  BallMode mode{.normal = spheroidal(0), .tangential = spheroidal(1)};

  // r^e and r^f, 0 at the core.
  const double e = outer.m;
  const double f = inner.m;
  const double at_rim = 1.0 / (e - 1.0 - (f - 1.0) * std::exp((e - f) * log_core_));
  const double inner_share = std::exp((e - f) * (log_core_ - log_place_));
  const double power = std::exp(e * log_place_);
  mode.twist = at_rim * power * -std::expm1((e - f) * (log_core_ - log_place_));
  mode.twist_shear = at_rim * power * (e - 1.0 - (f - 1.0) * inner_share) / place_;
  return mode;
}

}  // namespace tactile_net
