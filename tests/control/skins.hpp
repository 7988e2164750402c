/// @file
/// Skins of every kind that plans are made for.
#pragma once

#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// A line or a skin to plan for.
struct PlanCase {
  std::string name{};
  LinearProblem problem{};
  std::optional<LinearProblem> whole{};  ///< where taxels are dead
};

struct Skin : PlanCase {
  SkinArray array{};
  Material material{.youngs_modulus = 0.25e6, .poisson_ratio = 0.48};
};

inline Skin skin_of(const std::string& name, const SkinArray& array,
                    const SkinProblemOptions& options = {}) {
  Skin skin;
  skin.name = name;
  skin.array = array;
  skin.problem = make_problem(array, skin.material, options);
  SkinProblemOptions alive = options;
  alive.dead_taxels.clear();
  if (!options.dead_taxels.empty()) skin.whole = make_problem(array, skin.material, alive);
  return skin;
}

inline const std::vector<Quantity> three_stresses{Quantity::stress_x, Quantity::shear_xy,
                                                  Quantity::shear_xz};

inline Skin rectangle(std::size_t rows, std::size_t columns, std::vector<std::size_t> dead = {},
                      std::size_t components = 3) {
  const SkinArray array{.rows = rows,
                        .columns = columns,
                        .pitch_y = 2e-3,
                        .pitch_z = 2e-3,
                        .depths = {4e-3},
                        .reads = three_stresses};
  return skin_of(std::to_string(rows) + " x " + std::to_string(columns), array,
                 {.components = components, .dead_taxels = std::move(dead)});
}

/// @param components  0: three
inline Skin square(std::size_t size, std::size_t components = 0,
                   std::vector<std::size_t> dead = {}) {
  return rectangle(size, size, std::move(dead), components == 0 ? 3 : components);
}

/// Normal stresses along both axes, at two depths.
inline Skin two_depths(std::size_t size) {
  return skin_of("two depths", {.rows = size,
                                .columns = size,
                                .pitch_y = 2e-3,
                                .pitch_z = 2e-3,
                                .depths = {3e-3, 5e-3},
                                .reads = {Quantity::stress_y, Quantity::stress_x,
                                          Quantity::shear_yz, Quantity::stress_z}});
}

/// Two cells from taxel to taxel.
inline Skin fine(std::size_t size) {
  return skin_of("fine", {.rows = size,
                          .columns = size,
                          .pitch_y = 2e-3,
                          .pitch_z = 2e-3,
                          .depths = {2e-3},
                          .reads = three_stresses});
}

inline Skin uneven(std::size_t count, double depth = 3e-3) {
  std::mt19937 generator(11);
  std::vector<Taxel> taxels;
  for (std::size_t i = 0; i < count; ++i) {
    const auto random = [&] { return static_cast<double>(generator()) / 0x1p32; };
    taxels.push_back({.y = 14e-3 * random(),
                      .z = 12e-3 * random(),
                      .depth = depth,
                      .reads = i % 3 == 0 ? std::vector{Quantity::stress_x} : three_stresses});
  }
  return skin_of("uneven", uneven_skin(taxels), {.grid = {.spacing = 2e-3}});
}

/// What a few cells press and drag, and noise of a thousandth; seed 3: noise alone.
inline std::vector<double> frame_of(const LinearProblem& problem, unsigned seed) {
  std::mt19937 generator(seed + 1);
  std::normal_distribution<double> noise;
  std::vector<double> f(problem.kernel.columns);
  if (seed != 3)
    for (double& value : f) value = generator() % 4 == 0 ? 1e4 * noise(generator) : 0.0;
  std::vector<double> readings(problem.kernel.rows);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    for (std::size_t j = 0; j < f.size(); ++j) readings[i] += problem.kernel(i, j) * f[j];
    readings[i] += 5.0 * noise(generator);
  }
  return readings;
}

}  // namespace tactile_net
