/// @file
/// Frames in which readings are missing.
///
///     lab::IncompleteFrames solver(problem, Method::tikhonov);
///     const lab::FrameResult result = solver.solve(readings, f);  // NaN: missing
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/scene_problem.hpp"

namespace tactile_net::lab {

/// What becomes of a frame in which a reading is missing.
enum class Missing {
  fail,      ///< the recording is refused
  skip,      ///< it gets no answer
  estimate,  ///< it is solved from the taxels that it has
};

[[nodiscard]] std::string_view name(Missing missing) noexcept;
[[nodiscard]] std::optional<Missing> missing_named(std::string_view name) noexcept;

/// Whether frames can be solved without some taxels: a method that knows dead ones, of an array
/// that has a matrix.
[[nodiscard]] bool can_leave_out(const SceneProblem& problem, Method method);

/// Solves each frame from the taxels whose readings are all there: a taxel that misses one is dead
/// in that frame, with all its channels, and the answer is that of the scene with these taxels
/// under [dead_taxels] too. What a pattern of missing taxels needs is made once and kept, in
/// 64 MiB for all patterns, the latest ones first. Not thread-safe.
class IncompleteFrames {
 public:
  /// @throw std::invalid_argument  as `make_solver`; the method takes a dead taxel for a living one
  IncompleteFrames(SceneProblem problem, Method method);
  ~IncompleteFrames();
  IncompleteFrames(const IncompleteFrames&) = delete;
  IncompleteFrames& operator=(const IncompleteFrames&) = delete;

  /// @param readings   channels x count; NaN: missing, and 0 afterwards
  /// @param tractions  as `FrameSolver::solve`
  /// @return           absent: no taxel is left
  [[nodiscard]] std::optional<FrameResult> solve(std::span<double> readings,
                                                 std::span<double> tractions);

  /// What solves a frame of which some taxels are missing.
  struct Rest {
    const SceneProblem& problem;
    FrameSolver& solver;
  };
  /// @param readings  as above
  /// @return          absent: no taxel is left
  [[nodiscard]] std::optional<Rest> rest(std::span<double> readings);

  /// The problem that the last frame was solved with.
  [[nodiscard]] const SceneProblem& problem() const noexcept;
  /// How many patterns are kept.
  [[nodiscard]] std::size_t kept() const noexcept;
  /// And how many may be.
  [[nodiscard]] std::size_t most_kept() const noexcept;

 private:
  struct Pattern;
  struct Patterns;

  SceneProblem problem_;
  Method method_;
  std::unique_ptr<Patterns> patterns_;
  const Pattern* last_ = nullptr;
};

}  // namespace tactile_net::lab
