// A part of docs/bands.md, whose page has many more arrays, draws and contacts: bands are right as
// often as they say.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/catch.hpp"
#include "tests/coverage/intervals.hpp"
#include "tests/coverage/ranks.hpp"

using namespace tactile_net;
using namespace tactile_net::coverage;

namespace {

const std::string mixture = "answer = \"mixture\"\n";

/// Three of its deviations below a share that holds, of so many independent ones.
double least_percent(double share, std::size_t count) {
  return 100.0 * (share - 3.0 * std::sqrt(share * (1.0 - share) / static_cast<double>(count)));
}

}  // namespace

TEST_CASE("ranks of the model's own draws are uniform, and a tenth in a deviation is seen",
          "[bands]") {
  constexpr std::size_t draws = 1000;
  std::vector<double> forces, planted;
  for (const Setting& setting : {Setting{.reconstruct = mixture},
                                 Setting{.pitch = 2.0, .unknowns = 2, .reconstruct = mixture},
                                 Setting{.reconstruct = mixture + "offset = true\n",
                                 .of_noise = "degrees = 1e6\n",
                                 .dead = {2, 7, 8}}}) {
    CAPTURE(setting.pitch, setting.unknowns, setting.dead.size());
    const ModelRanks found = model_ranks(setting, {.draws = draws, .seed = 2});
    REQUIRE(found.of.size() == (setting.unknowns == 1 ? 6 : 12));
    CHECK(found.hash.size() == 64);
    for (const Ranks& one : found.of) {
      CAPTURE(one.name);
      CHECK(one.values.size() > draws / 4);
      // Of 26 tests one in 40 would be beyond these if all is right.
      CHECK(kolmogorov(one.values) < 1.95);
      CHECK(std::abs(dispersion(one.values)) < 3.3);
    }
    const Ranks& force = found.of.front();
    forces.insert(forces.end(), force.values.begin(), force.values.end());
    planted.insert(planted.end(), force.planted.begin(), force.planted.end());
  }
  CHECK(std::abs(dispersion(forces)) < 2.6);
  CHECK(dispersion(planted) < -3.3);
}

TEST_CASE("ranks are uniform whatever is known of the noise, and on a skin", "[bands]") {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto check = [](const ModelRanks& found, std::size_t numbers) {
    REQUIRE(found.of.size() == numbers);
    for (const Ranks& one : found.of) {
      CAPTURE(one.name);
      CHECK(kolmogorov(one.values) < 1.95);
      CHECK(std::abs(dispersion(one.values)) < 3.3);
    }
  };
  for (const double degrees : {0.0, infinite}) {
    CAPTURE(degrees);
    const ModelRanks found = model_ranks(Setting{.reconstruct = mixture}, {.degrees = degrees});
    check(found, 6);
    CHECK(dispersion(found.of.front().planted) < dispersion(found.of.front().values));
  }
  check(model_ranks(SkinSetting{.rows = 6}, {.draws = 300, .places = 2}), 11);
}

TEST_CASE("the mixture's intervals hold contacts that its model does not know", "[bands]") {
  constexpr std::size_t count = 200;
  const auto check = [](const Holds& holds, std::size_t independent) {
    CHECK(holds.percent(0) >= least_percent(0.45, independent));
    CHECK(holds.percent(1) >= least_percent(0.75, independent));
    CHECK(holds.percent(2) >= least_percent(0.94, independent));
  };
  for (const Load load : {Load::hertz, Load::even, Load::rigid_punch, Load::two_hertz}) {
    const Contacts contacts(count, {.load = load});
    for (const Setting& setting : {Setting{.pitch = 0.5}, Setting{}, Setting{.unknowns = 2}}) {
      CAPTURE(static_cast<int>(load), setting.pitch, setting.unknowns);
      Setting by_mixture = setting;
      by_mixture.reconstruct = mixture;
      const IntervalScore found = interval_score(by_mixture, contacts);
      check(found.force, count);
      check(found.centre, count);
      if (setting.unknowns == 2) check(found.tangential, count);
      // Nor is a band an excuse: it is narrower than one alpha's, about a value that is nearer. One
      // window holds two contacts apart, and what may press between and beyond them.
      Setting by_alpha = setting;
      by_alpha.reconstruct = "answer = \"alpha\"\n";
      const IntervalScore alpha = interval_score(by_alpha, contacts);
      CHECK(found.width < 0.9 * alpha.width);
      if (load == Load::two_hertz) continue;
      CHECK(found.error < 0.8 * alpha.error);
      CHECK(found.crps < 0.8 * alpha.crps);
    }
  }
}

TEST_CASE("values on the surface are in their intervals, and certain where nothing presses",
          "[bands]") {
  const Contacts contacts(60);
  const IntervalScore found = interval_score({.reconstruct = mixture}, contacts, true);
  CHECK(found.pressed.percent(2) >= 95.0);
  CHECK(found.unpressed.percent(2) >= 97.0);
  CHECK(found.pressed.count + found.unpressed.count <= 60 * 81);
  CHECK(found.pressed.count > 60 * 4);
}

TEST_CASE("a noise stated half as large as it is stays in the force's interval, an offset does not",
          "[bands]") {
  const Contacts contacts(100);
  const auto held = [&](Setting setting) {
    setting.reconstruct += mixture;
    return interval_score(setting, contacts).force.percent(2);
  };
  CHECK(held({.stated_noise = 0.5}) >= 85.0);
  CHECK(held({.of_noise = "degrees = 1e6\n", .stated_noise = 0.5}) < 85.0);
  CHECK(held({.offset = 0.01}) < 85.0);
  CHECK(held({.offset = 0.01, .reconstruct = "offset = true\n"}) >= 90.0);
}
