// Recordings of a calibrated array, sound and with gains that have changed since: what check names.
#include <cmath>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/lab/readings_check.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"
#include "tests/lab/checked_recording.hpp"

using namespace tactile_net;

namespace {

struct Array {
  std::size_t count;
  double pitch, depth;
  std::string reads;
};

/// Presses at random places with random forces, held and let go.
///
/// @param noise   over the largest readings
/// @param spread  of the gains about what the scene's calibration says
RecordedLine recorded_presses(const Array& array, unsigned seed, double noise = 0.004,
                              double spread = 0.0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const bool strain = array.reads.find("strain") != array.reads.npos;
  const double rms = noise * 40.0 / array.depth / (strain ? 2e5 : 1.0);
  const std::string pad = "[sensor]\ncount = " + std::to_string(array.count) +
                          "\npitch = " + std::to_string(array.pitch) +
                          "\ndepth = " + std::to_string(array.depth) + "\nreads = [" + array.reads +
                          "]\n[material]\nyoungs_modulus = 2e5\npoisson_ratio = 0.45\n[noise]\n"
                          "rms = " +
                          std::to_string(rms) + '\n';
  RecordedLine result{parse_scene(pad, "pad.toml")};
  const std::size_t readings = reading_count(result.scene.sensor);
  std::vector<double> gains(readings);
  for (double& gain : gains) gain = 1.0 + spread * normal(random);
  const double half_width = uniform(0.4, 1.6) * array.depth;
  const double friction = seed % 3 == 0 ? uniform(0.0, 0.5) : 0.0;
  const double end = 0.45 * array.pitch * static_cast<double>(array.count);
  for (int press = 0; press < 15; ++press) {
    const Scene pressed =
        parse_scene(pad + "[[contact]]\nshape = \"" + (seed % 2 == 0 ? "cylinder" : "punch") +
                        "\"\nforce = " + std::to_string(uniform(30.0, 100.0)) + "\nhalf_width = " +
                        std::to_string(half_width) + "\nfriction = " + std::to_string(friction) +
                        "\ncenter = " + std::to_string(uniform(-end, end)) + '\n',
                    "pad.toml");
    const std::vector<double> pure =
        exact_readings(pressed.sensor, pressed.material, pressed.contacts);
    for (const double share : {0.0, 0.0, 0.0, 0.3, 0.7, 1.0, 1.0, 1.0, 1.0, 1.0, 0.5, 0.1}) {
      std::vector<double>& frame = result.frames.emplace_back();
      for (std::size_t i = 0; i < readings; ++i)
        frame.push_back(gains[i] * share * pure[i] + rms * normal(random));
    }
  }
  result.scene.calibration = Calibration{.gain = std::vector<double>(readings, 1.0),
                                         .baseline = std::vector<double>(readings),
                                         .offset = std::vector<double>(readings)};
  return result;
}

const Array dense_array{41, 0.5e-3, 1.5e-3, "\"stress_x\", \"shear_xy\""};

void drift(RecordedLine& recording, std::size_t reading, double change) {
  for (std::vector<double>& frame : recording.frames) frame[reading] *= 1.0 + change;
}

lab::finding::GainsChanged changed(const RecordedLine& recording) {
  lab::ReadingsChecker checker(recording.scene);
  double time = 0.0;
  for (const std::vector<double>& frame : recording.frames) checker.add(time += 0.01, frame);
  for (const lab::Finding& one : checker.result().findings)
    if (const auto* found = std::get_if<lab::finding::GainsChanged>(&one)) return *found;
  return {};
}

}  // namespace

TEST_CASE("a gain that changed is named with its size, and no other", "[lab][check]") {
  RecordedLine recording = recorded_presses(dense_array, 4, 0.003);
  drift(recording, 17, -0.06);
  const lab::finding::GainsChanged found = changed(recording);
  REQUIRE(found.readings == std::vector<std::size_t>{17});
  CHECK(std::abs(found.changes[0] + 0.06) < 4.0 * found.sds[0]);
  CHECK(found.sds[0] < 0.013);
}

TEST_CASE("gains of a sound array are not named, whatever presses", "[lab][check]") {
  const Array array = GENERATE(values<Array>({dense_array,
                                              {32, 0.5e-3, 2e-3, "\"strain_x\""},
                                              {31, 1e-3, 1.5e-3, "\"stress_x\""},
                                              {11, 2e-3, 1.5e-3, "\"stress_x\""}}));
  const unsigned seed = GENERATE(10u, 11u, 12u);
  const double spread = GENERATE(0.0, 0.01);
  CAPTURE(array.count, array.reads, seed, spread);
  CHECK(changed(recorded_presses(array, seed, 0.003, spread)).readings.empty());
}

TEST_CASE("at most one sound recording in a hundred names a gain", "[long]") {
  std::size_t named = 0;
  for (unsigned seed = 100; seed < 300; ++seed) {
    const bool strain = seed % 5 == 0;
    const Array array{seed % 4 == 0 ? 21u : 41u, seed % 4 == 0 ? 1e-3 : 0.5e-3, 1.5e-3,
                      strain ? "\"strain_x\"" : dense_array.reads};
    named += !changed(recorded_presses(array, seed, seed % 2 == 0 ? 0.01 : 0.003, 0.005))
                  .readings.empty();
  }
  CHECK(named <= 2);
}

TEST_CASE("two neighbours that read 5 % less are named in most recordings", "[long]") {
  std::size_t right = 0, wrong = 0;
  for (unsigned seed = 1000; seed < 1020; ++seed) {
    RecordedLine recording = recorded_presses(dense_array, seed, 0.003, 0.002);
    const std::size_t first = 8 + seed % 25;
    drift(recording, first, -0.05);
    drift(recording, first + 1, -0.05);
    std::size_t own = 0;
    for (const std::size_t reading : changed(recording).readings)
      reading == first || reading == first + 1 ? ++own : ++wrong;
    right += own > 0 ? 1U : 0U;
  }
  CHECK(right >= 10);  // 43 of 60 were
  CHECK(wrong <= 6);
}

TEST_CASE("coarse arrays and arrays without a calibration say nothing of gains", "[lab][check]") {
  RecordedLine coarse = recorded_presses({16, 1.5e-3, 1.5e-3, "\"stress_x\""}, 5, 0.003);
  drift(coarse, 8, -0.05);
  CHECK(changed(coarse).readings.empty());
  RecordedLine stated = recorded_presses(dense_array, 4, 0.003);
  drift(stated, 17, -0.06);
  stated.scene.calibration.reset();
  CHECK(changed(stated).readings.empty());
}

TEST_CASE("a few presses say nothing of gains", "[lab][check]") {
  RecordedLine recording = recorded_presses(dense_array, 4, 0.003);
  recording.frames.resize(8);
  drift(recording, 17, -0.06);
  CHECK(changed(recording).readings.empty());
}
