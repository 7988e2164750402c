#include "tactile_net/inverse/thesis/dft_tikhonov.hpp"

#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/fft_tikhonov.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/resolution.hpp"
#include "tactile_net/inverse/thesis/dft.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/circular_readings.hpp"
#include "tests/inverse/pads.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;
using enum Quantity;

TEST_CASE("without alpha the circular system is inverted exactly", "[dft_tikhonov]") {
  const std::size_t n = GENERATE(as<std::size_t>{}, 20, 21, 31);
  for (const auto& reads : {std::vector{stress_x, shear_xy}, std::vector{strain_x, shear_xy}}) {
    const SensorArray array{n, 0.5, {1.0}, reads};
    DftTikhonov inverse(array, pad,
                        {.unknowns = 2, .smoothing_length = 1.0, .channel_rms = {1.0, 0.5}});
    CHECK(inverse.null_modes().empty());
    const std::vector<double> f = random_values(2 * n, 1);
    std::vector<double> answer(2 * n);
    REQUIRE(inverse.solve(circular_readings(array, pad, f), 0.0, answer) == FrameStatus::ok);
    CHECK(relative_l2_error(answer, f) < 1e-14 * inverse.condition(0.0) + 1e-13);
  }
}

TEST_CASE("what no reading shows is listed and set to zero", "[dft_tikhonov]") {
  const bool even = GENERATE(false, true);
  const std::size_t n = even ? 20 : 21;
  const SensorArray array{n, 0.5, {1.0}, {stress_x, stress_y}};
  DftTikhonov inverse(array, pad, {.unknowns = 2, .smoothing_length = 1.0});
  REQUIRE(inverse.null_modes().size() == (even ? 2 : 1));
  const DftNullMode& constant = inverse.null_modes()[0];
  CHECK(constant.frequency == 0);
  CHECK(constant.unknown == Traction::tangential_y);
  CHECK_FALSE(constant.wavelength.has_value());
  CHECK_FALSE(constant.alternating);
  if (even) {
    const DftNullMode& nyquist = inverse.null_modes()[1];
    CHECK(nyquist.frequency == n / 2);
    CHECK(nyquist.unknown == Traction::tangential_y);
    CHECK(nyquist.wavelength == 1.0);  // two pitches
    CHECK(nyquist.alternating);
  }

  std::vector<double> f = random_values(2 * n, 2);
  std::vector<double> answer(2 * n);
  REQUIRE(inverse.solve(circular_readings(array, pad, f), 0.0, answer) == FrameStatus::ok);
  double average = 0.0;
  for (std::size_t i = 0; i < n; ++i) average += answer[n + i] / static_cast<double>(n);
  CHECK_THAT(average, WithinAbs(0.0, 1e-10));
  // The rest is measured.
  CHECK(relative_l2_error(std::span(answer).first(n), std::span(f).first(n)) < 1e-9);
}

TEST_CASE("alpha means the same in the Fourier basis", "[dft_tikhonov]") {
  // The circular functional's gradient vanishes: its Toeplitz form with wrapped lags.
  const std::size_t n = 20;
  const SensorArray array{n, 0.5, {1.0}, {stress_x, stress_y}};
  const double alpha = 1e-3;
  const double ratio = 2.0;
  const double weight = GENERATE(0.4, 1.0, 3.0);  // of the tangential traction
  DftTikhonov inverse(array, pad,
                      {.unknowns = 2, .smoothing_length = 1.0, .tangential_weight = weight});
  const std::vector<double> g = random_values(2 * n, 5);
  std::vector<double> f(2 * n);
  REQUIRE(inverse.solve(g, alpha, f) == FrameStatus::ok);
  const auto functional = [&](const std::vector<double>& x) {
    const std::vector<double> back = circular_readings(array, pad, x);
    double sum = 0.0;
    for (std::size_t i = 0; i < 2 * n; ++i) sum += std::pow(back[i] - g[i], 2);
    for (std::size_t u = 0; u < 2; ++u)
      for (std::size_t i = 0; i < n; ++i)
        sum += alpha * (u == 0 ? 1.0 : weight * weight) *
               (std::pow(x[u * n + i], 2) +
                std::pow(ratio * (x[u * n + (i + 1) % n] - x[u * n + i]), 2));
    return sum;
  };
  const double least = functional(f);
  for (unsigned seed = 1; seed < 20; ++seed)
    for (const double size : {1e-3, -1e-3}) {
      std::vector<double> changed = f;
      const std::vector<double> step = random_values(2 * n, seed);
      for (std::size_t i = 0; i < f.size(); ++i) changed[i] += size * step[i];
      CHECK(functional(changed) > least);
    }
}

