// Sensors by name: the files of sensors/.
#include "tactile_net/scene/known_sensor.hpp"

#include <filesystem>
#include <random>
#include <sstream>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {}  // namespace

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
