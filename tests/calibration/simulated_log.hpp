/// @file
/// Logs of presses whose truth is known: the set-up of docs/internals/calibration.md.
#pragma once

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "tactile_net/calibration/press_fit.hpp"

namespace tactile_net {

struct LogOptions {
  double noise = 0.01;  ///< of the largest reading
  std::size_t presses = 20;
  double gain_spread = 0.05;
  bool knows_width = true, knows_centre = true, knows_force = true;
  std::vector<Quantity> reads{Quantity::stress_x};
  bool layer = true;
  double depth = 1.5e-3;
  double drag = 0.0;  ///< friction of the ninth press; what is stated of it is the test's
};

struct SimulatedLog {
  SensorArray array{};
  Material truth{};
  Material nominal{};
  double nominal_depth = 0.0;
  std::vector<double> gains{};
  std::vector<double> offsets{}, rms{};  ///< of each reading, and of each channel's noise
  PressLog log{};

  [[nodiscard]] PressModel model() const {
    SensorArray other = array;
    other.depths = {nominal_depth};
    return {other, nominal};
  }
};

/// Rods at random places with random widths and forces; a nominal scene that is wrong by 15 % in
/// depth, 10 % in thickness and 0.03 in nu, at random.
inline SimulatedLog simulated_log(unsigned seed, const LogOptions& options = {}) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  SimulatedLog result;
  result.array = {.count = 41, .pitch = 0.5e-3, .depths = {options.depth}, .reads = options.reads};
  result.truth = {.youngs_modulus = 2e5, .poisson_ratio = 0.45};
  if (options.layer) result.truth.layer = Layer{3e-3, Base::bonded};
  result.nominal = result.truth;
  result.nominal_depth = options.depth * std::exp(0.15 * normal(random));
  result.nominal.poisson_ratio = std::min(0.5, 0.45 + 0.03 * normal(random));
  if (result.nominal.layer)
    result.nominal.layer->thickness =
        std::max(3e-3 * std::exp(0.1 * normal(random)), result.nominal_depth);

  std::vector<PressState> presses;
  for (std::size_t p = 0; p < options.presses; ++p)
    presses.push_back({Shape::cylinder, std::log(uniform(50.0, 400.0)), uniform(-8e-3, 8e-3),
                       std::log(uniform(0.6e-3, 2e-3)), 0.0});
  if (options.drag != 0.0) presses.at(8).friction = options.drag;
  const PressModel model(result.array, result.truth);
  const PressReadings readings = model.readings(model.nominal(), presses, false);
  const std::size_t n = model.sites().size();
  const std::vector<Channel> channel = channels(result.array);
  std::vector<double>& rms = result.rms;
  rms.resize(channel.size());
  for (std::size_t p = 0; p < presses.size(); ++p)
    for (std::size_t j = 0; j < n; ++j) {
      double& most = rms[model.sites()[j].channel];
      most = std::max(most, options.noise * std::abs(readings.value(p, j)));
    }
  std::vector<double>& offsets = result.offsets;
  offsets.resize(n);
  for (std::size_t j = 0; j < n; ++j) {
    result.gains.push_back(std::exp(options.gain_spread * normal(random)));
    offsets[j] = 2.0 * rms[model.sites()[j].channel] * normal(random);
  }
  const auto noisy = [&](std::size_t j, double value) {
    return result.gains[j] * value + offsets[j] + rms[model.sites()[j].channel] * normal(random);
  };
  std::vector<std::vector<double>> frames(20);
  for (std::vector<double>& frame : frames)
    for (std::size_t j = 0; j < n; ++j) frame.push_back(noisy(j, 0.0));
  result.log.unloaded = unloaded_frames(result.array, frames);
  for (std::size_t p = 0; p < presses.size(); ++p) {
    Press press{.number = p + 1};
    if (options.knows_force) press.force.value = std::exp(presses[p].log_force);
    if (options.knows_centre) press.position.value = presses[p].center;
    if (options.knows_width) press.half_width.value = std::exp(presses[p].log_half_width);
    for (std::size_t j = 0; j < n; ++j) press.readings.push_back(noisy(j, readings.value(p, j)));
    result.log.presses.push_back(std::move(press));
  }
  return result;
}

}  // namespace tactile_net
