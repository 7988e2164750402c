// Recordings of known scenes, clean and with one defect planted: what check_readings finds, and
// what it must not find.
#include "tactile_net/lab/readings_check.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>

#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/lab/checked_line.hpp"
#include "tests/lab/recording_defects.hpp"

using namespace tactile_net;
namespace finding = lab::finding;

namespace {

std::size_t count_of(const RecordedLine& recording) { return recording.scene.sensor.count; }

}  // namespace

TEST_CASE("nothing is suspicious about clean recordings", "[lab][check]") {
  const std::size_t count = GENERATE(11u, 41u, 81u);
  const std::string reads = GENERATE("\"stress_x\"", "\"strain_x\"", "\"stress_x\", \"shear_xy\"");
  const std::string contact = GENERATE(presses, slides, holds, idles);
  const std::uint64_t seed = GENERATE(1u, 2u);
  if (count == 81 && (seed > 1 || reads.size() > 12)) return;  // enough, and slow
  CAPTURE(count, reads, contact, seed);
  const lab::ReadingsCheck result = check(recorded_line(line_pad(count, reads, contact, seed)));
  CHECK(kinds(result) == Names{});
  CHECK(result.frames == 400);
  REQUIRE(result.channels[0].noise);
  CHECK_THAT(*result.channels[0].noise / *result.channels[0].stated, WithinAbs(1.0, 0.15));
  REQUIRE(result.residual);
  CHECK_THAT(*result.residual, WithinAbs(1.0, 0.4));
}

TEST_CASE("nothing is suspicious about a clean recording of a coarse array", "[lab][check]") {
  const std::string contact = GENERATE(presses, slides, holds);
  const std::uint64_t seed = GENERATE(1u, 2u);
  std::string text = line_pad(9, "\"stress_x\"", contact, seed);
  text.replace(text.find("0.5e-3"), 6, "3.0e-3");  // twice the depth
  CAPTURE(contact, seed);
  const lab::ReadingsCheck result = check(recorded_line(text));
  CHECK(kinds(result) == Names{});
  REQUIRE(result.peak);
  CHECK(result.peak->force > 15.0);  // of 30 or 40 that press
  CHECK(result.peak->force < 80.0);
}

TEST_CASE("a spike is told wherever its neighbours would feel a load", "[lab][check]") {
  const std::string pitch = GENERATE("0.5e-3", "1.0e-3", "3.0e-3");  // of a depth of 1.5 mm
  std::string text = line_pad(11, "\"stress_x\"", idles, 1);
  text.replace(text.find("0.5e-3"), 6, pitch);
  CAPTURE(pitch);
  RecordedLine recording = recorded_line(text);
  CHECK_FALSE(kinds(check(recording)).contains("single_frame_spikes"));
  recording.frames[200][4] += 150.0 * pad_noise;
  CHECK(kinds(check(recording)).contains("single_frame_spikes") == (pitch != "3.0e-3"));
}

TEST_CASE("each planted defect is found", "[lab][check]") {
  const std::size_t count = GENERATE(11u, 41u);
  const std::uint64_t seed = GENERATE(1u, 2u);
  const RecordedLine clean = recorded_line(line_pad(count, "\"stress_x\"", presses, seed));
  for (const auto& defect : recording_defects<RecordedLine>(count / 2)) {
    CAPTURE(defect.name, count, seed);
    RecordedLine recording = clean;
    std::mt19937 random(static_cast<unsigned>(seed));
    defect.plant(recording, random);
    Names names = kinds(check(recording));
    CHECK(names.contains(defect.expected));
    for (const std::string& one : defect.also) names.erase(one);
    CHECK(names == (defect.also.contains(defect.expected) ? Names{} : Names{defect.expected}));
  }
}

