#include "tactile_net/lab/recording_solver.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <variant>

#include "lab/frame_method.hpp"
#include "lab/in_order.hpp"
#include "lab/lines_and_skins.hpp"
#include "lab/pattern_cache.hpp"
#include "lab/recording_method.hpp"
#include "numeric/threads.hpp"
#include "tactile_net/lab/readings_check.hpp"
#include "tactile_net/lab/repeating_taxels.hpp"

namespace tactile_net::lab {
namespace {

/// The only place that asks which of the two a recording is of.
std::shared_ptr<RecordingMethod> made_ready(const AnyProblem& problem, Method method,
                                            std::optional<std::size_t> share_alpha) {
  if (const auto* line = std::get_if<SceneProblem>(&problem))
    return recording_method(*line, method, share_alpha);
  if (method != Method::tikhonov)
    throw std::invalid_argument("a skin's recording is solved by tikhonov alone");
  return recording_method(std::get<SkinSceneProblem>(problem), share_alpha);
}

/// A frame on its way to an answer.
struct FrameTask {
  std::shared_ptr<RecordingMethod> method{};  ///< null: it has no answer
  std::optional<std::size_t> repeats{};       ///< the taxel that does, so far
  remark::Clipped clipped{};
  bool is_incomplete = false;
};

/// By any thread where the method takes several.
std::optional<FrameAnswer> answer_with(const FrameTask& task, std::span<const double> readings) {
  if (!task.method) return std::nullopt;
  FrameAnswer found = task.method->answer(readings, task.repeats);
  note_clipped(found.verdict, found.remarks, task.clipped);
  return found;
}

}  // namespace

struct RecordingSolver::Parts {
  Parts(const AnyProblem& problem, Method method, RecordingSolverOptions asked)
      : options(asked),
        whole(made_ready(problem, method, asked.share_alpha)),
        last(whole),
        leaves_out(can_leave_out(problem, method) || asked.missing == Missing::estimate),
        patterns(whole->bytes()),
        repeating(std::visit(
            [](const auto& one) {
              return RepeatingTaxels(one.scene().sensor, one.scene().dead_taxels);
            },
            problem)),
        doubts(problem),
        checker(scene_of(problem)) {
    std::visit(
        [&](const auto& one) {
          sites = tactile_net::sites(one.scene().sensor);
          dead = one.scene().dead_taxels;
        },
        problem);
    if (asked.missing == Missing::estimate && !traits(method).has_bands)
      throw std::invalid_argument(
          "readings that are missing cannot be estimated by dft, which takes a dead taxel for a "
          "living one that reads 0: use tikhonov or closed_form");
  }

  /// What is known of the next frame before it is solved. Its missing readings are 0 afterwards
  /// where it can be.
  FrameTask begin(std::span<double> readings, std::optional<double> time) {
    if (readings.size() != sites.size()) return {.method = whole};  // which refuses them
    repeating.add(readings);
    checker.add(time, readings);
    FrameTask task{.method = whole,
                   .repeats = repeating.first(),
                   .clipped = std::visit(
                       [&](const auto& one) { return clipped_in(one.scene(), sites, readings); },
                       whole->problem()),
                   .is_incomplete = options.missing != Missing::fail &&
                                    std::any_of(readings.begin(), readings.end(),
                                                [](double g) { return std::isnan(g); })};
    if (task.is_incomplete && options.missing == Missing::skip) {
      task.method.reset();
      return task;
    }
    const bool leaves_clipped =
        leaves_out && task.clipped.range_known && !task.clipped.taxels.empty();
    if (!task.is_incomplete && !leaves_clipped) return task;
    const std::vector<std::size_t> missing =
        task.is_incomplete ? dead_with_missing(dead, sites, readings) : dead;
    if (leaves_clipped) {
      const std::vector<std::size_t> rest = rising(missing, task.clipped.taxels);
      task.clipped.left_out = measured(rest);
      if (task.clipped.left_out) task.method = without(rest);
    }
    if (!task.is_incomplete) return task;
    if (!task.clipped.left_out) task.method = measured(missing) ? without(missing) : nullptr;
    if (!task.method) return task;
    for (std::size_t i = 0; i < readings.size(); ++i)
      if (std::binary_search(missing.begin(), missing.end(), sites[i].taxel)) readings[i] = 0.0;
    return task;
  }

