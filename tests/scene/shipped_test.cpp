// Every scene in scenes/ is good, says what it shows, and has what its text promises.
#include <filesystem>
#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace {

namespace fs = std::filesystem;
using namespace tactile_net;

Scene shipped(const std::string& name) { return read_scene(fs::path{SCENES} / name); }

}  // namespace

TEST_CASE("every shipped scene is read, has a title and begins with a comment", "[scene]") {
  std::size_t scenes = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator{SCENES}) {
    const fs::path& path = entry.path();
    if (path.extension() != ".toml" || path.parent_path().filename() == "hands" ||
        path.parent_path().filename() == "sweeps" || path.filename() == "hand.toml")
      continue;
    ++scenes;
    CAPTURE(path);
    const auto title = [](const auto& scene) { return scene.title; };
    CHECK_FALSE(std::visit(title, read_any_scene(path)).empty());
    std::string line;
    std::ifstream in{path};
    CHECK((std::getline(in, line) && line.starts_with("# ")));
  }
  CHECK(scenes == 73);
}

TEST_CASE("the thesis' examples have the thesis' parameters", "[scene]") {
  const Scene cylinder = shipped("thesis/cylinder.toml");
  CHECK(cylinder.sensor.count == 81);
  CHECK(cylinder.sensor.pitch == 0.25);
  CHECK(cylinder.sensor.depths == std::vector{1.5});
  CHECK(cylinder.sensor.reads == std::vector{Quantity::strain_x});
  CHECK(cylinder.material.poisson_ratio == 0.45);
  CHECK(cylinder.reconstruct.alpha == 1e-4);
  CHECK(cylinder.reconstruct.smoothing_length == 1.0);
  CHECK(shipped("thesis/example-4.1.toml").reconstruct.alpha == 1e-3);
  for (const char* name : {"thesis/example-3.1-stress.toml", "thesis/example-3.1-strain.toml"}) {
    const Scene scene = shipped(name);
    CHECK(scene.sensor.count == 121);
    CHECK(scene.material.poisson_ratio == 0.5);
    CHECK(scene.reconstruct.methods == std::vector{Method::dft});
    CHECK(std::get<RigidContact>(scene.contacts.at(0)).force == 3.534);
  }
}

TEST_CASE("the contact at the edge ends where the array ends", "[scene]") {
  const Scene scene = shipped("edge-of-array.toml");
  const auto& contact = std::get<RigidContact>(scene.contacts.at(0));
  const double half = 0.5 * static_cast<double>(scene.sensor.count) * scene.sensor.pitch;
  CHECK(contact.center + contact.half_width == half);
}

TEST_CASE("the bare scene has no effect, the other has them all", "[scene]") {
  for (const auto& [effect, simulated] : effects(shipped("effects/bare.toml"))) {
    CAPTURE(effect);
    CHECK_FALSE(simulated);
  }
  for (const auto& [effect, simulated] : effects(shipped("effects/everything.toml"))) {
    CAPTURE(effect);
    CHECK(simulated);
  }
}
