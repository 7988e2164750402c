#include "tactile_net/calibration/press_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "calibration/fit_doubts.hpp"
#include "calibration/fit_problem.hpp"
#include "calibration/fit_summary.hpp"
#include "calibration/levenberg_marquardt.hpp"
#include "calibration/log_doubts.hpp"
#include "calibration/null_space.hpp"
#include "numeric/named.hpp"

namespace tactile_net {
namespace {

constexpr double cauchy_scale = 2.4;  // standard deviations at which a row's weight is a half
constexpr std::size_t most_reweightings = 25;
constexpr std::size_t most_robust_steps = 5;  // times those of a start
constexpr std::size_t most_put_aside = 3;     // rounds; one value of a press

/// Several parameters hang together, and what is stated of one of them holds them all: each keeps
/// its prior, and the standard deviations say how far that goes. Held, the others would take over
/// the error of what is stated.
bool is_held_by_priors(const NullDirection& direction, const CalibrationOptions& options) {
  std::size_t together = 0;
  bool stated = false;
  for (std::size_t i = 0; i < pad_parameter_count; ++i) {
    if (!takes_part({direction}, static_cast<PadParameter>(i))) continue;
    ++together;
    stated = stated || std::isfinite(options.sd(static_cast<PadParameter>(i)));
  }
  return together > 1 && stated;
}

/// The same options, every parameter held that the log cannot tell from others at this state.
CalibrationOptions identifiable(const PressModel& model, const PressLog& log,
                                CalibrationOptions options, std::span<const bool> unread,
                                const FitState& state) {
  for (std::size_t i = 0; i <= pad_parameter_count; ++i) {
    const FitProblem problem(model, log, options, unread);
    std::vector<NullDirection> directions = null_directions(problem, state);
    std::erase_if(directions, [&](const NullDirection& direction) {
      return is_held_by_priors(direction, options);
    });
    const auto* held = std::find_if(std::begin(held_first), std::end(held_first),
                                    [&](PadParameter one) { return takes_part(directions, one); });
    if (held == std::end(held_first)) break;
    options.set_sd(*held, 0.0);
  }
  return options;
}

/// Whether a parameter is free that was held.
bool frees(const CalibrationOptions& now, const CalibrationOptions& before) {
  for (std::size_t i = 0; i < pad_parameter_count; ++i) {
    const auto parameter = static_cast<PadParameter>(i);
    if (now.sd(parameter) > 0.0 && before.sd(parameter) == 0.0) return true;
  }
  return false;
}

double cauchy(double deviation) {
  return 1.0 / (1.0 + (deviation / cauchy_scale) * (deviation / cauchy_scale));
}

/// New weights from the residuals; the largest change of one.
double reweigh(FitProblem& problem, const FitState& state) {
  const PressReadings readings = problem.readings(state, false);
  const std::size_t n = problem.model().sites().size();
  double change = 0.0;
  const auto set = [&](double& weight, double deviation) {
    const double next = cauchy(deviation);
    change = std::max(change, std::abs(next - weight));
    weight = next;
  };
  for (std::size_t p = 0; p < state.presses.size(); ++p) {
    for (std::size_t j = 0; j < n; ++j)
      if (problem.used(j)) set(problem.weights[p * n + j], problem.residual(state, readings, p, j));
    for (const PressQuantity quantity :
         {PressQuantity::force, PressQuantity::position, PressQuantity::position_z})
      if (problem.holds(p, quantity))
        set(problem.press_rows[p].weight[static_cast<std::size_t>(quantity)],
            problem.deviation(state, p, quantity));
  }
  return change;
}

Descent reweighted(FitProblem& problem, Descent best) {
  const std::size_t most = most_robust_steps * problem.options().most_iterations;
  for (std::size_t pass = 0; pass < most_reweightings && best.iterations < most; ++pass) {
    if (reweigh(problem, best.state) < 1e-3) break;
    const std::size_t before = best.iterations;
    best = descend(problem, std::move(best.state));
    best.iterations += before;
  }
  return best;
}

/// What is contradicted becomes unknown; whether anything was.
bool put_wrong_values_aside(FitProblem& problem, const FitState& state) {
  bool any = false;
  const PressReadings readings = problem.readings(state, true);
  for (std::size_t p = 0; p < state.presses.size(); ++p) {
    if (problem.press_rows[p].put_aside) continue;
    if (const auto wrong = contradiction(problem, state, readings, p)) {
      problem.put_aside(p, wrong->quantity);
      any = true;
    }
  }
  return any;
}

Descent robust(FitProblem& problem, Descent best) {
  best = reweighted(problem, std::move(best));
  for (std::size_t round = 0; round < most_put_aside; ++round) {
    if (!put_wrong_values_aside(problem, best.state)) break;
    const std::size_t before = best.iterations;
    best = reweighted(problem, descend(problem, std::move(best.state)));
    best.iterations += before;
  }
  return best;
}

bool all_loads_stated(const PressLog& log) {
  return std::all_of(log.presses.begin(), log.presses.end(), [](const Press& press) {
    return press.force.value && press.position.value && press.position_z.value &&
           press.half_width.value;
  });
}

/// The best of the descents from all starts, and what became of each.
void descend_from_all(const FitProblem& problem, const CalibrationOptions& options, PressFit& fit,
                      Descent& best) {
  fit.starts.clear();
  for (const double factor : options.starts) {
    Descent descent =
        descend(problem, problem.start(factor), {}, fit.starts.empty() ? 0.0 : best.objective);
    fit.starts.push_back({factor, descent.objective, descent.iterations, descent.converged});
    fit.iterations += descent.iterations;
    if (fit.starts.size() == 1 || descent.objective < best.objective * (1.0 - 1e-6))
      best = std::move(descent);
    // Held, all starts are one; and with known loads every start finds the one minimum.
    if (problem.pad_column(PadParameter::depth) == no_column || all_loads_stated(problem.log()))
      break;
  }
}

std::vector<ProfilePoint> profile_of(const FitProblem& problem, const Descent& best,
                                     const FittedValue& depth) {
  std::vector<ProfilePoint> profile;
  const std::size_t column = problem.pad_column(PadParameter::depth);
  if (column == no_column || !std::isfinite(depth.sd) || depth.sd == 0.0) return profile;
  const double log_sd = depth.sd / depth.value;
  for (const double side : {-1.0, 1.0}) {
    FitState state = best.state;
    for (int i = 1; i <= 6; ++i) {
      const double z = side * 0.5 * i;
      Eigen::VectorXd step = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.columns()));
      step(static_cast<Eigen::Index>(column)) =
          best.state.pad.log_depth + z * log_sd - state.pad.log_depth;
      const Descent held = descend(problem, problem.moved(state, step, {}), PadParameter::depth);
      const double rise = std::max(0.0, 2.0 * (held.objective - best.objective));
      profile.push_back({z, depth.value * std::exp(z * log_sd), side * std::sqrt(rise)});
      state = held.state;
    }
  }
  profile.push_back({0.0, depth.value, 0.0});
  std::sort(profile.begin(), profile.end(),
            [](const ProfilePoint& a, const ProfilePoint& b) { return a.z < b.z; });
  return profile;
}

}  // namespace

