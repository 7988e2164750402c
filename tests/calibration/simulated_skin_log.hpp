/// @file
/// Logs of presses on a skin whose truth is known, simulated by the exact forward model, which
/// knows nothing of the calibration's; on a dome by sums of point loads.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tactile_net/calibration/ball_contact.hpp"
#include "tactile_net/calibration/press_fit.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tactile_net/skin/signal_layout.hpp"
#include "tests/calibration/curved_pads.hpp"

namespace tactile_net {

struct SkinLogOptions {
  std::size_t side = 5;  ///< taxels along y and z
  double noise = 0.01;   ///< of a channel's largest reading
  std::size_t presses = 12;
  std::vector<Quantity> reads{Quantity::stress_x};
  bool layer = false;
  bool at_one_place = false;
  bool states_force = true;
  bool states_radius = true;  ///< of the balls; else the contact's
  double friction = 0.0;      ///< most of a press' drag, to any side; it is stated within 0.1
  double shift_y = 0.0, shift_z = 0.0;  ///< of the skin on its stage [m]
  double dome = 0.0;                    ///< its radius; 0: a flat skin
  Stand stand{};                        ///< of the dome
};

struct SimulatedSkinLog {
  SkinArray truth{}, nominal{};
  Material pad{}, nominal_pad{};
  std::vector<double> gains{}, offsets{};
  std::vector<double> rms{};  ///< of each channel's noise
  PressLog log{};
  std::vector<SkinContact> frictions{};  ///< of dragged presses

  [[nodiscard]] PressModel model() const { return {nominal, nominal_pad}; }
};

/// Balls of 3 to 8 mm pressed evenly over the skin; forces stated within 1 %, places within 0.1 mm.
/// The nominal depth is 20 % too small.
inline SimulatedSkinLog simulated_skin_log(unsigned seed, const SkinLogOptions& options = {}) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  SimulatedSkinLog result;
  const auto skin = [&](double depth) -> SkinArray {
    if (options.dome != 0.0)
      return dome({.side = options.side,
                   .radius = options.dome,
                   .depth = depth,
                   .reads = options.reads,
                   .stand = options.stand});
    return {.rows = options.side,
            .columns = options.side,
            .pitch_y = 2e-3,
            .pitch_z = 2e-3,
            .depths = {depth},
            .reads = options.reads};
  };
  result.truth = skin(1.8e-3);
  result.pad = {.youngs_modulus = 2.2e5, .poisson_ratio = 0.46};
  if (options.layer) result.pad.layer = Layer{4e-3, Base::bonded};
  result.nominal = skin(1.5e-3);
  result.nominal_pad = result.pad;
  result.nominal_pad.youngs_modulus = 2e5;
  if (options.layer) result.nominal_pad.layer->thickness = 3.6e-3;

  const std::size_t n = reading_count(result.truth);
  const double half = 1e-3 * static_cast<double>(options.side - 1);
  const ExactSkinModel exact(result.truth, result.pad);
  const auto across = std::max<std::size_t>(
      2, static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(options.presses)))));
  std::vector<std::vector<double>> clean;
  for (std::size_t p = 0; p < options.presses; ++p) {
    const auto place = [&](std::size_t i) {
      return options.at_one_place
                 ? 0.0
                 : half * (2.0 * static_cast<double>(i) / static_cast<double>(across - 1) - 1.0) +
                       uniform(-3e-4, 3e-4);
    };
    const double y = place(p / across);
    const double z = place(p % across);
    const double radius = options.at_one_place ? 5e-3 : uniform(3e-3, 8e-3);
    const double force = uniform(0.3, 1.0);
    const double relative =
        options.dome != 0.0 ? 1.0 / (1.0 / radius + 1.0 / options.dome) : radius;
    const double a = ball_contact_radius(result.pad, force, relative);
    SkinContact contact{
        .y = y - options.shift_y, .z = z - options.shift_z, .radius = a, .force = force};
    if (options.friction > 0.0) {
      contact.friction = uniform(0.0, options.friction);
      contact.direction = uniform(-3.1, 3.1);
    }
    if (options.dome != 0.0) {
      PressState state{.log_force = std::log(force), .center = contact.y};
      state.log_half_width = std::log(a);
      state.center_z = contact.z;
      state.friction = contact.friction * std::cos(contact.direction);
      state.friction_z = contact.friction * std::sin(contact.direction);
      clean.push_back(summed_readings(result.truth, result.pad, state, 24));
    } else {
      const std::vector<SkinLoad> loads{contact};
      clean.push_back(exact.readings(loads));
    }
    Press press{.number = p + 1};
    if (options.states_force) press.force = {force * (1.0 + 0.01 * normal(random)), 0.01 * force};
    press.position = {y + 1e-4 * normal(random), 1e-4};
    press.position_z = {z + 1e-4 * normal(random), 1e-4};
    if (options.friction > 0.0) {
      press.friction = {contact.friction * std::cos(contact.direction) + 0.1 * normal(random), 0.1};
      press.friction_z = {contact.friction * std::sin(contact.direction) + 0.1 * normal(random),
                          0.1};
      result.frictions.push_back(contact);
    }
    if (options.states_radius)
      press.radius = radius;
    else
      press.half_width.value = a;
    result.log.presses.push_back(press);
  }
  const std::vector<Site> where = sites(result.truth);
  std::vector<double>& rms = result.rms;
  rms.resize(channel_count(result.truth));
  for (const std::vector<double>& readings : clean)
    for (std::size_t j = 0; j < n; ++j)
      rms[where[j].channel] =
          std::max(rms[where[j].channel], options.noise * std::abs(readings[j]));
  std::vector<double>& offsets = result.offsets;
  for (std::size_t j = 0; j < n; ++j) {
    result.gains.push_back(std::exp(0.05 * normal(random)));
    offsets.push_back(2.0 * rms[where[j].channel] * normal(random));
  }
  const auto noisy = [&](std::size_t j, double value) {
    return result.gains[j] * value + offsets[j] + rms[where[j].channel] * normal(random);
  };
  std::vector<std::vector<double>> frames(20);
  for (std::vector<double>& frame : frames)
    for (std::size_t j = 0; j < n; ++j) frame.push_back(noisy(j, 0.0));
  result.log.unloaded = unloaded_frames(signal_layout(result.truth), frames);
  for (std::size_t p = 0; p < options.presses; ++p)
    for (std::size_t j = 0; j < n; ++j)
      result.log.presses[p].readings.push_back(noisy(j, clean[p][j]));
  return result;
}

}  // namespace tactile_net
