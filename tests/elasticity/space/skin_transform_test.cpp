#include "tactile_net/elasticity/space/skin_transform.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tests/catch.hpp"
#include "tests/elasticity/layer.hpp"
#include "tests/elasticity/space/reference.hpp"
#include "tests/not_finite.hpp"

using namespace tactile_net;
using tactile_net::test::Real;
using Complex = std::complex<double>;

namespace {

/// A square matrix of Reals, as small as these are.
template <std::size_t size>
using Matrix = std::array<std::array<Real, size>, size>;

template <std::size_t size>
Matrix<size> product(const Matrix<size>& a, const Matrix<size>& b) {
  Matrix<size> c{};
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < size; ++j)
      for (std::size_t l = 0; l < size; ++l) c[i][j] += a[i][l] * b[l][j];
  return c;
}

/// exp(A length), by Taylor's series of a 2^-12th of it.
template <std::size_t size>
Matrix<size> exponential(const Matrix<size>& a, const Real& length) {
  Matrix<size> step{};
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < size; ++j) step[i][j] = a[i][j] * length / 4096;
  Matrix<size> sum{};
  Matrix<size> term{};
  for (std::size_t i = 0; i < size; ++i) sum[i][i] = term[i][i] = 1;
  for (int order = 1; order < 60; ++order) {
    term = product(term, step);
    for (auto& row : term)
      for (Real& value : row) value /= order;
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) sum[i][j] += term[i][j];
  }
  for (int doubling = 0; doubling < 12; ++doubling) sum = product(sum, sum);
  return sum;
}

/// The layer by the equations of its state, with 2 G = 1. Along the wave the state is (u_x, u_L /
/// i, sigma_xx, sigma_xL / i), across it (u_T, sigma_xT), tension positive; both are real.
struct StateOfLayer {
  StateOfLayer(const Real& nu_, const Real& h, Base base, const Real& k_, const Real& x)
      : nu(nu_), k(k_) {
    const Real c = nu / (1 - nu);
    Matrix<4> along{};
    along[0] = {0, c * k, (1 - 2 * nu) / (1 - nu), 0};
    along[1] = {-k, 0, 0, 2};
    along[2] = {0, 0, 0, k};
    along[3] = {0, k * k / (1 - nu), -c * k, 0};
    const Matrix<4> down = exponential(along, h);
    const Matrix<4> here = exponential(along, x);
    const std::size_t second =
        base == Base::bonded ? 1 : 3;  // what vanishes beside u_x at the base
    for (const std::size_t load : {2U, 3U}) {
      const Real sign = load == 2 ? -1 : 1;  // p = 1 pushes; T = sigma_xL / i = 1 drags by -i
      const Real right0 = -sign * down[0][load];
      const Real right1 = -sign * down[second][load];
      const Real determinant = down[0][0] * down[second][1] - down[0][1] * down[second][0];
      std::array<Real, 4> top{};
      top[0] = (right0 * down[second][1] - right1 * down[0][1]) / determinant;
      top[1] = (down[0][0] * right1 - down[second][0] * right0) / determinant;
      top[load] = sign;
      auto& state = sagittal[load - 2];
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) state[i] += here[i][j] * top[j];
    }
    Matrix<2> across{};
    across[0] = {0, 2};
    across[1] = {k * k / 2, 0};
    const Matrix<2> down2 = exponential(across, h);
    const Matrix<2> here2 = exponential(across, x);
    const std::size_t fixed = base == Base::bonded ? 0 : 1;
    const std::array<Real, 2> top{down2[fixed][1] / down2[fixed][0], Real(-1)};
    for (std::size_t i = 0; i < 2; ++i) antiplane[i] = here2[i][0] * top[0] + here2[i][1] * top[1];
  }

  [[nodiscard]] Real along(std::size_t load) const {  // sigma_LL
    return nu / (1 - nu) * sagittal[load][2] + k / (1 - nu) * -sagittal[load][1];
  }

  Real nu, k;
  std::array<std::array<Real, 4>, 2> sagittal{};
  std::array<Real, 2> antiplane{};
};

}  // namespace

