#include "tactile_net/lab/readings_check.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "lab/check/clock_track.hpp"
#include "lab/check/judgement.hpp"
#include "lab/check/peak_track.hpp"
#include "lab/check/sign_track.hpp"
#include "numeric/robust.hpp"

namespace tactile_net::lab {
namespace {

std::size_t most_groups_of(std::size_t readings) {
  return std::clamp(ReadingsChecker::most_values / (3 * readings), std::size_t{24},
                    ReadingsChecker::most_groups);
}

/// Of each reading whether its taxel lives, by the scene.
std::vector<bool> living_of(const CheckedSensor& sensor) {
  std::vector<bool> living;
  for (const Site& reading : sensor.layout.readings)
    living.push_back(std::find(sensor.dead_taxels.begin(), sensor.dead_taxels.end(),
                               reading.taxel) == sensor.dead_taxels.end());
  return living;
}

/// What each reading's raw number may be off by the way through a calibration and back.
std::vector<double> rounding_of(const std::optional<Calibration>& calibration,
                                std::size_t readings) {
  std::vector<double> rounding(readings);
  if (calibration)
    for (std::size_t i = 0; i < readings; ++i)
      rounding[i] = 1e-12 * (std::abs(calibration->baseline[i]) +
                             std::abs(calibration->offset[i] / calibration->gain[i]));
  return rounding;
}

/// Whether the scene's array could see what presses at all.
bool is_fathomable(const Findings& by_scene) {
  return std::none_of(by_scene.begin(), by_scene.end(), [](const Finding& one) {
    return std::holds_alternative<finding::DepthBeyondArray>(one) ||
           std::holds_alternative<finding::PitchCoarse>(one);
  });
}

}  // namespace

std::optional<double> RecordingClock::rate() const noexcept {
  if (!in_seconds || timed < 2 || !(forwards > 0.0)) return std::nullopt;
  return static_cast<double>(timed - 1 - backwards) / forwards;
}

struct ReadingsChecker::Parts {
  explicit Parts(AnyScene given)
      : scene(std::move(given)),
        sensor(std::visit([](const auto& one) { return checked_sensor(one); }, scene)),
        weights(reading_weights(sensor)),
        tracks(sensor.layout.readings.size()),
        spikes(sensor.layout, weights),
        codes(sensor.layout),
        thresholds(sensor.layout),
        peaks(sensor.layout),
        signs(sensor.layout),
        living(living_of(sensor)),
        equal(
            sensor.layout,
            std::visit([&](const auto& one) { return rounding_of(one.calibration, tracks.size()); },
                       scene),
            living),
        rates(sensor.layout, living, most_groups_of(tracks.size())),
        triples(most_groups_of(tracks.size())) {}

  AnyScene scene;
  CheckedSensor sensor;
  std::vector<double> weights;  // per reading
  std::vector<ReadingTrack> tracks;
  SpikeTrack spikes;
  CodeTrack codes;
  ThresholdTrack thresholds;
  PeakTrack peaks;
  SignTrack signs;
  std::vector<bool> living;  // per reading: the scene does not call its taxel dead
  EqualTrack equal;
  RateTrack rates;
  FrameTriples triples;
  ClockTrack clock;
  std::size_t frames = 0;
  FrameRuns repeating{};
  FrameRuns missing{};
  std::vector<double> last{};
  std::vector<double> peak{};  // the frame with the largest weighted reading
  double peak_size = 0.0;
  std::size_t peak_frame = 0;

