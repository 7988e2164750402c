#include "tactile_net/lab/simulated_pad.hpp"

#include <memory>
#include <string>
#include <vector>

#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace tactile_net::lab {
namespace {

using Frames = std::vector<std::vector<double>>;

/// A cylinder whose force rises in a straight line and drags, under effects with and without
/// memory.
const std::string ramp =
    "[sensor]\ncount = 11\npitch = 0.5\ndepth = 1.5\nreads = [\"strain_x\", \"shear_xy\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
    "[time]\nrate = 100.0\nframes = 8\n"
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 0.7\nfriction = 0.2\n"
    "trajectory = [{ t = 0.0, force = 0.0 }, { t = 0.07, force = 1.4 }]\n";
const std::string line_effects =
    "[viscoelasticity]\nterms = [{ fraction = 0.4, time = 0.02 }]\n"
    "[low_pass]\ntime_constant = 0.01\n[sampling]\naperture = 0.004\n"
    "[noise]\nrms = { strain_x = 1e-3, shear_xy = 1e-3 }\nseed = 3\n"
    "[quantization]\nbits = 12\nrange = [-0.5, 0.5]\n";

std::shared_ptr<const PadModel> pad_model(const std::string& rest) {
  return std::make_shared<const PadModel>(parse_scene(ramp + rest, "pad.toml"));
}

std::vector<LoadPatch> at(const Scene& scene, double time) {
  const auto cylinder = std::get<RigidContact>(contacts_at(scene, time).front());
  return {{.center = cylinder.center,
           .half_width = cylinder.half_width,
           .normal = cylinder.force,
           .tangential = cylinder.friction * cylinder.force}};
}

Frames read(SimulatedPad& pad, const Scene& scene, double begin = 0.0) {
  Frames frames;
  for (std::size_t k = 0; k < scene.time->frames; ++k) {
    frames.emplace_back(reading_count(scene.sensor));
    pad.read(begin + scene.time->time(k), at(scene, scene.time->time(k)), frames.back());
  }
  return frames;
}

}  // namespace

TEST_CASE("a pad in a simulation reads as the scene's own simulation", "[lab][pad]") {
  for (const std::string& rest : {std::string(), line_effects}) {
    const auto shared = pad_model(rest);
    SimulatedPad pad(shared);
    const Frames frames = read(pad, shared->scene);
    SensorRecording recording(shared->scene);
    for (std::size_t k = 0; recording.next(); ++k)
      for (std::size_t i = 0; i < frames[k].size(); ++i) {
        CAPTURE(rest.empty(), k, i);
        CHECK_THAT(frames[k][i], WithinAbs(recording.readings()[i], 1e-9));
      }
  }
}

TEST_CASE("time that begins anew begins with a sensor at rest", "[lab][pad]") {
  const auto shared = pad_model(line_effects);
  SimulatedPad pad(shared);
  const Frames once = read(pad, shared->scene);
  CHECK(read(pad, shared->scene) == once);
  CHECK(read(pad, shared->scene, 1.0) != once);  // goes on: it has crept, other noise is drawn

  SimulatedPad other(shared);
  CHECK(read(other, shared->scene) == once);
}

TEST_CASE("a moment that is asked for twice reads the same", "[lab][pad]") {
  const auto shared = pad_model(line_effects);
  SimulatedPad pad(shared);
  read(pad, shared->scene);
  std::vector<double> first(22);
  std::vector<double> second(22);
  std::vector<double> after(22);
  pad.read(0.08, at(shared->scene, 0.05), first);
  pad.read(0.08, at(shared->scene, 0.05), second);
  pad.read(0.08, at(shared->scene, 0.02), after);
  CHECK(first == second);
  CHECK(after != second);
}

}  // namespace tactile_net::lab
