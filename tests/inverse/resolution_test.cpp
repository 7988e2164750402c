#include "tactile_net/inverse/resolution.hpp"

#include <Eigen/QR>
#include <cmath>
#include <numbers>

#include "inverse/transfer_matrix.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;
using enum Quantity;
using Complex = std::complex<double>;

namespace {

constexpr double e_modulus = 2.0;

Complex determinant(std::vector<Quantity> reads, std::vector<double> depths, double nu, double k) {
  const std::vector<Complex> a = transfer_matrix({9, 0.5, std::move(depths), std::move(reads)},
                                                 {e_modulus, nu}, {.unknowns = 2}, k);
  return a[0] * a[3] - a[1] * a[2];
}

bool near(Complex a, Complex b, double size) { return std::abs(a - b) <= 1e-14 * size; }

}  // namespace

TEST_CASE("the determinants of two quantities are the closed ones", "[resolution][property]") {
  const double depth = 1.5;
  const double nu = GENERATE(0.0, 0.3, 0.45, 0.5);
  const Complex i{0.0, 1.0};
  for (const double k : {-3.0, -0.4, 0.0, 1e-6, 0.1, 1.0, 2.5}) {
    CAPTURE(nu, k);
    const double a = std::abs(k) * depth;
    const double sign = k > 0.0 ? 1.0 : k < 0.0 ? -1.0 : 0.0;
    const double decay = std::exp(-2.0 * a);
    const double size = (2.0 + a) * (2.0 + a) * decay;
    CHECK(near(determinant({stress_x, shear_xy}, {depth}, nu, k), decay, size));
    CHECK(near(determinant({stress_x, stress_y}, {depth}, nu, k), -2.0 * i * sign * decay, size));
    const double hooke = (1.0 + nu) * (1.0 + nu) * (1.0 - 2.0 * nu) / (e_modulus * e_modulus);
    CHECK(near(determinant({strain_x, strain_y}, {depth}, nu, k), -2.0 * i * sign * decay * hooke,
               size));
    const double deeper = 2.25;
    CHECK(near(determinant({stress_x}, {depth, deeper}, nu, k),
               -i * k * (deeper - depth) * std::exp(-std::abs(k) * (depth + deeper)),
               4.0 * (1.0 + a) * (1.0 + a) * decay));
  }
}

TEST_CASE("rows are divided by their noise", "[resolution]") {
  const SensorArray array{9, 0.5, {1.5}, {stress_x, strain_x}};
  const auto one = transfer_matrix(array, {}, {.unknowns = 2, .channel_rms = {1.0, 1.0}}, 0.7);
  const auto other = transfer_matrix(array, {}, {.unknowns = 2, .channel_rms = {4.0, 0.5}}, 0.7);
  for (std::size_t u = 0; u < 2; ++u) {
    CHECK(other[u] == one[u] / 4.0);
    CHECK(other[2 + u] == one[2 + u] / 0.5);
  }
  CHECK_THROWS_AS(transfer_matrix(array, {}, {.unknowns = 2}, 0.7), std::invalid_argument);
}

TEST_CASE("the mean of the tangential load is hidden from two stresses alone", "[resolution]") {
  const auto studied = [](std::vector<Quantity> reads) {
    return resolutions({40, 0.25, {1.5}, std::move(reads)}, {1.0, 0.45}, {.unknowns = 2});
  };
  const auto stresses = studied({stress_x, stress_y});
  CHECK(std::isinf(stresses[0].wavelength));
  CHECK(std::isinf(stresses[0].tangential));
  CHECK(std::isfinite(stresses[0].normal));
  CHECK(std::isinf(stresses[20].tangential));  // Nyquist
  for (std::size_t j = 1; j < 20; ++j) CHECK(std::isfinite(stresses[j].tangential));
  for (const Resolution& resolution : studied({stress_x, shear_xy})) {
    CHECK(std::isfinite(resolution.normal));
    CHECK(std::isfinite(resolution.tangential));
  }
}

TEST_CASE("where two quantities are one, neither traction is known", "[resolution]") {
  for (const Resolution& resolution :
       resolutions({40, 0.25, {1.5}, {strain_x, strain_y}}, {1.0, 0.5}, {.unknowns = 2})) {
    if (!std::isfinite(resolution.wavelength)) continue;
    CHECK(std::isinf(resolution.tangential));
    // At Nyquist the tangential traction shows nothing, which leaves the normal one alone.
    if (resolution.wavelength > 0.501) CHECK(std::isinf(resolution.normal));
  }
}

TEST_CASE("shear and stress invert as their determinant says", "[resolution]") {
  // f_v = e^a [(1-a) stress + i a shear], f_t = e^a [(1+a) shear + i a stress].
  const std::size_t n = 41;
  const auto all = resolutions({n, 0.25, {1.5}, {stress_x, shear_xy}}, {1.0, 0.3}, {.unknowns = 2});
  for (std::size_t j = 1; j < all.size(); ++j) {
    const double a = 2.0 * std::numbers::pi / all[j].wavelength * 1.5;
    const double factor = std::exp(a) * std::sqrt(2.0 / static_cast<double>(n));
    CHECK_THAT(all[j].normal, WithinRel(factor * std::hypot(1.0 - a, a), 1e-10));
    CHECK_THAT(all[j].tangential, WithinRel(factor * std::hypot(1.0 + a, a), 1e-10));
  }
}