  /// @param of_loads  told of the frames solved; null: none is
  [[nodiscard]] ReadingsCheck judged(Observer* of_loads) const;
  /// A converter's steps may make all readings equal to those of the frame before.
  [[nodiscard]] bool repeats_by_chance() const;
  void say_frames(ReadingsCheck& check) const;
  void say_channels(const Evidence& evidence, ReadingsCheck& check) const;
};

ReadingsChecker::ReadingsChecker(AnyScene scene)
    : parts_(std::make_unique<Parts>(std::move(scene))) {}

ReadingsChecker::~ReadingsChecker() = default;
ReadingsChecker::ReadingsChecker(ReadingsChecker&&) noexcept = default;
ReadingsChecker& ReadingsChecker::operator=(ReadingsChecker&&) noexcept = default;

void ReadingsChecker::add(std::optional<double> time, std::span<const double> readings) {
  Parts& p = *parts_;
  p.clock.add(time, p.frames);
  double size = 0.0;
  bool any_missing = false;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    p.tracks[i].add(readings[i], p.frames);
    if (std::isnan(readings[i]))
      any_missing = true;
    else
      size = std::max(size, std::abs(readings[i]) * p.weights[i]);
  }
  if (any_missing) p.missing.add(p.frames);
  const bool repeats = std::equal(readings.begin(), readings.end(), p.last.begin(), p.last.end());
  if (repeats) p.repeating.add(p.frames);
  p.last.assign(readings.begin(), readings.end());
  if (size > p.peak_size) {
    p.peak_size = size;
    p.peak = p.last;
    p.peak_frame = p.frames;
  }
  p.spikes.add(readings);
  std::vector<double> numbers =
      std::visit([&](const auto& scene) { return raw_numbers(scene, readings); }, p.scene);
  p.thresholds.add(numbers, p.living);
  p.peaks.add(numbers, p.living);
  p.signs.add(numbers, p.living);
  p.equal.add(numbers);
  p.codes.add(std::move(numbers), p.living);
  p.rates.add(readings);
  p.triples.add(readings);
  ++p.frames;
}

void ReadingsChecker::times_without_unit() { parts_->clock.without_unit(); }

bool ReadingsChecker::Parts::repeats_by_chance() const {
  double expected = static_cast<double>(frames);
  std::vector<double> shares;
  for (const ReadingTrack& track : tracks) {
    if (track.present() == 0 || track.is_constant()) continue;
    expected *= track.repeating();
    shares.push_back(track.repeating());
  }
  // Most readings repeat where little moves, and then together.
  constexpr double usual = 0.3;
  return expected > 1e-3 || median(std::move(shares)) > usual;
}

void ReadingsChecker::Parts::say_frames(ReadingsCheck& check) const {
  Findings& findings = check.findings;
  check.clock = clock.clock();
  if (frames == 0) findings.emplace_back(finding::NoFrames{});
  if (check.clock.backwards > 0)
    findings.emplace_back(finding::TimeBackwards{check.clock.backwards, check.clock.first_backwards,
                                                 check.clock.rollovers});
  if (check.clock.repeats > 0)
    findings.emplace_back(finding::TimeRepeats{check.clock.repeats, check.clock.first_repeat});
  // Readings that are quantised coarsely, or without noise, repeat for good.
  if (repeating.count() > 0 && 5 * repeating.count() < frames && !repeats_by_chance())
    findings.emplace_back(finding::FramesRepeat{repeating});
  if (missing.count() > 0) {
    finding::ValuesMissing found{.frames = missing};
    std::vector<std::size_t> most(sensor.layout.taxels);
    for (std::size_t i = 0; const Site& reading : sensor.layout.readings)
      most[reading.taxel] = std::max(most[reading.taxel], tracks[i++].missing());
    for (std::size_t taxel = 0; taxel < most.size(); ++taxel)
      if (2 * most[taxel] > frames) found.taxels.push_back(taxel);
    for (const ReadingTrack& track : tracks) found.values += track.missing();
    check.missing = found.values;
    findings.emplace_back(std::move(found));
  }
}

void ReadingsChecker::Parts::say_channels(const Evidence& evidence, ReadingsCheck& check) const {
  for (std::size_t c = 0; const Channel& channel : evidence.channels()) {
    CheckedChannel found{
        .name = sensor.names[c], .stated = sensor.stated[c], .threshold = thresholds.threshold(c)};
    ++c;
    bool any = false;
    for (std::size_t i = channel.first; i < channel.first + channel.count; ++i) {
      if (tracks[i].present() == 0) continue;
      found.least = any ? std::min(found.least, tracks[i].least()) : tracks[i].least();
      found.largest = any ? std::max(found.largest, tracks[i].largest()) : tracks[i].largest();
      any = true;
    }
    check.channels.push_back(std::move(found));
  }
}