TEST_CASE("codes for missing values are told from readings, and from gaps", "[lab][check]") {
  const std::uint64_t seed = GENERATE(1u, 2u);
  const std::string contact = GENERATE(presses, slides, holds, idles);
  CAPTURE(seed, contact);
  RecordedLine recording = recorded_line(line_pad(41, "\"stress_x\"", contact, seed));
  const std::size_t count = count_of(recording);
  recording.scene.calibration = Calibration{.gain = std::vector<double>(count, 25.0),
                                            .baseline = std::vector<double>(count, 500.0),
                                            .offset = std::vector<double>(count, 0.0)};
  const auto reading = [](double number) { return 25.0 * (number - 500.0); };
  for (auto& frame : recording.frames)
    for (double& value : frame) value = reading(std::round(value / 25.0 + 500.0));
  CHECK_FALSE(kinds(check(recording)).contains("codes_for_missing"));

  RecordedLine gaps = recording;
  std::map<double, std::size_t> planted;
  const auto plant = [&](std::size_t frame, std::size_t taxel, double number) {
    recording.frames[frame][taxel] = reading(number);
    gaps.frames[frame][taxel] = std::numeric_limits<double>::quiet_NaN();
    ++planted[number];
  };
  std::mt19937 random(static_cast<unsigned>(seed));
  for (std::size_t k = 0; k < recording.frames.size(); ++k) {
    if (k % 100 == 33) {
      for (std::size_t i = 0; i < count; ++i) plant(k, i, -1.0);
      continue;
    }
    if (random() % 4 == 0) plant(k, 4 + random() % (count - 4), 65535.0);
    if (k >= 100 && k < 120) plant(k, 3, 30000.0);
  }
  const lab::ReadingsCheck result = check(recording);
  REQUIRE(kinds(result) == Names{"codes_for_missing"});
  std::map<double, std::size_t> told;
  for (const auto& code : std::get<lab::finding::CodesForMissing>(result.findings.at(0)).codes) {
    told[code.number] = code.fields;
    CHECK(code.frames == (code.number == -1.0 ? 4 : 0));
  }
  CHECK(told == planted);
  const Names of_gaps = kinds(check(gaps));
  CHECK(of_gaps.contains("values_missing"));
  CHECK_FALSE(of_gaps.contains("codes_for_missing"));
}

TEST_CASE("the rate is that of the steps forwards, in a known unit", "[lab][check]") {
  const RecordedLine recording = recorded_line(line_pad(11, "\"stress_x\"", idles, 1));
  const auto clock_with = [&](auto time_of, bool unit_known) {
    lab::ReadingsChecker checker(recording.scene);
    for (std::size_t k = 0; k < 100; ++k)
      checker.add(time_of(static_cast<double>(k)), recording.frames[k]);
    if (!unit_known) checker.times_without_unit();
    return checker.result_without_loads().clock;
  };
  const double count = std::ldexp(1e-6, 32);  // of microseconds [s]
  const auto wraps = [&](double k) { return std::fmod(count - 0.5 + 0.01 * k, count); };
  const auto forwards = [](double k) { return 0.01 * k; };
  CHECK_THAT(*clock_with(forwards, true).rate(), WithinRel(100.0, 1e-9));
  const lab::RecordingClock wrapped = clock_with(wraps, true);
  CHECK_THAT(*wrapped.rate(), WithinRel(100.0, 1e-9));
  CHECK(wrapped.backwards == 1);
  CHECK(wrapped.rollovers == 1);
  CHECK_FALSE(clock_with(forwards, false).rate());
}

TEST_CASE("columns in the other order are found by what shears say", "[lab][check]") {
  const std::uint64_t seed = GENERATE(1u, 2u);
  const std::string contact = GENERATE(presses, slides);
  const std::string reads = GENERATE("\"stress_x\", \"shear_xy\"", "\"stress_x\"");
  RecordedLine recording = recorded_line(line_pad(41, reads, contact, seed));
  const auto count = static_cast<std::ptrdiff_t>(count_of(recording));
  for (auto& frame : recording.frames)
    for (auto first = frame.begin(); first != frame.end(); first += count)
      std::reverse(first, first + count);
  const lab::ReadingsCheck result = check(recording);
  // Pressures alone know no direction.
  const bool told = recording.scene.sensor.reads.size() > 1;
  CHECK(kinds(result).contains("order_mirrored") == told);
  if (!told) return;
  const auto order = finding_of<finding::OrderMirrored>(result);
  CHECK(order.along_y);
  CHECK_FALSE(order.exchanged);
  CHECK(order.frames == order.of);
  // The shear's sign turned as well is the pad seen in a mirror.
  for (auto& frame : recording.frames)
    std::transform(frame.begin() + count, frame.end(), frame.begin() + count, std::negate<>());
  CHECK(kinds(check(recording)) == Names{});
}

