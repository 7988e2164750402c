/// @file
/// What a press does to the readings of a line or a skin, before crosstalk. Private.
#pragma once

#include <span>

#include "tactile_net/calibration/press_model.hpp"
#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {

/// The taxels of a pad whose state is known.
struct PadTaxels {
  std::span<const Site> sites{};        ///< nominal
  std::span<const double> y{}, z{};     ///< of each reading, as they are [m]
  double depth_factor = 1.0;            ///< on the nominal depths
  Material material{};                  ///< as it is
  bool tied_to_base = false;            ///< a layer is as thick as each taxel is deep
  bool by_friction = false;             ///< a skin's derivatives by friction are asked for
  const CurvedSkin* curved = nullptr;   ///< of a curved skin, whose places are these
  double nominal_thickness = 0.0;       ///< of its layer
  double shift_y = 0.0, shift_z = 0.0;  ///< of it on the stage, along its chart
};

/// Adds to `value`, and with derivatives to those by depth, thickness, nu, place, half width and
/// friction, which have presses x readings numbers.
void add_line_readings(const PadTaxels& taxels, std::span<const PressState> presses,
                       bool with_derivatives, PressReadings& out);
void add_skin_readings(const PadTaxels& taxels, std::span<const PressState> presses,
                       bool with_derivatives, PressReadings& out);
void add_curved_readings(const PadTaxels& taxels, std::span<const PressState> presses,
                         bool with_derivatives, PressReadings& out);

}  // namespace tactile_net
