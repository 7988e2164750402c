/// @file
/// A small skin that can be solved without a matrix too, and the answers beside each other.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <variant>

#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/euclidean.hpp"

namespace tactile_net {

inline SkinScene millimetre_skin(const std::string& more = "",
                                 const std::string& taxels = "rows = 12\ncolumns = 11") {
  const std::string toml =
      "[sensor]\n" + taxels +
      "\npitch = 1e-3\ndepth = 2e-3\n"
      "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
      "[material]\nyoungs_modulus = 2e5\npoisson_ratio = 0.45\n"
      "[[contact]]\nshape = \"sphere\"\nplace = [0.8e-3, -0.9e-3]\nradius = 2e-3\nforce = 0.5\n"
      "friction = 0.4\ndirection = 30.0\n[noise]\nrms = 100.0\n";
  return std::get<SkinScene>(parse_any_scene(toml + more, "skin.toml"));
}

inline void check_like(const Uncertain& found, const Uncertain& expected) {
  CAPTURE(found.value, found.deviation, expected.value, expected.deviation);
  CHECK(std::abs(found.value - expected.value) < 0.1 * expected.deviation);
  CHECK_THAT(found.deviation, WithinRel(expected.deviation, 0.05));
}

inline void check_like(const std::optional<Uncertain>& found,
                       const std::optional<Uncertain>& expected) {
  REQUIRE(found.has_value() == expected.has_value());
  if (found) check_like(*found, *expected);
}

/// Everything large: no traction is solved for with a matrix.
inline lab::SkinSceneProblem without_matrix(const SkinScene& scene) {
  return lab::SkinSceneProblem(scene, 0);
}

}  // namespace tactile_net
