/// @file
/// A layer bonded to a rigid ball, or to the wall of a round hole, in 50 digits, by no solution
/// that is known beforehand: equilibrium and Hooke's law of one spherical harmonic are a system of
/// differential equations in ln r with constant coefficients, whose exponential matrix leads from
/// the core to the surface.
#pragma once

#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstddef>
#include <vector>

namespace tactile_net::test {

using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                             boost::multiprecision::et_off>;

template <std::size_t size>
using Square = std::array<std::array<Digits, size>, size>;

template <std::size_t size>
Square<size> product(const Square<size>& a, const Square<size>& b) {
  Square<size> c{};
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t k = 0; k < size; ++k)
      for (std::size_t j = 0; j < size; ++j) c[i][j] += a[i][k] * b[k][j];
  return c;
}

/// exp(t a) of a matrix with known eigenvalues that differ (Sylvester's formula).
template <std::size_t size>
class Exponential {
 public:
  Exponential(const Square<size>& a, const std::array<Digits, size>& eigenvalues)
      : eigenvalues_(eigenvalues) {
    for (std::size_t i = 0; i < size; ++i) {
      Square<size> part{};
      Digits differences = 1;
      for (std::size_t k = 0; k < size; ++k) part[k][k] = 1;
      for (std::size_t j = 0; j < size; ++j) {
        if (j == i) continue;
        Square<size> factor = a;
        for (std::size_t k = 0; k < size; ++k) factor[k][k] -= eigenvalues[j];
        differences *= eigenvalues[i] - eigenvalues[j];
        part = product(part, factor);
      }
      for (auto& row : part)
        for (Digits& value : row) value /= differences;
      parts_[i] = part;
    }
  }
  [[nodiscard]] Square<size> operator()(const Digits& t) const {
    Square<size> sum{};
    for (std::size_t i = 0; i < size; ++i) {
      const Digits growth = exp(eigenvalues_[i] * t);
      for (std::size_t k = 0; k < size; ++k)
        for (std::size_t j = 0; j < size; ++j) sum[k][j] += growth * parts_[i][k][j];
    }
    return sum;
  }

 private:
  std::array<Digits, size> eigenvalues_;
  std::array<Square<size>, size> parts_{};
};

/// What unit tractions of one degree cause at one radius, the surface's radius and G being 1.
struct BallMotion {
  Digits u, v, rr, rt, along;  // U, V, S, T, half the trace of the stress along the sphere
};
struct BallMotions {
  BallMotion normal, tangential;
  Digits w, wt;
};

inline BallMotions ball_motions(unsigned degree, const Digits& nu, const Digits& core,
                                const Digits& place) {
  const Digits n = degree;
  const Digits c = n * (n + 1);
  const Digits l = nu / (1 - nu);                  // lambda / (lambda + 2 G)
  const Digits q = (1 - 2 * nu) / (2 * (1 - nu));  // G / (lambda + 2 G)
  const Digits k = 2 * l + 1;
  // Of U, V, r s_rr, r s_rt: d / d ln r.
  const Square<4> a = {{{-2 * l, c * l, q, 0},
                        {-1, 1, 0, 1},
                        {4 * k, -2 * k * c, 2 * l - 1, c},
                        {-2 * k, k * c + c - 2, -l, -2}}};
  const Exponential<4> spread(a, {n + 1, n - 1, -n, -n - 2});
  const Square<4> to_surface = spread(-log(core));
  const Square<4> to_place = spread(log(place / core));
  const Digits determinant =
      to_surface[2][2] * to_surface[3][3] - to_surface[2][3] * to_surface[3][2];
  const auto motion = [&](const Digits& rr, const Digits& rt) {
    // The stresses at the core that make these at the surface.
    const Digits at_core_rr = (rr * to_surface[3][3] - rt * to_surface[2][3]) / determinant;
    const Digits at_core_rt = (rt * to_surface[2][2] - rr * to_surface[3][2]) / determinant;
    std::array<Digits, 4> y;
    for (std::size_t i = 0; i < 4; ++i)
      y[i] = to_place[i][2] * at_core_rr + to_place[i][3] * at_core_rt;
    return BallMotion{y[0], y[1], y[2] / place, y[3] / place,
                      (l * y[2] + k * (2 * y[0] - c * y[1])) / place};
  };
  const Square<2> b = {{{1, 1}, {c - 2, -2}}};  // of W, r s
  const Exponential<2> turned(b, {n, -n - 1});
  const Digits at_core = 1 / turned(-log(core))[1][1];
  const Square<2> to = turned(log(place / core));
  return {motion(1, 0), motion(0, 1), to[0][1] * at_core, to[1][1] * at_core / place};
}

