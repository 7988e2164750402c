#include "tactile_net/sensing/effects/noise.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

std::vector<double> noise(std::size_t count, double rms, std::uint64_t seed, std::size_t channel) {
  std::vector<double> readings(count);
  add_noise(readings, rms, seed, channel);
  return readings;
}

double mean(const std::vector<double>& values, auto of) {
  double sum = 0.0;
  for (const double value : values) sum += of(value);
  return sum / static_cast<double>(values.size());
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum / static_cast<double>(a.size());
}

}  // namespace

TEST_CASE("noise has the moments of a Gaussian", "[effects][property]") {
  const auto values = noise(200000, 1.0, 1, 0);
  // Standard errors: 1, sqrt 2, sqrt 15 and sqrt 96 over sqrt(200000); five of them.
  const double standard = 5.0 / std::sqrt(200000.0);
  CHECK_THAT(mean(values, [](double x) { return x; }), WithinAbs(0.0, standard));
  CHECK_THAT(mean(values, [](double x) { return x * x; }), WithinAbs(1.0, 1.42 * standard));
  CHECK_THAT(mean(values, [](double x) { return x * x * x; }), WithinAbs(0.0, 3.88 * standard));
  CHECK_THAT(mean(values, [](double x) { return x * x * x * x; }), WithinAbs(3.0, 9.8 * standard));
}

TEST_CASE("noise is white", "[effects][property]") {
  const auto values = noise(100001, 1.0, 7, 3);
  const std::vector<double> now(values.begin(), values.end() - 1);
  const std::vector<double> next(values.begin() + 1, values.end());
  CHECK_THAT(correlation(now, next), WithinAbs(0.0, 5.0 / std::sqrt(1e5)));
}

TEST_CASE("equal seeds give equal noise, other seeds and channels another", "[effects][property]") {
  CHECK(noise(100, 1.0, 42, 5) == noise(100, 1.0, 42, 5));
  const auto reference = noise(100000, 1.0, 42, 5);
  const std::pair<std::uint64_t, std::size_t> others[] = {
      {42, 6}, {43, 5}, {5, 42}, {42 + (std::uint64_t{1} << 32), 5}, {0, 0}};
  for (const auto& [seed, channel] : others) {
    CAPTURE(seed, channel);
    CHECK_THAT(correlation(reference, noise(100000, 1.0, seed, channel)),
               WithinAbs(0.0, 5.0 / std::sqrt(1e5)));
  }
}

TEST_CASE("a longer frame begins with the noise of a shorter one", "[effects]") {
  const auto longer = noise(50, 1.0, 3, 1);
  const auto shorter = noise(20, 1.0, 3, 1);
  CHECK(std::equal(shorter.begin(), shorter.end(), longer.begin()));
}

TEST_CASE("noise is added, and scales with its rms", "[effects]") {
  std::vector<double> readings{1.0, 2.0, 3.0};
  add_noise(readings, 0.5, 9, 2);
  const auto unit = noise(3, 1.0, 9, 2);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(readings[i] == static_cast<double>(i + 1) + 0.5 * unit[i]);
  add_noise(readings, 0.0, 1, 2);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(readings[i] == static_cast<double>(i + 1) + 0.5 * unit[i]);
}

TEST_CASE("the noise of a seed is the same everywhere", "[effects]") {
  // Recorded once: files of results depend on it.
  const auto values = noise(4, 1.0, 1, 0);
  CAPTURE(values);
  CHECK(values == std::vector<double>{-0.58466202888902641, -0.77842214712949354,
                                      0.13377168600915845, -0.20791152380946903});
}

TEST_CASE("noise of the first frame is add_noise's, of later ones what follows", "[effects]") {
  const SensorArray array{3, 1.0, {1.0, 2.0}, {Quantity::stress_x}};
  const auto stage = make_effect(NoiseModel{.rms = {{Quantity::stress_x, 0.5}}, .seed = 9}, array);
  std::vector<double> frames;
  for (int frame = 0; frame < 2; ++frame) {
    std::vector<double> readings(6);
    stage->apply({}, readings);
    frames.insert(frames.end(), readings.begin(), readings.end());
  }
  for (std::size_t channel = 0; channel < 2; ++channel) {
    const auto drawn = noise(6, 0.5, 9, channel);
    for (std::size_t i = 0; i < 6; ++i)
      CHECK(frames[(i / 3) * 6 + channel * 3 + i % 3] == drawn[i]);
  }
}
