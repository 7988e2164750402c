#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
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

/// The share of each channel's values that equal the one before; above a half
/// they are quantised so coarsely that all of its readings seem to stick.
std::vector<double> usual_repeating(const Evidence& evidence) {
  std::vector<double> usual;
  for (const Channel& channel : evidence.channels()) {
    std::vector<double> shares;
    for (std::size_t k = channel.first; k < channel.first + channel.count; ++k)
      if (evidence.living[k]) shares.push_back(evidence.tracks[k].repeating());
    usual.push_back(median(std::move(shares)));
  }
  return usual;
}
constexpr double coarse = 0.5;

/// The least change of any of a channel's readings, which is a converter's step where that is
/// coarse; 0: there is no change.
double step_of(const Evidence& evidence, std::size_t channel) {
  double least = std::numeric_limits<double>::infinity();
  const Channel& line = evidence.channels()[channel];
  for (std::size_t i = line.first; i < line.first + line.count; ++i)
    if (evidence.living[i]) least = std::min(least, evidence.tracks[i].least_step());
  return std::isfinite(least) ? least : 0.0;
}

/// Of those that change: what is constant shows no noise, and what is cut off less.
StillNoise noise_of(const Evidence& evidence) {
  std::vector<bool> changing = evidence.telling();
  for (std::size_t i = 0; i < changing.size(); ++i)
    if (evidence.tracks[i].is_constant()) changing[i] = false;
  std::vector<double> steps;
  for (std::size_t c = 0; c < evidence.channels().size(); ++c) {
    if (evidence.thresholds.threshold(c)) return {};
    steps.push_back(step_of(evidence, c));
  }
  return still_noise(evidence.triples, changing, evidence.channels(), steps);
}

/// Readings that never change, though those beside them do by more than a
/// converter's steps.
class Constants {
 public:
  explicit Constants(const Evidence& evidence) : evidence_(evidence) {
    for (std::size_t c = 0; c < evidence.channels().size(); ++c)
      hides_noise_.push_back(evidence.thresholds.threshold(c) || is_coarse(c) || is_cut(c));
    for (std::size_t i = 0; i < evidence.living.size(); ++i)
      if (evidence.living[i] && (!evidence.tracks[i].is_constant() || !is_zero(i)))
        nothing_at_all_ = false;
  }

  [[nodiscard]] bool at(std::size_t i) const {
    const ReadingTrack& track = evidence_.tracks[i];
    if (track.present() < 3 || !track.is_constant()) return false;
    if (nothing_at_all_) return true;
    if (hides_noise_[evidence_.sites()[i].channel]) return is_passed_over(i);
    const Side left = beside(i, -1);
    const Side right = beside(i, +1);
    return left != Side::idle && right != Side::idle &&
           (left == Side::changes || right == Side::changes);
  }
  [[nodiscard]] bool is_zero(std::size_t i) const { return evidence_.tracks[i].largest() == 0.0; }

 private:
  enum class Side { none, idle, changes };

  /// Most values of those that change at all equal the one before.
  [[nodiscard]] bool is_coarse(std::size_t channel) const {
    const Channel& line = evidence_.channels()[channel];
    std::vector<double> shares;
    for (std::size_t i = line.first; i < line.first + line.count; ++i)
      if (const ReadingTrack& track = evidence_.tracks[i];
          evidence_.living[i] && track.present() > 0 && !track.is_constant())
        shares.push_back(track.repeating());
    return median(std::move(shares)) > coarse;
  }
  /// None is nearer to zero than noise is, one hardly farther: a threshold may be between.
  [[nodiscard]] bool is_cut(std::size_t channel) const {
    constexpr double noise_reaches = 3.0;
    constexpr double thresholds_reach = 12.0;
    const Channel& line = evidence_.channels()[channel];
    double nearest = std::numeric_limits<double>::infinity();
    std::vector<double> roughness;
    for (std::size_t i = line.first; i < line.first + line.count; ++i) {
      const ReadingTrack& track = evidence_.tracks[i];
      if (!evidence_.living[i] || track.present() == 0 || track.is_constant()) continue;
      nearest = std::min(nearest, std::max({track.least(), -track.largest(), 0.0}));
      for (const FrameTriple& triple : evidence_.triples)
        if (const double d = triple.roughness(i); std::isfinite(d)) roughness.push_back(d);
    }
    const double sigma = robust_rms(std::move(roughness));
    return nearest > noise_reaches * sigma && nearest < thresholds_reach * sigma;
  }
  /// Far from what presses all are constant where noise does not show: one that is between others
  /// that feel much is not far.
  [[nodiscard]] bool is_passed_over(std::size_t i) const {
    const std::vector<std::size_t>& beside = evidence_.sensor.around[i].beside;
    const Channel& line = evidence_.channels()[evidence_.sites()[i].channel];
    double least = 20.0 * step_of(evidence_, evidence_.sites()[i].channel);
    for (std::size_t k = line.first; k < line.first + line.count; ++k)
      least = std::max(least, 0.3 * range(evidence_.tracks[k]));
    const auto all_reach = [&](double sign) {
      return std::all_of(beside.begin(), beside.end(), [&](std::size_t k) {
        const ReadingTrack& track = evidence_.tracks[k];
        return evidence_.living[k] && (sign > 0.0 ? track.largest() : -track.least()) > least;
      });
    };
    // Between readings of two signs one is zero.
    return !beside.empty() && (all_reach(1.0) || all_reach(-1.0));
  }

