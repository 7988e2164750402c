/// @file
/// Frame after frame of a line's or a skin's recording, solved and judged: what every front end
/// does with readings, wherever they come from.
///
///     lab::RecordingSolver solver(problem, Method::tikhonov);
///     while (source.next(readings))
///       if (const auto answer = solver.solve(readings, source.seconds())) use(*answer);
///     // or, of a skin on every processor
///     solver.solve_all(next, use);
///     for (const lab::Finding& one : solver.findings())
///       puts(report::in_words(one, scene).c_str());
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/finding.hpp"
#include "tactile_net/lab/missing.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/summary.hpp"

namespace tactile_net::lab {

struct RecordingSolverOptions {
  Missing missing = Missing::fail;
  /// Of how many frames that follow one another a rule chooses alpha together, >= 1; absent: of
  /// each frame alone.
  std::optional<std::size_t> share_alpha{};
};

/// Remembers what frames before have shown. Not thread-safe.
class RecordingSolver {
 public:
  /// @param problem  of a skin: the method is tikhonov
  /// @throw std::invalid_argument, std::domain_error  as `make_solver` and `make_sharing_solver`;
  ///                  readings are to be estimated by a method that takes a dead taxel for a living
  ///                  one; a skin has no other method
  explicit RecordingSolver(const AnyProblem& problem, Method method = Method::tikhonov,
                           RecordingSolverOptions options = {});
  ~RecordingSolver();
  RecordingSolver(RecordingSolver&&) noexcept;
  RecordingSolver& operator=(RecordingSolver&&) noexcept;

  /// How many a frame has.
  [[nodiscard]] std::size_t tractions() const;
  /// What holds before any frame.
  [[nodiscard]] Remarks remarks() const;

  /// The next frame, with the verdict of its readings. Without the taxels at the end of a range
  /// that the scene states, by methods that can leave some out (clipped_taxels.hpp); without those
  /// whose readings are missing, as if they were dead in it, or without an answer: as the options
  /// say.
  ///
  /// @param readings  channels x count; where values may be missing NaN is one, and 0 afterwards
  ///                  where there is an answer
  /// @param time      [s], where the frame has one: what is found suspicious, not what is answered
  /// @return  absent: values are missing, and the frame has no answer. Of a line it is without
  ///          bands, which take many times as long: `with_bands`
  /// @throw   as `solve` of a frame; the frame does not count
  [[nodiscard]] std::optional<FrameAnswer> solve(std::span<double> readings,
                                                 std::optional<double> time = std::nullopt);

  /// The next frame's readings, and its time where it has one; false: there is none.
  using NextFrame = std::function<bool(std::vector<double>& readings, std::optional<double>& time)>;
  /// As `solve` leaves the readings, and what it returns.
  using UseAnswer = std::function<void(std::span<const double> readings,
                                       const std::optional<FrameAnswer>& answer)>;

  /// All frames that follow: `while (next(readings, time)) use(readings, solve(readings, time))`,
  /// several of them at a time on a thread each, and the same bits and order however many there
  /// are. A few frames are read ahead. Frames of a line, whose problem is made as frames ask for
  /// it, those that share an alpha, and those of a large skin are solved one by one.
  ///
  /// @param next, use  are called by this thread alone
  /// @param threads    at most so many; 1: none but this one, which reads nothing ahead; 0: one a
  ///                   processor
  /// @throw            as `solve`, of the first frame that throws, after all before it are used; or
  ///                   what `next` or `use` throws
  void solve_all(const NextFrame& next, const UseAnswer& use, std::size_t threads = 0);

  /// That the last frame with an answer was solved with, within `use` that frame's: the
  /// recording's, or one with taxels left out.
  [[nodiscard]] const AnyProblem& problem() const noexcept;

  [[nodiscard]] const SolvedFrames& solved() const noexcept;
  /// What is suspicious about the readings so far, as far as answers and frames tell it without
  /// solving any other: `SolvingDoubts` and `ReadingsChecker::doubts`.
  [[nodiscard]] Findings doubts() const;
  /// All that is suspicious about the frames so far, as they were recorded:
  /// `ReadingsChecker::result`, which solves some of them.
  [[nodiscard]] Findings findings(Observer& observer = silent) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tactile_net::lab
