/// @file
/// A circuit that datasheets are made of.
#pragma once

#include <string>

#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net {

inline constexpr const char* datasheet_opamp =
    "{ gain = 1e6, bandwidth = 10e6, second_pole = 25e6, offset = 50e-6, bias_current = 1e-9, "
    "noise_voltage = 5e-9, noise_current = 1e-12, input_capacitance = 4e-12 }";

/// Op-amps that have everything a figure is of.
inline lab::SceneCircuit datasheet_circuit(const std::string& tolerance = "{ relative = 0.01 }",
                                           const std::string& more = {},
                                           const std::string& opamp = datasheet_opamp,
                                           int taxels = 9) {
  return lab::simulated_circuit(parse_scene(
      "[sensor]\ncount = " + std::to_string(taxels) +
          "\npitch = 0.5\ndepth = 1.5\nreads = [\"strain_x\"]\n"
          "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
          "[[contact]]\nshape = \"cylinder\"\nhalf_width = 2.0\nforce = 1.0\n"
          "[reconstruct]\nalpha = 1e-3\nsmoothing_length = 1.0\n[network]\n"
          "realization = \"lattice\"\nsiemens = 5e-3\nopamp = " +
          opamp + "\nparasitic = { node = 5e-12, input = 2e-12 }\ntolerance = " + tolerance + "\n" +
          more,
      "small.toml"));
}

}  // namespace tactile_net
