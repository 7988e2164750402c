/// @file
/// What five more presses buy: chosen ones against random ones, realised over logs whose truth is
/// known.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "tactile_net/calibration/next_press.hpp"
#include "tests/calibration/simulated_log.hpp"

namespace tactile_net {

/// Ways to choose the presses that follow the first two.
enum class PressChoice { none, chosen, even, random_full_force, random };

/// Errors relative to the truth.
struct TrialErrors {
  double readings = 0.0;  ///< rms of those predicted under reference loads
  double depth = 0.0;
  double gains = 0.0;  ///< rms
};

/// A log whose truth is known, with five more presses.
///
/// @tparam Made  `SimulatedLog` or `SimulatedSkinLog`
template <class Made>
class PressTrial {
 public:
  static constexpr std::size_t more = 5;

  virtual ~PressTrial() = default;

  [[nodiscard]] TrialErrors errors(PressChoice choice) {
    const PressLog before = log_;
    std::mt19937_64 random(1000 + seed_);
    for (const NextPress& one : presses_of(choice, random)) press(one, random);
    const PressFit fit = fit_presses(model_, log_);
    log_ = before;
    return errors_of(fit);
  }

 protected:
  PressTrial(Made made, unsigned seed)
      : made_(std::move(made)), seed_(seed), model_(made_.model()), log_(made_.log) {
    log_.presses.clear();
  }

  using Uniform = std::function<double(double low, double high)>;
  [[nodiscard]] virtual NextPress evenly(std::size_t i) const = 0;
  [[nodiscard]] virtual NextPress anywhere(bool any_force, const Uniform& uniform) const = 0;
  virtual void press(const NextPress& done, std::mt19937_64& random) = 0;
  /// Under which readings are predicted.
  [[nodiscard]] virtual std::vector<PressState> reference_loads() const = 0;
  [[nodiscard]] virtual PressModel truth() const = 0;
  [[nodiscard]] virtual double true_depth() const = 0;

  [[nodiscard]] std::vector<NextPress> presses_of(PressChoice choice,
                                                  std::mt19937_64& random) const {
    if (choice == PressChoice::none) return {};
    if (choice == PressChoice::chosen)
      return next_presses(model_, log_, {}, fit_presses(model_, log_), more).presses;
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::vector<NextPress> presses;
    for (std::size_t i = 0; i < more; ++i)
      presses.push_back(choice == PressChoice::even
                            ? evenly(i)
                            : anywhere(choice == PressChoice::random, uniform));
    return presses;
  }

  /// Through gains, offsets and noise into the log.
  void add(Press press, std::span<const double> clean, std::mt19937_64& random,
           std::normal_distribution<double>& normal) {
    for (std::size_t j = 0; j < clean.size(); ++j)
      press.readings.push_back(made_.gains[j] * clean[j] + made_.offsets[j] +
                               made_.rms[model_.sites()[j].channel] * normal(random));
    log_.presses.push_back(std::move(press));
  }

  [[nodiscard]] TrialErrors errors_of(const PressFit& fit) const {
    const std::vector<PressState> loads = reference_loads();
    const PressModel true_model = truth();
    const PressReadings is = true_model.readings(true_model.nominal(), loads, false);
    const PressReadings said = model_.readings(fit.pad, loads, false);
    TrialErrors errors;
    double apart = 0.0;
    double size = 0.0;
    const auto n = static_cast<double>(made_.gains.size());
    for (std::size_t j = 0; j < made_.gains.size(); ++j) {
      errors.gains += std::pow(std::log(fit.gains[j] / made_.gains[j]), 2) / n;
      const double noise = made_.rms[model_.sites()[j].channel];
      for (std::size_t p = 0; p < loads.size(); ++p) {
        const double reading = made_.gains[j] * is.value(p, j);
        apart += std::pow((fit.gains[j] * said.value(p, j) - reading) / noise, 2);
        size += std::pow(reading / noise, 2);
      }
    }
    errors.readings = std::sqrt(apart / size);
    errors.gains = std::sqrt(errors.gains);
    errors.depth = fit.at(PadParameter::depth).value / true_depth() - 1.0;
    return errors;
  }

  Made made_;
  unsigned seed_;
  PressModel model_;
  PressLog log_;
};

/// Two presses in the middle, a narrow and a wide one with the largest force, then five more.
/// Forces are known exactly, places within 0.1 mm, widths not at all; noise is 1 %.
class NextPressTrial final : public PressTrial<SimulatedLog> {
 public:
  explicit NextPressTrial(unsigned seed) : PressTrial(simulated_log(seed), seed) {
    std::mt19937_64 random(seed);
    NextPressTrial::press({.half_width = narrow, .force = largest}, random);
    NextPressTrial::press({.half_width = wide, .force = largest}, random);
  }

 private:
  static constexpr double narrow = 0.6e-3, wide = 2e-3, reach = 8.5e-3;
  static constexpr double largest = 400.0;

  [[nodiscard]] NextPress evenly(std::size_t i) const override {
    return {.position = reach * (0.5 * static_cast<double>(i) - 1.0),
            .half_width = i % 2 == 0 ? narrow : wide,
            .force = largest};
  }
  [[nodiscard]] NextPress anywhere(bool any_force, const Uniform& uniform) const override {
    NextPress one{.position = uniform(-reach, reach), .half_width = uniform(narrow, wide)};
    one.force = any_force ? uniform(50.0, largest) : largest;
    return one;
  }

  void press(const NextPress& done, std::mt19937_64& random) override {
    std::normal_distribution<double> normal;
    const PressModel model = truth();
    const PressState state{done.shape, std::log(done.force), done.position,
                           std::log(done.half_width), 0.0};
    const PressReadings readings = model.readings(model.nominal(), std::span(&state, 1), false);
    std::vector<double> clean;
    for (std::size_t j = 0; j < made_.gains.size(); ++j) clean.push_back(readings.value(0, j));
    Press press{.number = log_.presses.size() + 1, .force = {.value = done.force}};
    press.position = {.value = done.position + 1e-4 * normal(random), .sd = 1e-4};
    add(std::move(press), clean, random, normal);
  }

  [[nodiscard]] std::vector<PressState> reference_loads() const override {
    std::vector<PressState> loads;
    for (const double half_width : {narrow, 0.5 * (narrow + wide), wide})
      for (int i = -4; i <= 4; ++i)
        loads.push_back(
            {Shape::cylinder, std::log(largest), 0.25 * i * reach, std::log(half_width), 0.0});
    return loads;
  }
  [[nodiscard]] PressModel truth() const override { return {made_.array, made_.truth}; }
  [[nodiscard]] double true_depth() const override { return made_.array.depths.front(); }
};

inline constexpr unsigned trials_each = 25;

/// Root of the mean square over the logs.
template <class Trial = NextPressTrial>
TrialErrors trial_errors(PressChoice choice) {
  TrialErrors rms;
  for (unsigned seed = 0; seed < trials_each; ++seed) {
    const TrialErrors one = Trial(7000 + seed).errors(choice);
    rms.readings += one.readings * one.readings / trials_each;
    rms.depth += one.depth * one.depth / trials_each;
    rms.gains += one.gains * one.gains / trials_each;
  }
  return {std::sqrt(rms.readings), std::sqrt(rms.depth), std::sqrt(rms.gains)};
}

}  // namespace tactile_net