ReadingsCheck ReadingsChecker::Parts::judged(Observer* of_loads) const {
  ReadingsCheck check{.scene = scene, .frames = frames};
  say_frames(check);
  Evidence evidence{.sensor = sensor,
                    .frames = frames,
                    .tracks = tracks,
                    .triples = triples.all(),
                    .spikes = spikes.spikes(),
                    .thresholds = thresholds,
                    .living = std::vector<bool>(tracks.size(), true)};
  evidence.bury(sensor.dead_taxels);
  for (const Finding& one : check.findings)
    if (const auto* without = std::get_if<finding::ValuesMissing>(&one))
      evidence.bury(without->taxels);
  say_channels(evidence, check);
  if (frames == 0) return check;
  const Findings by_scene = scene_findings(scene);

  check.sampled = evidence.triples.size();
  finding::SignsLost unsigned_ones;
  for (std::size_t c = 0; c < evidence.channels().size(); ++c)
    if (const auto lost = signs.lost(c)) {
      unsigned_ones.channels.push_back(c);
      unsigned_ones.codes = lost->codes;
      unsigned_ones.jumps += lost->jumps;
    }
  if (!unsigned_ones.channels.empty()) {
    check.findings.emplace_back(std::move(unsigned_ones));
    return check;  // noise, rest and loads are those of jumps
  }
  if (const auto same = peaks.same()) {
    check.findings.emplace_back(finding::FramesNormalised{same->number, same->frames});
    return check;  // noise, rest and loads are those of numbers that cannot be compared
  }
  if (is_fathomable(by_scene)) {
    const std::size_t before = check.findings.size();
    judge_codes(evidence, codes, scene, check.findings);
    if (check.findings.size() > before) return check;  // noise, rest and loads are those of codes
  }
  judge_equal(evidence, equal, check.findings);
  // Readings that are there twice have no noise from the one to the other.
  std::vector<FrameTriple> renewed;
  if (const std::vector<std::size_t> slow = judge_rates(rates, check.findings); !slow.empty()) {
    renewed = rates.renewed(evidence.triples, slow);
    evidence.triples = renewed;
  }
  const StillNoise noise = judge_taxels(evidence, check.findings);
  check.still = noise.known() ? noise.still.size() : 0;
  if (std::find(evidence.living.begin(), evidence.living.end(), true) != evidence.living.end()) {
    const std::unique_ptr<PatternSolver> made =
        std::visit([](const auto& one) { return pattern_solver(one); }, scene);
    PatternSolver& solver = *made;
    if (is_fathomable(by_scene)) {
      judge_worn(evidence, noise, solver, check.findings);
      judge_spikes(evidence, noise, solver, check.findings);
    }
    // With lengths that cannot be right no load explains anything.
    const RestState rest =
        is_fathomable(by_scene) ? judge_rest(evidence, noise, solver, check.findings) : RestState{};
    check.quiet = rest.quiet;
    check.never_let_go = rest.loaded;
    if (noise.known())
      for (std::size_t c = 0; c < check.channels.size(); ++c) {
        CheckedChannel& channel = check.channels[c];
        const double seen = rest.noise.empty() ? noise.of_channel[c] : rest.noise[c];
        // Rounding errs by as much as a step's twelfth in the square, and shows less in frames that
        // it makes equal.
        if (noise.steps[c] > 0.5 * noise.of_channel[c])
          channel.rounding = noise.steps[c] / std::sqrt(12.0);
        channel.noise = std::max(seen, channel.rounding);
      }
    if (of_loads != nullptr) {
      if (const auto* line = std::get_if<Scene>(&scene); line != nullptr && is_fathomable(by_scene))
        judge_gains(evidence, *line, check);
      check.peak = PeakFrame{.frame = peak_frame};
      judge_loads(evidence, rest.baseline, peak, solver, *of_loads, check);
      if (is_fathomable(by_scene))
        judge_serpentine(evidence, scene, rest.baseline, solver, check.findings);
      judge_scale(check);
    }
  }
  check.findings.insert(check.findings.end(), by_scene.begin(), by_scene.end());
  return check;
}

ReadingsCheck ReadingsChecker::result(Observer& observer) const {
  return parts_->judged(&observer);
}

ReadingsCheck ReadingsChecker::result_without_loads() const { return parts_->judged(nullptr); }

Findings ReadingsChecker::doubts() const {
  Findings all = result_without_loads().findings;
  std::erase_if(all, [](const Finding& one) {
    return !std::holds_alternative<finding::CodesForMissing>(one) &&
           !std::holds_alternative<finding::SignsLost>(one) &&
           !std::holds_alternative<finding::FramesNormalised>(one) &&
           !std::holds_alternative<finding::SlowChannels>(one) &&
           !std::holds_alternative<finding::EqualReadings>(one) &&
           !std::holds_alternative<finding::WornTaxels>(one) &&
           !std::holds_alternative<finding::Baseline>(one) &&
           !std::holds_alternative<finding::Drift>(one);
  });
  return all;
}

}  // namespace tactile_net::lab
