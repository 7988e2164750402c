// Recordings of sound sensors, of many kinds and by their seeds: check has nothing to say of them;
// and what it must say where one fault is planted in one.
#include "tests/lab/checked_recording.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/broken_taxels.hpp"
#include "tactile_net/lab/readings_check.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/lab/scene_parts.hpp"

using namespace tactile_net;
namespace finding = lab::finding;

namespace {

enum class Course { presses, holds, lasts, slides, sways, idles };
enum class Chain { noise, fine_steps, coarse_steps, threshold };

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double white(double rms) { return rms * std::normal_distribution<double>()(engine_); }
  template <typename Value>
  Value one_of(std::initializer_list<Value> values) {
    return values
        .begin()[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(engine_)];
  }

 private:
  std::mt19937_64 engine_;
};

std::string number(double value) { return std::to_string(value); }

/// What a recording is of. What is left out, or empty, is chosen at random.
struct RecordingKind {
  std::optional<Course> course{};
  std::optional<Chain> chain{};
  std::optional<double> pitch_in_depths{};
  std::string reads{};
  double least_peak = 40.0;  // the largest reading, about, over the noise
};

constexpr std::size_t frames_recorded = 160;  // 1.6 s

/// @param place  of a share of the way along which contacts move
std::string contact_course(Course course, double force, Random& random, const auto& place) {
  const auto at = [&](double t, double share, double way) {
    return "{ t = " + number(t) + ", force = " + number(std::max(share * force, 1e-6)) + ", " +
           place(way) + " }";
  };
  const double shift = random.uniform(-0.1, 0.1);
  std::string points;
  switch (course) {
    case Course::presses:
      points = at(0.2, 0, 0) + ", " + at(0.35, 0.6, 0) + ", " + at(0.5, 0, 0) + ", " +
               at(0.8, 0, 1) + ", " + at(0.95 + shift, 1, 1) + ", " + at(1.2, 0, 1);
      break;
    case Course::holds:
      points = at(0.4 + shift, 0, 0) + ", " + at(0.45 + shift, 1, 0) + ", " +
               at(random.uniform(0.6, 1.5), 1, 0) + ", " + at(1.55, 0, 0);
      break;
    case Course::lasts:
      points = at(0.0, 1, 0) + ", " + at(1.6, 1, 0);
      break;
    case Course::slides:
      points = at(0.0, 1, 0) + ", " + at(0.8 + shift, 1, 1) + ", " + at(1.6, 1, 0);
      break;
    case Course::sways:
      points = at(0.0, 1, 0) + ", " + at(0.4, 1.03, 0) + ", " + at(0.8, 0.97, 0.05) + ", " +
               at(1.2, 1.02, 0) + ", " + at(1.6, 1, 0);
      break;
    case Course::idles:
      points = at(0.0, 0, 0) + ", " + at(1.6, 0, 0);
      break;
  }
  return "trajectory = [" + points + "]\n";
}

Course course_of(const RecordingKind& kind, Random& random) {
  const auto any = random.one_of({Course::presses, Course::holds, Course::lasts, Course::slides,
                                  Course::sways, Course::idles});
  return kind.course.value_or(any);
}

std::string pad_table(const std::string& reads, double depth, std::uint64_t seed) {
  return "depth = " + number(depth) + "\nreads = [" + reads +
         "]\n[material]\nyoungs_modulus = 4e5\npoisson_ratio = 0.45\n[noise]\nrms = " +
         number(pad_noise) + "\nseed = " + std::to_string(seed) +
         "\n[time]\nrate = 100.0\nframes = " + std::to_string(frames_recorded) + "\n[[contact]]\n";
}

/// What stands between the transducers and the file.
template <typename Recording>
Recording through(Chain chain, Random& random, Recording recording) {
  const double step = pad_noise * (chain == Chain::fine_steps     ? random.uniform(0.05, 0.5)
                                   : chain == Chain::coarse_steps ? random.uniform(1.0, 6.0)
                                                                  : 0.1);
  const double threshold = chain == Chain::threshold ? pad_noise * random.uniform(3.0, 6.0) : 0.0;
  if (chain == Chain::noise) return recording;
  for (auto& frame : recording.frames)
    for (double& reading : frame) {
      if (std::abs(reading) < threshold) reading = 0.0;
      reading = step * std::round(reading / step);
    }
  return recording;
}

/// A threshold leaves nothing of a sensor that nothing touches.
Chain chain_of(const RecordingKind& kind, Course course, Random& random) {
  if (course == Course::idles)
    return kind.chain.value_or(random.one_of({Chain::noise, Chain::coarse_steps}));
  const auto any = random.one_of(
      {Chain::noise, Chain::noise, Chain::fine_steps, Chain::coarse_steps, Chain::threshold});
  return kind.chain.value_or(any);
}

