/// @file
/// The shipped logs of calibrations, and how near a calibration comes to what made them.
#pragma once

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

namespace tactile_net {

inline std::string log_of(const std::string& name) { return scene("calibration/" + name + ".csv"); }
inline std::string nominal_of(const std::string& name) {
  return scene("calibration/" + name + ".toml");
}
inline nlohmann::json truth_of(const std::string& name) {
  return nlohmann::json::parse(read_text(scene("calibration/" + name + ".truth.json")));
}

/// Rms of the gains about the true ones, their common factor aside.
inline double gains_left(const nlohmann::json& found, const nlohmann::json& true_gains) {
  std::vector<double> logs;
  double mean = 0.0;
  const auto n = static_cast<double>(true_gains.size());
  for (std::size_t j = 0; j < true_gains.size(); ++j) {
    // JSON has them in the scene's units: kPa over SI's Pa.
    logs.push_back(
        std::log(found["gains"][j]["value"].get<double>() / true_gains[j].get<double>()));
    mean += logs.back() / n;
  }
  double squares = 0.0;
  for (const double one : logs) squares += std::pow(one - mean, 2) / n;
  return std::sqrt(squares);
}

}  // namespace tactile_net
