// No contact drops out of what a skin's tractions amount to.
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

constexpr double taxel_pitch = 2.0;

struct Place {
  double y, z, radius;
};

/// Middles of contacts that lie inside the skin and do not overlap, as far as they fit.
std::vector<Place> places(std::size_t count, double depth, double half, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Place> all;
  for (int attempt = 0; attempt < 200 && all.size() < count; ++attempt) {
    const double radius = depth * (0.7 + 0.9 * unit(random));
    const double room = half - 0.8 * radius;
    const Place one{room * (2.0 * unit(random) - 1.0), room * (2.0 * unit(random) - 1.0), radius};
    bool apart = true;
    for (const Place& other : all)
      apart = apart && std::hypot(one.y - other.y, one.z - other.z) > one.radius + other.radius;
    if (apart) all.push_back(one);
  }
  return all;
}

/// Contacts of mean pressures between 5 and 40, noise of 0.2 to 5 % of the highest at the taxels.
SkinScene scene_of(std::size_t contacts, std::uint64_t seed) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const int taxels = 6 + 2 * static_cast<int>(random() % 2);
  const double depth = taxel_pitch * (0.6 + 0.7 * unit(random));
  const bool drags = random() % 2 == 0;
  const int constraint = static_cast<int>(random() % 3);
  std::ostringstream toml;
  toml << "[sensor]\nrows = " << taxels << "\ncolumns = " << taxels << "\npitch = " << taxel_pitch
       << "\ndepth = " << depth
       << "\nreads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
          "[material]\nyoungs_modulus = 250.0\npoisson_ratio = 0.45\n";
  double highest = 0.0;
  for (const Place& at : places(contacts, depth, 0.5 * taxel_pitch * (taxels - 1), random)) {
    const double area = std::numbers::pi * at.radius * at.radius;
    const double force = area * (5.0 + 35.0 * unit(random));
    highest = std::max(highest, force / (area + std::numbers::pi * depth * depth));
    toml << "[[contact]]\nshape = \"" << (random() % 3 == 0 ? "punch" : "sphere") << "\"\nplace = ["
         << at.y << ", " << at.z << "]\nradius = " << at.radius << "\nforce = " << force << '\n';
    if (drags)
      toml << "friction = " << 0.1 + 0.3 * unit(random)
           << "\ndirection = " << 360.0 * unit(random) - 180.0 << '\n';
  }
  toml << "[noise]\nrms = " << highest * std::pow(10.0, -2.7 + 1.4 * unit(random))
       << "\nseed = " << seed + 1 << "\n[reconstruct]\n";
  if (constraint == 1) toml << "friction_limit = 0.6\n";
  if (constraint == 2 && !drags) toml << "nonnegative = true\ntangential = false\n";
  return std::get<SkinScene>(parse_any_scene(toml.str(), "several.toml"));
}

struct Coverage {
  int judged = 0;  // with verdict ok
  int held = 0;    // force within two deviations
  int split = 0;   // more contacts found than there are
};

Coverage coverage(std::size_t contacts, std::uint64_t first, std::uint64_t count) {
  Coverage all;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const SkinScene scene = scene_of(contacts, seed);
    const lab::Experiment found = lab::run(scene);
    REQUIRE(found.results.front().has_answer());
    if (found.results.front().answer.verdict != lab::Verdict::ok) continue;
    const Uncertain& force = found.results.front().answer.wrench.normal;
    const double off = (force.value - found.frame.wrench.force[0]) / force.deviation;
    CAPTURE(contacts, seed, off, force.value, force.deviation, found.frame.wrench.force[0]);
    CHECK(std::abs(off) < 5.0);
    ++all.judged;
    all.held += std::abs(off) <= 2.0;
    all.split += found.results.front().answer.patches.size() > scene.contacts.size();
  }
  return all;
}

}  // namespace

TEST_CASE("the weaker of two contacts counts, and the stronger too", "[lab][skin][contacts]") {
  // Cells of 0.6 of the pitch are so little certain one by one that a rule for cells alone lost
  // three fifths of the force, and said ok.
  const double weaker = GENERATE(300.0, 40.0);
  const auto scene = std::get<SkinScene>(parse_any_scene(
      "[sensor]\nrows = 8\ncolumns = 8\npitch = 2.0\ndepth = 1.2\n"
      "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
      "[material]\nyoungs_modulus = 250.0\npoisson_ratio = 0.48\n"
      "[[contact]]\nshape = \"sphere\"\nplace = [-3.0, -3.0]\nradius = 2.5\nforce = 500.0\n"
      "[[contact]]\nshape = \"sphere\"\nplace = [3.5, 3.0]\nradius = 1.5\nforce = " +
          std::to_string(weaker) + "\n[noise]\nrms = 0.2\n[reconstruct]\nnonnegative = true\n",
      "two.toml"));
  const lab::Experiment found = lab::run(scene);
  REQUIRE(found.results.front().has_answer());
  const Uncertain& force = found.results.front().answer.wrench.normal;
  CAPTURE(weaker, force.value, force.deviation);
  CHECK(found.results.front().answer.verdict == lab::Verdict::ok);
  CHECK(found.results.front().answer.patches.size() == 2);
  CHECK(std::abs(force.value - 500.0 - weaker) < 3.0 * force.deviation);
  CHECK(force.deviation < 0.05 * force.value);
}

TEST_CASE("deviations hold the forces of one, two and three contacts", "[lab][skin][contacts]") {
  Coverage all;
  for (const std::size_t contacts : {std::size_t{1}, std::size_t{2}, std::size_t{3}}) {
    const Coverage some = coverage(contacts, 100 * contacts, 7);
    all.judged += some.judged;
    all.held += some.held;
    all.split += some.split;
  }
  CAPTURE(all.judged, all.held);
  CHECK(all.judged >= 12);
  CHECK(all.held >= all.judged - 2);
  CHECK(all.split == 0);
}

TEST_CASE("of many scenes deviations hold the forces of several contacts",
          "[lab][skin][contacts][long]") {
  const std::size_t contacts = GENERATE(std::size_t{1}, std::size_t{2}, std::size_t{3});
  const Coverage all = coverage(contacts, 1000 * contacts, 60);
  CAPTURE(contacts, all.judged, all.held, all.split);
  CHECK(all.judged >= 35);
  CHECK(all.held >= 0.93 * all.judged);
  CHECK(all.split <= 1);
}

TEST_CASE("noise alone is no contact", "[lab][skin][contacts][long]") {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SkinScene scene = scene_of(1, seed);
    scene.contacts.clear();
    const lab::Experiment experiment = lab::run(scene);
    REQUIRE(experiment.results.front().has_answer());
    found += !experiment.results.front().answer.patches.empty();
  }
  CHECK(found == 0);
}
