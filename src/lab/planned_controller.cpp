#include "tactile_net/lab/planned_controller.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "lab/border.hpp"
#include "tactile_net/control/fft_convolution.hpp"
#include "tactile_net/control/planner.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/sensing/resultant.hpp"
#include "tactile_net/system/memory.hpp"

namespace tactile_net::lab {
namespace {

using Choose = std::function<ChosenAlpha(std::span<const double> readings)>;

/// The middle of what the rule chooses on each frame.
std::optional<PlanAlpha> median_alpha(std::size_t count, const NextFrame& next, Observer& observer,
                                      const Choose& choose) {
  std::vector<double> readings(count);
  std::vector<double> alphas;
  std::optional<AlphaRule> rule;
  while (next(readings)) {
    observer.step({.kind = Step::Kind::frame, .count = alphas.size()});
    const ChosenAlpha chosen = choose(readings);
    alphas.push_back(chosen.value);
    rule = chosen.rule;
  }
  if (alphas.empty()) return std::nullopt;
  const auto middle = alphas.begin() + std::ssize(alphas) / 2;
  std::nth_element(alphas.begin(), middle, alphas.end());
  return PlanAlpha{.value = *middle,
                   .source = PlanAlpha::Source::recording,
                   .rule = rule,
                   .frames = alphas.size()};
}

PlanAlpha of_contact(const ChosenAlpha& chosen) {
  return {.value = chosen.value, .source = PlanAlpha::Source::contact, .rule = chosen.rule};
}

std::size_t taxels_of(const SensorArray& sensor) { return sensor.count; }
std::size_t taxels_of(const SkinArray& sensor) { return taxel_count(sensor); }

/// The converter's range in what the controller reads. Where readings of a channel differ in their
/// gain or baseline, that which none of them leaves without being at its own end, less rounding;
/// none where they have nothing in common.
/// @param scene  of a line or of a skin
std::vector<ReadingRange> ranges_of(const auto& scene,
                                    const std::optional<Calibration>& calibration) {
  const auto all = channels(scene.sensor);
  const bool alike = std::all_of(all.begin(), all.end(), [&](const auto& channel) {
    return channel.count == taxels_of(scene.sensor);
  });
  std::vector<ReadingRange> ranges;
  for (const auto& channel : all) {
    const auto& [low, high] = scene.quantization->range.at(channel.quantity);
    ranges.push_back({low, high});
  }
  const auto per_reading = [&](const std::vector<ReadingRange>& of_channels) {
    std::vector<ReadingRange> spread;
    for (const auto& site : sites(scene.sensor)) spread.push_back(of_channels[site.channel]);
    return spread;
  };
  if (!calibration) return alike ? ranges : per_reading(ranges);
  std::vector<double> lowest;
  std::vector<double> highest;
  for (const auto& site : sites(scene.sensor)) {
    lowest.push_back(ranges[site.channel].lowest);
    highest.push_back(ranges[site.channel].highest);
  }
  uncalibrate(*calibration, lowest);
  uncalibrate(*calibration, highest);
  for (std::size_t c = 0; c < ranges.size(); ++c) {
    ReadingRange& range = ranges[c];
    range = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (std::size_t i = all[c].first; i < all[c].first + all[c].count; ++i) {
      const auto [first, second] = std::minmax(lowest[i], highest[i]);
      const double rounding =
          4.0 * std::numeric_limits<double>::epsilon() *
          (std::abs(first) + std::abs(second) + std::abs(calibration->baseline[i]));
      range = {std::max(range.lowest, first + rounding),
               std::min(range.highest, second - rounding)};
    }
    if (!(range.lowest < range.highest)) return {};
  }
  return alike ? ranges : per_reading(ranges);
}

}  // namespace

std::optional<PlanAlpha> plan_alpha(const SceneProblem& problem, const NextFrame& next,
                                    Observer& observer) {
  const Scene& scene = problem.scene();
  if (scene.reconstruct.alpha) return PlanAlpha{.value = *scene.reconstruct.alpha};
  const auto choose = [&](std::span<const double> readings) {
    return SceneFrame(problem, readings).alpha();
  };
  if (next) return median_alpha(problem.readings(), next, observer, choose);
  if (scene.contacts.empty()) return std::nullopt;
  return of_contact(choose(simulate(scene).readings));
}

std::optional<PlanAlpha> plan_alpha(const SkinSceneProblem& problem, const NextFrame& next,
                                    Observer& observer) {
  const SkinScene& scene = problem.scene();
  if (scene.reconstruct.alpha) return PlanAlpha{.value = *scene.reconstruct.alpha};
  check_memory(scene, available_memory());
  const auto choose = [&](std::span<const double> readings) { return problem.alpha(readings); };
  if (next) return median_alpha(reading_count(scene.sensor), next, observer, choose);
  if (scene.contacts.empty()) return std::nullopt;
  return of_contact(choose(simulate(scene, observer).readings));
}

namespace {

void refuse_estimated_weight(const auto& problem) {
  if (problem.estimates_weight())
    throw std::invalid_argument(
        "a plan is one matrix for all frames, and here each has a tangential_weight of its own: "
        "state it");
}

/// With what options leave open taken from the scene.
PlannerOptions completed(const auto& problem, PlannerOptions options) {
  const auto& scene = problem.scene();
  options.traction_limit = scene.material.youngs_modulus;
  options.noise_rms = problem.stated_noise().value_or(0.0);
  if (!options.friction_coefficient && options.cone)
    options.friction_coefficient = options.cone->constraints.friction_limit;
  if (!options.friction_coefficient)
    options.friction_coefficient = scene.reconstruct.friction_limit;
  if (!options.calibration) options.calibration = scene.calibration;
  if (scene.quantization) options.ranges = ranges_of(scene, options.calibration);
  options.label = scene.title.empty() ? scene.file : scene.title;
  options.judge_baseline = true;
  options.border = problem.border();
  if constexpr (std::is_same_v<std::decay_t<decltype(scene)>, SkinScene>)
    options.moment_about = scene.reconstruct.moment_about;
  if (options.cone && options.noise_rms > 0.0 && !scene.contacts.empty()) {
    const std::vector<double> readings = weighted(problem.problem(), simulate(scene).readings);
    double largest = 0.0;
    for (const double reading : readings) largest = std::max(largest, std::abs(reading));
    options.cone->signal = std::clamp(largest / options.noise_rms, 10.0, 1e5);
  }
  return options;
}

/// @param family  the problem's
PlannedController controller_of(const auto& problem, const PlanAlpha& alpha,
                                const PlannerOptions& given, const TikhonovFamily& family) {
  const PlannerOptions options = completed(problem, given);
  std::optional<std::decay_t<decltype(problem)>> whole;
  if (!problem.scene().dead_taxels.empty()) whole = problem.without({});
  return {.alpha = alpha,
          .estimator = plan_estimator(problem.problem(), family, alpha.value, options,
                                      whole ? &whole->problem() : nullptr),
          .for_raw_numbers = options.calibration.has_value(),
          .needs_baseline = options.calibration && options.calibration->baseline_frames};
}

}  // namespace

PlannedController plan_controller(const SceneProblem& problem, const PlanAlpha& alpha,
                                  const PlannerOptions& options) {
  refuse_estimated_weight(problem);
  return controller_of(problem, alpha, options, problem.family());
}

void check_memory(const SkinScene& scene, double memory) {
  const std::size_t readings = reading_count(scene.sensor);
  const std::size_t tractions = components(scene) * grid(scene).count();
  const double wanted = planning_bytes(readings, tractions);
  if (wanted <= memory) return;
  const auto in_gigabytes = [](double bytes) { return brief(1e-9 * bytes, 2) + " GB"; };
  throw std::invalid_argument(
      "a plan from " + std::to_string(readings) + " readings to " + std::to_string(tractions) +
      " tractions takes " + in_gigabytes(wanted) + " to make, and this machine has " +
      in_gigabytes(memory) + " left: choose a wider reconstruct.spacing or a smaller margin");
}

PlannedController plan_controller(const SkinSceneProblem& problem, const PlanAlpha& alpha,
                                  const PlannerOptions& options) {
  refuse_estimated_weight(problem);
  check_memory(problem.scene(), available_memory());
  PlanAlpha used = alpha;
  if (options.cone && alpha.rule) used.value = constrained_alpha(*alpha.rule, alpha.value);
  return controller_of(problem, used, options, problem.family());
}

FrameTimes frame_times(const EstimatorPlan& plan) {
  const Pinned pinned;
  ContactEstimator estimator(plan, fft_convolutions());
  const std::vector<double> readings(plan.readings(), 1.0);
  std::vector<double> tractions(plan.tractions());
  ContactEstimate estimate;
  estimate.tractions = tractions;
  const auto frame = [&] {
    return time_of([&] { (void)estimator.update(readings, estimate); }).median;
  };
  FrameTimes times{.frame = frame()};
  if (!plan.cone) return times;
  constexpr std::size_t few = 1;
  constexpr std::size_t many = 17;
  estimator.set_work({.steps = few});
  const double short_frame = frame();
  estimator.set_work({.steps = many});
  times.step = std::max(frame() - short_frame, 0.0) / static_cast<double>(many - few);
  return times;
}

void fit_steps(PlannedEstimator& planned, const FrameTimes& times, double seconds) {
  constexpr std::size_t least = 6;
  ConePlan& cone = *planned.plan.cone;
  const bool knows_noise = planned.plan.noise_rms > 0.0;
  const double unit = knows_noise ? 1.0 : deviation_without_noise;
  const double without = times.frame - static_cast<double>(cone.steps) * times.step;
  const double fitting = times.step > 0.0 ? (seconds - without) / times.step : 0.0;
  const std::size_t steps = fitting >= static_cast<double>(cone.steps)
                                ? cone.steps
                                : static_cast<std::size_t>(std::max(fitting, 0.0));
  std::size_t enough = 1;
  while (enough < planned.unfinished.size() - 1 && planned.unfinished[enough].median > unit)
    ++enough;
  const std::string needed =
      std::to_string(std::max(enough, least)) + " steps, which take " +
      duration(without + static_cast<double>(std::max(enough, least)) * times.step);
  if (steps < std::min(least, cone.steps))
    throw std::invalid_argument("in " + duration(seconds) + " a frame takes " +
                                std::to_string(steps) + " steps towards its constraints here: " +
                                "give it " + needed + ", or smooth more: a larger alpha");
  if (planned.unfinished[steps].median > unit)
    throw std::invalid_argument(
        "in " + duration(seconds) + " a frame takes " + std::to_string(steps) +
        " steps towards its constraints here, and half of the frames are then more than " +
        (knows_noise ? "a standard deviation" : "1 %") + " from their minimum: give it " + needed +
        ", or smooth more: a larger alpha");
  cone.steps = steps;
  cone.expected = planned.unfinished[steps];
}

namespace {

/// @param solved  of the readings, the solver's
std::optional<PlannedForce> force_beside(const EstimatorPlan& plan, std::vector<double> readings,
                                         const std::optional<Calibration>& calibration,
                                         double solved) {
  if (calibration) uncalibrate(*calibration, readings);
  ContactEstimator estimator(plan);
  std::vector<double> tractions(estimator.tractions());
  ContactEstimate estimate{.tractions = tractions};
  if (estimator.update(readings, estimate) != FrameStatus::ok || !estimate.contact ||
      !(solved > 0.0))
    return std::nullopt;
  return PlannedForce{.planned = estimate.normal_force, .solved = solved};
}

bool needs_convolution(const EstimatorPlan& plan) {
  return plan.reconstruction.structure == Structure::fft ||
         (plan.prediction && plan.prediction->structure == Structure::fft);
}

}  // namespace

std::optional<PlannedForce> planned_force(const SceneProblem& problem, const EstimatorPlan& plan,
                                          const std::optional<Calibration>& calibration) {
  const Scene& scene = problem.scene();
  if (scene.contacts.empty() || needs_convolution(plan)) return std::nullopt;
  std::vector<double> readings = simulate(scene).readings;
  const auto solver = make_solver(problem, Method::tikhonov);
  std::vector<double> f(solver->tractions());
  if (solver->solve(readings, f).status != FrameStatus::ok) return std::nullopt;
  const auto normal = std::span<const double>(f).first(problem.surface().count);
  return force_beside(plan, std::move(readings), calibration ? calibration : scene.calibration,
                      resultant_of(normal, {}, problem.surface()).normal);
}

std::optional<PlannedForce> planned_force(const SkinSceneProblem& problem,
                                          const EstimatorPlan& plan,
                                          const std::optional<Calibration>& calibration) {
  const SkinScene& scene = problem.scene();
  if (scene.contacts.empty()) return std::nullopt;
  std::vector<double> readings = simulate(scene).readings;
  const double solved = solve(problem, readings).wrench.normal.value;
  return force_beside(plan, std::move(readings), calibration ? calibration : scene.calibration,
                      solved);
}

}  // namespace tactile_net::lab