std::string_view name(ValueVerdict verdict) noexcept {
  return name_in<Enumerators<ValueVerdict>::all>(verdict);
}
std::string_view name(FitVerdict verdict) noexcept {
  return name_in<Enumerators<FitVerdict>::all>(verdict);
}
std::string_view name(PressQuantity quantity) noexcept {
  return name_in<Enumerators<PressQuantity>::all>(quantity);
}
std::string_view name(TrendOf trend) noexcept { return name_in<Enumerators<TrendOf>::all>(trend); }

const ValueWithSd& FittedPress::at(PressQuantity quantity) const noexcept {
  const ValueWithSd* const values[] = {&force,    &center,   &half_width,
                                       &friction, &center_z, &friction_z};
  return *values[static_cast<std::size_t>(quantity)];
}

PressFit fit_presses(const PressModel& model, const PressLog& log,
                     const CalibrationOptions& options, std::span<const bool> unread,
                     const std::function<void(std::size_t)>& watch) {
  const FitProblem whole(model, log, options, unread);
  require_plausible(whole);
  PressFit fit;
  Descent best;
  std::optional<FitProblem> fitted;
  FitState known_at = whole.start(1.0);
  CalibrationOptions held;
  // Presses at one place start with equal widths, which determine the gains alone. After the widths
  // are fitted they may determine more, so what is identifiable is asked again.
  for (std::size_t round = 0; round <= pad_parameter_count; ++round) {
    if (round > 0 && !frees(options, held)) break;  // nothing is held
    const CalibrationOptions told = identifiable(model, log, options, unread, known_at);
    if (round > 0 && !frees(told, held)) break;
    held = told;
    fitted.emplace(model, log, held, unread);
    fitted->watch = watch;
    descend_from_all(*fitted, options, fit, best);
    known_at = best.state;
  }
  FitProblem& problem = *fitted;
  if (options.robust) {
    best = robust(problem, std::move(best));
    fit.iterations += best.iterations;
  }
  fit.null_directions = null_directions(whole, best.state);
  summarise(problem, best, options, fit);
  doubt(problem, best.state, options, fit);
  if (!best.converged) fit.verdict = FitVerdict::iteration_limit;
  if (options.profile && best.converged)
    fit.profile = profile_of(problem, best, fit.at(PadParameter::depth));
  return fit;
}

}  // namespace tactile_net
