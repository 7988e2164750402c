// Check of what stands between taxels and the file: thresholds, whole numbers and lost signs.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "tests/catch.hpp"
#include "tests/lab/sound_recordings.hpp"

using namespace tactile_net;
namespace finding = lab::finding;

TEST_CASE("a threshold is told as such, and a taxel without a wire behind it too", "[lab][check]") {
  const std::uint64_t seed = GENERATE(110U, 112U, 114U);
  RecordedLine line = honest_line(seed, {.course = Course::pressed,
                                         .chain = Chain::noise,
                                         .pitch_in_depths = 0.5,
                                         .least_peak = 200.0});
  const double threshold = 5.0 * pad_noise;
  for (auto& frame : line.frames)
    for (double& reading : frame)
      if (std::abs(reading) < threshold) reading = 0.0;
  const lab::ReadingsCheck result = check(line);
  CAPTURE(seed);
  CHECK(kinds(result) == Names{});
  for (const lab::CheckedChannel& channel : result.channels) {
    REQUIRE(channel.threshold);
    CHECK(*channel.threshold >= threshold);
    CHECK(*channel.threshold < 1.5 * threshold);
    CHECK_FALSE(channel.noise);
  }
  const std::size_t taxel = taxel_in_the_middle(line);
  for (auto& frame : line.frames) frame[taxel] = 0.0;
  const auto dead = found_in<finding::DeadTaxels>(check(line));
  REQUIRE(dead);
  CHECK(dead->taxels == std::vector<std::size_t>{taxel});
}

TEST_CASE("whole numbers that lost their sign are told, and with it are sound", "[lab][check]") {
  const std::uint64_t seed = GENERATE(130U, 132U);
  RecordedLine line = honest_line(seed, {.course = Course::held,
                                         .chain = Chain::noise,
                                         .pitch_in_depths = 0.5,
                                         .reads = "\"stress_x\", \"shear_xy\"",
                                         .least_peak = 100.0});
  double largest = 0.0;
  for (const auto& frame : line.frames)
    for (const double reading : frame) largest = std::max(largest, std::abs(reading));
  const double step = largest / 60.0;
  const std::size_t count = line.scene.sensor.count;
  line.scene.calibration = Calibration{.gain = std::vector<double>(2 * count, step),
                                       .baseline = std::vector<double>(2 * count, 0.0),
                                       .offset = std::vector<double>(2 * count, 0.0)};
  RecordedLine lost = line;
  for (std::size_t k = 0; k < line.frames.size(); ++k)
    for (std::size_t i = 0; i < 2 * count; ++i) {
      const double number = std::round(line.frames[k][i] / step);
      line.frames[k][i] = step * number;
      lost.frames[k][i] = step * (number < 0.0 ? number + 256.0 : number);
    }
  CAPTURE(seed);
  CHECK_FALSE(kinds(check(line)).contains("signs_lost"));
  CHECK(kinds(check(lost)) == Names{"signs_lost"});
  lab::ReadingsChecker checker(lost.scene);
  for (const auto& frame : lost.frames) checker.add({}, frame);
  const lab::Findings told = checker.doubts();  // what solving tells
  CHECK(std::any_of(told.begin(), told.end(), [](const lab::Finding& one) {
    return std::holds_alternative<finding::SignsLost>(one);
  }));
}

TEST_CASE("signs that are lost are told where one end holds a single number, unless it is a code",
          "[lab][check]") {
  // What presses is of one sign, and noise goes to the nearest number at the other end.
  const double sign = GENERATE(1.0, -1.0);
  const std::uint64_t seed = GENERATE(140U, 141U, 142U);
  RecordedLine line = honest_line(seed, {.course = Course::pressed,
                                         .chain = Chain::noise,
                                         .pitch_in_depths = 0.5,
                                         .reads = "\"stress_x\"",
                                         .least_peak = 100.0});
  const std::vector<std::vector<double>> once = line.frames;
  for (int again = 0; again < 3; ++again)
    line.frames.insert(line.frames.end(), once.begin(), once.end());
  const double step = pad_noise;
  const std::size_t count = line.scene.sensor.count;
  line.scene.calibration = Calibration{.gain = std::vector<double>(count, step),
                                       .baseline = std::vector<double>(count, 0.0),
                                       .offset = std::vector<double>(count, 0.0)};
  std::mt19937 random(static_cast<unsigned>(seed));
  RecordedLine lost = line;
  RecordedLine missing = line;  // the number at the other end is a code, which comes at any time
  const double code = sign > 0.0 ? 255.0 : 0.0;
  for (std::size_t k = 0; k < line.frames.size(); ++k)
    for (std::size_t i = 0; i < count; ++i) {
      const double size = std::clamp(std::round(line.frames[k][i] / step), -1.0, 60.0);
      const double number = sign > 0.0 ? size : std::min(-size, 0.0);
      const double byte = number < 0.0 ? number + 256.0 : number;
      lost.frames[k][i] = step * byte;
      const double whole = sign > 0.0 ? std::max(size, 0.0) : 255.0 - std::max(size, 0.0);
      missing.frames[k][i] = step * (random() % 4 == 0 ? code : whole);
      line.frames[k][i] = step * number;
    }
  CAPTURE(sign, seed);
  CHECK_FALSE(kinds(check(line)).contains("signs_lost"));
  CHECK(kinds(check(lost)) == Names{"signs_lost"});
  CHECK_FALSE(kinds(check(missing)).contains("signs_lost"));
}

TEST_CASE("a converter's steps are no noise of a taxel, whatever its mean", "[lab][check]") {
  // Between two steps the one, or the other; in the middle of one always the same.
  RecordedLine line = honest_line(120, {.course = Course::idle,
                                        .chain = Chain::noise,
                                        .pitch_in_depths = 1.0,
                                        .reads = "\"stress_x\""});
  const double step = GENERATE(2.0, 3.0, 5.0) * pad_noise;
  const auto converted = [&](double spread) {
    RecordedLine read = line;
    Random random(1);
    for (auto& frame : read.frames)
      for (std::size_t i = 0; i < frame.size(); ++i) {
        const double noise = i == 2 ? random.white(spread) : 0.0;
        frame[i] = step * std::round((frame[i] + noise + (i == 4 ? 0.5 * step : 0.0)) / step);
      }
    return kinds(check(read));
  };
  CAPTURE(step);
  CHECK_FALSE(converted(0.0).contains("noisy_taxels"));
  CHECK(converted(5.0 * step).contains("noisy_taxels"));
}
