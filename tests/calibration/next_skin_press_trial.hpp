/// @file
/// What five more presses on a skin buy: chosen ones against random ones, realised over logs whose
/// truth is known.
#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "tactile_net/calibration/next_press.hpp"
#include "tests/calibration/next_press_trial.hpp"
#include "tests/calibration/simulated_skin_log.hpp"

namespace tactile_net {

/// Two balls in the middle of 5 x 5 taxels, a small and a large one with the largest force, then
/// five more. Forces and radii are known exactly, places within 0.1 mm; noise is 1 %.
class NextSkinPressTrial final : public PressTrial<SimulatedSkinLog> {
 public:
  explicit NextSkinPressTrial(unsigned seed)
      : PressTrial(simulated_skin_log(seed, {.reads = {Quantity::stress_x, Quantity::shear_xy}}),
                   seed),
        exact_(made_.truth, made_.pad) {
    std::mt19937_64 random(seed);
    NextSkinPressTrial::press({.radius = small, .force = largest}, random);
    NextSkinPressTrial::press({.radius = large, .force = largest}, random);
  }

  /// The criterion before and after, as it was said and as the fit with these presses has it.
  struct Promise {
    double now = 0.0, said = 0.0, kept = 0.0;
  };
  [[nodiscard]] Promise promise(std::optional<PadParameter> target) {
    const PressLog before = log_;
    std::mt19937_64 random(1000 + seed_);
    const NextPresses next =
        next_presses(model_, log_, {}, fit_presses(model_, log_), more, target);
    for (const NextPress& one : next.presses) press(one, random);
    const PressFit fit = fit_presses(model_, log_);
    const Promise result{next.now, next.presses.back().remaining,
                         next_presses(model_, log_, {}, fit, 0, target).now};
    log_ = before;
    return result;
  }

 private:
  static constexpr double small = 3e-3, large = 8e-3, reach = 3.4e-3;
  static constexpr double largest = 1.0;

  [[nodiscard]] NextPress evenly(std::size_t i) const override {  // the corners and the middle
    NextPress one{.radius = i % 2 == 0 ? small : large, .force = largest};
    one.position = i == 4 ? 0.0 : reach * (i % 2 == 0 ? 1.0 : -1.0);
    one.position_z = i == 4 ? 0.0 : reach * (i < 2 ? 1.0 : -1.0);
    return one;
  }
  [[nodiscard]] NextPress anywhere(bool any_force, const Uniform& uniform) const override {
    NextPress one{.position = uniform(-reach, reach), .radius = uniform(small, large)};
    one.position_z = uniform(-reach, reach);
    one.force = any_force ? uniform(0.1, largest) : largest;
    return one;
  }

  void press(const NextPress& done, std::mt19937_64& random) override {
    std::normal_distribution<double> normal;
    const std::vector<SkinLoad> loads{
        SkinContact{.y = done.position,
                    .z = done.position_z,
                    .radius = ball_contact_radius(made_.pad, done.force, done.radius),
                    .force = done.force}};
    Press press{.number = log_.presses.size() + 1, .force = {.value = done.force}};
    press.position = {done.position + 1e-4 * normal(random), 1e-4};
    press.position_z = {done.position_z + 1e-4 * normal(random), 1e-4};
    press.radius = done.radius;
    add(std::move(press), exact_.readings(loads), random, normal);
  }

  [[nodiscard]] std::vector<PressState> reference_loads() const override {
    std::vector<PressState> loads;
    for (const double radius : {small, large})
      for (int i = -2; i <= 2; ++i)
        for (int k = -2; k <= 2; ++k) {
          PressState one{.log_force = std::log(largest), .center = 0.5 * i * reach};
          one.log_half_width = std::log(ball_contact_radius(made_.pad, largest, radius));
          one.center_z = 0.5 * k * reach;
          loads.push_back(one);
        }
    return loads;
  }
  [[nodiscard]] PressModel truth() const override { return {made_.truth, made_.pad}; }
  [[nodiscard]] double true_depth() const override { return made_.truth.depths.front(); }

  ExactSkinModel exact_;
};

}  // namespace tactile_net
