/// @file
/// Skins whose frames bench_skin times.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "tactile_net/control/planner.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/skin/problem.hpp"

namespace bench {

using namespace tactile_net;

constexpr double alpha = 1e-4;

inline double seconds_of(const std::function<void()>& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Taxels above the cells' middles, depth two pitches.
inline LinearProblem square_problem(std::size_t size, std::size_t components) {
  SkinArray skin{.rows = size,
                 .columns = size,
                 .pitch_y = 2e-3,
                 .pitch_z = 2e-3,
                 .depths = {4e-3},
                 .reads = {Quantity::stress_x}};
  if (components == 3) skin.reads = {Quantity::stress_x, Quantity::shear_xy, Quantity::shear_xz};
  return make_problem(skin, {.youngs_modulus = 0.25e6, .poisson_ratio = 0.45},
                      {.components = components});
}

inline std::vector<double> random_readings(std::size_t count) {
  std::mt19937 generator(1);
  std::vector<double> readings(count);
  for (double& reading : readings) reading = static_cast<double>(generator()) / 0x1p32;
  return readings;
}

}  // namespace bench
