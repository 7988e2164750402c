// Check of recordings in which a contact lasts all the time, or was there when the zero was taken.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/catch.hpp"
#include "tests/lab/sound_recordings.hpp"

using namespace tactile_net;
namespace finding = lab::finding;

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
  const RecordingKind kind{.course = Course::swaying, .chain = Chain::noise};
  CAPTURE(seed);
  both(honest_line(seed, kind));
  both(honest_skin(seed, kind));
}

TEST_CASE("of a contact and a wrong zero together nothing is taken off, and the force stays",
          "[lab][check]") {
  std::size_t told = 0;  // some such zeros are explained by loads
  for (std::uint64_t seed = 70; seed < 90; ++seed) {
    RecordedLine line = honest_line(
        seed, {.course = Course::lasting, .chain = Chain::noise, .pitch_in_depths = 0.5});
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
  RecordedSkin skin = honest_skin(seed, {.course = Course::lasting, .chain = Chain::noise});
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
  const RecordingKind kind{.course = Course::held, .chain = Chain::noise, .least_peak = 200.0};
  CAPTURE(seed);
  judged(honest_line(seed, kind));
  judged(honest_skin(seed, kind));
}
