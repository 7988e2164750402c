// Of sound sensors check has nothing to say; and a fault planted in one it finds.
#include "tests/lab/sound_recordings.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

/// How many of so many have any finding.
std::size_t accused_recordings(std::uint64_t first, std::uint64_t count) {
  std::size_t alarms = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Names names =
        seed % 2 == 0 ? kinds(check(honest_line(seed))) : kinds(check(honest_skin(seed)));
    if (names.empty()) continue;
    ++alarms;
    UNSCOPED_INFO("seed " << seed << ": " << *names.begin());
  }
  return alarms;
}

}  // namespace

TEST_CASE("sound sensors have nothing suspicious, whatever touches them and however they are read",
          "[lab][check]") {
  CHECK(accused_recordings(1, 24) == 0);
}

TEST_CASE("of two hundred sound sensors hardly any is suspicious", "[lab][check][long]") {
  CHECK(accused_recordings(1000, 200) <= 4);
}

TEST_CASE("displacements in the plane do not tell the order of taxels", "[lab][check][skin]") {
  RecordedSkin skin = record_with<lab::SkinRecording>(std::get<SkinScene>(parse_any_scene(
      "[sensor]\nrows = 8\ncolumns = 8\npitch = 1.5e-3\ndepth = 1e-3\n"
      "reads = [\"displacement_y\", \"displacement_z\"]\n[material]\nyoungs_modulus = 1.2e5\n"
      "poisson_ratio = 0.48\n[noise]\nrms = 1.8e-6\n[time]\nrate = 100.0\nframes = 40\n"
      "[[contact]]\nshape = \"sphere\"\nradius = 3e-3\nplace = [1e-3, -1e-3]\nfriction = 0.4\n"
      "direction = 76.0\ntrajectory = [{ t = 0.0, force = 1e-6 }, { t = 0.2, force = 1e-6 }, "
      "{ t = 0.22, force = 0.8 }, { t = 0.4, force = 0.8 }]\n",
      "markers.toml")));
  for (const bool backwards : {false, true}) {
    if (backwards)
      for (auto& frame : skin.frames) std::reverse(frame.begin(), frame.end());
    CHECK_FALSE(kinds(check(skin)).contains("order_mirrored"));
  }
}

namespace {

struct Fault {
  std::string name;
  /// @param taxel  that reads most
  std::function<void(std::vector<std::vector<double>>& frames, std::size_t taxel, Random& random)>
      plant;
  std::string expected;
};

const std::vector<Fault> faults{
    {"kPa for Pa",
     [](auto& frames, auto, auto&) {
       for (auto& frame : frames)
         for (double& reading : frame) reading *= 1e-3;
     },
     "scale_by_1000"},
    {"the sign",
     [](auto& frames, auto, auto&) {
       for (auto& frame : frames)
         for (double& reading : frame) reading *= -1.0;
     },
     "whole_pad_pulled"},
    {"a cut wire",
     [](auto& frames, auto taxel, auto&) {
       for (auto& frame : frames) frame[taxel] = 0.0;
     },
     "dead_taxels"},
    {"a loose contact",
     [](auto& frames, auto taxel, auto& random) {
       for (auto& frame : frames) frame[taxel] += random.white(20.0 * pad_noise);
     },
     "noisy_taxels"},
    {"a bit that is lost now and then",
     [](auto& frames, auto taxel, auto&) {
       for (const std::size_t k : {20U, 70U, 130U}) frames[k][taxel] += 100.0 * pad_noise;
     },
     "single_frame_spikes"},
    {"a reading that is held",
     [](auto& frames, auto, auto&) {
       for (std::size_t k = 10; k < frames.size(); ++k) frames[k][1] = frames[10][1];
     },
     "stuck_taxels"},
    {"a zero of each taxel",
     [](auto& frames, auto, auto& random) {
       std::vector<double> zero(frames[0].size());
       for (double& one : zero) one = random.white(15.0 * pad_noise);
       for (auto& frame : frames)
         for (std::size_t i = 0; i < zero.size(); ++i) frame[i] += zero[i];
     },
     "baseline"},
    {"warmth",
     [](auto& frames, auto, auto&) {
       for (std::size_t k = 0; k < frames.size(); ++k)
         for (double& reading : frames[k]) reading += 0.3 * pad_noise * static_cast<double>(k);
     },
     "drift"},
    {"frames that are divided by their largest reading",
     [](auto& frames, auto, auto&) {
       for (auto& frame : frames) {
         const double largest = *std::max_element(frame.begin(), frame.end());
         for (double& reading : frame) reading /= largest;
       }
     },
     "frames_normalised"},
};

}  // namespace

TEST_CASE("a fault planted in what is sound otherwise is told", "[lab][check]") {
  for (std::size_t n = 0; n < faults.size(); ++n)
    for (const Course course : {Course::pressed, Course::held}) {
      const std::uint64_t seed = 50 + 2 * n;
      const RecordingKind kind{
          .course = course, .chain = Chain::noise, .pitch_in_depths = 0.5, .least_peak = 150.0};
      Random random(seed);
      CAPTURE(faults[n].name, seed, course == Course::held);
      RecordedLine line = honest_line(seed, kind);
      faults[n].plant(line.frames, taxel_in_the_middle(line), random);
      CHECK(kinds(check(line)).contains(faults[n].expected));
      RecordedSkin skin = honest_skin(seed, kind);
      faults[n].plant(skin.frames, taxel_in_the_middle(skin), random);
      CHECK(kinds(check(skin)).contains(faults[n].expected));
    }
}
