/// @file
/// A frame of contacts that drag, and its problem.
#pragma once

#include <random>
#include <vector>

#include "tests/skin/skins.hpp"

namespace tactile_net {

struct SkinFrame {
  LinearProblem problem;
  std::vector<double> readings;
};

/// Of a skin of `count` by `count` taxels, with 1 % noise.
inline SkinFrame dragged_frame(std::size_t count, unsigned seed,
                               const SkinProblemOptions& options = {}) {
  const SkinArray skin = square_skin(count, 2e-3);
  SkinFrame frame{make_problem(skin, silicone, options), {}};
  std::mt19937 random(seed);
  frame.readings =
      exact_readings(skin, silicone, random_contacts(random, 0.5e-3 * static_cast<double>(count)));
  (void)add_noise(frame.readings, 0.01, random);
  return frame;
}

}  // namespace tactile_net