  /// What the nearest reading does that is not constant.
  [[nodiscard]] Side beside(std::size_t i, int step) const {
    const Channel& channel = evidence_.channels()[evidence_.sites()[i].channel];
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
  std::vector<bool> hides_noise_{};  // per channel
  bool nothing_at_all_ = true;       // every reading is zero
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
  const double sigma = noise.least_change[evidence.sites()[i].channel];
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

/// Runs of equal values that chance does not make.
bool sticks(const Evidence& evidence, const StillNoise& noise, std::span<const double> repeating,
            std::size_t i) {
  const std::size_t channel = evidence.sites()[i].channel;
  if (noise.of_channel[channel] == 0.0) return false;
  const double usual = std::max(repeating[channel], 1e-3);
  if (usual > coarse) return false;
  const double chances =
      static_cast<double>(evidence.frames) * static_cast<double>(evidence.tracks.size());
  // Far from what presses a reading is in one step more often than in the middle.
  const double in_one_step =
      std::erf(step_of(evidence, channel) / (2.0 * std::sqrt(2.0) * noise.of_channel[channel]));
  if (in_one_step > 0.99) return false;
  const double longest = 10.0 + 1.5 * std::log(chances) / -std::log(std::max(usual, in_one_step));
  return static_cast<double>(evidence.tracks[i].longest_run()) > longest;
}

/// Whether values that a converter's steps make equal pile up at the end of a range: it is that of
/// its channel, too, and of others, or noise does not leave it.
bool is_end_of_range(const Evidence& evidence, const StillNoise& noise, std::size_t i, bool high) {
  constexpr std::size_t least = 12;
  constexpr std::size_t times = 10;
  const std::size_t channel = evidence.sites()[i].channel;
  const double step = step_of(evidence, channel);
  if (step < 0.05 * noise.of_channel[channel]) return true;
  const auto end_of = [&](std::size_t k) -> const RangeEnd& {
    return high ? evidence.tracks[k].high() : evidence.tracks[k].low();
  };
  std::size_t there = 0;
  const Channel& line = evidence.channels()[channel];
  for (std::size_t k = line.first; k < line.first + line.count; ++k) {
    if (!evidence.living[k]) continue;
    const double beyond = end_of(k).outermost() - end_of(i).outermost();
    if (beyond > 0.5 * step) return false;
    if (std::abs(beyond) < 0.5 * step && end_of(k).piles_up()) ++there;
  }
  return there > 1 || (step < 2.0 * noise.of_channel[channel] && end_of(i).piles_up(least, times));
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
    if (end->piles_up() && is_end_of_range(evidence, noise, i, end == &track.high())) return end;
  return nullptr;
}

}  // namespace

void Evidence::bury(std::span<const std::size_t> taxels) {
  for (const std::size_t taxel : taxels)
    for (std::size_t i = 0; i < living.size(); ++i)
      if (sites()[i].taxel == taxel) living[i] = false;
}

std::vector<bool> Evidence::telling() const {
  std::vector<bool> all = living;
  for (std::size_t i = 0; i < clipped.size(); ++i) all[i] = all[i] && !clipped[i];
  return all;
}

StillNoise judge_taxels(Evidence& evidence, Findings& findings) {
  const Constants constants(evidence);
  const auto is_zero = [&](std::size_t i) { return constants.at(i) && constants.is_zero(i); };
  std::vector<std::size_t> dead = taxels_where(evidence, is_zero);
  const std::vector<std::size_t> constant =
      taxels_where(evidence, [&](std::size_t i) { return constants.at(i) && !is_zero(i); });
  evidence.bury(dead);
  evidence.bury(constant);

  StillNoise noise = noise_of(evidence);
  std::vector<std::size_t> stuck = constant;
  if (noise.known()) {
    const std::vector<double> middles = middles_of(evidence);
    const auto silent_taxels = taxels_where(
        evidence, [&](std::size_t i) { return feels_nothing(evidence, noise, middles, i); });
    evidence.bury(silent_taxels);

    const std::vector<double> repeating = usual_repeating(evidence);
    // One that lived before it held its value is not dead from the beginning.
    for (const std::size_t taxel : silent_taxels) {
      bool holds = false;
      for (std::size_t i = 0; i < evidence.tracks.size(); ++i)
        holds =
            holds || (evidence.sites()[i].taxel == taxel && sticks(evidence, noise, repeating, i));
      (holds ? stuck : dead).push_back(taxel);
    }
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
    for (const Site& site : evidence.sites())
      evidence.clipped.push_back(
          std::binary_search(saturated.taxels.begin(), saturated.taxels.end(), site.taxel));
    if (StillNoise of_others = noise_of(evidence); of_others.known()) noise = std::move(of_others);

    const auto sticking = taxels_where(evidence, [&](std::size_t i) {
      return saturated_end(evidence, noise, repeating, i) == nullptr &&
             sticks(evidence, noise, repeating, i);
    });
    evidence.bury(sticking);
    stuck.insert(stuck.end(), sticking.begin(), sticking.end());

    finding::NoisyTaxels noisy;
    noisy.taxels = taxels_where(evidence, [&](std::size_t i) {
      const double usual = noise.least_change[evidence.sites()[i].channel];
      const double times = usual > 0.0 ? noise.of_reading[i] / usual : 0.0;
      if (evidence.clipped[i]) return false;
      if (times > std::max(noisy.times, noisy_times)) {
        noisy.times = times;
        noisy.worst = evidence.sites()[i].taxel;
      }
      return times > noisy_times;
    });
    evidence.bury(noisy.taxels);
    if (!noisy.taxels.empty()) {
      findings.emplace_back(noisy);
      if (StillNoise of_others = noise_of(evidence); of_others.known())
        noise = std::move(of_others);
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
