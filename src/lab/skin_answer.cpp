#include "tactile_net/lab/skin_answer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "lab/skin_method.hpp"
#include "tactile_net/inverse/error_bound.hpp"
#include "tactile_net/lab/skin_data_verdict.hpp"
#include "tactile_net/lab/skin_sight.hpp"
#include "tactile_net/scene/clipped_taxels.hpp"
#include "tactile_net/skin/covariance.hpp"

namespace tactile_net::lab {
namespace {

ChosenAlpha alpha_of(const SkinSceneProblem& problem, const FilterFrame& frame,
                     const SkinAlphaChooser& choose) {
  if (const auto& given = problem.scene().reconstruct.alpha) return {.value = *given};
  const AlphaChoice choice = choose ? choose(frame)
                                    : choose_alone(frame, problem.alpha_tables(frame),
                                                   problem.alpha_rule(), problem.stated_noise());
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

remark::OffsetsFound with_names(std::span<const double> offsets, const SkinArray& skin) {
  remark::OffsetsFound found;
  for (const SkinChannel& channel : channels(skin))
    found.channels.emplace_back(channel.name, offsets[found.channels.size()]);
  return found;
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
    answer.remarks.emplace_back(with_names(answer.offsets, problem.scene().sensor));
  if (answer.noise.model_rms > 0.0)
    answer.remarks.emplace_back(remark::ModelError{
        .times = answer.noise.model_rms / *answer.noise.stated_rms, .held = true});
}

/// Of the prior that sizes the bands: gml's alpha, or where that has no verdict the tractions' own.
AlphaChoice prior_of(const FilterFrame& frame, const AlphaTables& tables, AlphaRule rule,
                     double alpha, std::optional<double> stated) {
  AlphaChoice prior = choose_alone(
      frame, tables, rule == AlphaRule::evidence ? AlphaRule::evidence : AlphaRule::gml, stated);
  if (prior.verdict != AlphaVerdict::ok) prior.alpha = alpha;
  return prior;
}

/// Whether the sum over cells is certain, though no single one may be: cells that are narrow for
/// their depth share what is told of them. Under constraints noise can only push: of it the sum is
/// some deviations, and not as many as are asked for.
bool is_certain(const Uncertain& force) {
  constexpr double deviations = 6.0;
  return force.value > deviations * force.deviation;
}
bool is_felt(const Uncertain& force) {
  constexpr double deviations = 2.0;
  return force.value > deviations * force.deviation;
}

/// Makes deviations small enough for the highest pressure to be certain.
void scale_to_peak(std::vector<double>& deviations, std::span<const double> pressure) {
  const auto peak = static_cast<std::size_t>(std::max_element(pressure.begin(), pressure.end()) -
                                             pressure.begin());
  const double certain = 0.2 * pressure[peak];
  if (!(deviations[peak] > certain)) return;
  const double factor = certain / deviations[peak];
  for (double& deviation : deviations) deviation *= factor;
}

/// The variance of place that smoothing may have added to pressure: of a rectangle that stands for
/// one degree of freedom of it.
double smoothed_variance(const SkinSceneProblem& problem, double degrees_of_freedom) {
  const SkinArray& skin = problem.scene().sensor;
  const double depth = least_depth(skin);
  const double y = is_even(skin) && skin.rows == 1 ? depth : skin.pitch_y;
  const double z = is_even(skin) && skin.columns == 1 ? depth : skin.pitch_z;
  const auto components = static_cast<double>(problem.layout().components);
  const double each = degrees_of_freedom / components / static_cast<double>(taxel_count(skin));
  return y * z / std::max(each, 1e-3) / 12.0;
}

/// A radius by second moments lies between what it would be if smoothing had added all of that
/// variance, and none.
Uncertain without_smoothing(const Uncertain& radius, double variance) {
  constexpr double hertz = 5.0;  // the radius' square over the variance
  const double least = std::sqrt(std::max(radius.value * radius.value - hertz * variance, 0.0));
  return {0.5 * (radius.value + least),
          std::hypot(radius.deviation, (radius.value - least) / std::sqrt(12.0))};
}

/// How far apart the taxels lie, in depths.
double pitch_in_depths(const SkinArray& skin) {
  const double y = !is_even(skin) || skin.rows > 1 ? skin.pitch_y : 0.0;
  const double z = !is_even(skin) || skin.columns > 1 ? skin.pitch_z : 0.0;
  return std::max(y, z) / least_depth(skin);
}
constexpr double far_apart = 1.75;       // what presses between them is little seen
constexpr double too_far_apart = 2.001;  // and here no deviation holds it

/// Where constraints leave a single row or column of cells, its place is what they have decided,
/// not what the readings tell: the deviations are those of the cells beside it too, without
/// constraints, and of a place anywhere in the width of a cell.
void widen_centre(UncertainWrench& wrench, const SkinGrid& grid, std::span<const double> tractions,
                  std::span<const std::size_t> cells, const Covariance& free, double rms) {
  if (!wrench.centre_y || !wrench.centre_z) return;
  std::vector<std::size_t> pressed;
  for (const std::size_t cell : cells)
    if (tractions[cell] != 0.0) pressed.push_back(cell);
  const bool one_row = is_one_line(grid, pressed, false);
  const bool one_column = is_one_line(grid, pressed, true);
  if (!one_row && !one_column) return;
  const UncertainWrench wider =
      resultant_of(grid, tractions, with_neighbours(grid, pressed), free, rms);
  const auto widen = [&](std::optional<Uncertain>& centre, const std::optional<Uncertain>& of_more,
                         double spacing) {
    centre->deviation = std::hypot(std::max(centre->deviation, of_more ? of_more->deviation : 0.0),
                                   spacing / std::sqrt(12.0));
  };
  if (one_row) widen(wrench.centre_y, wider.centre_y, grid.spacing_y);
  if (one_column) widen(wrench.centre_z, wider.centre_z, grid.spacing_z);
}

/// Bands, the cells that touch, and what the tractions amount to. Under constraints the contacts
/// are judged by what these leave free; the bands of cells are those without constraints, which
/// hold what the constraints have moved.
///
/// @param face  what constraints leave free; absent: there are none, or they leave nothing
void add_bands(SkinAnswer& answer, const SkinSceneProblem& problem, const SkinMethod& method,
               const FilterFrame& frame, const std::optional<SkinFamily>& face,
               std::span<const double> readings) {
  const SkinGrid& grid = problem.grid();
  const double alpha = answer.alpha.value;
  // An error of the model counts for noise.
  const double rms = answer.noise.model_rms > 0.0 ? answer.noise.residual_rms : answer.noise.rms();
  const AlphaRule rule = problem.alpha_rule();
  const double prior =
      prior_of(frame, problem.alpha_tables(frame), rule, alpha, problem.stated_noise()).alpha;
  const std::unique_ptr<const Covariance> free = method.covariance(alpha, prior);
  const Covariance& own = *free;
  answer.deviations = own.deviations();
  for (double& deviation : answer.deviations) deviation *= rms;

  std::optional<SkinCovariance> of_face;
  std::vector<double> touching = answer.deviations;
  if (face) {
    const FilterFrame left = face->analyse(readings);
    const AlphaTables tables(left.gamma, left.rows, left.shares);
    of_face.emplace(*face, alpha,
                    prior_of(left, tables, rule, alpha, problem.stated_noise()).alpha);
    touching = of_face->deviations();
    for (double& deviation : touching) deviation *= rms;
  }
  const Covariance& covariance = of_face ? static_cast<const Covariance&>(*of_face) : own;
  const std::span<const double> f = answer.tractions;
  // Under constraints the cells around a contact hold what noise pushes there, and nothing pulls.
  const double rim = (face ? 0.5 : 1.0) * least_depth(problem.scene().sensor);
  answer.cells = contact_cells(grid, f, touching, rim);
  std::vector<std::size_t> summed;
  if (answer.cells.empty()) {
    summed.resize(grid.count());
    std::iota(summed.begin(), summed.end(), std::size_t{0});
    answer.wrench = resultant_of(grid, f, summed, covariance, rms);
  }
  if (answer.cells.empty() && is_certain(answer.wrench.normal)) {
    scale_to_peak(touching, f.first(grid.count()));
    answer.cells = contact_cells(grid, f, touching, rim);
  }
  if (answer.cells.empty()) {
    // What no cell is certain of may press beside the taxels that see.
    widen_centre(answer.wrench, grid, f, summed, own, rms);
    if (is_felt(answer.wrench.normal)) answer.unseen = unseen_share(f, summed, problem.unseen());
    return;
  }
  answer.unseen = unseen_share(f, answer.cells, problem.unseen());
  const bool seen = answer.unseen <= most_unseen;
  // Where no taxel sees, what constraints hold is not certain either.
  const std::unique_ptr<const Covariance> contact =
      method.covariance(alpha, contact_prior(prior, answer.cells.size(), grid.count(), seen));
  const Covariance& of_contact = *contact;
  // Nor where offsets are free: what they take the constraints give back, all of it to one side;
  // nor between taxels that lie far apart, where they decide how much presses.
  const bool held = seen && !problem.layout().unknown_offsets &&
                    pitch_in_depths(problem.scene().sensor) <= far_apart;
  const Covariance& known = of_face && held ? covariance : of_contact;
  answer.wrench = resultant_of(grid, f, answer.cells, known, rms);
  widen_centre(answer.wrench, grid, f, answer.cells, of_contact, rms);
  answer.friction =
      friction_of(grid, f, answer.cells, known, rms, problem.scene().reconstruct.friction_limit);
  const auto apart = separate_contacts(grid, f, answer.cells);
  answer.contacts = apart.size();
  answer.ellipse = contact_ellipse(grid, f, apart.front(), known, rms);
  if (!answer.ellipse) return;
  // Of tractions without constraints: these change little of what the readings tell of a size.
  const double variance = smoothed_variance(problem, method.degrees_of_freedom(alpha));
  answer.ellipse->radius = without_smoothing(answer.ellipse->radius, variance);
  answer.ellipse->second_radius = without_smoothing(answer.ellipse->second_radius, variance);
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
  const SkinProblem& solved = problem.layout();
  std::size_t strongest = 0;
  double most = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (const double size = std::abs(solved.weights[i] * readings[i]); size > most) {
      most = size;
      strongest = i;
    }
  if (!(most > deviations * noise)) return false;
  const SkinSite& site = solved.sites[strongest];
  const SkinGrid& grid = problem.grid();
  const double reach =
      std::max(grid.spacing_y, grid.spacing_z) + least_depth(problem.scene().sensor);
  for (std::size_t cell = 0; cell < grid.count(); ++cell)
    if (problem.unseen()[cell] && std::hypot(grid.y(cell / grid.columns) - site.y,
                                             grid.z(cell % grid.columns) - site.z) <= reach)
      return true;
  return false;
}

/// That force's verdict which says most of it.
void judge_force(SkinAnswer& answer, const SkinSceneProblem& problem,
                 std::span<const double> readings) {
  const bool solved =
      answer.verdict != Verdict::iteration_limit && answer.verdict != Verdict::ill_conditioned;
  const bool guessed =
      answer.unseen > most_guessed || (answer.cells.empty() && answer.verdict != Verdict::ok &&
                                       strongest_at_edge(problem, readings, answer.noise.rms()));
  if (guessed && solved)
    answer.verdict = Verdict::cut_off;
  else if (answer.verdict == Verdict::ok &&
           answer.wrench.normal.deviation > largest_force(problem, readings))
    answer.verdict = Verdict::undetermined;
  else if (answer.verdict == Verdict::ok && pitch_in_depths(problem.scene().sensor) > too_far_apart)
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
  std::optional<SkinFamily> face;
  if (problem.constraints()) {
    answer.cone = method->solve_in_cones(readings, answer.alpha.value);
    if (answer.cone->status != FrameStatus::ok) throw FrameOverflow();
    answer.tractions = answer.cone->tractions;
    if (answer.cone->verdict == ConstrainedVerdict::iteration_limit) {
      answer.verdict = Verdict::iteration_limit;
      answer.remarks.emplace_back(remark::IterationLimit{answer.cone->iterations});
    }
    if (!answer.cone->face.free.empty()) face.emplace(problem.problem(), answer.cone->face);
    // Of a large skin those without constraints, which are more.
    answer.degrees_of_freedom = face ? face->degrees_of_freedom(answer.alpha.value)
                                : problem.is_large()
                                    ? method->degrees_of_freedom(answer.alpha.value)
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
  if (problem.is_large() && !answer.iteration) answer.iteration.emplace();
  judge(answer, problem, *method, frame, readings);
  answer.data = data_verdict(problem, readings, answer.tractions);
  if (!answer.data.consistent()) answer.remarks.emplace_back(remark::DataDoubted{answer.data});
  add_bands(answer, problem, *method, frame, face, readings);
  if (answer.unseen > most_unseen && !problem.scene().reconstruct.grid.margin)
    take_from_beyond(answer, solve_as_read(problem.reaching_beyond(), readings, {}));
  judge_force(answer, problem, readings);
  return answer;
}

std::vector<SignalReading> signal_readings(const SkinProblem& problem) {
  std::vector<SignalReading> all;
  for (const SkinSite& site : problem.sites)
    all.push_back({site.quantity, site.taxel, site.channel});
  return all;
}

}  // namespace

std::span<const double> component(std::span<const double> values, const SkinGrid& grid,
                                  SkinTraction which) {
  const std::size_t first = static_cast<std::size_t>(which) * grid.count();
  return first < values.size() ? values.subspan(first, grid.count()) : std::span<const double>{};
}

SkinAnswer solve(const SkinSceneProblem& problem, std::span<const double> readings,
                 const SkinAlphaChooser& choose) {
  const SkinScene& scene = problem.scene();
  if (readings.size() != problem.layout().sites.size())
    return solve_as_read(problem, readings, choose);  // which refuses them
  const ClippedTaxels clipped = clipped_taxels(scene, signal_readings(problem.layout()), readings);
  if (clipped.taxels.empty()) return solve_as_read(problem, readings, choose);
  std::vector<std::size_t> dead = scene.dead_taxels;
  dead.insert(dead.end(), clipped.taxels.begin(), clipped.taxels.end());
  std::sort(dead.begin(), dead.end());
  const bool left_out =
      clipped.range_known && is_measured(scene.sensor, dead, scene.reconstruct.offset);
  SkinAnswer answer = left_out ? solve_as_read(problem.left_with(dead), readings, {})
                               : solve_as_read(problem, readings, choose);
  answer.verdict = Verdict::clipped;
  answer.remarks.emplace_back(remark::Clipped{
      .taxels = clipped.taxels, .range_known = clipped.range_known, .left_out = left_out});
  return answer;
}

}  // namespace tactile_net::lab