RecordedLine honest_line(std::uint64_t seed, const RecordingKind& kind = {}) {
  Random random(seed);
  const double depth = 1e-3 * random.uniform(1.0, 4.0);
  const double pitch = depth * kind.pitch_in_depths.value_or(random.one_of({0.35, 0.5, 1.0, 1.6}));
  const double half = std::max(4.0 * depth, 4.0 * pitch);
  const auto count = static_cast<std::size_t>(2.0 * half / pitch) + 1;
  const auto any = random.one_of<std::string>({"\"stress_x\"", "\"stress_x\", \"shear_xy\""});
  const std::string reads = kind.reads.empty() ? any : kind.reads;
  const double width = depth * random.uniform(0.5, 1.5);
  const double peak = pad_noise * random.uniform(kind.least_peak, 500.0);
  const double from = half * random.uniform(-0.5, 0.5);
  const double to = half * random.uniform(-0.5, 0.5);
  const auto place = [&](double way) { return "center = " + number(from + way * (to - from)); };
  const Course course = course_of(kind, random);
  const bool drags = reads.find("shear") != reads.npos;
  const std::string contact =
      "shape = \"cylinder\"\nhalf_width = " + number(width) +
      (drags ? "\nfriction = " + number(random.uniform(0.0, 0.4)) : std::string()) + '\n' +
      contact_course(course, 1.6 * peak * (depth + 0.5 * width), random, place);
  return through(chain_of(kind, course, random), random,
                 record_with<lab::SensorRecording>(parse_scene(
                     "[sensor]\ncount = " + std::to_string(count) + "\npitch = " + number(pitch) +
                         '\n' + pad_table(reads, depth, seed) + contact,
                     "line.toml")));
}

RecordedSkin honest_skin(std::uint64_t seed, const RecordingKind& kind = {}) {
  Random random(seed);
  const double depth = 1e-3 * random.uniform(1.0, 4.0);
  const double pitch = depth * kind.pitch_in_depths.value_or(random.one_of({0.6, 1.0, 1.6}));
  const auto rows = random.one_of<std::size_t>({5, 6, 7, 8});
  const auto columns = random.one_of<std::size_t>({5, 6, 7});
  const auto any = random.one_of<std::string>({"\"stress_x\"", "\"stress_x\"", three_stresses});
  const std::string reads = kind.reads.empty() ? any : kind.reads;
  const double radius = depth * random.uniform(0.7, 1.6);
  const double peak = pad_noise * random.uniform(kind.least_peak, 500.0);
  const auto somewhere = [&](std::size_t taxels) {
    return 0.25 * static_cast<double>(taxels) * pitch * random.uniform(-1.0, 1.0);
  };
  const double y[2] = {somewhere(rows), somewhere(rows)};
  const double z[2] = {somewhere(columns), somewhere(columns)};
  const auto place = [&](double way) {
    return "place = [" + number(y[0] + way * (y[1] - y[0])) + ", " +
           number(z[0] + way * (z[1] - z[0])) + "]";
  };
  const Course course = course_of(kind, random);
  const bool drags = reads.find("shear") != reads.npos;
  const std::string contact =
      "shape = \"sphere\"\nradius = " + number(radius) +
      (drags ? "\nfriction = " + number(random.uniform(0.0, 0.4)) +
                   "\ndirection = " + number(random.uniform(0.0, 360.0))
             : std::string()) +
      '\n' +
      contact_course(course, 2.1 * peak * (depth * depth + 0.7 * radius * radius), random, place);
  return through(
      chain_of(kind, course, random), random,
      record_with<lab::SkinRecording>(std::get<SkinScene>(parse_any_scene(
          "[sensor]\nrows = " + std::to_string(rows) + "\ncolumns = " + std::to_string(columns) +
              "\npitch = " + number(pitch) + '\n' + pad_table(reads, depth, seed) + contact,
          "skin.toml"))));
}

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

