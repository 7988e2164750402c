// Sensors by name: the files of sensors/, and directions that a surface's frames may follow.
#include "tactile_net/scene/known_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <sstream>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

constexpr double degrees = std::numbers::pi / 180.0;

/// Fibonacci's points of a cap around z.
std::vector<SpaceVector> cap(double half_angle) {
  constexpr int count = 400;
  std::vector<SpaceVector> normals;
  for (int k = 0; k < count; ++k) {
    const double height = 1.0 - (1.0 - std::cos(half_angle)) * (k + 0.5) / count;
    const double around = std::numbers::pi * (1.0 + std::sqrt(5.0)) * k;
    const double wide = std::sqrt(1.0 - height * height);
    normals.push_back({std::cos(around) * wide, std::sin(around) * wide, height});
  }
  return normals;
}

double nearest_angle(const SpaceVector& direction, const std::vector<SpaceVector>& normals) {
  double least = std::numbers::pi;
  for (const SpaceVector& normal : normals)
    least = std::min(least, std::acos(std::min(1.0, std::abs(dot(direction, normal)))));
  return least;
}

}  // namespace

TEST_CASE("of every sensor one thing is known: how a scene begins, what it lacks, or why none is",
          "[known_sensor]") {
  CHECK(known_sensors().size() == 12);
  for (const KnownSensor& one : known_sensors()) {
    CAPTURE(one.name);
    CHECK(&known_sensor(one.name) == &one);
    CHECK((!one.reads.empty()) + (!one.needs.empty()) + (!one.refusal.empty()) == 1);
    CHECK(one.needs.empty() == one.call.empty());
    CHECK(one.reads.empty() != (one.lattice.has_value() || !one.models.empty()));
  }
  CHECK(known_sensor("mjlab").refusal == known_sensor("mujoco").refusal);
  CHECK_THROWS_WITH(known_sensor("digit"), ContainsSubstring("no sensor 'digit'") &&
                                               ContainsSubstring("paxini, points, tac3d"));
}

TEST_CASE("every file of taxels is a model's, and its normals are of length 1", "[known_sensor]") {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SENSORS)) {
    if (entry.path().extension() != ".csv") continue;
    ++files;
    const auto& models = known_sensor(entry.path().parent_path().filename().string()).models;
    CAPTURE(entry.path());
    const auto found = models.find(entry.path().stem().string());
    REQUIRE(found != models.end());
    std::istringstream lines(found->second);
    std::string line;
    std::getline(lines, line);
    CHECK(line == "name,x [mm],y [mm],z [mm],nx,ny,nz");
    std::size_t taxels = 0;
    for (; std::getline(lines, line); ++taxels) {
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream fields(line);
      std::string name;
      SpaceVector place{};
      SpaceVector normal{};
      fields >> name >> place[0] >> place[1] >> place[2] >> normal[0] >> normal[1] >> normal[2];
      CHECK(fields);
      CHECK(name == "t" + std::to_string(taxels));
      CHECK_THAT(length(normal), WithinAbs(1.0, 1e-9));
    }
    CHECK(taxels >= 9);
  }
  CHECK(files == 12);
}

TEST_CASE("a lattice is two numbers", "[known_sensor]") {
  CHECK(lattice_of("12x32") == std::pair<std::size_t, std::size_t>{12, 32});
  for (const char* wrong : {"", "12", "0x4", "4x257", "4x4x4", "ax4", "-1x4", "4 x 4"})
    CHECK_FALSE(lattice_of(wrong));
}

TEST_CASE("reference directions keep away from every normal, the furthest first",
          "[known_sensor]") {
  const std::vector<SpaceVector> plane = {{0.0, 0.0, 1.0}};
  CHECK(reference_directions(plane).front() == SpaceVector{0.0, 1.0, 0.0});
  const double half_angle = GENERATE(10.0, 40.0, 60.0, 75.0);
  const std::vector<SpaceVector> normals = cap(half_angle * degrees);
  const std::vector<SpaceVector> found = reference_directions(normals);
  REQUIRE_FALSE(found.empty());
  CHECK(found.front() == SpaceVector{0.0, 1.0, 0.0});
  double before = std::numbers::pi;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double angle = nearest_angle(found[k], normals);
    CHECK(angle > 10.0 * degrees);
    if (k > 0) CHECK(angle <= before + 1e-12);
    if (k > 0) before = angle;
  }
  // y is left out where a normal is near it, and all where the normals are everywhere.
  std::vector<SpaceVector> with_y = normals;
  with_y.push_back({0.0, -std::cos(0.1), std::sin(0.1)});
  for (const SpaceVector& one : reference_directions(with_y))
    CHECK(nearest_angle(one, with_y) > 10.0 * degrees);
  CHECK(reference_directions(cap(180.0 * degrees)).empty());
}