TEST_CASE("amplitudes scatter as predicted, in the sampled problem of a long array",
          "[resolution][property]") {
  // Noise alone, through the least squares of the real matrices for tractions made of waves that
  // the array resolves. All shorter waves together would add what leaks from near Nyquist, where
  // the sampled determinant (1 - a^2) e^-2a of stress and shear has changed its sign.
  const std::size_t n = 400;
  const Eigen::Index size = 2 * static_cast<Eigen::Index>(n);
  const SensorArray array{n, 0.5, {0.75}, {stress_x, shear_xy}};
  const Material pad{3.0, 0.3};
  const LineProblemOptions options{.unknowns = 2, .channel_rms = {2.0, 2.0}};
  const LinearProblem problem = make_problem(array, pad, options);
  const auto predicted = resolutions(array, pad, options);
  const auto kernel = view(problem.kernel);

  // Columns: cosines j = 0 ... most - 1, sines, of the normal, then of the tangential traction.
  constexpr Eigen::Index most = 64;
  Eigen::MatrixXd waves = Eigen::MatrixXd::Zero(size, 4 * most - 2);
  for (Eigen::Index i = 0; i < size / 2; ++i)
    for (Eigen::Index j = 0; j < most; ++j) {
      const double phase =
          2.0 * std::numbers::pi * static_cast<double>(i * j) / static_cast<double>(n);
      waves(i, j) = waves(size / 2 + i, 2 * most - 1 + j) = std::cos(phase);
      if (j == 0) continue;
      waves(i, most + j - 1) = waves(size / 2 + i, 3 * most - 2 + j) = std::sin(phase);
    }
  constexpr int frames = 1500;
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(size, frames);  // weighted: of unit variance
  for (int frame = 0; frame < frames; ++frame)
    add_noise({noise.col(frame).data(), 2 * n}, 1.0, 5, static_cast<std::size_t>(frame));
  const Eigen::MatrixXd amplitudes =
      Eigen::HouseholderQR<Eigen::MatrixXd>(kernel * waves).solve(noise);

  for (const Eigen::Index j : {0, 1, 5, 20, 40}) {
    CAPTURE(j);
    const auto scatter = [&](Eigen::Index row) {
      return amplitudes.row(row).norm() / std::sqrt(frames);
    };
    // 1500 frames know it to 1.8 %; the ends of the array add up to 8 %, which falls as 1/count.
    const Resolution& expected = predicted[static_cast<std::size_t>(j)];
    CHECK_THAT(scatter(j), WithinRel(expected.normal, 0.06));
    CHECK_THAT(scatter(2 * most - 1 + j), WithinRel(expected.tangential, 0.12));
  }
}

TEST_CASE("the resolvable wavelength grows with the depth and with the noise", "[resolution]") {
  const auto shortest = [](double depth, double limit) {
    return resolvable_wavelength(
        resolutions({81, 0.25, {depth}, {stress_x, shear_xy}}, {1.0, 0.45}, {.unknowns = 2}),
        Traction::normal, limit);
  };
  CHECK(*shortest(1.0, 10.0) < *shortest(2.0, 10.0));
  CHECK(*shortest(1.0, 100.0) < *shortest(1.0, 10.0));
  CHECK_FALSE(shortest(1.0, 1e-3).has_value());
}

TEST_CASE("one wavelength that is not known hides all shorter ones", "[resolution]") {
  const std::vector<Resolution> all = {{std::numeric_limits<double>::infinity(), 9.0, 9.0},
                                       {8.0, 1.0, 9.0},
                                       {4.0, 2.0, 1.0},
                                       {2.0, 9.0, 1.0},
                                       {1.0, 1.0, 1.0}};
  CHECK(resolvable_wavelength(all, Traction::normal, 2.0) == 4.0);
  CHECK_FALSE(resolvable_wavelength(all, Traction::tangential_y, 2.0).has_value());
}

TEST_CASE("the resolution does not depend on the units", "[resolution][property]") {
  const auto all = [](double length, double stress) {
    return resolutions({40, 0.25 * length, {1.5 * length}, {stress_x, strain_x}},
                       {5.0 * stress, 0.3}, {.unknowns = 2, .channel_rms = {0.1 * stress, 0.02}});
  };
  const auto one = all(1.0, 1.0);
  const auto other = all(1e-3, 1e6);
  for (std::size_t j = 1; j + 1 < one.size(); ++j) {
    CHECK_THAT(other[j].wavelength, WithinRel(1e-3 * one[j].wavelength, 1e-12));
    CHECK_THAT(other[j].normal, WithinRel(1e6 * one[j].normal, 1e-9));
    CHECK_THAT(other[j].tangential, WithinRel(1e6 * one[j].tangential, 1e-9));
  }
}
