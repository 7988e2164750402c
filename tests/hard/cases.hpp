/// @file
/// Problems at which reconstructions fail in silence.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net::hard {

struct Case {
  std::string name;
  SensorArray array;
  Material material;
  LineProblemOptions options;
  double alpha = 1e-4;
  std::vector<double> readings;
};

/// Those whose factorisations 50 digits can follow.
[[nodiscard]] std::vector<Case> cases();

/// 251 (prime) and 1024 taxels.
[[nodiscard]] std::vector<Case> large_cases();

}  // namespace tactile_net::hard