namespace {

template <class Found>
std::optional<Found> found_in(const lab::ReadingsCheck& check) {
  for (const lab::Finding& one : check.findings)
    if (const Found* found = std::get_if<Found>(&one)) return *found;
  return std::nullopt;
}

/// The one whose first channel reads most.
template <typename Scene>
std::size_t taxel_in_the_middle(const CheckedRecording<Scene>& recording) {
  const std::size_t channels = channel_count(recording.scene.sensor);
  std::size_t most = 0;
  double largest = 0.0;
  for (const auto& frame : recording.frames)
    for (std::size_t i = 0; i < frame.size() / channels; ++i)
      if (frame[i] > largest) {
        largest = frame[i];
        most = i;
      }
  return most;
}

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
    for (const Course course : {Course::presses, Course::holds}) {
      const std::uint64_t seed = 50 + 2 * n;
      const RecordingKind kind{
          .course = course, .chain = Chain::noise, .pitch_in_depths = 0.5, .least_peak = 150.0};
      Random random(seed);
      CAPTURE(faults[n].name, seed, course == Course::holds);
      RecordedLine line = honest_line(seed, kind);
      faults[n].plant(line.frames, taxel_in_the_middle(line), random);
      CHECK(kinds(check(line)).contains(faults[n].expected));
      RecordedSkin skin = honest_skin(seed, kind);
      faults[n].plant(skin.frames, taxel_in_the_middle(skin), random);
      CHECK(kinds(check(skin)).contains(faults[n].expected));
    }
}

TEST_CASE("a contact that never leaves is no zero: the force is that of a recording with a rest",
          "[lab][check]") {
  const std::uint64_t seed = GENERATE(70U, 71U, 72U, 73U);
  const auto both = [&](auto lasts) {
    auto comes = lasts;
    Random random(seed);
    std::vector<std::vector<double>> rest(60, std::vector<double>(lasts.frames[0].size()));
    for (auto& frame : rest)
      for (double& reading : frame) reading = random.white(pad_noise);
    comes.frames.insert(comes.frames.begin(), rest.begin(), rest.end());
    const lab::ReadingsCheck all = check(lasts);
    const lab::ReadingsCheck with_rest = check(comes);
    CHECK(kinds(all) == Names{});
    CHECK(kinds(with_rest) == Names{});
    CHECK(all.never_let_go);
    CHECK_FALSE(with_rest.never_let_go);
    REQUIRE((all.peak && with_rest.peak));
    CHECK(all.peak->frame + rest.size() == with_rest.peak->frame);
    CHECK_THAT(all.peak->force, WithinRel(with_rest.peak->force, 1e-9));
  };
  const RecordingKind kind{.course = Course::sways, .chain = Chain::noise};
  CAPTURE(seed);
  both(honest_line(seed, kind));
  both(honest_skin(seed, kind));
}

TEST_CASE("of a contact and a wrong zero together nothing is taken off, and the force stays",
          "[lab][check]") {
  std::size_t told = 0;  // some such zeros are explained by loads
  for (std::uint64_t seed = 70; seed < 90; ++seed) {
    RecordedLine line =
        honest_line(seed, {.course = Course::lasts, .chain = Chain::noise, .pitch_in_depths = 0.5});
    const double force = check(line).peak.value().force;
    double squares = 0.0;
    for (const double reading : line.frames[0]) squares += reading * reading;
    const double rms = std::sqrt(squares / static_cast<double>(line.frames[0].size()));
    for (auto& frame : line.frames)
      for (std::size_t i = 0; i < frame.size(); ++i)
        frame[i] += i % 2 == 0 ? 0.35 * rms : -0.35 * rms;
    const lab::ReadingsCheck result = check(line);
    CAPTURE(seed, kinds(result));
    const auto baseline = found_in<finding::Baseline>(result);
    if (!baseline) continue;
    ++told;
    CHECK(baseline->loaded);
    CHECK(result.never_let_go);
    CHECK_THAT(result.peak.value().force, WithinRel(force, 0.3));
  }
  CHECK(told >= 5);
}

TEST_CASE("warmth under a contact that never leaves is a drift, and no zero of it is told",
          "[lab][check]") {
  const std::uint64_t seed = GENERATE(80U, 81U, 82U);
  RecordedSkin skin = honest_skin(seed, {.course = Course::lasts, .chain = Chain::noise});
  for (std::size_t k = 0; k < skin.frames.size(); ++k)
    for (double& reading : skin.frames[k]) reading += 0.3 * pad_noise * static_cast<double>(k);
  const lab::ReadingsCheck result = check(skin);
  CAPTURE(seed, kinds(result));
  const auto drift = found_in<finding::Drift>(result);
  REQUIRE(drift);
  CHECK(drift->loaded);
  CHECK_FALSE(found_in<finding::Baseline>(result));
}

