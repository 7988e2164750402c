#include "tactile_net/scene/clipped_taxels.hpp"

#include <limits>
#include <vector>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

constexpr Quantity pressure = Quantity::stress_x;
constexpr Quantity shear = Quantity::shear_xy;

std::vector<Site> channel(std::size_t count, Quantity quantity = pressure, std::size_t number = 0) {
  std::vector<Site> sites;
  for (std::size_t i = 0; i < count; ++i)
    sites.push_back({.quantity = quantity, .taxel = i, .channel = number});
  return sites;
}

using Taxels = std::vector<std::size_t>;

}  // namespace

TEST_CASE("readings at the end of a stated range are clipped", "[scene][clipped]") {
  SensorEffects effects;
  effects.saturation = Saturation{.range = {{pressure, {-10.0, 40.0}}}};
  const std::vector<double> readings = {0.0, 40.0, 39.9, -10.0, 40.0 - 1e-12, 41.0};
  const auto clipped = clipped_taxels(effects, channel(6), readings);
  CHECK(clipped.range_known);
  CHECK(clipped.taxels == Taxels{1, 3, 4, 5});
  effects.dead_taxels = {1, 5};
  CHECK(clipped_taxels(effects, channel(6), readings).taxels == Taxels{3, 4});

  // A converter's range is one too, and the narrower one counts.
  effects.dead_taxels.clear();
  effects.quantization = Quantization{.bits = 8, .range = {{pressure, {-100.0, 39.9}}}};
  CHECK(clipped_taxels(effects, channel(6), readings).taxels == Taxels{1, 2, 3, 4, 5});
}

TEST_CASE("an end that readings reach at rest is none", "[scene][clipped]") {
  SensorEffects effects;
  effects.saturation = Saturation{.range = {{pressure, {0.0, 40.0}}}};
  const auto clipped =
      clipped_taxels(effects, channel(6), std::vector{0.0, 0.0, 0.0, 1.0, 40.0, 2.0});
  CHECK(clipped.taxels == Taxels{4});
}

TEST_CASE("a taxel is clipped where one of its readings is", "[scene][clipped]") {
  SensorEffects effects;
  effects.saturation = Saturation{.range = {{pressure, {-9.0, 9.0}}, {shear, {-2.0, 2.0}}}};
  std::vector<Site> sites = channel(3);
  for (const Site& site : channel(3, shear, 1)) sites.push_back(site);
  const std::vector<double> readings = {9.0, 2.0, 1.0, 0.0, 1.0, -2.0};
  CHECK(clipped_taxels(effects, sites, readings).taxels == Taxels{0, 2});
}

TEST_CASE("where no range is stated many taxels of one largest value are", "[scene][clipped]") {
  const auto found = [](const std::vector<double>& readings) {
    const auto clipped = clipped_taxels({}, channel(readings.size()), readings);
    CHECK_FALSE(clipped.range_known);
    return clipped.taxels;
  };
  CHECK(found({1.0, 7.0, 7.0, 7.0, 7.0, 7.0, 6.0, 2.0}) == Taxels{1, 2, 3, 4, 5});
  CHECK(found({1.0, -7.0, -7.0, -7.0, -7.0, -7.0, 6.0, 2.0}) == Taxels{1, 2, 3, 4, 5});
  // A load between four taxels, which mirrors itself; coarse steps; none at all; no load.
  CHECK(found({1.0, 7.0, 7.0, 7.0, 7.0, 6.0, 6.0, 6.0, 6.0}).empty());
  CHECK(found({1.0, 7.0, 7.0, 7.0, 7.0, 7.0, 6.0, 6.0}).empty());
  CHECK(found({0.0, 0.0, 0.0, 0.0, 0.0, 0.0}).empty());
  CHECK(found({0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 8.0, 4.0}).empty());
  CHECK(found({3.0, 3.0, 3.0, 3.0, 3.0, 3.0}).empty());
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  CHECK(found({missing, 7.0, 7.0, 7.0, 7.0, 7.0, missing, 2.0}) == Taxels{1, 2, 3, 4, 5});
}
