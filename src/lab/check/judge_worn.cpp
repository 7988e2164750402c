#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "lab/check/judgement.hpp"
#include "numeric/finite.hpp"

namespace tactile_net::lab {
namespace {

constexpr std::size_t worn_searches = 2;
constexpr std::size_t least_triples = 2;  // for each
constexpr std::size_t most_triples = 32;  // for all
constexpr double pressed_hard = 0.8;      // of the hardest press
/// What a contact leaves where worn taxels are among what it must explain: more than noise, and no
/// little of the readings.
constexpr double times_noise = 2.0;
constexpr double of_readings = 0.05;
constexpr double without_worn = 0.25;  // of that, at most: a pad that differs from its model is so
                                       // everywhere
constexpr double far_less = 0.25;      // than a contact makes it read that the others tell
constexpr double as_little = 0.4;      // as the contact makes a worn one beside it read
constexpr double missing_clearly = 10.0;  // times the noise

/// Of the readings that live.
double rms_of(const Evidence& evidence, std::span<const double> frame,
              const std::vector<bool>& living) {
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (!living[i] || !std::isfinite(frame[i])) continue;
    squares += std::pow(evidence.sensor.weights[evidence.sites()[i].channel] * frame[i], 2);
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

struct Worn {
  std::size_t taxel = 0;
  double share = 0.0;  // of what it should read
};

/// What each reading has less than a contact makes it read, over its noise.
std::vector<double> missing_in(std::span<const double> frame, const PressedPattern& pressed,
                               std::span<const double> noise) {
  std::vector<double> missing;
  for (std::size_t i = 0; i < frame.size(); ++i)
    missing.push_back((std::abs(pressed.read[i]) - std::abs(frame[i])) / noise[i]);
  return missing;
}

/// Looks for them in one frame.
class WornSearch {
 public:
  /// @param noise_share  of the frame's noise over that of a single one
  WornSearch(const Evidence& evidence, const StillNoise& noise, PatternSolver& solver,
             std::span<const double> frame, double noise_share)
      : evidence_(evidence), noise_(noise.scale), solver_(solver), frame_(frame) {
    for (double& one : noise_) one *= noise_share;
  }

  /// Taxels without which a contact explains the frame, and which read far less than that contact
  /// lets them.
  [[nodiscard]] std::vector<Worn> found() {
    const double sound = most_of_sound();
    const auto whole = solver_.press(frame_, evidence_.living, sound);
    if (!whole || !(whole->residual > sound)) return {};
    std::vector<bool> living = without_seed(*whole);
    if (living.empty()) return {};
    const auto seed = solver_.press(frame_, living);
    if (!seed || seed->residual > without_worn * whole->residual) return {};
    return grown(*seed, without_worn * whole->residual);
  }

 private:
  /// What a contact leaves of sound taxels, at most.
  [[nodiscard]] double most_of_sound() const {
    double squares = 0.0;  // of the noise of a weighted reading
    for (std::size_t i = 0; i < frame_.size(); ++i)
      squares += std::pow(evidence_.sensor.weights[evidence_.sites()[i].channel] * noise_[i], 2);
    const double usual = std::sqrt(squares / static_cast<double>(frame_.size()));
    return std::max(times_noise * usual, of_readings * rms_of(evidence_, frame_, evidence_.living));
  }

  /// A contact that must explain worn taxels, too, errs at all of them: those at which it errs most
  /// go first. @return  empty: half of the taxels would
  [[nodiscard]] std::vector<bool> without_seed(PressedPattern pressed) {
    constexpr std::size_t most_rounds = 16;
    std::vector<bool> living = evidence_.living;
    for (std::size_t round = 0; round < most_rounds; ++round) {
      std::vector<double> missing = missing_in(frame_, pressed, noise_);
      for (std::size_t i = 0; i < missing.size(); ++i)
        if (!living[i]) missing[i] = 0.0;
      const double most = *std::max_element(missing.begin(), missing.end());
      if (!(most > times_noise)) break;
      std::set<std::size_t> taxels;
      for (std::size_t i = 0; i < missing.size(); ++i)
        if (missing[i] >= 0.5 * most) taxels.insert(evidence_.sites()[i].taxel);
      leave_out(taxels, living);
      auto next = solver_.press(frame_, living);
      if (!next || is_too_few(living)) return {};
      pressed = std::move(*next);
    }
    return living;
  }

  /// With those beside them that read as little: a contact of an odd shape may explain one half of
  /// what is worn by pressing on the other.
  ///
  /// @param enough  a residual as of sound taxels alone
  [[nodiscard]] std::vector<Worn> grown(PressedPattern pressed, double enough) {
    std::set<std::size_t> taxels;
    for (const Worn& one : worn_by(pressed)) taxels.insert(one.taxel);
    if (taxels.empty()) return {};
    constexpr std::size_t most_rounds = 12;
    for (std::size_t round = 0; round < most_rounds; ++round) {
      const std::set<std::size_t> before = taxels;
      const auto try_beside = [&](std::size_t worn, std::size_t beside) {
        if (before.contains(evidence_.sites()[worn].taxel) &&
            std::abs(frame_[beside]) < as_little * std::abs(pressed.read[worn]))
          taxels.insert(evidence_.sites()[beside].taxel);
      };
      for (const auto& [a, b] : evidence_.sensor.layout.neighbours) {
        try_beside(a, b);
        try_beside(b, a);
      }
      auto next = press_without(taxels);
      if (!next) return {};
      pressed = std::move(*next);
      if (pressed.residual > enough && taxels != before) continue;
      // What reads as it should without being asked stays.
      for (std::size_t i = 0; i < frame_.size(); ++i)
        if (std::abs(frame_[i]) > 0.5 * std::abs(pressed.read[i]))
          taxels.erase(evidence_.sites()[i].taxel);
      if (taxels == before) break;
    }
    const auto last = press_without(taxels);
    if (!last || last->residual > enough) return {};
    pressed = *last;
    std::vector<Worn> worn = worn_by(pressed);
    std::erase_if(worn, [&](const Worn& one) { return !taxels.contains(one.taxel); });
    return worn;
  }

  [[nodiscard]] std::optional<PressedPattern> press_without(const std::set<std::size_t>& taxels) {
    std::vector<bool> living = evidence_.living;
    leave_out(taxels, living);
    if (is_too_few(living)) return std::nullopt;
    return solver_.press(frame_, living);
  }
  void leave_out(const std::set<std::size_t>& taxels, std::vector<bool>& living) const {
    for (std::size_t i = 0; i < living.size(); ++i)
      if (taxels.contains(evidence_.sites()[i].taxel)) living[i] = false;
  }
  [[nodiscard]] bool is_too_few(const std::vector<bool>& living) const {
    return 2 * std::count(living.begin(), living.end(), true) <
           std::count(evidence_.living.begin(), evidence_.living.end(), true);
  }
  [[nodiscard]] std::vector<Worn> worn_by(const PressedPattern& pressed) const {
    const std::vector<double> missing = missing_in(frame_, pressed, noise_);
    std::vector<Worn> worn;
    for (std::size_t i = 0; i < frame_.size(); ++i)
      if (const double share = std::abs(frame_[i] / pressed.read[i]);
          evidence_.living[i] && missing[i] > missing_clearly && share < far_less)
        worn.push_back({evidence_.sites()[i].taxel, share});
    return worn;
  }

  const Evidence& evidence_;
  std::vector<double> noise_;  // of each reading
  PatternSolver& solver_;
  std::span<const double> frame_;
};

}  // namespace

void judge_worn(Evidence& evidence, const StillNoise& noise, PatternSolver& solver,
                Findings& findings) {
  const bool saturated = std::any_of(findings.begin(), findings.end(), [](const Finding& one) {
    return std::holds_alternative<finding::SaturatedTaxels>(one);
  });
  if (!noise.known() || saturated || evidence.sensor.offset) return;
  std::vector<std::pair<double, const FrameTriple*>> by_load;
  for (const FrameTriple& triple : evidence.triples)
    by_load.emplace_back(rms_of(evidence, triple.middle(), evidence.living), &triple);
  std::sort(by_load.rbegin(), by_load.rend());
  while (by_load.size() > most_triples ||
         (!by_load.empty() && by_load.back().first < pressed_hard * by_load.front().first))
    by_load.pop_back();
  if (by_load.size() < worn_searches * least_triples) return;

  // In each of the means of frames that press hard: a mean of loads is a load, too.
  std::vector<Worn> worn;
  for (std::size_t k = 0; k < worn_searches; ++k) {
    std::vector<double> mean(evidence.living.size());
    std::size_t frames = 0;
    for (std::size_t i = k; i < by_load.size(); i += worn_searches)
      for (const std::vector<double>& frame : by_load[i].second->frames) {
        for (std::size_t r = 0; r < mean.size(); ++r) mean[r] += frame[r];
        ++frames;
      }
    for (double& reading : mean) reading /= static_cast<double>(frames);
    if (!all_finite(mean)) return;
    const double share = std::sqrt(3.0 / static_cast<double>(frames));  // triples share frames
    const std::vector<Worn> now = WornSearch(evidence, noise, solver, mean, share).found();
    if (k == 0) worn = now;
    std::erase_if(worn, [&](const Worn& one) {
      return std::none_of(now.begin(), now.end(),
                          [&](const Worn& other) { return other.taxel == one.taxel; });
    });
    if (worn.empty()) return;
  }
  const auto worst = std::min_element(
      worn.begin(), worn.end(), [](const Worn& a, const Worn& b) { return a.share < b.share; });
  std::set<std::size_t> taxels;
  for (const Worn& one : worn) taxels.insert(one.taxel);
  finding::WornTaxels found{
      .taxels = {taxels.begin(), taxels.end()}, .worst = worst->taxel, .share = worst->share};
  evidence.bury(found.taxels);
  findings.emplace_back(std::move(found));
}

}  // namespace tactile_net::lab
