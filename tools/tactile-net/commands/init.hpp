/// @file
/// The command `init`: from somebody's recording to a scene that fits it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "streams.hpp"
#include "tactile_net/elasticity/material.hpp"

namespace tactile_net::tool {

struct InitOptions {
  std::string recording{};  ///< or
  std::string sensor{};     ///< by its name
  std::string model{};      ///< of the sensor
  std::string output{};
  std::string columns{};
  bool force = false;                     ///< replaces what is there
  std::vector<std::string> quantities{};  ///< that every taxel measures, as in a scene
  std::optional<double> pitch{};
  std::vector<double> depths{};
  std::optional<double> modulus{};
  std::optional<double> poisson{};
  std::optional<double> layer{};  ///< thickness
  Base base = Base::bonded;
  std::vector<double> noise{};  ///< rms: one, or one for each quantity
  std::string length_unit{}, modulus_unit{}, stress_unit{}, force_unit{};
};

/// What is not given is asked for where somebody is there to answer.
///
/// @throw WrongUsage  something is not given, and nobody is there: names all of it
void run(const InitOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
