#include "report/json/packed_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/catch.hpp"

namespace tactile_net::report {
namespace {

using Frames = std::vector<std::span<const double>>;

/// Values as the header says that they are read.
std::vector<double> unpacked(const PackedValues& packed) {
  std::size_t at = 0;
  const auto symbol = [&] {
    const char c = packed.text.at(at++);
    return c == ' ' ? '<' - '#' : c == '!' ? '\\' - '#' : c - '#';
  };
  std::vector<double> values;
  for (const double step : packed.steps)
    for (std::size_t i = 0; i < packed.size; ++i) {
      int steps = symbol();
      if (!packed.sizes && steps < 86) {
        steps -= 43;
      } else if (!packed.sizes) {
        const int number = 92 * (steps - 86) + symbol();
        if (number == 551) {
          values.push_back(std::numeric_limits<double>::quiet_NaN());
          continue;
        }
        steps = number < 276 ? 43 + number : -44 - (number - 276);
      }
      values.push_back(step * steps);
    }
  CHECK(at == packed.text.size());
  return values;
}

std::vector<double> noise(std::size_t count, double size, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> of(0.0, size);
  std::vector<double> values(count);
  for (double& value : values) value = of(generator);
  return values;
}

}  // namespace

TEST_CASE("packed values are those they were, within half a step", "[report][packed]") {
  std::vector<std::vector<double>> frames;
  for (unsigned k = 0; k < 5; ++k) frames.push_back(noise(400, std::pow(30.0, k), k));
  for (double& value : frames[3]) value = std::abs(value) * 1e-9;
  frames[2][7] = std::numeric_limits<double>::quiet_NaN();
  const PackedValues packed_frames = packed(Frames(frames.begin(), frames.end()));
  REQUIRE(packed_frames.steps.size() == 5);
  const std::vector<double> found = unpacked(packed_frames);
  REQUIRE(found.size() == 5 * 400);
  double of_all = 0.0;
  for (const double value : frames[4]) of_all = std::max(of_all, std::abs(value));
  for (std::size_t k = 0; k < 5; ++k) {
    const double step = packed_frames.steps[k];
    CHECK(step <= of_all / 299.0);
    for (std::size_t i = 0; i < 400; ++i) {
      if (std::isnan(frames[k][i]))
        CHECK(std::isnan(found[400 * k + i]));
      else
        CHECK(std::abs(found[400 * k + i] - frames[k][i]) <= 0.501 * step);
    }
  }
}

TEST_CASE("sizes are a character each, and what all frames share is packed once",
          "[report][packed]") {
  std::vector<double> sizes = noise(300, 2.0, 1);
  for (double& size : sizes) size = std::abs(size);
  const PackedValues once = packed(Frames(7, sizes), Packing::sizes);
  CHECK(once.steps.size() == 1);
  CHECK(once.text.size() == 300);
  const std::vector<double> found = unpacked(once);
  for (std::size_t i = 0; i < 300; ++i)
    CHECK(std::abs(found[i] - sizes[i]) <= 0.501 * once.steps.front());
}

TEST_CASE("values that scale are packed alike, in characters that need no escape",
          "[report][packed]") {
  const std::vector<double> values = noise(100, 1.0, 3);
  std::vector<double> doubled = values;
  for (double& value : doubled) value *= 1024.0 * 1024.0;
  std::vector<double> zeros(100);
  const std::string text = packed(Frames{values}).text;
  CHECK(text.find_first_of("<\"\\&") == std::string::npos);
  const std::vector<double> found = unpacked(packed(Frames{doubled}));
  const std::vector<double> small = unpacked(packed(Frames{values}));
  for (std::size_t i = 0; i < 100; ++i)
    CHECK(std::abs(found[i] / (1024.0 * 1024.0) - small[i]) <= 0.01);
  for (const double value : unpacked(packed(Frames{zeros}))) CHECK(value == 0.0);
}

}  // namespace tactile_net::report
