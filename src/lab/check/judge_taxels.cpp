#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <span>

#include "lab/check/judgement.hpp"
#include "numeric/robust.hpp"

namespace tactile_net::lab {
namespace {

constexpr double noisy_times = 4.0;  // its channel's noise: what no sound taxel of 4096 reaches

/// The taxels of which one reading is so.
std::vector<std::size_t> taxels_where(const Evidence& evidence,
                                      const std::function<bool(std::size_t)>& is_so) {
  std::set<std::size_t> taxels;
  for (std::size_t i = 0; i < evidence.living.size(); ++i)
    if (evidence.living[i] && is_so(i)) taxels.insert(evidence.sites()[i].taxel);
  return {taxels.begin(), taxels.end()};
}

/// How far a reading went.
double range(const ReadingTrack& track) {
  return track.present() == 0 ? 0.0 : track.largest() - track.least();
}

/// Readings that never change, though those beside them do by more than a
/// converter's steps.
class Constants {
 public:
  explicit Constants(const Evidence& evidence) : evidence_(evidence) {
    for (std::size_t i = 0; i < evidence.living.size(); ++i)
      if (evidence.living[i] && (!evidence.tracks[i].is_constant() || !is_zero(i)))
        nothing_at_all_ = false;
  }

  [[nodiscard]] bool at(std::size_t i) const {
    const ReadingTrack& track = evidence_.tracks[i];
    if (track.present() < 3 || !track.is_constant()) return false;
    const Side left = beside(i, -1);
    const Side right = beside(i, +1);
    return nothing_at_all_ || (left != Side::idle && right != Side::idle &&
                               (left == Side::changes || right == Side::changes));
  }
  [[nodiscard]] bool is_zero(std::size_t i) const { return evidence_.tracks[i].largest() == 0.0; }

 private:
  enum class Side { none, idle, changes };

  /// What the nearest reading does that is not constant.
  [[nodiscard]] Side beside(std::size_t i, int step) const {
    const SignalChannel& channel = evidence_.channels()[evidence_.sites()[i].channel];
    const auto count = static_cast<std::ptrdiff_t>(channel.count);
    const auto first = static_cast<std::ptrdiff_t>(channel.first);
    for (auto k = static_cast<std::ptrdiff_t>(i) + step; k >= first && k < first + count;
         k += step) {
      const ReadingTrack& track = evidence_.tracks[static_cast<std::size_t>(k)];
      if (!evidence_.living[static_cast<std::size_t>(k)] || track.is_constant()) continue;
      return range(track) > 4.0 * track.least_step() ? Side::changes : Side::idle;
    }
    return Side::none;
  }

