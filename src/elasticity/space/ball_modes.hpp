/// @file
/// A layer on a rigid ball under a traction that is one spherical harmonic. Private.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "numeric/dual.hpp"

namespace tactile_net {

/// What a traction of degree n causes at one depth, at the unit sphere's gradients: with Y a
/// harmonic, the displacement U Y e_r + V grad Y + W e_r x grad Y and the stress s_rr = S Y,
/// s_r. = T grad Y + T_W e_r x grad Y, in tension; the surface's radius and G are 1.
template <class Number>
struct BallModeOf {
  /// Under a traction of the kinds U and V.
  struct Spheroidal {
    Number radial = 0.0;      ///< U
    Number along = 0.0;       ///< V
    Number stress = 0.0;      ///< S
    Number shear = 0.0;       ///< T
    Number mean_along = 0.0;  ///< half the trace of the stress along the sphere, over Y
  };
  Spheroidal normal{};       ///< under s_rr = Y
  Spheroidal tangential{};   ///< under s_r. = grad Y
  Number twist = 0.0;        ///< W under s_r. = e_r x grad Y
  Number twist_shear = 0.0;  ///< T_W
};
using BallMode = BallModeOf<double>;

/// The modes of one layer at one depth, by Love's solid harmonics (1927, article 172; in the notes
/// of docs/internals/space.md). Their powers are scaled to be 1 at the face to which they belong,
/// so that none overflows, and the second of each pair vanishes there but for its radial part, so
/// that the two stay apart at every degree. Nothing is divided by 1 - 2 nu.
template <class Number>
class BallModesOf {
 public:
  /// @param nu         Poisson's ratio, [0, 0.5]
  /// @param curvature  thickness over radius: in (0, 1) on a ball, < 0 in a cup
  /// @param depth      [0, 1], in units of the thickness
  BallModesOf(const Number& nu, const Number& curvature, const Number& depth) noexcept;

  /// @param degree  any
  [[nodiscard]] BallModeOf<Number> operator()(std::size_t degree) const noexcept;

  /// Degrees that matter: those beyond are below exp(-40) of the largest.
  [[nodiscard]] std::size_t degrees() const noexcept {
    return 8 + static_cast<std::size_t>(std::ceil(40.0 / std::abs(plain(log_place_))));
  }

 private:
  [[nodiscard]] BallModeOf<Number> breathing() const noexcept;

  Number nu_;
  Number core_;        // its radius
  Number log_core_;    // the logarithm of it
  Number log_place_;   // and of the place's radius, which lies between 0 and the former
  Number place_;       // the place's radius
  Number core_rise_;   // core^2 - 1
  Number place_rise_;  // place^2 - 1
  Number place_rest_;  // place^2 - core^2
};
using BallModes = BallModesOf<double>;

/// One solution at one radius r.
template <class Number>
struct BallSolution {
  Number radial, along, stress, shear, slope;  // U, V, S, T, U'
};

/// Of phi = (r / a)^(m - 1) r Y, a solid harmonic of degree m whose face is at r = a.
template <class Number>
struct SolidHarmonic {
  Number nu;
  double m;
  double size;  // of the degree

  /// grad phi, over the degree.
  [[nodiscard]] BallSolution<Number> first(const Number& r, const Number& power) const noexcept {
    const Number p = power / size;
    const Number slope = m * (m - 1.0) * p / r;
    return {m * p, p, 2.0 * slope, 2.0 * (m - 1.0) * p / r, slope};
  }

  /// D (r^2 - a^2) grad phi + N phi r e_r, over the degree.
  ///
  /// @param rise  r^2 - a^2
  [[nodiscard]] BallSolution<Number> second(const Number& r, const Number& power,
                                            const Number& rise) const noexcept {
    const Number d = m + 5.0 - 4.0 * nu;
    const Number n = -2.0 * (2.0 * nu * m + (3.0 * m + 1.0) * (1.0 - 2.0 * nu));
    const Number p = power / size;
    const Number rr = r * r;
    const Number slope = (m * d * (2.0 * rr + (m - 1.0) * rise) + n * (m + 1.0) * rr) * p / r;
    return {(m * d * rise + n * rr) * p, d * rise * p,
            2.0 * slope - 4.0 * nu * (2.0 * m + 3.0) * (m + 1.0) * r * p,
            (2.0 * d * (rr + (m - 1.0) * rise) + n * rr) * p / r, slope};
  }
};

/// Rows of a 4 x 4 system with two right sides, solved in place.
template <class Number>
using BallSystem = std::array<std::array<Number, 6>, 4>;

template <class Number>
void eliminate(BallSystem<Number>& rows) noexcept {
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 4; ++i)
      if (std::abs(plain(rows[i][k])) > std::abs(plain(rows[pivot][k]))) pivot = i;
    std::swap(rows[k], rows[pivot]);
    for (std::size_t i = 0; i < 4; ++i) {
      if (i == k) continue;
      const Number factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j < 6; ++j) rows[i][j] = rows[i][j] - factor * rows[k][j];
    }
  }
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 4; j < 6; ++j) rows[k][j] = rows[k][j] / rows[k][k];
}

