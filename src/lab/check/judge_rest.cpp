#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "lab/check/judgement.hpp"
#include "numeric/robust.hpp"

namespace tactile_net::lab {
namespace {

/// Readings weighted to one unit, and their rms over those that live.
class Weighted {
 public:
  Weighted(const Evidence& evidence, std::vector<bool> living)
      : evidence_(evidence), living_(std::move(living)), weights_(evidence.sensor.weights) {}

  [[nodiscard]] double rms(std::span<const double> frame) const {
    double squares = 0.0;
    double living = 0.0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (!living_[i]) continue;
      const double value = weights_[evidence_.sites()[i].channel] * frame[i];
      squares += value * value;
      living += 1.0;
    }
    return living > 0.0 ? std::sqrt(squares / living) : 0.0;
  }

  /// The same of noise, given for each channel.
  [[nodiscard]] double of_noise(const std::vector<double>& channels) const {
    double squares = 0.0;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const double value = weights_[c] * channels[c];
      squares += value * value;
    }
    return std::sqrt(squares / static_cast<double>(channels.size()));
  }

 private:
  const Evidence& evidence_;
  std::vector<bool> living_;
  std::vector<double> weights_;
};

/// What is left of a pattern where the scene has each channel's constant found
/// with the loads.
std::vector<double> beside_offsets(const Evidence& evidence, std::span<const double> pattern) {
  std::vector<double> left(pattern.begin(), pattern.end());
  if (!evidence.sensor.offset) return left;
  for (const Channel& channel : evidence.channels()) {
    const std::size_t end = channel.first + channel.count;
    std::vector<double> values;
    for (std::size_t i = channel.first; i < end; ++i)
      if (evidence.living[i]) values.push_back(left[i]);
    const double constant = median(values);
    for (std::size_t i = channel.first; i < end; ++i) left[i] -= constant;
  }
  return left;
}

/// Tells contacts from what electronics and temperature add.
class NoContactTest {
 public:
  NoContactTest(const Evidence& evidence, const std::vector<double>& noise, PatternSolver& solver)
      : evidence_(evidence),
        living_(evidence.telling()),
        weighted_(evidence, living_),
        channel_noise_(noise),
        solver_(solver) {
    noise_ = weighted_.of_noise(noise);
  }

  /// Rms over that of the noise.
  [[nodiscard]] double times(std::span<const double> pattern) const {
    return noise_ > 0.0 ? weighted_.rms(beside_offsets(evidence_, pattern)) / noise_ : 0.0;
  }

