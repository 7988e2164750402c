#include "tactile_net/lab/skin_answer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "tactile_net/skin/covariance.hpp"

namespace tactile_net::lab {
namespace {

/// |W (K f - g)|
double residual_of(const SkinProblem& problem, std::span<const double> readings,
                   std::span<const double> tractions) {
  const std::vector<double> explained = weighted(problem, readings);
  double size = 0.0;
  for (std::size_t i = 0; i < explained.size(); ++i) {
    if (problem.weights[i] == 0.0) continue;
    const std::span<const double> row = problem.kernel.row(i);
    size = std::hypot(size,
                      std::inner_product(row.begin(), row.end(), tractions.begin(), -explained[i]));
  }
  return size;
}

ChosenAlpha alpha_of(const SkinSceneProblem& problem, const FilterFrame& frame) {
  if (const auto& given = problem.scene().reconstruct.alpha) return {.value = *given};
  const AlphaChoice choice = choose_alone(frame, problem.alpha_tables(frame),
                                          problem.alpha_rule(frame), problem.stated_noise());
  const double alpha =
      problem.constraints() ? constrained_alpha(choice.rule, choice.alpha) : choice.alpha;
  return {.value = alpha, .rule = choice.rule, .verdict = choice.verdict};
}

void judge(SkinAnswer& answer, const SkinSceneProblem& problem, const FilterFrame& frame,
           std::span<const double> readings) {
  const double left = residual_of(problem.problem(), readings, answer.tractions);
  answer.noise =
      estimate_noise(left, frame.rows, answer.degrees_of_freedom, problem.stated_noise());
  const std::vector<double> none(answer.tractions.size());
  const double all = residual_of(problem.problem(), readings, none);
  if (all > 0.0 && left > 0.5 * all) {
    if (answer.verdict == Verdict::ok) answer.verdict = Verdict::oversmoothed;
    answer.remarks.emplace_back(remark::Unexplained{left / all});
  }
  if (answer.noise.model_rms > 0.0)
    answer.remarks.emplace_back(
        remark::ModelError{.times = answer.noise.model_rms / *answer.noise.stated_rms});
}

/// Of the prior that sizes the bands: gml's alpha, or where it has no verdict the tractions' own.
double prior_of(const SkinSceneProblem& problem, const FilterFrame& frame, double alpha) {
  const bool known = problem.alpha_rule(frame) == AlphaRule::evidence;
  const AlphaChoice prior =
      choose_alone(frame, problem.alpha_tables(frame), known ? AlphaRule::evidence : AlphaRule::gml,
                   problem.stated_noise());
  return prior.verdict == AlphaVerdict::ok ? prior.alpha : alpha;
}

/// Bands, the cells that touch, and what the tractions amount to. Under constraints the bands are
/// those of what the readings say without them: they hold what the constraints have moved.
void add_bands(SkinAnswer& answer, const SkinSceneProblem& problem, const FilterFrame& frame) {
  const SkinGrid& grid = problem.grid();
  const double alpha = answer.alpha.value;
  const double rms = answer.noise.rms();
  const SkinCovariance covariance(problem.family(), alpha, prior_of(problem, frame, alpha));
  answer.deviations = covariance.deviations();
  for (double& deviation : answer.deviations) deviation *= rms;
  const std::span<const double> f = answer.tractions;
  answer.cells = contact_cells(grid, f, answer.deviations, least_depth(problem.scene().sensor));
  answer.wrench = resultant_of(grid, f, answer.cells, covariance, rms);
  answer.friction = friction_of(grid, f, answer.cells, covariance, rms,
                                problem.scene().reconstruct.friction_limit);
  const auto apart = separate_contacts(grid, f, answer.cells);
  answer.contacts = apart.size();
  if (!apart.empty()) answer.ellipse = contact_ellipse(grid, f, apart.front(), covariance, rms);
}

}  // namespace

std::span<const double> component(std::span<const double> values, const SkinGrid& grid,
                                  SkinTraction which) {
  const std::size_t first = static_cast<std::size_t>(which) * grid.count();
  return first < values.size() ? values.subspan(first, grid.count()) : std::span<const double>{};
}

SkinAnswer solve(const SkinSceneProblem& problem, std::span<const double> readings) {
  const FilterFrame frame = problem.family().analyse(readings);
  SkinAnswer answer{.alpha = alpha_of(problem, frame)};
  answer.verdict = verdict_of(answer.alpha.verdict);
  answer.condition = problem.family().stacked_condition(answer.alpha.value);
  answer.degrees_of_freedom = problem.family().degrees_of_freedom(answer.alpha.value);
  if (problem.constraints()) {
    answer.cone = problem.cone(answer.alpha.value).solve(readings);
    if (answer.cone->status != FrameStatus::ok)
      throw std::domain_error("the frame's tractions overflow a double; scale the readings");
    answer.tractions = answer.cone->tractions;
    if (answer.cone->verdict == ConstrainedVerdict::iteration_limit) {
      answer.verdict = Verdict::iteration_limit;
      answer.remarks.emplace_back(remark::IterationLimit{answer.cone->iterations});
    }
  } else {
    answer.tractions = problem.family().solve(frame, answer.alpha.value);
  }
  judge(answer, problem, frame, readings);
  add_bands(answer, problem, frame);
  return answer;
}

}  // namespace tactile_net::lab