template <class Number>
BallModesOf<Number>::BallModesOf(const Number& nu, const Number& curvature,
                                 const Number& depth) noexcept
    : nu_(nu),
      core_(1.0 - curvature),
      log_core_(log1p(-curvature)),
      log_place_(log1p(-curvature * depth)),
      place_(1.0 - curvature * depth),
      core_rise_(-curvature * (2.0 - curvature)),
      place_rise_(-curvature * depth * (2.0 - curvature * depth)),
      place_rest_(curvature * (1.0 - depth) * (2.0 - curvature * (1.0 + depth))) {}

template <class Number>
BallModeOf<Number> BallModesOf<Number>::breathing() const noexcept {
  using std::exp, std::expm1;
  const Number ratio = exp(3.0 * (log_core_ - log_place_));
  const Number m = 1.0 - 2.0 * nu_;
  const Number scale = 1.0 / (2.0 * (1.0 + nu_) + 4.0 * m * core_ * core_ * core_);
  const Number stretch = m * -expm1(3.0 * (log_core_ - log_place_)) * scale;  // U / r
  const Number stress = (2.0 * (1.0 + nu_) + 4.0 * m * ratio) * scale;
  const Number slope = m * (1.0 + 2.0 * ratio) * scale;
  return {.normal = {.radial = stretch * place_,
                     .stress = stress,
                     .mean_along = 2.0 * stretch + stress - 2.0 * slope}};
}

template <class Number>
BallModeOf<Number> BallModesOf<Number>::operator()(std::size_t degree) const noexcept {
  using std::exp, std::expm1;
  if (degree == 0) return breathing();
  const auto n = static_cast<double>(degree);
  const bool cup = plain(log_core_) > 0.0;
  // Of the surface's face and of the core's: the one grows with r, the other falls.
  const SolidHarmonic<Number> outer{nu_, cup ? -n - 1.0 : n, n};
  const SolidHarmonic<Number> inner{nu_, cup ? n : -n - 1.0, n};
  const Number outer_at_place = exp((outer.m - 1.0) * log_place_);
  const Number outer_at_core = exp((outer.m - 1.0) * log_core_);
  const Number inner_at_place = exp((inner.m - 1.0) * (log_place_ - log_core_));
  const Number inner_at_surface = exp((1.0 - inner.m) * log_core_);

  const std::array at_surface = {outer.first(1.0, 1.0), outer.second(1.0, 1.0, 0.0),
                                 inner.first(1.0, inner_at_surface),
                                 inner.second(1.0, inner_at_surface, -core_rise_)};
  const std::array at_core = {outer.first(core_, outer_at_core),
                              outer.second(core_, outer_at_core, core_rise_),
                              inner.first(core_, 1.0), inner.second(core_, 1.0, 0.0)};
  BallSystem<Number> rows{};
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
    typename BallModeOf<Number>::Spheroidal sum;
    Number slope = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
      const Number weight = rows[j][4 + load];
      sum.radial = sum.radial + weight * at_place[j].radial;
      sum.along = sum.along + weight * at_place[j].along;
      sum.stress = sum.stress + weight * at_place[j].stress;
      sum.shear = sum.shear + weight * at_place[j].shear;
      slope = slope + weight * at_place[j].slope;
    }
    sum.mean_along =
        (2.0 * sum.radial - n * (n + 1.0) * sum.along) / place_ + sum.stress - 2.0 * slope;
    return sum;
  };
  BallModeOf<Number> mode{.normal = spheroidal(0), .tangential = spheroidal(1)};

  // r^e and r^f, 0 at the core.
  const double e = outer.m;
  const double f = inner.m;
  const Number at_rim = 1.0 / (e - 1.0 - (f - 1.0) * exp((e - f) * log_core_));
  const Number inner_share = exp((e - f) * (log_core_ - log_place_));
  const Number power = exp(e * log_place_);
  mode.twist = at_rim * power * -expm1((e - f) * (log_core_ - log_place_));
  mode.twist_shear = at_rim * power * (e - 1.0 - (f - 1.0) * inner_share) / place_;
  return mode;
}

}  // namespace tactile_net
