/// @file
/// Whether readings are those of a load. Private.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tactile_net/lab/missing.hpp"
#include "tactile_net/lab/scene_problem.hpp"

namespace tactile_net::lab {

/// |W (K f - g)| / sqrt(rows - tr H): what one weighted reading is off the tractions found for it;
/// 0 of a large array, which is solved without a matrix.
[[nodiscard]] double residual_rms(const SceneProblem& problem, std::span<const double> readings,
                                  std::span<const double> tractions, double alpha);

struct SolvedPattern {
  std::vector<double> tractions{};  ///< [Pa]
  double residual = 0.0;            ///< as `residual_rms`
};

/// Solves frames, and differences of frames, by tikhonov with the rule rgcv, without constraints.
class PatternSolver {
 public:
  explicit PatternSolver(const Scene& scene);

  /// @param living  per reading: the others are taken for missing
  /// @return        nothing where no taxel is left, or the tractions overflow
  [[nodiscard]] std::optional<SolvedPattern> solve(std::span<const double> readings,
                                                   const std::vector<bool>& living);

  [[nodiscard]] const Scene& scene() const noexcept { return problem_.scene(); }

 private:
  SceneProblem problem_;
  IncompleteFrames frames_;
};

/// What channels' readings are multiplied by to have one unit: 1 over the noise where the scene
/// states it for each quantity, else 1.
[[nodiscard]] std::vector<double> channel_weights(const Scene& scene);

/// The same, one for each reading.
[[nodiscard]] std::vector<double> reading_weights(const Scene& scene);

}  // namespace tactile_net::lab
