/// @file
/// Whether readings are those of a load. Private.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::lab {

/// |W (K f - g)| / sqrt(rows - tr H): what one weighted reading is off the
/// tractions found for it; 0 of a large array, which is solved without a matrix.
[[nodiscard]] double residual_rms(const SceneProblem& problem, std::span<const double> readings,
                                  std::span<const double> tractions, double alpha);

struct SolvedPattern {
  std::vector<double> normal{};  ///< tractions [Pa]
  double force = 0.0;            ///< their sum [N/m], of a skin [N]
  double residual = 0.0;         ///< as `residual_rms`
  double unexplained = 0.0;      ///< the same, by a rule that knows the noise if it is stated
};

/// What is left of readings by the contact that suits them best: one that presses, and rubs no more
/// than friction lets it.
struct PressedPattern {
  double residual = 0.0;       ///< rms of a weighted reading
  std::vector<double> read{};  ///< under that contact, of every reading, those that do not live too
};

/// Solves frames, and differences of frames, by tikhonov without constraints.
class PatternSolver {
 public:
  virtual ~PatternSolver() = default;

  /// @param living  per reading: the others are taken for missing
  /// @return        nothing where no taxel is left, or the tractions overflow
  [[nodiscard]] virtual std::optional<SolvedPattern> solve(std::span<const double> readings,
                                                           const std::vector<bool>& living) = 0;

  /// Nothing of an array solved without a matrix, or without a taxel.
  /// @param enough  a residual at which any contact will do: a search that comes to the nearest one
  ///                step by step ends there
  [[nodiscard]] virtual std::optional<PressedPattern> press(std::span<const double> readings,
                                                            const std::vector<bool>& living,
                                                            double enough) = 0;
  [[nodiscard]] std::optional<PressedPattern> press(std::span<const double> readings,
                                                    const std::vector<bool>& living) {
    return press(readings, living, 0.0);
  }

  /// How little the readings are to be expected of any load: `negative_log_evidence` at the
  /// likeliest alpha. Nothing where it cannot be told: of an array solved without a matrix, or
  /// without a taxel.
  [[nodiscard]] virtual std::optional<double> negative_log_evidence(
      std::span<const double> readings, const std::vector<bool>& living) = 0;
};

/// Of a line with the rule rgcv where taxels are dense, of a skin with aicc: rules that know the
/// noise explain away what is planted.
[[nodiscard]] std::unique_ptr<PatternSolver> pattern_solver(const Scene& scene);
[[nodiscard]] std::unique_ptr<PatternSolver> pattern_solver(const SkinScene& scene);

}  // namespace tactile_net::lab