/// Stress (compression positive) and displacement times 2 G along x (into the skin), along the arc
/// away from the load, and across; unit point forces, the surface's radius 1.
struct BallField {
  std::array<std::array<Digits, 3>, 3> stress{};
  std::array<Digits, 3> displacement{};
};

/// Under a force along x and under one along the direction that makes `angle` with the arc, in
/// turned axes.
struct BallFields {
  BallField normal{}, tangential{};
};

/// @param place   its radius; the core's is 1 - thickness on a ball, 1 + thickness in a hole
/// @param arcs    along the surface, > 0
inline std::vector<BallFields> ball_fields(const Digits& nu, const Digits& core,
                                           const Digits& place, const std::vector<Digits>& arcs,
                                           const Digits& angle, unsigned degrees) {
  const Digits out = core < 1 ? 1 : -1;
  const Digits ca = cos(angle);
  const Digits sa = sin(angle);
  const Digits pi = boost::math::constants::pi<Digits>();
  struct Legendre {
    std::array<Digits, 4> now{1, 0, 0, 0}, before{};  // P and its derivatives
  };
  std::vector<Legendre> legendre(arcs.size());
  std::vector<BallFields> fields(arcs.size());
  for (unsigned degree = 0; degree < degrees; ++degree) {
    const BallMotions motions = ball_motions(degree, nu, core, place);
    const BallMotion& m = motions.normal;
    const BallMotion& t = motions.tangential;
    const Digits n = degree;
    const Digits f = (2 * n + 1) / (4 * pi);
    const Digits q = degree == 0 ? Digits(0) : f / (n * (n + 1));
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      const Digits c = cos(arcs[i]);
      const Digits s = sin(arcs[i]);
      auto& [now, before] = legendre[i];
      const auto& [p, p1, p2, p3] = now;
      {
        auto& [stress, displacement] = fields[i].normal;
        const Digits slope = -s * p1;  // of P by the arc, and once more:
        const Digits bend = s * s * p2 - c * p1;
        stress[0][0] += f * m.rr * p;
        stress[0][1] -= out * f * m.rt * slope;
        const Digits deviator = f * m.v / place * (bend - c / s * slope);
        stress[1][1] += f * m.along * p + deviator;
        stress[2][2] += f * m.along * p - deviator;
        displacement[0] += 2 * out * f * m.u * p;
        displacement[1] -= 2 * f * m.v * slope;
      }
      auto& [stress, displacement] = fields[i].tangential;
      const Digits y = s * p1;  // the harmonic of order 1, its slope and its bend
      const Digits slope = c * p1 - s * s * p2;
      const Digits bend = -s * p1 - 3 * s * c * p2 + s * s * s * p3;
      stress[0][0] -= out * q * t.rr * y * ca;
      stress[0][1] += q * (t.rt * slope + motions.wt * y / s) * ca;
      stress[0][2] -= q * (t.rt * y / s + motions.wt * slope) * sa;
      displacement[0] -= 2 * q * t.u * y * ca;
      displacement[1] += 2 * out * q * (t.v * slope + motions.w * y / s) * ca;
      displacement[2] -= 2 * out * q * (t.v * y / s + motions.w * slope) * sa;
      const Digits even = bend - c / s * slope + y / (s * s);
      const Digits odd = (slope - c / s * y) / s;
      const Digits mean = -out * q * t.along * y * ca;
      const Digits deviator = -out * q / place * (t.v * even + 2 * motions.w * odd) * ca;
      stress[1][1] += mean + deviator;
      stress[2][2] += mean - deviator;
      stress[1][2] += out * q / place * (2 * t.v * odd + motions.w * even) * sa;
      std::array<Digits, 4> next;
      for (std::size_t k = 0; k < 4; ++k)
        next[k] =
            degree < k ? Digits(0) : ((2 * n + 1) * c * now[k] - (n + k) * before[k]) / (n + 1 - k);
      // P_n's nth derivative is (2 n - 1)!!.
      if (degree + 1 == 1) next[1] = 1;
      if (degree + 1 == 2) next[2] = 3;
      if (degree + 1 == 3) next[3] = 15;
      before = now;
      now = next;
    }
  }
  for (BallFields& at : fields)
    for (BallField* const field : {&at.normal, &at.tangential})
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < a; ++b) field->stress[a][b] = field->stress[b][a];
  return fields;
}

}  // namespace tactile_net::test