  /// True where no load within the array explains it: it is larger than noise,
  /// and either rougher than a buried sensor can read, or the same from end to
  /// end.
  ///
  /// @param frames  how many its noise is averaged over
  [[nodiscard]] bool operator()(std::span<const double> read, std::size_t frames) {
    const std::vector<double> pattern = beside_offsets(evidence_, read);
    const double size = weighted_.rms(pattern);
    if (size < noise_) return false;
    unexplained_ = 1.0;
    if (is_even(pattern)) return true;
    const auto solved = solver_.solve(pattern, living_);
    if (!solved) return false;
    unexplained_ = solved->residual / size;
    if (solved->residual <= most_unexplained(pattern, frames)) return false;
    // A coarse array's few readings are smoothed, contact or not.
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> turned = pattern;
      for (double& value : turned) value *= sign;
      if (presses(turned, most_unexplained(pattern, frames))) return false;
    }
    return true;
  }

  /// Of the last pattern, the share that no load explains; 1: all. Of one that a contact explains
  /// it may be too large.
  [[nodiscard]] double unexplained() const noexcept { return unexplained_; }

  /// Where each of two states is within noise, or that of a contact, what has changed is a contact
  /// that came, went or moved.
  [[nodiscard]] bool are_loads(std::span<const double> one, std::span<const double> other,
                               std::size_t frames) {
    std::vector<double> change(one.begin(), one.end());
    for (std::size_t i = 0; i < change.size(); ++i) change[i] -= other[i];
    change = beside_offsets(evidence_, change);
    if (is_even(change)) return false;
    const double most = most_unexplained(change, frames);
    const auto is_load = [&](std::span<const double> read) {
      const std::vector<double> pattern = beside_offsets(evidence_, read);
      return weighted_.rms(pattern) <= most || presses(pattern, most);
    };
    return is_load(one) && is_load(other);
  }

  /// A contact, well above noise, is in what is read at rest.
  [[nodiscard]] bool is_loaded(std::span<const double> read, std::size_t frames) {
    constexpr double above_noise = 8.0;
    const std::vector<double> pattern = beside_offsets(evidence_, read);
    bool any = false;
    for (std::size_t i = 0; i < pattern.size(); ++i)
      any = any || (living_[i] && std::abs(pattern[i]) >
                                      above_noise * channel_noise_[evidence_.sites()[i].channel]);
    return any && presses(pattern, most_unexplained(pattern, frames));
  }

 private:
  /// Real pads differ from their model, and leave a tenth of a contact unexplained.
  [[nodiscard]] double most_unexplained(std::span<const double> pattern, std::size_t frames) const {
    return std::max(0.2 * weighted_.rms(pattern),
                    5.0 * noise_ / std::sqrt(static_cast<double>(frames)));
  }

  /// A contact explains the pattern but for so much.
  [[nodiscard]] bool presses(std::span<const double> pattern, double most) {
    const auto pressed = solver_.press(pattern, living_, most);
    if (!pressed) return false;
    unexplained_ = std::min(unexplained_, pressed->residual / weighted_.rms(pattern));
    return pressed->residual <= most;
  }

  [[nodiscard]] bool is_even(std::span<const double> pattern) const {
    if (!evidence_.sensor.is_wide) return false;
    for (std::size_t channel = 0; channel < channel_noise_.size(); ++channel) {
      const Channel& line = evidence_.channels()[channel];
      std::vector<double> values;
      for (std::size_t i = line.first; i < line.first + line.count; ++i)
        if (evidence_.living[i]) values.push_back(pattern[i]);
      const double middle = median(values);
      if (std::abs(middle) < 2.0 * channel_noise_[channel]) continue;
      const auto near = [&](double value) {
        return std::abs(value - middle) < 0.25 * std::abs(middle);
      };
      if (!values.empty() && near(values.front()) && near(values.back()) &&
          std::all_of(values.begin(), values.end(), near))
        return true;
    }
    return false;
  }

  const Evidence& evidence_;
  std::vector<bool> living_;
  Weighted weighted_;
  std::vector<double> channel_noise_;
  PatternSolver& solver_;
  double noise_ = 0.0;
  double unexplained_ = 1.0;
};

std::vector<double> difference(std::span<const double> a, std::span<const double> b) {
  std::vector<double> result(a.begin(), a.end());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] -= b[i];
  return result;
}