TEST_CASE("a layer's amplitudes are those of its state equations' matrix exponential",
          "[skin_transform]") {
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const double nu = GENERATE(0.0, 0.25, 0.5);
  const double h = 2.0;
  const Material material{.youngs_modulus = 1.0 + nu, .poisson_ratio = nu, .layer = Layer{h, base}};
  for (const double kh : {1e-3, 0.1, 1.0, 4.0, 20.0})
    for (const double share : {0.01, 0.5, 1.0}) {
      const double k = kh / h;
      const double x = share * h;
      const StateOfLayer state(nu, h, base, k, x);
      CAPTURE(name(base), nu, kh, share);
      const auto check = [&](Quantity q, Traction load, const Real& expected, bool odd,
                             double size) {
        const Complex value = skin_transform(q, load, material, x, k, 0.0);
        CAPTURE(name(q), name(load));
        CHECK((odd ? value.real() : value.imag()) == 0.0);
        CHECK_THAT((odd ? -value.imag() : value.real()),
                   WithinAbs(expected.convert_to<double>(), size));
      };
      const auto& p = state.sagittal[0];
      const auto& q = state.sagittal[1];
      using Q = Quantity;
      const auto normal = Traction::normal;
      const auto y = Traction::tangential_y;
      const auto z = Traction::tangential_z;
      const double pole = base == Base::bonded ? 1.0 : 1.0 + 1.0 / kh;
      const double ulps = 2e-15;
      check(Q::stress_x, normal, -p[2], false, ulps);
      check(Q::shear_xy, normal, p[3], true, ulps);
      check(Q::stress_y, normal, -state.along(0), false, ulps);
      check(Q::stress_z, normal, -nu * (p[2] + state.along(0)), false, ulps);
      check(Q::stress_x, y, q[2], true, ulps);
      check(Q::shear_xy, y, q[3], false, ulps);
      check(Q::stress_y, y, state.along(1), true, ulps * pole);
      check(Q::stress_z, y, nu * (q[2] + state.along(1)), true, ulps * pole);
      check(Q::shear_xz, z, -state.antiplane[1], false, ulps);
      check(Q::shear_yz, z, k / 2 * state.antiplane[0], true, ulps * pole);
      check(Q::displacement_x, normal, p[0], false, ulps / k);
      check(Q::displacement_y, normal, -p[1], true, ulps / k);
      check(Q::displacement_x, y, -q[0], true, ulps / k);
      check(Q::displacement_y, y, -q[1], false, ulps / k * pole);
      check(Q::displacement_z, z, state.antiplane[0], false, ulps / k * pole);
    }
}

TEST_CASE("a wave along y is a line array's", "[skin_transform]") {
  // So what holds of a skin's waves holds of a line's: the matrix exponential, the half space of a
  // thick layer, finite values everywhere.
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const double nu = GENERATE(0.0, 0.3, 0.45, 0.4999, 0.5);
  const double h = 1.5;
  Material half = layer(nu, h, base);
  half.layer.reset();
  half.youngs_modulus = 3.0;
  for (const Material& material : {layer(nu, h, base), half})
    for (const double k : {-3.0, 1e-9, 0.01, 0.2, 1.0, 6.0, 40.0, 1e3, 1e9, 1e300, infinite})
      for (const double x : {1e-9, 0.02, 0.9, h})
        for (const Traction load : line_tractions) {
          const auto line = [&](Quantity q) { return pad_transform(q, load, material, x, k); };
          const Complex down = line(Quantity::stress_x);
          const Complex along = line(Quantity::stress_y);
          for (const Quantity q : line_quantities) {
            CAPTURE(name(base), material.layer.has_value(), nu, k, x, name(q), name(load));
            const Complex value = line(q);
            CHECK(std::isfinite(value.real()));
            CHECK(std::isfinite(value.imag()));
            const Complex plane = skin_transform(q, load, material, x, k, 0.0);
            CHECK(std::abs(plane - value) <= 4e-15 * (1.0 + std::abs(value)));
            if (!is_strain(q)) continue;
            const bool is_down = q == Quantity::strain_x;  // by Hooke's law
            const Complex strain = ((1.0 - nu * nu) * (is_down ? down : along) -
                                    nu * (1.0 + nu) * (is_down ? along : down)) /
                                   material.youngs_modulus;
            CHECK(std::abs(value - strain) <= 1e-14 * (1.0 + std::abs(down) + std::abs(along)));
          }
        }
}

TEST_CASE("turning wave, traction and tensor together changes nothing",
          "[skin_transform][property]") {
  const Material material =
      GENERATE(Material{.youngs_modulus = 3.0, .poisson_ratio = 0.4}, layer(0.3, 1.5, Base::bonded),
               layer(0.5, 1.5, Base::frictionless));
  const double k = 1.3;
  using Tensor = std::array<std::array<Complex, 3>, 3>;
  const std::array components = {
      std::array{Quantity::stress_x, Quantity::shear_xy, Quantity::shear_xz},
      std::array{Quantity::shear_xy, Quantity::stress_y, Quantity::shear_yz},
      std::array{Quantity::shear_xz, Quantity::shear_yz, Quantity::stress_z}};
  const std::array vector = {Quantity::displacement_x, Quantity::displacement_y,
                             Quantity::displacement_z};
  // Tractions (p, q_y, q_z) at a wave k: the stress tensor and the displacement.
  const auto respond = [&](const std::array<double, 3>& f, double ky, double kz) {
    std::pair<Tensor, std::array<Complex, 3>> all{};
    for (std::size_t l = 0; l < 3; ++l)
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < 3; ++b)
          all.first[a][b] +=
              f[l] * skin_transform(components[a][b], skin_tractions[l], material, 0.8, ky, kz);
        all.second[a] += f[l] * skin_transform(vector[a], skin_tractions[l], material, 0.8, ky, kz);
      }
    return all;
  };
  for (const double angle : {0.4, 1.5707963267948966, 2.0, -2.9}) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const std::array<std::array<double, 3>, 3> turn{{{1, 0, 0}, {0, c, -s}, {0, s, c}}};
    const std::array<double, 3> load{0.3, -1.1, 0.7};
    std::array<double, 3> turned_load{};
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) turned_load[a] += turn[a][b] * load[b];
    const auto first = respond(load, k, 0.0);
    const auto second = respond(turned_load, k * c, k * s);
    for (std::size_t a = 0; a < 3; ++a) {
      Complex u = 0.0;
      for (std::size_t b = 0; b < 3; ++b) {
        u += turn[a][b] * first.second[b];
        Complex stress = 0.0;
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) stress += turn[a][i] * turn[b][j] * first.first[i][j];
        CHECK(std::abs(stress - second.first[a][b]) < 4e-15);
      }
      CHECK(std::abs(u - second.second[a]) < 4e-15);
    }
  }
}