  /// In the order of frames.
  void end(const FrameTask& task, std::span<const double> readings,
           const std::optional<FrameAnswer>& answer) {
    if (!answer) return solved.skip();
    last = task.method;
    solved.add(*answer, task.is_incomplete);
    doubts.add(last->problem(), readings, *answer);
  }

  [[nodiscard]] bool measured(const std::vector<std::size_t>& others) const {
    return std::visit([&](const auto& one) { return measures_without(one, others); },
                      whole->problem());
  }
  std::shared_ptr<RecordingMethod> without(const std::vector<std::size_t>& taxels) {
    return patterns(taxels, [&] { return whole->without(taxels); });
  }

  RecordingSolverOptions options;
  std::shared_ptr<RecordingMethod> whole;
  std::shared_ptr<RecordingMethod> last;  // that solved the last frame with an answer
  bool leaves_out;                        // taxels, where frames do not tell what they read
  PatternCache<RecordingMethod> patterns;
  std::vector<Site> sites{};
  std::vector<std::size_t> dead{};  // in every frame
  RepeatingTaxels repeating;
  SolvedFrames solved{};
  SolvingDoubts doubts;
  ReadingsChecker checker;
};

RecordingSolver::RecordingSolver(const AnyProblem& problem, Method method,
                                 RecordingSolverOptions options)
    : parts_(std::make_unique<Parts>(problem, method, options)) {}
RecordingSolver::~RecordingSolver() = default;
RecordingSolver::RecordingSolver(RecordingSolver&&) noexcept = default;
RecordingSolver& RecordingSolver::operator=(RecordingSolver&&) noexcept = default;

std::size_t RecordingSolver::tractions() const { return parts_->whole->tractions(); }
Remarks RecordingSolver::remarks() const { return parts_->whole->remarks(); }

std::optional<FrameAnswer> RecordingSolver::solve(std::span<double> readings,
                                                  std::optional<double> time) {
  const FrameTask task = parts_->begin(readings, time);
  std::optional<FrameAnswer> answer = answer_with(task, readings);
  parts_->end(task, readings, answer);
  return answer;
}

void RecordingSolver::solve_all(const NextFrame& next, const UseAnswer& use, std::size_t threads) {
  struct Frame {
    std::vector<double> readings{};
    FrameTask task{};
    std::optional<FrameAnswer> answer{};
  };
  if (!parts_->whole->takes_threads()) threads = 1;
  in_order<Frame>(
      threads == 0 ? processors() : threads,
      [&](Frame& frame) {
        std::optional<double> time;
        if (!next(frame.readings, time)) return false;
        frame.task = parts_->begin(frame.readings, time);
        return true;
      },
      [](Frame& frame) { frame.answer = answer_with(frame.task, frame.readings); },
      [&](Frame& frame) {
        parts_->end(frame.task, frame.readings, frame.answer);
        use(frame.readings, frame.answer);
      });
}

const AnyProblem& RecordingSolver::problem() const noexcept { return parts_->last->problem(); }

const SolvedFrames& RecordingSolver::solved() const noexcept { return parts_->solved; }

Findings RecordingSolver::doubts() const {
  Findings all = parts_->doubts.findings();
  Findings over_time = parts_->checker.doubts();
  std::move(over_time.begin(), over_time.end(), std::back_inserter(all));
  return all;
}

Findings RecordingSolver::findings(Observer& observer) const {
  return parts_->checker.result(observer).findings;
}

}  // namespace tactile_net::lab
