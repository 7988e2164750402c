#include "tactile_net/lab/skin_answer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "lab/border.hpp"
#include "lab/large_skin.hpp"
#include "lab/lines_and_skins.hpp"
#include "lab/skin_bands.hpp"
#include "lab/skin_data_verdict.hpp"
#include "lab/skin_method.hpp"
#include "tactile_net/inverse/error_bound.hpp"
#include "tactile_net/lab/skin_sight.hpp"
#include "tactile_net/scene/clipped_taxels.hpp"

namespace tactile_net::lab {
namespace {

ChosenAlpha alpha_of(const SkinSceneProblem& problem, const FilterFrame& frame,
                     const SkinAlphaChooser& choose) {
  if (const auto& given = problem.scene().reconstruct.alpha) return {.value = *given};
  const AlphaChoice choice = choose
                                 ? choose(frame)
                                 : choose_alone(frame, problem.alpha_tables(frame),
                                                problem.alpha_rule(frame), problem.stated_noise());
  const double alpha =
      problem.constraints() ? constrained_alpha(choice.rule, choice.alpha) : choice.alpha;
  return {.value = alpha, .rule = choice.rule, .verdict = choice.verdict};
}

/// How far rounding alone may have moved the tractions, over their 2-norm, in coordinates in which
/// the stabiliser is simple.
double rounding_bound(const FilterFrame& frame, double alpha, double condition,
                      std::size_t columns) {
  const double root = std::sqrt(alpha);
  double solution = 0.0;
  double residual = frame.outside;
  double right = frame.outside;
  double largest = root;
  for (std::size_t i = 0; i < frame.gamma.size(); ++i) {
    const double size = std::hypot(frame.gamma[i], root);
    solution = std::hypot(solution, frame.beta[i] / size * (frame.gamma[i] / size));
    residual = std::hypot(residual, frame.beta[i] * (root / size));  // with what alpha takes
    right = std::hypot(right, frame.beta[i]);
    largest = std::max(largest, frame.gamma[i]);
  }
  const double rounding = std::numeric_limits<double>::epsilon() / 2.0 *
                          std::sqrt(static_cast<double>(frame.rows + columns));
  return wedin_bound(condition, largest, right, residual, solution, rounding);
}

void judge(SkinAnswer& answer, const SkinSceneProblem& problem, const SkinMethod& method,
           const FilterFrame& frame, std::span<const double> readings) {
  const double left = method.residual(readings, answer.tractions);
  answer.noise =
      estimate_noise(left, frame.rows, answer.degrees_of_freedom, problem.stated_noise());
  double all = 0.0;  // without tractions
  for (const double reading : weighted(problem.layout(), readings)) all = std::hypot(all, reading);
  if (all > 0.0 && left > 0.5 * all) {
    if (answer.verdict == Verdict::ok) answer.verdict = Verdict::oversmoothed;
    answer.remarks.emplace_back(remark::Unexplained{left / all});
  }
  const double rounding = rounding_bound(frame, answer.alpha.value,
                                         method.condition(answer.alpha.value), problem.tractions());
  if (!(rounding <= 1e-3)) {
    if (answer.verdict == Verdict::ok) answer.verdict = Verdict::ill_conditioned;
    answer.remarks.emplace_back(remark::Rounding{rounding});
  }
  if (!problem.is_large())  // of which they are known
    answer.offsets = offsets(problem.problem(), readings, answer.tractions);
  if (!answer.offsets.empty())
    answer.remarks.emplace_back(offsets_found(answer.offsets, problem.scene()));
  if (answer.noise.model_rms > 0.0)
    answer.remarks.emplace_back(remark::ModelError{
        .times = answer.noise.model_rms / *answer.noise.stated_rms, .held = true});
}

/// What a contact that reaches over the skin's edge amounts to, from an answer on a grid that
/// reaches further. The map stays as it is.
void take_from_beyond(SkinAnswer& answer, SkinAnswer beyond) {
  if (beyond.cells.empty()) return;
  answer.wrench = beyond.wrench;
  answer.unseen = beyond.unseen;
  answer.ellipse = beyond.ellipse;
  if (!answer.friction || !beyond.friction) return;
  beyond.friction->cell_margins = std::move(answer.friction->cell_margins);  // of this grid's cells
  answer.friction = std::move(beyond.friction);
}

/// Whether the largest reading is more than noise and beside what no taxel sees: what presses is
/// there, or beyond.
bool strongest_at_edge(const SkinSceneProblem& problem, std::span<const double> readings,
                       double noise) {
  constexpr double deviations = 4.0;  // of the largest of many honest readings
  const LinearProblem& solved = problem.layout();
  const std::vector<double> seen = weighted(solved, readings);
  std::size_t strongest = 0;
  double most = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (const double size = std::abs(seen[i]); size > most) {
      most = size;
      strongest = i;
    }
  if (!(most > deviations * noise)) return false;
  const Site& site = solved.sites[strongest];
  const SurfaceGrid& grid = problem.grid();
  const double reach =
      std::max(grid.spacing_y, grid.spacing_z) + least_depth(problem.scene().sensor);
  for (std::size_t cell = 0; cell < grid.count(); ++cell)
    if (problem.unseen()[cell] && std::hypot(grid.y(cell / grid.columns) - site.y,
                                             grid.z(cell % grid.columns) - site.z) <= reach)
      return true;
  return false;
}

constexpr double most_assumed = 0.7;
/// Taxels, in depths: no deviation holds what is between. Under constraints that is `far_apart`.
constexpr double too_far_apart = 2.001;

/// That force's verdict which says most of it.
void judge_force(SkinAnswer& answer, const SkinSceneProblem& problem,
                 std::span<const double> readings) {
  const bool solved =
      answer.verdict != Verdict::iteration_limit && answer.verdict != Verdict::ill_conditioned;
  const std::span<const double> pressure =
      std::span(answer.tractions).first(problem.grid().count());
  // A verdict that is ok says that the readings are explained, and not noise.
  const bool bounded =
      answer.verdict == Verdict::ok && presses_at_border(pressure, problem.border());
  if (bounded) answer.remarks.emplace_back(remark::LowerBound{});
  const bool guessed = bounded || answer.unseen > most_guessed ||
                       (answer.cells.empty() && answer.verdict != Verdict::ok &&
                        strongest_at_edge(problem, readings, answer.noise.rms()));
  if (guessed && solved)
    answer.verdict = Verdict::cut_off;
  else if (answer.verdict == Verdict::ok && answer.assumed > most_assumed &&
           !answer.data.noise_alone)
    answer.verdict = Verdict::undetermined;
  else if (answer.verdict == Verdict::ok &&
           answer.wrench.normal.deviation >
               largest_force(problem, without_offsets(problem, readings, answer.tractions)))
    answer.verdict = Verdict::undetermined;
  else if (answer.verdict == Verdict::ok &&
           pitch_in_depths(problem.scene().sensor) > (answer.cone ? far_apart : too_far_apart))
    answer.verdict = Verdict::coarse;
}

/// Every reading is taken for what it says.
SkinAnswer solve_as_read(const SkinSceneProblem& problem, std::span<const double> readings,
                         const SkinAlphaChooser& choose) {
  if (problem.estimates_weight()) {
    const double weight = problem.likeliest_weight(readings);
    SkinAnswer answer = solve_as_read(problem.weighed(weight), readings, choose);
    answer.alpha.tangential_weight = weight;
    answer.remarks.emplace_back(remark::EstimatedWeight{weight});
    return answer;
  }
  const std::unique_ptr<const SkinMethod> method = method_of(problem);
  const FilterFrame frame = method->analyse(readings);
  SkinAnswer answer{.alpha = alpha_of(problem, frame, choose)};
  answer.verdict = verdict_of(answer.alpha.verdict);
  answer.condition = method->stacked_condition(answer.alpha.value);
  require_full_rank(method->condition(answer.alpha.value), readings.size() + problem.tractions());
  std::optional<TikhonovFamily> face;
  if (problem.constraints()) {
    answer.cone = method->solve_in_cones(readings, answer.alpha.value);
    if (answer.cone->status != FrameStatus::ok) throw FrameOverflow();
    answer.tractions = answer.cone->tractions;
    if (answer.cone->verdict == ConstrainedVerdict::iteration_limit) {
      answer.verdict = Verdict::iteration_limit;
      answer.remarks.emplace_back(remark::IterationLimit{answer.cone->iterations});
    }
    if (!problem.is_large() && !answer.cone->face.free.empty())
      face.emplace(problem.problem(), answer.cone->face);
    answer.degrees_of_freedom = face                 ? face->degrees_of_freedom(answer.alpha.value)
                                : problem.is_large() ? problem.large().degrees_of_freedom(
                                                           answer.cone->face, answer.alpha.value)
                                                     : 0.0;
  } else {
    answer.tractions = method->solve(frame, readings, answer.alpha.value);
    if (const auto reached = method->convergence()) {
      const double off = std::min(reached->bound, reached->estimate);
      answer.iteration = {.steps = reached->steps, .estimate = off};
      if (!reached->converged) {
        answer.verdict = Verdict::iteration_limit;
        answer.remarks.emplace_back(remark::NotConverged{reached->steps, off});
      }
    }
    answer.degrees_of_freedom = method->degrees_of_freedom(answer.alpha.value);
  }
  if (!std::all_of(answer.tractions.begin(), answer.tractions.end(),
                   [](double f) { return std::isfinite(f); }))
    throw FrameOverflow();
  if (problem.is_large() && !answer.iteration) answer.iteration = SkinAnswer::Iteration{};
  judge(answer, problem, *method, frame, readings);
  answer.data = data_verdict(problem, readings, answer.tractions);
  if (answer.cone && answer.data.has(DataDoubt::misfit))
    find_pulls(answer.data,
               method->residual(readings, method->solve(frame, readings, answer.alpha.value)),
               frame.rows);
  if (!answer.data.consistent())
    answer.remarks.emplace_back(with_names(answer.data, problem.scene()));
  add_bands(answer, problem, *method, frame, face, readings);
  if (answer.unseen > most_unseen && !problem.scene().reconstruct.grid.margin)
    take_from_beyond(answer, solve_as_read(problem.reaching_beyond(), readings, {}));
  judge_force(answer, problem, readings);
  answer.verdict = overall(answer.verdict, answer.data, answer.wrench.normal);
  return answer;
}

}  // namespace

std::span<const double> component(std::span<const double> values, const SurfaceGrid& grid,
                                  Traction which) {
  const std::size_t first = static_cast<std::size_t>(which) * grid.count();
  return first < values.size() ? values.subspan(first, grid.count()) : std::span<const double>{};
}

SkinAnswer solve(const SkinSceneProblem& problem, std::span<const double> readings,
                 const SkinAlphaChooser& choose) {
  const SkinScene& scene = problem.scene();
  if (readings.size() != problem.layout().sites.size())
    return solve_as_read(problem, readings, choose);  // which refuses them
  const ClippedTaxels clipped = clipped_taxels(scene, problem.layout().sites, readings);
  if (clipped.taxels.empty()) return solve_as_read(problem, readings, choose);
  std::vector<std::size_t> dead = scene.dead_taxels;
  dead.insert(dead.end(), clipped.taxels.begin(), clipped.taxels.end());
  std::sort(dead.begin(), dead.end());
  const bool left_out =
      clipped.range_known && is_measured(scene.sensor, dead, scene.reconstruct.offset);
  SkinAnswer answer = left_out ? solve_as_read(*problem.left_with(dead), readings, {})
                               : solve_as_read(problem, readings, choose);
  answer.verdict = Verdict::clipped;
  answer.remarks.emplace_back(remark::Clipped{.taxels = clipped.taxels,
                                              .names = taxel_names(scene.sensor, clipped.taxels),
                                              .range_known = clipped.range_known,
                                              .left_out = left_out});
  return answer;
}

}  // namespace tactile_net::lab