TEST_CASE("a thick layer is a half space, at any k h", "[skin_transform]") {
  const auto base = GENERATE(Base::bonded, Base::frictionless);
  const double nu = GENERATE(0.0, 0.45, 0.5);
  const double kh = GENERATE(60.0, 300.0, 2000.0, 1e6, 1e300);
  const Material material = layer(nu, 1.0, base);
  Material half = material;
  half.layer.reset();
  for (const double a : {1e-3, 0.5, 3.0, 15.0})
    for (const Traction load : skin_tractions)
      for (const Quantity q : skin_quantities) {
        CAPTURE(name(base), nu, kh, a, name(load), name(q));
        const double scale = traits(q).kind == QuantityKind::displacement ? 1.0 / kh : 1.0;
        const Complex expected = skin_transform(q, load, half, a / kh, 0.6 * kh, 0.8 * kh);
        const Complex value = skin_transform(q, load, material, a / kh, 0.6 * kh, 0.8 * kh);
        CHECK(std::abs(value - expected) <= 3e-15 * (2.0 + a) * std::exp(-a) * scale);
      }
}

TEST_CASE("nothing in a skin overflows or is lost", "[skin_transform]") {
  const Material material =
      GENERATE(Material{.youngs_modulus = 3.0, .poisson_ratio = 0.5}, layer(0.5, 2.0, Base::bonded),
               layer(0.0, 2.0, Base::frictionless));
  for (const double k : {1e-150, 1e-9, 1e3, 1e9, 1e300, infinite})
    for (const double depth : {1e-9, 1.0, 2.0})
      for (const Traction load : skin_tractions)
        for (const Quantity q : skin_quantities) {
          CAPTURE(k, depth, name(q), name(load));
          const Complex value = skin_transform(q, load, material, depth, k, 0.0);
          const bool pole = k == 1e-150;  // 1 / k^2 at the worst
          CHECK((pole || std::isfinite(value.real())));
          CHECK((pole || std::isfinite(value.imag())));
          CHECK_FALSE(std::isnan(value.real()));
          CHECK_FALSE(std::isnan(value.imag()));
        }
}

TEST_CASE("k = 0 is the mean over directions of small k", "[skin_transform]") {
  const Material material =
      GENERATE(Material{.youngs_modulus = 3.0, .poisson_ratio = 0.4}, layer(0.3, 1.5, Base::bonded),
               layer(0.5, 1.5, Base::bonded), layer(0.3, 1.5, Base::frictionless));
  for (const Traction load : skin_tractions)
    for (const Quantity q : skin_quantities) {
      Complex mean = 0.0;
      double largest = 0.0;
      for (int i = 0; i < 16; ++i) {
        const double angle = std::numbers::pi * (i + 0.5) / 8.0;
        const Complex value =
            skin_transform(q, load, material, 0.7, 1e-7 * std::cos(angle), 1e-7 * std::sin(angle));
        mean += value / 16.0;
        largest = std::max(largest, std::abs(value));
      }
      const double size = 4e-7 + 1e-15 * largest;
      const Complex at_zero = skin_transform(q, load, material, 0.7, 0.0, 0.0);
      CAPTURE(name(q), name(load), at_zero.real(), mean.real(), mean.imag());
      if (std::isinf(at_zero.real())) {
        CHECK(mean.real() > 1e5);
      } else {
        CHECK_THAT(at_zero.real(), WithinAbs(mean.real(), size));
        CHECK_THAT(mean.imag(), WithinAbs(0.0, size));
        CHECK(at_zero.imag() == 0.0);
      }
    }
  const Material half{.youngs_modulus = 1.0, .poisson_ratio = 0.25};
  CHECK(skin_transform(Quantity::stress_y, Traction::normal, half, 1.0, 0.0, 0.0) == 0.75);
}
