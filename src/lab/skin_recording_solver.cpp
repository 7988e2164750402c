#include "tactile_net/lab/skin_recording_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lab/frame_sharing.hpp"
#include "lab/in_order.hpp"
#include "lab/pattern_cache.hpp"
#include "numeric/threads.hpp"
#include "tactile_net/lab/repeating_taxels.hpp"

namespace tactile_net::lab {
struct SkinRecordingSolver::Parts {
  Parts(SkinSceneProblem given, RecordingSolverOptions asked)
      : problem(std::move(given)),
        options(asked),
        patterns(problem.bytes()),
        repeating(problem.scene().sensor, problem.scene().dead_taxels),
        checker(problem.scene()) {
    if (options.share_alpha) sharing.emplace(problem, *options.share_alpha);
  }

  FrameAnswer solve_whole(std::span<const double> readings) {
    if (!sharing) return lab::solve(problem, readings, {}, repeating.first());
    const auto choose = [&](const FilterFrame& frame) { return sharing->push(problem, frame); };
    return lab::solve(problem, readings, choose, repeating.first());
  }

  /// The problem without the taxels that miss readings, which are 0 afterwards. Absent: no taxel is
  /// left.
  std::optional<SkinSceneProblem> rest(std::span<double> readings) {
    const SkinScene& scene = problem.scene();
    const std::vector<Site>& sites = problem.layout().sites;
    const std::vector<std::size_t> dead = dead_with_missing(scene.dead_taxels, sites, readings);
    if (!is_measured(scene.sensor, dead, scene.reconstruct.offset)) return std::nullopt;
    for (std::size_t i = 0; i < readings.size(); ++i)
      if (std::binary_search(dead.begin(), dead.end(), sites[i].taxel)) readings[i] = 0.0;
    return patterns(dead,
                    [&] { return std::make_unique<SkinSceneProblem>(problem.without(dead)); });
  }

  [[nodiscard]] bool is_incomplete(std::span<const double> readings) const {
    return options.missing != Missing::fail &&
           std::any_of(readings.begin(), readings.end(), [](double g) { return std::isnan(g); });
  }

  /// In the order of frames.
  void count(const std::optional<FrameAnswer>& answer, bool incomplete) {
    if (answer)
      solved.add({.alpha = answer->alpha, .verdict = answer->verdict, .data = answer->data},
                 incomplete);
    else
      solved.skip();
  }

  /// Frames that share an alpha depend on one another, and large skins keep what the last frame
  /// needed.
  [[nodiscard]] bool one_by_one() const { return sharing || problem.is_large(); }

  SkinSceneProblem problem;
  RecordingSolverOptions options;
  PatternCache<SkinSceneProblem> patterns;
  std::optional<FrameSharing> sharing{};
  std::optional<SkinSceneProblem> last{};  // absent: the recording's
  SolvedFrames solved{};
  RepeatingTaxels repeating;
  ReadingsChecker checker;
};

SkinRecordingSolver::SkinRecordingSolver(SkinSceneProblem problem, RecordingSolverOptions options)
    : parts_(std::make_unique<Parts>(std::move(problem), options)) {}
SkinRecordingSolver::~SkinRecordingSolver() = default;
SkinRecordingSolver::SkinRecordingSolver(SkinRecordingSolver&&) noexcept = default;
SkinRecordingSolver& SkinRecordingSolver::operator=(SkinRecordingSolver&&) noexcept = default;

std::optional<FrameAnswer> SkinRecordingSolver::solve(std::span<double> readings,
                                                      std::optional<double> time) {
  Parts& p = *parts_;
  p.repeating.add(readings);
  p.checker.add(time, readings);
  const bool incomplete = p.is_incomplete(readings);
  std::optional<FrameAnswer> answer;
  if (!incomplete) {
    p.last.reset();
    answer = p.solve_whole(readings);
  } else if (p.options.missing == Missing::estimate) {
    if (std::optional<SkinSceneProblem> rest = p.rest(readings)) {
      p.last = std::move(rest);
      answer = lab::solve(*p.last, readings, {}, p.repeating.first());
    }
  }
  p.count(answer, incomplete);
  return answer;
}

void SkinRecordingSolver::solve_all(const NextFrame& next, const UseAnswer& use,
                                    std::size_t threads) {
  struct Frame {
    std::vector<double> readings{};
    std::optional<std::size_t> repeats{};  // the taxel that does, so far
    bool incomplete = false;
    std::optional<SkinSceneProblem> solved_with{};  // absent: the frame has no answer
    std::optional<FrameAnswer> answer{};
  };
  Parts& p = *parts_;
  if (p.one_by_one()) {
    std::vector<double> readings;
    for (std::optional<double> time; next(readings, time); time.reset())
      use(readings, solve(readings, time));
    return;
  }
  in_order<Frame>(
      threads == 0 ? processors() : threads,
      [&](Frame& frame) {
        std::optional<double> time;
        if (!next(frame.readings, time)) return false;
        p.repeating.add(frame.readings);
        frame.repeats = p.repeating.first();
        p.checker.add(time, frame.readings);
        frame.incomplete = p.is_incomplete(frame.readings);
        if (!frame.incomplete)
          frame.solved_with = p.problem;
        else if (p.options.missing == Missing::estimate)
          frame.solved_with = p.rest(frame.readings);
        return true;
      },
      [](Frame& frame) {
        if (frame.solved_with)
          frame.answer = lab::solve(*frame.solved_with, frame.readings, {}, frame.repeats);
      },
      [&](Frame& frame) {
        if (frame.answer) p.last = frame.incomplete ? std::move(frame.solved_with) : std::nullopt;
        p.count(frame.answer, frame.incomplete);
        use(frame.readings, frame.answer);
      });
}

const SkinSceneProblem& SkinRecordingSolver::problem() const noexcept {
  return parts_->last ? *parts_->last : parts_->problem;
}

const SolvedFrames& SkinRecordingSolver::solved() const noexcept { return parts_->solved; }

Findings SkinRecordingSolver::doubts() const { return parts_->checker.doubts(); }

Findings SkinRecordingSolver::findings(Observer& observer) const {
  return parts_->checker.result(observer).findings;
}

}  // namespace tactile_net::lab
