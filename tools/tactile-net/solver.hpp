/// @file
/// A scene's reconstruction methods, made ready: from a scene's words to the library's calls.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/inverse/dft.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::tool {

/// The inverse problem a scene describes: its K, weights and smoothing length.
[[nodiscard]] InverseProblem problem_of(const Scene& scene);

/// The scene's alpha. @throw InputError  the scene has none
[[nodiscard]] double alpha_of(const Scene& scene);

/// What a method of one frame needs, after the part that may throw and take long.
struct Solver {
  std::variant<Reconstruction, DftInverse> inverse;
  std::optional<double> alpha{};  ///< empty: the method has none
  std::string verdict = "ok";
  double condition = 0.0;  ///< of the system; for dft the noise gain
  std::vector<std::string> warnings{};

  Status solve(std::span<const double> readings, std::span<double> tractions) noexcept;
};

/// @param method  dft, tikhonov or closed_form
/// @throw InputError             alpha is missing
/// @throw std::invalid_argument  the method cannot take this scene
/// @throw std::domain_error      its answer would be noise
[[nodiscard]] Solver make_solver(const Scene& scene, Method method);

}  // namespace tactile_net::tool