TEST_CASE("a constant that is found with the loads is no baseline, a drift of it no drift",
          "[lab][check]") {
  RecordedLine recording = recorded_line(line_pad(41, "\"stress_x\", \"stress_y\"", presses, 3));
  const auto names = [&](bool found_with_loads) {
    recording.scene.reconstruct.offset = found_with_loads;
    return kinds(check(recording));
  };
  for (std::size_t k = 0; k < recording.frames.size(); ++k)
    for (std::size_t i = 0; i < 41; ++i)
      recording.frames[k][i] += 10.0 * pad_noise + 0.1 * pad_noise * static_cast<double>(k);
  CHECK(names(false).contains("drift"));
  CHECK(names(true).empty());
  recording.frames = recorded_line(line_pad(41, "\"stress_x\", \"stress_y\"", presses, 3)).frames;
  for (auto& frame : recording.frames) frame[7] += 20.0 * pad_noise;  // of one taxel alone
  CHECK(names(true).contains("baseline"));
}

TEST_CASE("a check says where, how much and what to write", "[lab][check]") {
  const std::uint64_t seed = GENERATE(1u, 2u, 3u);
  const RecordedLine clean = recorded_line(line_pad(41, "\"stress_x\"", presses, seed));
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> white(0.0, 1.0);
  {
    RecordedLine broken = clean;
    for (auto& frame : broken.frames) {
      frame[20] = 0.0;
      frame[7] += 10.0 * pad_noise * white(random);
    }
    const auto result = check(broken);
    CHECK(finding_of<finding::DeadTaxels>(result).taxels == std::vector<std::size_t>{20});
    CHECK(finding_of<finding::NoisyTaxels>(result).taxels == std::vector<std::size_t>{7});
    CHECK_THAT(finding_of<finding::NoisyTaxels>(result).times, WithinRel(10.0, 0.2));
  }
  {
    RecordedLine shifted = clean;
    std::vector<double> offset(41);
    for (double& one : offset) one = 500.0 * white(random);
    for (auto& frame : shifted.frames)
      for (std::size_t i = 0; i < 41; ++i) frame[i] += offset[i];
    const auto baseline = finding_of<finding::Baseline>(check(shifted));
    for (std::size_t i = 0; i < 41; ++i)
      CHECK_THAT(baseline.values[i], WithinAbs(offset[i], pad_noise));
    CHECK_FALSE(baseline.loaded);
  }
  {
    RecordedLine stuck = clean;
    for (std::size_t k = 100; k < 250; ++k) stuck.frames[k][30] = stuck.frames[100][30];
    const auto run = finding_of<finding::StuckTaxels>(check(stuck));
    CHECK(run.worst == 30);
    CHECK(run.first == 100);
    CHECK(run.frames == 150);
    RecordedLine clean_copy = clean;  // from before anything presses on, and so at rest
    for (std::size_t k = 50; k < 400; ++k) clean_copy.frames[k][20] = clean.frames[50][20];
    const auto at_rest = finding_of<finding::StuckTaxels>(check(clean_copy));
    CHECK(at_rest.worst == 20);
    CHECK(at_rest.first == 50);
    CHECK(at_rest.frames == 350);
  }
  {
    RecordedLine spiked = clean;
    for (const std::size_t k : {30u, 110u, 222u}) spiked.frames[k][12] += 60.0 * pad_noise;
    const auto spikes = finding_of<finding::SingleFrameSpikes>(check(spiked));
    CHECK(spikes.taxels == std::vector<std::size_t>{12});
    CHECK(spikes.frames == 3);
    CHECK_THAT(spikes.times, WithinRel(60.0, 0.2));
  }
  {
    RecordedLine tapped = clean;  // a press for one frame, which is no defect
    for (std::size_t i = 0; i < 41; ++i) tapped.frames[350][i] += tapped.frames[100][i];
    CHECK(kinds(check(tapped)) == Names{});
  }
  {
    RecordedLine silent = clean;
    silent.scene.noise.reset();
    CHECK_THAT(*check(silent).channels[0].noise, WithinRel(pad_noise, 0.15));
  }
}

