#include "tactile_net/lab/skin_recording_solver.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lab/pattern_cache.hpp"
#include "tactile_net/inverse/shared_alpha.hpp"

namespace tactile_net::lab {
struct SkinRecordingSolver::Parts {
  Parts(SkinSceneProblem given, RecordingSolverOptions asked)
      : problem(std::move(given)), options(asked), patterns(problem.bytes()) {
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
        shared.emplace(AlphaTables(frame.gamma, frame.rows, frame.shares), problem.alpha_rule(),
                       *options.share_alpha, problem.stated_noise());
      return shared->push(frame);
    });
  }

  /// Absent: no taxel is left.
  std::optional<SkinAnswer> solve_rest(std::span<double> readings) {
    const SkinScene& scene = problem.scene();
    const std::vector<SkinSite>& sites = problem.layout().sites;
    const std::vector<std::size_t> dead = dead_with_missing(scene.dead_taxels, sites, readings);
    if (!is_measured(scene.sensor, dead, scene.reconstruct.offset)) return std::nullopt;
    for (std::size_t i = 0; i < readings.size(); ++i)
      if (std::binary_search(dead.begin(), dead.end(), sites[i].taxel)) readings[i] = 0.0;
    last =
        &patterns(dead, [&] { return std::make_unique<SkinSceneProblem>(problem.without(dead)); });
    return lab::solve(*last, readings);
  }

  SkinSceneProblem problem;
  RecordingSolverOptions options;
  PatternCache<SkinSceneProblem> patterns;
  std::optional<SharedAlpha> shared{};
  const SkinSceneProblem* last = nullptr;  // absent: the recording's
  SolvedFrames solved{};
};

SkinRecordingSolver::SkinRecordingSolver(SkinSceneProblem problem, RecordingSolverOptions options)
    : parts_(std::make_unique<Parts>(std::move(problem), options)) {}
SkinRecordingSolver::~SkinRecordingSolver() = default;
SkinRecordingSolver::SkinRecordingSolver(SkinRecordingSolver&&) noexcept = default;
SkinRecordingSolver& SkinRecordingSolver::operator=(SkinRecordingSolver&&) noexcept = default;

std::optional<SkinAnswer> SkinRecordingSolver::solve(std::span<double> readings) {
  Parts& p = *parts_;
  const bool incomplete =
      p.options.missing != Missing::fail &&
      std::any_of(readings.begin(), readings.end(), [](double g) { return std::isnan(g); });
  std::optional<SkinAnswer> answer;
  if (!incomplete) {
    p.last = nullptr;
    answer = p.solve_whole(readings);
  } else if (p.options.missing == Missing::estimate) {
    answer = p.solve_rest(readings);
  }
  if (answer)
    p.solved.add({.alpha = answer->alpha, .verdict = answer->verdict, .data = answer->data},
                 incomplete);
  else
    p.solved.skip();
  return answer;
}

const SkinSceneProblem& SkinRecordingSolver::problem() const noexcept {
  return parts_->last == nullptr ? parts_->problem : *parts_->last;
}

const SolvedFrames& SkinRecordingSolver::solved() const noexcept { return parts_->solved; }

}  // namespace tactile_net::lab
