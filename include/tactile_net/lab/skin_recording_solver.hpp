/// @file
/// Frame after frame of a skin's recording, solved: what `RecordingSolver` is for lines.
///
///     lab::SkinRecordingSolver solver(problem, {.missing = lab::Missing::estimate});
///     while (source.next(readings))
///       if (const auto answer = solver.solve(readings, source.seconds())) use(*answer);
///     // or, on every processor
///     solver.solve_all(next, use);
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/recording_solver.hpp"
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
  /// @param time      [s], where the frame has one: what is found suspicious, not what is answered
  /// @return          absent: values are missing, and the frame has no answer
  /// @throw           as `solve` of a frame
  [[nodiscard]] std::optional<FrameAnswer> solve(std::span<double> readings,
                                                 std::optional<double> time = std::nullopt);

  /// The next frame's readings, and its time where it has one; false: there is none.
  using NextFrame = std::function<bool(std::vector<double>& readings, std::optional<double>& time)>;
  /// As `solve` leaves the readings, and what it returns.
  using UseAnswer = std::function<void(std::span<const double> readings,
                                       const std::optional<FrameAnswer>& answer)>;

  /// All frames that follow: `while (next(readings, time)) use(readings, solve(readings, time))`,
  /// several of them at a time on a thread each, and the same bits and order however many there
  /// are. A few frames are read ahead. Frames that share an alpha, and those of a large skin, are
  /// solved one by one.
  ///
  /// @param next, use  are called by this thread alone
  /// @param threads    at most so many; 1: none but this one, which reads nothing ahead; 0: one a
  ///                   processor
  /// @throw            as `solve`, of the first frame that throws, after all before it are used; or
  ///                   what `next` or `use` throws
  void solve_all(const NextFrame& next, const UseAnswer& use, std::size_t threads = 0);

  /// That the last frame with an answer was solved with: the recording's, or one with taxels left
  /// out.
  [[nodiscard]] const SkinSceneProblem& problem() const noexcept;

  [[nodiscard]] const SolvedFrames& solved() const noexcept;
  /// What is suspicious about the readings so far, as `ReadingsChecker::doubts` tells it.
  [[nodiscard]] Findings doubts() const;
  /// All that is suspicious about the frames so far, as they were recorded:
  /// `ReadingsChecker::result`, which solves some of them.
  [[nodiscard]] Findings findings(Observer& observer = silent) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tactile_net::lab
