/// @file
/// Frame after frame of a skin's recording, solved: what `RecordingSolver` is for lines.
///
///     lab::SkinRecordingSolver solver(problem, {.missing = lab::Missing::estimate});
///     while (source.next(readings))
///       if (const auto answer = solver.solve(readings)) use(*answer);
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/skin_answer.hpp"
#include "tactile_net/lab/summary.hpp"

namespace tactile_net::lab {

/// Remembers what frames before have shown. Not thread-safe.
class SkinRecordingSolver {
 public:
  /// @throw std::invalid_argument  frames are to share an alpha, and the scene gives one, or 0
  ///                               frames share it
  explicit SkinRecordingSolver(SkinSceneProblem problem, RecordingSolverOptions options = {});
  ~SkinRecordingSolver();
  SkinRecordingSolver(SkinRecordingSolver&&) noexcept;
  SkinRecordingSolver& operator=(SkinRecordingSolver&&) noexcept;

  /// The next frame. One that misses readings is solved without their taxels, as if they were dead
  /// in it, or has no answer: as the options say.
  ///
  /// @param readings  where values may be missing NaN is one, and 0 afterwards
  /// @return          absent: values are missing, and the frame has no answer
  /// @throw           as `solve` of a frame
  [[nodiscard]] std::optional<SkinAnswer> solve(std::span<double> readings);

  /// That the last frame with an answer was solved with: the recording's, or one with taxels left
  /// out.
  [[nodiscard]] const SkinSceneProblem& problem() const noexcept;

  [[nodiscard]] const SolvedFrames& solved() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tactile_net::lab