TEST_CASE("one channel without alpha is the plain division", "[dft_tikhonov]") {
  const SensorArray array{41, 0.5, {1.5}, {strain_x}};
  DftTikhonov inverse(array, pad, {.smoothing_length = 1.5});
  DftInverse plain(array, pad);
  const std::vector<double> g = random_values(41, 4);
  std::vector<double> a(41);
  std::vector<double> b(41);
  REQUIRE(inverse.solve(g, 0.0, a) == FrameStatus::ok);
  REQUIRE(plain.solve(g, b) == FrameStatus::ok);
  CHECK(relative_l2_error(a, b) < 1e-11);
}

TEST_CASE("the Fourier basis holds all of a frame", "[dft_tikhonov]") {
  const SensorArray array{20, 0.5, {1.0}, {stress_x, shear_xy}};
  DftTikhonov inverse(array, pad, {.unknowns = 2, .smoothing_length = 1.0});
  const std::vector<double> g = random_values(40, 6);
  const FilterFrame frame = inverse.analyse(g);
  double power = frame.outside * frame.outside;
  for (const double beta : frame.beta) power += beta * beta;
  double size = 0.0;
  for (const double value : g) size += value * value;
  CHECK_THAT(power * frame.scale * frame.scale, WithinRel(size, 1e-13));
  CHECK(frame.beta.size() == 40);
  CHECK(sweep_alpha(frame, 0.1).curves.size() == alpha_rules.size());
}

TEST_CASE("contacts at the array's end are cut off, in the middle they are not", "[dft_tikhonov]") {
  const SensorArray array{81, 0.25, {1.0}, {stress_x, shear_xy}};
  DftTikhonov inverse(array, pad, {.unknowns = 2, .smoothing_length = 1.0});
  const auto readings = [&](double centre) {
    const std::vector<Contact> contacts = {RigidContact{.center = centre, .half_width = 1.0}};
    return sampled_readings(array, pad, sample(contacts, array));
  };
  CHECK(inverse.cut_off(readings(9.5), 1e-3));
  CHECK_FALSE(inverse.cut_off(readings(0.0), 1e-3));
}

TEST_CASE("a ripple's amplitude scatters as predicted", "[dft_tikhonov][resolution]") {
  // Noise alone, through the circular system, which has no ends; the amplitude at one wavelength.
  const std::size_t n = 64;
  const SensorArray array{n, 0.5, {1.0}, {stress_x, shear_xy}};
  const Material compressible{1.0, 0.3};
  const auto predicted = resolutions(array, compressible, {.unknowns = 2});
  DftTikhonov inverse(array, compressible, {.unknowns = 2});
  const std::size_t j = 8;
  double normal = 0.0;
  double tangential = 0.0;
  const int frames = 600;
  for (int frame = 0; frame < frames; ++frame) {
    std::vector<double> g(2 * n);
    add_noise(g, 1.0, 5, static_cast<std::size_t>(frame));
    std::vector<double> f(2 * n);
    REQUIRE(inverse.solve(g, 0.0, f) == FrameStatus::ok);
    const auto amplitude = [&](std::size_t start) {
      double sum = 0.0;
      for (std::size_t i = 0; i < n; ++i)
        sum += f[start + i] * std::cos(2.0 * std::numbers::pi * static_cast<double>(j * i) /
                                       static_cast<double>(n));
      return 2.0 * sum / static_cast<double>(n);
    };
    normal += std::pow(amplitude(0), 2) / frames;
    tangential += std::pow(amplitude(n), 2) / frames;
  }
  CHECK_THAT(std::sqrt(normal), WithinRel(predicted[j].normal, 0.12));
  CHECK_THAT(std::sqrt(tangential), WithinRel(predicted[j].tangential, 0.12));
}

TEST_CASE("a filter is not P f = b where a contact touches the end",
          "[dft_tikhonov][fft_tikhonov]") {
  const SensorArray array{81, 0.125, {1.5}, {stress_x}};
  const std::vector<Contact> contacts = {RigidContact{.center = 4.5, .half_width = 1.0}};
  const std::vector<double> g = sampled_readings(array, pad, sample(contacts, array));
  const LineProblemOptions options{.smoothing_length = 1.0};
  const std::vector<double> direct = tikhonov_solve(make_problem(array, pad, options), 1e-3, g);
  std::vector<double> filtered(81);
  std::vector<double> solved(81);
  DftTikhonov filter(array, pad, options);
  FftTikhonov solver(array, pad, options, 1e-3);
  REQUIRE(filter.solve(g, 1e-3, filtered) == FrameStatus::ok);
  REQUIRE(solver.solve(g, solved) == FrameStatus::ok);
  CHECK(relative_l2_error(filtered, direct) > 0.05);
  CHECK(relative_l2_error(solved, direct) < 1e-9);
}

TEST_CASE("the circular system with a dead taxel is refused", "[dft_tikhonov]") {
  const SensorArray array{21, 0.5, {1.0}, {stress_x}};
  CHECK_THROWS_AS(DftTikhonov(array, pad, {.dead_taxels = {1}}), std::invalid_argument);
}
