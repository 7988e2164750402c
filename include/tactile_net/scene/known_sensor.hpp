/// @file
/// Sensors that are sold or simulated, by name, and what is known of each without a recording of
/// it: the files of sensors/.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

struct KnownSensor {
  std::string name{};             ///< "paxini"
  std::vector<Quantity> reads{};  ///< of each taxel in a scene; empty: no scene without a recording
  /// CSV of the taxels of each model, in millimetres: name,x,y,z,nx,ny,nz.
  std::map<std::string, std::string> models{};
  /// Rows and columns on a flat pad: "12x32"; "": as the model says; absent: none.
  std::optional<std::string> lattice{};
  std::string needs{};    ///< where the places are that are not known here
  std::string call{};     ///< in Python, of what makes a scene of a recording
  std::string refusal{};  ///< why there is no elastic model of what it reads; "": there is one
};

/// In the order of their names.
[[nodiscard]] std::span<const KnownSensor> known_sensors();

/// @throw std::invalid_argument  there is none of this name: says which there are
[[nodiscard]] const KnownSensor& known_sensor(std::string_view name);

/// "12x32" as rows and columns, each from 1 to 256; nothing where it is none.
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> lattice_of(std::string_view text);

/// Young's modulus where none is needed and none is given [Pa]: tractions do not depend on it where
/// stresses below a layer are read, and no reading strains a pad of it much.
inline constexpr double modulus_not_needed = 1e8;

}  // namespace tactile_net