  const Evidence& evidence_;
  bool nothing_at_all_ = true;  // every reading is zero
};

/// The median of every reading, which is its rest where loads are rare.
std::vector<double> middles_of(const Evidence& evidence) {
  std::vector<double> middles;
  for (std::size_t i = 0; i < evidence.living.size(); ++i) {
    std::vector<double> values;
    for (const FrameTriple& triple : evidence.triples)
      if (std::isfinite(triple.middle()[i])) values.push_back(triple.middle()[i]);
    middles.push_back(median(std::move(values)));
  }
  return middles;
}

/// Silent in most frames in which its neighbours clearly feel a load: all
/// beside it, and at least one of those behind them, all of one sign.
bool feels_nothing(const Evidence& evidence, const StillNoise& noise,
                   std::span<const double> middles, std::size_t i) {
  const auto& [beside, behind] = evidence.sensor.around[i];
  const auto lives = [&](std::size_t at) { return static_cast<bool>(evidence.living[at]); };
  if (beside.empty() || !std::all_of(beside.begin(), beside.end(), lives)) return false;
  const double sigma = noise.of_channel[evidence.sites()[i].channel];
  std::size_t felt = 0;
  std::size_t silent = 0;
  for (const FrameTriple& triple : evidence.triples) {
    const auto load = [&](std::size_t at) { return triple.middle()[at] - middles[at]; };
    const double sign = load(beside.front()) > 0.0 ? 1.0 : -1.0;
    const auto feels = [&](std::size_t at) { return sign * load(at) > 20.0 * sigma; };
    if (!std::all_of(beside.begin(), beside.end(), feels) ||
        std::none_of(behind.begin(), behind.end(), feels))
      continue;
    ++felt;
    if (std::abs(load(i)) < 5.0 * sigma) ++silent;
  }
  return felt >= 3 && 5 * silent >= 4 * felt;
}

/// The share of each channel's values that equal the one before; above a half
/// they are quantised so coarsely that all of its readings seem to stick.
std::vector<double> usual_repeating(const Evidence& evidence) {
  std::vector<double> usual;
  for (const SignalChannel& channel : evidence.channels()) {
    std::vector<double> shares;
    for (std::size_t k = channel.first; k < channel.first + channel.count; ++k)
      if (evidence.living[k]) shares.push_back(evidence.tracks[k].repeating());
    usual.push_back(median(std::move(shares)));
  }
  return usual;
}
constexpr double coarse = 0.5;

/// Runs of equal values that chance does not make.
bool sticks(const Evidence& evidence, const StillNoise& noise, std::span<const double> repeating,
            std::size_t i) {
  const std::size_t channel = evidence.sites()[i].channel;
  if (noise.of_channel[channel] == 0.0) return false;
  const double usual = std::max(repeating[channel], 1e-3);
  if (usual > coarse) return false;
  const double chances =
      static_cast<double>(evidence.frames) * static_cast<double>(evidence.tracks.size());
  const double longest = 10.0 + 1.5 * std::log(chances) / -std::log(usual);
  return static_cast<double>(evidence.tracks[i].longest_run()) > longest;
}

/// Where the values of a reading pile up, far from where they lie when nothing
/// happens.
const RangeEnd* saturated_end(const Evidence& evidence, const StillNoise& noise,
                              std::span<const double> repeating, std::size_t i) {
  const ReadingTrack& track = evidence.tracks[i];
  const std::size_t channel = evidence.sites()[i].channel;
  const double sigma = noise.of_channel[channel];
  if (sigma == 0.0 || range(track) < 10.0 * sigma || repeating[channel] > coarse) return nullptr;
  for (const RangeEnd* end : {&track.high(), &track.low()})
    if (end->piles_up()) return end;
  return nullptr;
}

}  // namespace

void Evidence::bury(std::span<const std::size_t> taxels) {
  for (const std::size_t taxel : taxels)
    for (std::size_t i = 0; i < living.size(); ++i)
      if (sites()[i].taxel == taxel) living[i] = false;
}

StillNoise judge_taxels(Evidence& evidence, Findings& findings) {
  const Constants constants(evidence);
  const auto is_zero = [&](std::size_t i) { return constants.at(i) && constants.is_zero(i); };
  std::vector<std::size_t> dead = taxels_where(evidence, is_zero);
  const std::vector<std::size_t> constant =
      taxels_where(evidence, [&](std::size_t i) { return constants.at(i) && !is_zero(i); });
  evidence.bury(dead);
  evidence.bury(constant);

  StillNoise noise = still_noise(evidence.triples, evidence.living, evidence.channels());
  std::vector<std::size_t> stuck = constant;
  if (noise.known()) {
    const std::vector<double> middles = middles_of(evidence);
    const auto silent_taxels = taxels_where(
        evidence, [&](std::size_t i) { return feels_nothing(evidence, noise, middles, i); });
    evidence.bury(silent_taxels);
    dead.insert(dead.end(), silent_taxels.begin(), silent_taxels.end());

    const std::vector<double> repeating = usual_repeating(evidence);
    finding::SaturatedTaxels saturated;
    saturated.taxels = taxels_where(evidence, [&](std::size_t i) {
      const RangeEnd* end = saturated_end(evidence, noise, repeating, i);
      if (end != nullptr && end->count() > saturated.frames) {
        saturated.limit = end == &evidence.tracks[i].high() ? end->outermost() : -end->outermost();
        saturated.frames = end->count();
      }
      return end != nullptr;
    });
    if (!saturated.taxels.empty()) findings.emplace_back(saturated);

    const auto sticking = taxels_where(evidence, [&](std::size_t i) {
      return saturated_end(evidence, noise, repeating, i) == nullptr &&
             sticks(evidence, noise, repeating, i);
    });
    evidence.bury(sticking);
    stuck.insert(stuck.end(), sticking.begin(), sticking.end());

    finding::NoisyTaxels noisy;
    noisy.taxels = taxels_where(evidence, [&](std::size_t i) {
      const double usual = noise.of_channel[evidence.sites()[i].channel];
      const double times = usual > 0.0 ? noise.of_reading[i] / usual : 0.0;
      if (times > std::max(noisy.times, noisy_times)) {
        noisy.times = times;
        noisy.worst = evidence.sites()[i].taxel;
      }
      return times > noisy_times;
    });
    evidence.bury(noisy.taxels);
    if (!noisy.taxels.empty()) {
      findings.emplace_back(noisy);
      noise = still_noise(evidence.triples, evidence.living, evidence.channels());
    }
  }
  std::sort(dead.begin(), dead.end());
  std::sort(stuck.begin(), stuck.end());
  if (!dead.empty()) findings.emplace_back(finding::DeadTaxels{dead});
  if (!stuck.empty()) {
    finding::StuckTaxels found{.taxels = stuck};
    for (const std::size_t taxel : stuck)
      for (std::size_t i = 0; i < evidence.tracks.size(); ++i)
        if (const ReadingTrack& track = evidence.tracks[i];
            evidence.sites()[i].taxel == taxel && track.longest_run() > found.frames) {
          found.worst = taxel;
          found.first = track.run_begins();
          found.frames = track.longest_run();
        }
    findings.emplace_back(std::move(found));
  }
  return noise;
}

}  // namespace tactile_net::lab