double largest_size(std::span<const double> values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

using Still = std::span<const FrameTriple* const>;

/// Frames that are in one of the triples at rest or in several.
std::size_t frames_of(Still still, const Rest& rest) {
  std::set<std::size_t> frames;
  for (const std::size_t k : rest.triples)
    for (const std::size_t offset : {0u, 1u, 2u}) frames.insert(still[k]->first + offset);
  return frames.size();
}

/// How the frames at rest differ from it: the rms of each channel, and whether
/// what is left remembers the frame before (noise does not), or resembles its
/// neighbour (as loads do).
struct Spread {
  std::vector<double> of_channel{};
  double in_time = 0.0;
  double in_space = 0.0;
};

Spread spread_of(const Evidence& evidence, Still still, const Rest& rest) {
  Spread spread;
  const auto raw = [&](std::size_t k, std::size_t frame, std::size_t i) {
    const double d = still[k]->frames[frame][i] - rest.values[i];
    return std::isfinite(d) ? d : 0.0;
  };
  std::vector<double> mean(rest.values.size());  // of what is quantised it is not the median
  for (std::size_t i = 0; i < mean.size(); ++i) {
    for (const std::size_t k : rest.triples) mean[i] += raw(k, 0, i) + raw(k, 1, i) + raw(k, 2, i);
    mean[i] /= 3.0 * static_cast<double>(rest.triples.size());
  }
  for (const Channel& channel : evidence.channels()) {
    const std::size_t end = channel.first + channel.count;
    std::vector<double> values;
    double squares = 0.0;
    double in_time = 0.0;
    double in_space = 0.0;
    for (std::size_t i = channel.first; i < end; ++i) {
      if (!evidence.living[i]) continue;
      const bool has_neighbour = i + 1 < end && evidence.living[i + 1];
      for (const std::size_t k : rest.triples) {
        const auto at = [&](std::size_t frame, std::size_t reading) {
          return raw(k, frame, reading) - mean[reading];
        };
        values.push_back(at(1, i));
        squares += at(1, i) * at(1, i);
        in_time += 0.5 * at(1, i) * (at(0, i) + at(2, i));
        if (has_neighbour) in_space += at(1, i) * at(1, i + 1);
      }
    }
    spread.of_channel.push_back(robust_rms(std::move(values)));
    if (squares == 0.0) continue;
    spread.in_time = std::max(spread.in_time, in_time / squares);
    spread.in_space = std::max(spread.in_space, in_space / squares);
  }
  return spread;
}

/// The largest change between the rests of two stretches of the recording that
/// is no load.
std::optional<finding::Drift> find_drift(const Evidence& evidence, const StillNoise& noise,
                                         NoContactTest& no_contact) {
  constexpr std::size_t per_stretch = 12;
  const std::size_t stretches = std::min<std::size_t>(noise.still.size() / per_stretch, 8);
  struct Stretch {
    Rest rest;
    std::size_t frame;
  };
  std::vector<Stretch> found;
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t begin = s * noise.still.size() / stretches;
    const std::size_t end = (s + 1) * noise.still.size() / stretches;
    const Still still = Still(noise.still).subspan(begin, end - begin);
    Rest rest = find_rest(still, evidence.living, noise);
    if (!rest.known()) continue;
    const std::size_t frame = still[rest.triples.front()]->first + 1;
    found.push_back({std::move(rest), frame});
  }
  std::optional<finding::Drift> drift;
  for (std::size_t b = 1; b < found.size(); ++b) {
    const std::vector<double> change = difference(found[b].rest.values, found[0].rest.values);
    // The difference of two medians is surer by the root of a third of their
    // frames.
    const std::size_t frames =
        std::min(found[b].rest.triples.size(), found[0].rest.triples.size()) / 3;
    const double times = no_contact.times(change);
    if (times < 2.0 || (drift && times < drift->times) || !no_contact(change, frames) ||
        no_contact.are_loads(found[b].rest.values, found[0].rest.values, frames))
      continue;
    drift = finding::Drift{.largest = largest_size(change),
                           .times = times,
                           .from = found[0].frame,
                           .to = found[b].frame};
  }
  return drift;
}

}  // namespace

RestState judge_rest(const Evidence& evidence, const StillNoise& noise, PatternSolver& solver,
                     Findings& findings) {
  RestState state;
  if (!noise.known()) return state;
  const Rest rest = find_rest(noise.still, evidence.living, noise);
  if (!rest.known()) return state;
  state.quiet = rest.triples.size();

  NoContactTest no_contact(evidence, noise.least_change, solver);
  std::optional<finding::Drift> drift = find_drift(evidence, noise, no_contact);
  const double times = no_contact.times(rest.values);
  const bool off_zero = no_contact(rest.values, rest.triples.size());
  const bool loaded = no_contact.unexplained() < 0.5;
  state.loaded = off_zero ? loaded : no_contact.is_loaded(rest.values, rest.triples.size());
  // What is loaded is no zero: without it the loads would be lost.
  if (off_zero && !loaded) state.baseline = rest.values;
  // What drifts is off zero sooner or later: one finding for both.
  if (off_zero && (!drift || times > 2.0 * drift->times))
    findings.emplace_back(finding::Baseline{.values = rest.values,
                                            .frames = frames_of(noise.still, rest),
                                            .largest = largest_size(rest.values),
                                            .times = times,
                                            .loaded = loaded});
  if (drift) {
    drift->loaded = state.loaded;
    findings.emplace_back(*drift);
  }

  Spread spread = spread_of(evidence, noise.still, rest);
  constexpr std::size_t enough = 300;  // values that a correlation is told by
  // A contact that lasts trembles, and steps make readings that hardly change equal from frame to
  // frame.
  bool stepped = false;
  for (std::size_t c = 0; c < noise.steps.size(); ++c)
    stepped = stepped || noise.steps[c] > 0.5 * noise.of_channel[c];
  if (!drift && !stepped && !state.loaded &&
      rest.triples.size() * evidence.tracks.size() >= enough && spread.in_time > 0.3 &&
      spread.in_space < 0.4 * spread.in_time) {
    findings.emplace_back(finding::NoiseColoured{spread.in_time});
    state.noise = std::move(spread.of_channel);
  }
  return state;
}

}  // namespace tactile_net::lab
