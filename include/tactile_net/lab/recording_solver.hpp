/// @file
/// Frame after frame of a recording, solved and judged: what every front end does with readings,
/// wherever they come from.
///
///     lab::RecordingSolver solver(problem, Method::tikhonov);
///     std::vector<double> f(solver.tractions());
///     while (source.next(readings))
///       if (const auto result = solver.solve(readings, f, source.seconds())) use(f, *result);
///     for (const lab::Finding& one : solver.findings())
///     puts(report::in_words(one, scene).c_str());
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/lab/finding.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/missing.hpp"
#include "tactile_net/lab/readings_check.hpp"
#include "tactile_net/lab/repeating_taxels.hpp"
#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/lab/summary.hpp"
#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net::lab {

struct RecordingSolverOptions {
  Missing missing = Missing::fail;
  /// Of how many frames that follow one another a rule chooses alpha together, >= 1; absent: as
  /// `make_solver`.
  std::optional<std::size_t> share_alpha{};
};

/// Remembers what frames before have shown. Not thread-safe.
class RecordingSolver {
 public:
  /// @throw std::invalid_argument, std::domain_error  as `make_solver`, `make_sharing_solver` and
  ///                                                  `IncompleteFrames`
  RecordingSolver(SceneProblem problem, Method method, RecordingSolverOptions options = {});

  [[nodiscard]] std::size_t tractions() const { return solver_->tractions(); }
  /// What holds before any frame.
  [[nodiscard]] Remarks remarks() const { return solver_->remarks(); }

  /// The next frame, with the verdict of its readings. Taxels at the end of a range that the scene
  /// states are left out, by methods that can (clipped_taxels.hpp).
  ///
  /// @param readings   channels x count; where values may be missing NaN is one; 0 afterwards of
  ///                   taxels that are left out
  /// @param tractions  `tractions()` values [Pa]; untouched unless there is an answer
  /// @param time       [s], where the frame has one: what is found suspicious, not what is answered
  /// @return  absent: values are missing, and the frame has no answer. A status that is not ok: the
  ///          frame is bad, and does not count
  [[nodiscard]] std::optional<FrameResult> solve(std::span<double> readings,
                                                 std::span<double> tractions,
                                                 std::optional<double> time = std::nullopt);

  /// That the last frame with an answer was solved with: the recording's, or one with taxels left
  /// out.
  [[nodiscard]] const SceneProblem& problem() const noexcept;

  [[nodiscard]] const SolvedFrames& solved() const noexcept { return solved_; }
  /// What is suspicious about the readings so far, as far as answers and frames tell it without
  /// solving any other: `SolvingDoubts` and `ReadingsChecker::doubts`.
  [[nodiscard]] Findings doubts() const;
  /// All that is suspicious about the frames so far, as they were recorded:
  /// `ReadingsChecker::result`, which solves some of them.
  [[nodiscard]] Findings findings(Observer& observer = silent) const {
    return checker_.result(observer).findings;
  }

 private:
  /// What solves a frame without the taxels that miss readings or are clipped, whose readings are 0
  /// afterwards. Absent: no taxel is left.
  std::optional<IncompleteFrames::Rest> without(std::span<double> readings,
                                                const remark::Clipped& clipped);

  SceneProblem problem_;
  Method method_;
  std::vector<Site> sites_;
  Missing missing_;
  std::unique_ptr<FrameSolver> solver_;
  std::unique_ptr<IncompleteFrames> incomplete_;  // where taxels may be left out
  RepeatingTaxels repeating_;
  DataMemory memory_{};  // of `problem_`
  SolvedFrames solved_{};
  SolvingDoubts doubts_;
  ReadingsChecker checker_;
  bool was_incomplete_ = false;
};

}  // namespace tactile_net::lab
