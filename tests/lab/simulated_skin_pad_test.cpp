#include "tactile_net/lab/simulated_skin_pad.hpp"

#include <memory>
#include <string>
#include <vector>

#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace tactile_net::lab {
namespace {

std::shared_ptr<const SkinPadModel> model(const std::string& effects) {
  const std::string text =
      "[sensor]\nrows = 4\ncolumns = 3\npitch = 2.0\ndepth = 1.5\n"
      "reads = [\"stress_x\", \"shear_xy\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
      "[time]\nrate = 100.0\nframes = 5\n"
      "[[contact]]\nshape = \"sphere\"\nradius = 1.5\nfriction = 0.2\n"
      "trajectory = [{ t = 0.0, force = 0.0 }, { t = 0.04, force = 1.4, place = [1.0, 0.5] }]\n";
  return std::make_shared<const SkinPadModel>(
      std::get<SkinScene>(parse_any_scene(text + effects, "pad.toml")));
}

std::vector<std::vector<double>> read(SimulatedSkinPad& pad, const SkinScene& scene, double begin) {
  std::vector<std::vector<double>> frames;
  for (std::size_t k = 0; k < scene.time->frames; ++k) {
    frames.emplace_back(reading_count(scene.sensor));
    pad.read(begin + scene.time->time(k), contacts_at(scene, scene.time->time(k)), frames.back());
  }
  return frames;
}

const std::string effects =
    "[noise]\nrms = { stress_x = 1e-2, shear_xy = 1e-3 }\nseed = 3\n[dead_taxels]\nindices = [5]\n";

}  // namespace

TEST_CASE("a skin in a simulation reads as the scene's own simulation", "[lab][pad][skin]") {
  for (const std::string& rest : {std::string(), effects}) {
    const auto shared = model(rest);
    SimulatedSkinPad pad(shared);
    const auto frames = read(pad, shared->scene, 0.0);
    SkinRecording recording(shared->scene);
    for (std::size_t k = 0; recording.next(); ++k) {
      CAPTURE(rest, k);
      CHECK(frames[k] == std::vector(recording.readings().begin(), recording.readings().end()));
    }
  }
}

TEST_CASE("a skin whose time begins anew has its noise again", "[lab][pad][skin]") {
  const auto shared = model(effects);
  SimulatedSkinPad pad(shared);
  const auto once = read(pad, shared->scene, 0.0);
  CHECK(read(pad, shared->scene, 1.0) != once);  // goes on
  CHECK(read(pad, shared->scene, 0.0) == once);
}

}  // namespace tactile_net::lab