TEST_CASE("the peak is that of the contact", "[lab][check]") {
  const auto result = check(
      recorded_line(line_pad(41, "\"stress_x\"", presses, 1) + "[forward]\nmodel = \"exact\"\n"));
  REQUIRE(result.peak);
  CHECK_THAT(result.peak->force, WithinRel(40.0, 0.03));
  CHECK(result.peak->frame >= 80);
  CHECK(result.peak->frame <= 120);
  CHECK_THAT(*result.clock.rate(), WithinRel(100.0, 1e-9));
}

TEST_CASE("coarse converters are no defect", "[lab][check]") {
  const std::string bits = GENERATE("8", "10", "14");
  const std::string contact = GENERATE(presses, slides, holds, idles);
  CAPTURE(bits, contact);
  const auto result =
      check(recorded_line(line_pad(41, "\"stress_x\"", contact, 1) +
                          "[quantization]\nbits = " + bits + "\nrange = [-20000.0, 20000.0]\n"));
  Names names = kinds(result);
  names.erase("noise_differs");  // it does: steps of 157 beside noise of 30
  names.erase("frames_repeat");
  CHECK(names == Names{});
}

TEST_CASE("a long recording is thinned, and says the same", "[lab][check]") {
  std::string quiet = line_pad(11, "\"stress_x\"", presses, 1);
  quiet.replace(quiet.find("rms = 30.0"), 10, "rms = 1e-9");
  RecordedLine once = recorded_line(quiet);
  once.scene.noise->rms.begin()->second = pad_noise;
  for (auto& frame : once.frames) frame[5] = 0.0;
  lab::ReadingsChecker checker(once.scene);
  std::mt19937 random(1);
  std::normal_distribution<double> white(0.0, pad_noise);
  constexpr std::size_t frames = 20'000;
  for (std::size_t k = 0; k < frames; ++k) {
    std::vector<double> frame = once.frames[k * once.frames.size() / frames];
    for (double& value : frame)
      if (value != 0.0) value += white(random);
    checker.add(std::nullopt, frame);
  }
  const auto result = checker.result();
  CHECK(result.frames == frames);
  CHECK(result.sampled <= lab::ReadingsChecker::most_groups);
  CHECK(result.sampled >= lab::ReadingsChecker::most_groups / 2);
  CHECK(kinds(result) == Names{"dead_taxels"});
}

TEST_CASE("recordings of hardly anything are checked as far as they go", "[lab][check]") {
  const RecordedLine whole = recorded_line(line_pad(11, "\"stress_x\"", holds, 1));
  const auto frames = static_cast<std::size_t>(GENERATE(0, 1, 2, 3, 8));
  RecordedLine few = whole;
  few.frames.resize(frames);
  const auto result = check(few);
  CHECK(result.still == 0);
  CHECK(kinds(result) == (frames == 0 ? Names{"no_frames"} : Names{}));
  for (auto& frame : few.frames)
    for (double& value : frame) value = std::numeric_limits<double>::quiet_NaN();
  CHECK(kinds(check(few)) == (frames == 0 ? Names{"no_frames"} : Names{"values_missing"}));
  for (auto& frame : few.frames)
    for (double& value : frame) value = 0.0;
  CHECK(kinds(check(few)).contains("dead_taxels") == (frames >= 3));
}
