#include "tactile_net/lab/skin_recording_solver.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lab/in_order.hpp"
#include "lab/pattern_cache.hpp"
#include "numeric/threads.hpp"
#include "tactile_net/inverse/shared_alpha.hpp"

namespace tactile_net::lab {
struct SkinRecordingSolver::Parts {
  Parts(SkinSceneProblem given, RecordingSolverOptions asked)
      : problem(std::move(given)),
        options(asked),
        patterns(problem.bytes()),
        checker(problem.scene()) {
    if (options.share_alpha && problem.scene().reconstruct.alpha)
      throw std::invalid_argument(
          "frames share an alpha that a rule chooses, and this scene gives one");
    if (options.share_alpha && problem.estimates_weight())
      throw std::invalid_argument(
          "frames share an alpha of one functional, and here each has a tangential_weight of its "
          "own: state it");
    if (options.share_alpha == std::size_t{0})
      throw std::invalid_argument("an alpha is shared by at least one frame");
  }

  SkinAnswer solve_whole(std::span<const double> readings) {
    if (!options.share_alpha) return lab::solve(problem, readings);
    return lab::solve(problem, readings, [&](const FilterFrame& frame) {
      if (!shared)
        shared.emplace(AlphaTables(frame.gamma, frame.rows, frame.shares),
                       problem.alpha_rule(frame), *options.share_alpha, problem.stated_noise());
      return shared->push(frame);
    });
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
  void count(const std::optional<SkinAnswer>& answer, bool incomplete) {
    if (answer)
      solved.add({.alpha = answer->alpha, .verdict = answer->verdict, .data = answer->data},
                 incomplete);
    else
      solved.skip();
  }

  /// Frames that share an alpha depend on one another, and large skins keep what the last frame
  /// needed.
  [[nodiscard]] bool one_by_one() const { return options.share_alpha || problem.is_large(); }

  SkinSceneProblem problem;
  RecordingSolverOptions options;
  PatternCache<SkinSceneProblem> patterns;
  std::optional<SharedAlpha> shared{};
  std::optional<SkinSceneProblem> last{};  // absent: the recording's
  SolvedFrames solved{};
  ReadingsChecker checker;
};

SkinRecordingSolver::SkinRecordingSolver(SkinSceneProblem problem, RecordingSolverOptions options)
    : parts_(std::make_unique<Parts>(std::move(problem), options)) {}
SkinRecordingSolver::~SkinRecordingSolver() = default;
SkinRecordingSolver::SkinRecordingSolver(SkinRecordingSolver&&) noexcept = default;
SkinRecordingSolver& SkinRecordingSolver::operator=(SkinRecordingSolver&&) noexcept = default;

std::optional<SkinAnswer> SkinRecordingSolver::solve(std::span<double> readings,
                                                     std::optional<double> time) {
  Parts& p = *parts_;
  p.checker.add(time, readings);
  const bool incomplete = p.is_incomplete(readings);
  std::optional<SkinAnswer> answer;
  if (!incomplete) {
    p.last.reset();
    answer = p.solve_whole(readings);
  } else if (p.options.missing == Missing::estimate) {
    if (std::optional<SkinSceneProblem> rest = p.rest(readings)) {
      p.last = std::move(rest);
      answer = lab::solve(*p.last, readings);
    }
  }
  p.count(answer, incomplete);
  return answer;
}

void SkinRecordingSolver::solve_all(const NextFrame& next, const UseAnswer& use,
                                    std::size_t threads) {
  struct Frame {
    std::vector<double> readings{};
    bool incomplete = false;
    std::optional<SkinSceneProblem> solved_with{};  // absent: the frame has no answer
    std::optional<SkinAnswer> answer{};
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
        p.checker.add(time, frame.readings);
        frame.incomplete = p.is_incomplete(frame.readings);
        if (!frame.incomplete)
          frame.solved_with = p.problem;
        else if (p.options.missing == Missing::estimate)
          frame.solved_with = p.rest(frame.readings);
        return true;
      },
      [](Frame& frame) {
        if (frame.solved_with) frame.answer = lab::solve(*frame.solved_with, frame.readings);
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