TEST_CASE("a zero taken under a contact is told, with frames that would do", "[lab][check]") {
  const std::uint64_t seed = GENERATE(90U, 91U, 92U, 93U);
  const auto judged = [&](auto recording) {
    CHECK(kinds(check(recording)) == Names{});
    // A contact touches in the first frames, and the zero is that of these.
    const std::vector<double> pressed = recording.frames[90];
    for (std::size_t k = 0; k < 20; ++k)
      for (std::size_t i = 0; i < pressed.size(); ++i) recording.frames[k][i] += 0.4 * pressed[i];
    const auto take_zero = [&](std::size_t first, std::size_t last) {
      std::vector<double> zero(pressed.size());
      for (std::size_t k = first; k <= last; ++k)
        for (std::size_t i = 0; i < zero.size(); ++i)
          zero[i] += recording.frames[k][i] / static_cast<double>(last - first + 1);
      for (auto& frame : recording.frames)
        for (std::size_t i = 0; i < zero.size(); ++i) frame[i] -= zero[i];
    };
    take_zero(0, 19);
    const auto found = found_in<finding::ZeroUnderLoad>(check(recording));
    REQUIRE(found);
    CHECK(found->force < 0.0);
    CHECK(found->last >= found->first + 5);
    take_zero(found->first, found->last);
    CHECK(kinds(check(recording)) == Names{});
  };
  const RecordingKind kind{.course = Course::holds, .chain = Chain::noise, .least_peak = 200.0};
  CAPTURE(seed);
  judged(honest_line(seed, kind));
  judged(honest_skin(seed, kind));
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

TEST_CASE("taxels that are worn are told among others that feel much", "[lab][check][skin]") {
  const std::uint64_t seed = GENERATE(101U, 103U, 105U, 107U);
  const double gain = GENERATE(0.0, 0.05);
  RecordedSkin skin = honest_skin(seed, {.course = Course::holds,
                                         .chain = Chain::noise,
                                         .pitch_in_depths = 1.0,
                                         .reads = "\"stress_x\"",
                                         .least_peak = 300.0});
  const std::size_t columns = skin.scene.sensor.columns;
  const std::size_t middle = taxel_in_the_middle(skin);
  Random random(seed);
  std::vector<std::size_t> worn;
  for (const std::size_t taxel : {middle, middle + 1, middle + columns, middle + columns + 1}) {
    worn.push_back(taxel);
    for (auto& frame : skin.frames) frame[taxel] = gain * frame[taxel] + random.white(pad_noise);
  }
  const lab::ReadingsCheck result = check(skin);
  CAPTURE(seed, gain, kinds(result));
  std::vector<std::size_t> told;
  if (const auto found = found_in<finding::WornTaxels>(result)) told = found->taxels;
  if (const auto found = found_in<finding::DeadTaxels>(result))
    told.insert(told.end(), found->taxels.begin(), found->taxels.end());
  std::sort(told.begin(), told.end());
  CHECK(told == worn);

  // Solved without them, as by a scene that says so: a force that falls short has a verdict.
  SkinScene scene = skin.scene;
  scene.dead_taxels = worn;
  const lab::SkinSceneProblem stated(scene);
  lab::SkinSceneProblem problem(skin.scene);
  const lab::Findings said = lab::leave_out_broken(problem, result);
  REQUIRE_FALSE(said.empty());
  CHECK(std::get<finding::TaxelsLeftOut>(said.back()).taxels == worn);
  CHECK(problem.scene().dead_taxels == worn);
  const std::vector<double>& pressed = skin.frames[frames_recorded / 2];
  const lab::FrameAnswer without = lab::solve(problem, pressed);
  const lab::FrameAnswer expected = lab::solve(stated, pressed);
  CHECK(without.verdict == expected.verdict);
  CHECK_THAT(without.wrench.normal.value, WithinRel(expected.wrench.normal.value, 1e-6));

  // A few frames show nothing, and nothing is left out where no taxel is left.
  lab::ReadingsCheck few = result;
  few.frames = 4;
  lab::SkinSceneProblem whole(skin.scene);
  CHECK(lab::leave_out_broken(whole, few).empty());
  lab::ReadingsCheck all = result;
  finding::DeadTaxels every;
  for (std::size_t taxel = 0; taxel < taxel_count(skin.scene.sensor); ++taxel)
    every.taxels.push_back(taxel);
  all.findings = {every};
  CHECK(lab::leave_out_broken(whole, all).empty());
  CHECK(whole.scene().dead_taxels.empty());
}

TEST_CASE("a threshold is told as such, and a taxel without a wire behind it too", "[lab][check]") {
  const std::uint64_t seed = GENERATE(110U, 112U, 114U);
  RecordedLine line = honest_line(seed, {.course = Course::presses,
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
  RecordedLine line = honest_line(seed, {.course = Course::holds,
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
  RecordedLine line = honest_line(seed, {.course = Course::presses,
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
  RecordedLine line = honest_line(120, {.course = Course::idles,
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
