/// @file
/// What tests of press models share, of lines and of skins.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tactile_net/calibration/press_model.hpp"
#include "tests/catch.hpp"

namespace tactile_net {

/// A half space, a layer that is bonded to its base, one that slips on it.
inline Material pad_of(int kind) {
  Material material{.youngs_modulus = 2e5, .poisson_ratio = 0.45};
  if (kind > 0) material.layer = Layer{3e-3, kind == 1 ? Base::bonded : Base::frictionless};
  return material;
}

inline double peak(const Matrix& rows, std::size_t row) {
  double most = 0.0;
  for (const double value : rows.row(row)) most = std::max(most, std::abs(value));
  return most;
}

/// Another place in the space of parameters, by `step` along one of them.
inline PadState moved(PadState pad, std::size_t parameter, double step) {
  double* const members[] = {&pad.log_depth,   &pad.log_thickness, &pad.poisson_ratio,
                             &pad.log_modulus, &pad.crosstalk,     &pad.shift,
                             &pad.log_pitch,   &pad.shift_z};
  *members[parameter] += step;
  return pad;
}

/// Every derivative is the central difference of the readings, of fourth order:
/// (8 (f(h) - f(-h)) - (f(2h) - f(-2h))) / 12 h.
///
/// @param channels  quantities of other units stand beside each other: so many equal parts are
///                  compared each with its own largest
inline void check_derivatives(const PressModel& model, const PadState& pad,
                              const std::vector<PressState>& presses, std::size_t channels,
                              bool by_friction) {
  const PressReadings at = model.readings(pad, presses, true, false, by_friction);
  const std::size_t width = model.sites().size() / channels;
  const auto compare = [&](const auto& value_at, const Matrix& column, double step,
                           const char* what) {
    const Matrix near = value_at(step), back = value_at(-step);
    const Matrix far = value_at(2.0 * step), behind = value_at(-2.0 * step);
    for (std::size_t p = 0; p < presses.size(); ++p)
      for (std::size_t c = 0; c < channels; ++c) {
        double slope = 0.0, value = 0.0;
        for (std::size_t j = c * width; j < (c + 1) * width; ++j) {
          slope = std::max(slope, std::abs(column(p, j)));
          value = std::max(value, std::abs(at.value(p, j)));
        }
        for (std::size_t j = c * width; j < (c + 1) * width; ++j) {
          const double difference =
              (8.0 * (near(p, j) - back(p, j)) - (far(p, j) - behind(p, j))) / (12.0 * step);
          CAPTURE(what, p, c, j);
          CHECK(std::abs(column(p, j) - difference) <= 1e-7 * slope + 1e-13 * value / step);
        }
      }
  };
  for (std::size_t i = 0; i < pad_parameter_count; ++i) {
    const auto parameter = static_cast<PadParameter>(i);
    const double step =
        parameter == PadParameter::shift || parameter == PadParameter::shift_z ? 2e-6 : 2e-3;
    compare([&](double by) { return model.readings(moved(pad, i, by), presses, false).value; },
            at.by_pad[i], step, name(parameter).data());
  }
  const auto by = [&](double PressState::*member, const Matrix& column, double step,
                      const char* what) {
    const auto value_at = [&](double change) {
      std::vector<PressState> other = presses;
      for (PressState& one : other) one.*member += change;
      return model.readings(pad, other, false).value;
    };
    compare(value_at, column, step, what);
  };
  by(&PressState::log_force, at.by_log_force, 2e-3, "force");
  by(&PressState::center, at.by_center, 2e-6, "y");
  by(&PressState::log_half_width, at.by_log_half_width, 2e-3, "a");
  if (by_friction) by(&PressState::friction, at.by_friction, 2e-3, "friction");
  if (!model.is_skin()) return;
  by(&PressState::center_z, at.by_center_z, 2e-6, "z");
  if (by_friction) by(&PressState::friction_z, at.by_friction_z, 2e-3, "friction_z");
}

/// Where taxels lie at the base, the derivative by the depth moves the thickness with it.
inline void check_tied(const PressModel& model, const std::vector<PressState>& presses) {
  const PadState state = model.nominal();
  const Matrix by_depth = model.readings(state, presses, true, true).by_pad[0];
  const auto value = [&](double by) {
    return model.readings(moved(state, 0, by), presses, false, true).value;
  };
  const Matrix up = value(1e-4), down = value(-1e-4);
  for (std::size_t p = 0; p < presses.size(); ++p)
    for (std::size_t j = 0; j < up.columns; ++j)
      CHECK(std::abs(by_depth(p, j) - (up(p, j) - down(p, j)) / 2e-4) <= 1e-7 * peak(by_depth, p));
}

}  // namespace tactile_net
