// Readings that are equal, or new too rarely, to those beside them: what the check finds, and what
// it must not find.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "tactile_net/lab/readings_check.hpp"
#include "tests/catch.hpp"
#include "tests/lab/checked_line.hpp"

using namespace tactile_net;
namespace finding = lab::finding;

namespace {

/// What of a check tells of these kinds alone.
Names of_readings_side_by_side(const lab::ReadingsCheck& check) {
  Names names = kinds(check);
  std::erase_if(names, [](const std::string& one) {
    return one != "equal_readings" && one != "slow_channels" && one != "order_serpentine";
  });
  return names;
}

/// Each value is written again until its channel is new, in the frames that `is_new` says.
void hold(RecordedLine& recording, std::size_t first, std::size_t count, auto is_new) {
  for (std::size_t k = 1; k < recording.frames.size(); ++k)
    if (!is_new(k))
      std::copy_n(recording.frames[k - 1].begin() + static_cast<std::ptrdiff_t>(first), count,
                  recording.frames[k].begin() + static_cast<std::ptrdiff_t>(first));
}

}  // namespace

TEST_CASE("two readings that are equal in every frame are named", "[lab][check]") {
  const std::string contact = GENERATE(presses, slides, holds, idles);
  const std::string reads = GENERATE("\"stress_x\"", "\"stress_x\", \"shear_xy\"");
  const bool rounded = GENERATE(false, true);
  CAPTURE(contact, reads, rounded);
  RecordedLine recording = recorded_line(line_pad(21, reads, contact, 1));
  // A converter whose steps are as large as the noise makes readings equal now and then.
  if (rounded)
    for (auto& frame : recording.frames)
      for (double& value : frame) value = pad_noise * std::round(value / pad_noise);
  CHECK(of_readings_side_by_side(check(recording)) == Names{});
  RecordedLine twins = recording;
  for (auto& frame : twins.frames) frame[12] = frame[11];
  const lab::ReadingsCheck result = check(twins);
  REQUIRE(of_readings_side_by_side(result) == Names{"equal_readings"});
  const auto found = finding_of<finding::EqualReadings>(result);
  CHECK(found.groups == std::vector<std::vector<std::size_t>>{{11, 12}});
  CHECK(found.taxels == std::vector<std::size_t>{11, 12});
  // In every frame but one is not in every frame.
  twins.frames[250][12] += 3.0 * pad_noise;
  CHECK(of_readings_side_by_side(check(twins)) == Names{});
  // A gap says nothing.
  twins.frames[250][12] = std::numeric_limits<double>::quiet_NaN();
  CHECK(of_readings_side_by_side(check(twins)) == Names{"equal_readings"});
}

TEST_CASE("raw numbers that are equal are so behind gains of their own", "[lab][check]") {
  RecordedLine recording = recorded_line(line_pad(21, "\"stress_x\"", presses, 2));
  Calibration calibration{.gain = {}, .baseline = {}, .offset = std::vector<double>(21, 7.0)};
  for (std::size_t i = 0; i < 21; ++i) {
    calibration.gain.push_back(20.0 + 0.3 * static_cast<double>(i));
    calibration.baseline.push_back(500.0 - 1.7 * static_cast<double>(i));
  }
  recording.scene.calibration = calibration;
  for (auto& frame : recording.frames) {
    std::vector<double> numbers = frame;
    uncalibrate(calibration, numbers);
    numbers[12] = numbers[11];
    frame = numbers;
    calibrate(calibration, frame);
  }
  REQUIRE(kinds(check(recording)).contains("equal_readings"));
  CHECK(finding_of<finding::EqualReadings>(check(recording)).taxels ==
        std::vector<std::size_t>{11, 12});
}

TEST_CASE("readings are not taken for equal that have no noise to differ by", "[lab][check]") {
  // Under a contact in the middle, one that presses and lets go as much as one that trembles.
  std::string trembles = cylinder + "trajectory = [";
  for (int k = 0; k <= 100; ++k)
    trembles += "{ t = " + std::to_string(0.04 * k) +
                ", force = " + std::to_string(k % 5 < 3 ? 20.0 + k % 5 : 12.0) + " }, ";
  const std::string contacts[] = {presses, holds, trembles + "]\n"};
  const std::string& contact = contacts[GENERATE(range(0, 3))];
  std::string quiet = line_pad(21, "\"stress_x\"", contact, 1);
  quiet.replace(quiet.find("rms = 30.0"), 10, "rms = 1e-9");
  RecordedLine recording = recorded_line(quiet);
  recording.scene.noise->rms.begin()->second = pad_noise;
  const double threshold = GENERATE(0.0, 400.0);
  for (auto& frame : recording.frames)
    for (double& value : frame) value = value < threshold ? 0.0 : std::round(value);
  std::size_t equal = 0;
  for (const auto& frame : recording.frames) equal += frame[9] == frame[11];
  REQUIRE(equal == recording.frames.size());
  CHECK(of_readings_side_by_side(check(recording)) == Names{});
}

TEST_CASE(
    "a quantity that is new in every k-th frame only is told with its rate, and its noise is "
    "that of its new frames",
    "[lab][check]") {
  const std::size_t every = GENERATE(2u, 3u, 5u);
  const std::string contact = GENERATE(presses, holds, idles);
  CAPTURE(every, contact);
  RecordedLine recording = recorded_line(line_pad(21, "\"stress_x\", \"shear_xy\"", contact, 1));
  const RecordedLine clean = recording;
  const auto by_rate = [&](std::size_t k) { return k % every == 0; };
  hold(recording, 21, 21, by_rate);
  const lab::ReadingsCheck result = check(recording);
  CHECK(kinds(result) == Names{"slow_channels"});
  const auto found = finding_of<finding::SlowChannels>(result);
  CHECK(found.channels == std::vector<std::size_t>{1});
  CHECK_THAT(found.every.at(0), WithinRel(static_cast<double>(every), 0.02));
  CHECK(found.last.at(0) % every == 0);
  CHECK_FALSE(found.all);
  REQUIRE(result.channels[1].noise);
  CHECK_THAT(*result.channels[1].noise / pad_noise, WithinAbs(1.0, 0.25));

  SECTION("a clock of its own is late by a frame now and then") {
    RecordedLine loose = clean;
    std::size_t next = 0;
    std::size_t count = 0;
    hold(loose, 21, 21, [&](std::size_t k) {
      if (k < next) return false;
      next = k + every + (++count % 3 == 0 ? 1 : 0);
      return true;
    });
    CHECK(of_readings_side_by_side(check(loose)) == Names{"slow_channels"});
  }
  SECTION("whole rows are told as such") {
    RecordedLine rows = clean;
    hold(rows, 0, 42, by_rate);
    const lab::ReadingsCheck of_rows = check(rows);
    CHECK(of_readings_side_by_side(of_rows) == Names{"slow_channels"});
    CHECK(finding_of<finding::SlowChannels>(of_rows).all);
    CHECK_FALSE(kinds(of_rows).contains("noise_differs"));
  }
  SECTION("one that pauses, and is then new in every frame, is not slow") {
    RecordedLine pauses = clean;
    hold(pauses, 21, 21, [](std::size_t k) { return k < 100 || k > 200; });
    CHECK(of_readings_side_by_side(check(pauses)) == Names{});
  }
}
