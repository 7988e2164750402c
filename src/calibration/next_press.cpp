#include "tactile_net/calibration/next_press.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "calibration/fit_problem.hpp"
#include "calibration/fit_system.hpp"
#include "calibration/press_design.hpp"
#include "calibration/triangle.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t places = 21;           // over an array
constexpr std::size_t places_of_a_side = 7;  // of a skin
constexpr std::size_t reference_places = 9;  // over an array
constexpr std::size_t reference_side = 5;    // of a skin
constexpr double reach = 0.85;               // of the array's half length
constexpr double smaller_force = 0.5;        // of the largest, on a skin

/// The options of the fit, what it could not know held.
CalibrationOptions held_as(const PressFit& fit, CalibrationOptions options) {
  for (std::size_t i = 0; i < pad_parameter_count; ++i)
    if (const auto parameter = static_cast<PadParameter>(i);
        std::count(fit.free.begin(), fit.free.end(), parameter) == 0)
      options.set_sd(parameter, 0.0);
  return options;
}

FitState state_of(const FitProblem& problem, const PressFit& fit) {
  FitState state = problem.start(1.0);
  state.pad = fit.pad;
  for (std::size_t j = 0; j < fit.gains.size(); ++j) {
    problem.set_gain(state, j, fit.gains[j]);
    state.offset[j] = (fit.offsets[j] - problem.log().unloaded.mean[j]) / problem.noise(j);
  }
  return state;
}

/// A log of presses that nobody has done, with what will be stated of them.
PressLog imagined(const PressLog& log, const std::vector<NextPress>& presses) {
  const Press& like = log.presses.front();
  PressLog result{.unloaded = log.unloaded};
  for (const NextPress& one : presses) {
    Press press{.number = result.presses.size() + 1, .shape = one.shape};
    press.disc = one.disc;
    if (like.force.value) press.force = {one.force, like.force.sd / *like.force.value * one.force};
    if (like.position.value) press.position = {one.position, like.position.sd};
    press.position_z = {like.position_z.value ? std::optional(one.position_z) : std::nullopt,
                        like.position_z.sd};
    if (like.half_width.value)
      press.half_width = {one.half_width,
                          like.half_width.sd / *like.half_width.value * one.half_width};
    if (like.radius && one.radius > 0.0) press.radius = one.radius;
    press.readings.assign(log.unloaded.mean.size(), 0.0);
    result.presses.push_back(std::move(press));
  }
  return result;
}

std::vector<PressState> states_of(const std::vector<NextPress>& presses) {
  std::vector<PressState> states;
  for (const NextPress& one : presses) {
    states.push_back({one.shape, std::log(one.force), one.position, std::log(one.half_width)});
    states.back().center_z = one.position_z;
    states.back().disc = one.disc;
  }
  return states;
}

/// The log's presses with the narrowest, the middle and the widest contact; one where all are
/// alike.
std::vector<std::size_t> typical(const PressFit& fit) {
  std::vector<std::size_t> order(fit.presses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto width = [&](std::size_t p) { return fit.presses[p].half_width.value; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return width(a) < width(b); });
  const std::size_t middle = order[order.size() / 2];
  if (width(order.back()) < 1.2 * width(order.front())) return {middle};
  return {order.front(), middle, order.back()};
}

double largest_force(const PressFit& fit) {
  double force = 0.0;
  for (const FittedPress& press : fit.presses) force = std::max(force, press.force.value);
  return force;
}

/// From -1 to 1.
double share_of(std::size_t i, std::size_t count) {
  return 2.0 * static_cast<double>(i) / static_cast<double>(count - 1) - 1.0;
}

std::vector<NextPress> presses_of_a_line(const FitProblem& problem, const PressFit& fit) {
  const double force = largest_force(fit);
  const Material pad = problem.material_at(fit.pad);
  std::vector<NextPress> presses;
  for (std::size_t i = 0; i < places; ++i)
    for (const std::size_t p : typical(fit)) {
      NextPress one{
          .position = reach * share_of(i, places) * 0.5 * (problem.last().y - problem.first().y),
          .half_width = fit.presses[p].half_width.value,
          .force = force};
      one.radius = problem.model().indenter_radius(pad, one.half_width, force);
      presses.push_back(one);
    }
  return presses;
}

/// A press that the log has, done with another force: balls stay as they are, not their contacts.
NextPress repeated(const PressModel& model, const Material& pad, const Press& log,
                   const FittedPress& done, double force) {
  NextPress one{.half_width = done.half_width.value, .force = force, .disc = log.disc};
  if (log.disc != DiscProfile::sphere) return one;
  const double y = done.center.value;
  const double z = done.center_z.value;
  const double relative = log.radius ? model.relative_radius(*log.radius, y, z)
                                     : model.indenter_radius(pad, one.half_width, done.force.value);
  one.radius = log.radius ? *log.radius : model.radius_of_relative(relative, y, z);
  one.half_width = model.contact_half_width(pad, force, relative);
  return one;
}

/// The log's typical presses, with shares of the largest force, at each place of a grid over the
/// skin's taxels.
std::vector<NextPress> presses_of_a_skin(const FitProblem& problem, const PressFit& fit,
                                         std::span<const double> shares, std::size_t side) {
  const Material pad = problem.material_at(fit.pad);
  std::vector<NextPress> kinds;
  for (const std::size_t p : typical(fit))
    for (const double share : shares)
      kinds.push_back(repeated(problem.model(), pad, problem.log().presses[p], fit.presses[p],
                               share * largest_force(fit)));
  std::vector<NextPress> presses;
  const auto at = [&](double low, double high, std::size_t i) {
    return 0.5 * (low + high) + reach * share_of(i, side) * 0.5 * (high - low);
  };
  for (std::size_t i = 0; i < side; ++i)
    for (std::size_t k = 0; k < side; ++k)
      for (NextPress one : kinds) {
        one.position = at(problem.first().y, problem.last().y, i);
        one.position_z = at(problem.first().z, problem.last().z, k);
        presses.push_back(one);
      }
  return presses;
}

std::vector<NextPress> candidates_of(const FitProblem& problem, const PressFit& fit) {
  constexpr double shares[] = {1.0, smaller_force};
  return problem.model().is_skin() ? presses_of_a_skin(problem, fit, shares, places_of_a_side)
                                   : presses_of_a_line(problem, fit);
}

std::vector<NextPress> reference_loads(const FitProblem& problem, const PressFit& fit) {
  std::vector<NextPress> chosen;
  if (!problem.model().is_skin()) {
    const std::vector<NextPress> loads = presses_of_a_line(problem, fit);
    for (std::size_t i = 0; i < reference_places; ++i)
      chosen.push_back(loads[i * (loads.size() - 1) / (reference_places - 1)]);
    return chosen;
  }
  constexpr double shares[] = {1.0};
  const std::vector<NextPress> loads = presses_of_a_skin(problem, fit, shares, reference_side);
  const std::size_t kinds = loads.size() / (reference_side * reference_side);
  for (std::size_t i = 0; i < loads.size(); i += kinds)
    chosen.push_back(loads[i + i / kinds % kinds]);
  return chosen;
}

/// Rows that a reading's uncertainty under reference loads is the length of, over the rms: their
/// triangle, which has the same lengths.
Eigen::MatrixXd reference_rows(const FitProblem& problem, const FitState& fitted,
                               const std::vector<NextPress>& loads) {
  const std::vector<PressState> states = states_of(loads);
  const PressReadings readings =
      problem.model().readings(fitted.pad, states, true, problem.options().at_base);
  const std::size_t n = problem.model().sites().size();
  const auto columns = static_cast<Eigen::Index>(problem.columns());
  Triangle triangle(columns);
  double square = 0.0;
  for (std::size_t p = 0; p < states.size(); ++p) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), columns);
    for (std::size_t j = 0; j < n; ++j) {
      if (!problem.used(j)) continue;
      const auto row = static_cast<Eigen::Index>(j);
      const double scale = problem.gain(fitted, j) / problem.noise(j);
      square += std::pow(scale * readings.value(p, j), 2);
      for (std::size_t i = 0; i < pad_parameter_count; ++i)
        if (const std::size_t c = problem.pad_column(static_cast<PadParameter>(i)); c != no_column)
          rows(row, static_cast<Eigen::Index>(c)) = scale * readings.by_pad[i](p, j);
      if (const std::size_t c = problem.gain_column(j); c != no_column)
        rows(row, static_cast<Eigen::Index>(c)) = scale * readings.value(p, j);
    }
    triangle.add(rows);
  }
  return triangle.take() / std::sqrt(square);
}

}  // namespace

NextPresses next_presses(const PressModel& model, const PressLog& log,
                         const CalibrationOptions& options, const PressFit& fit, std::size_t count,
                         std::optional<PadParameter> target,
                         const std::function<void(std::size_t)>& watch) {
  const CalibrationOptions held = held_as(fit, options);
  std::vector<bool> gone;
  for (const FittedValue& gain : fit.gain) gone.push_back(gain.verdict == ValueVerdict::fixed);
  const auto unread = std::make_unique<bool[]>(gone.size());
  std::copy(gone.begin(), gone.end(), unread.get());
  const std::span<const bool> left_out(unread.get(), gone.size());

  // What is known now.
  FitProblem done(model, log, held, left_out);
  FitState state = state_of(done, fit);
  for (std::size_t p = 0; p < fit.presses.size(); ++p) {
    const FittedPress& press = fit.presses[p];
    state.presses[p] = {log.presses[p].shape, std::log(press.force.value),
                        press.center.value,   std::log(press.half_width.value),
                        press.friction.value, press.center_z.value,
                        log.presses[p].disc,  press.friction_z.value};
    if (press.put_aside) done.put_aside(p, *press.put_aside);
  }
  const PressReadings now = done.readings(state, true);
  const SystemColumns columns = system_columns(done, state, now);
  const Eigen::MatrixXd root = common_system(done, state, now, columns, {}).triangle;
  for (Eigen::Index i = 0; i < root.cols(); ++i)
    if (root(i, i) == 0.0)
      throw std::invalid_argument("something is not known at all: state a standard deviation");

  Eigen::MatrixXd aims;
  if (target) {
    const std::size_t column = done.pad_column(*target);
    if (column == no_column)
      throw std::invalid_argument("the target " + std::string(name(*target)) +
                                  " is fixed, or cannot be identified");
    aims = Eigen::MatrixXd::Zero(1, root.cols());
    aims(0, static_cast<Eigen::Index>(column)) = 1.0;
  } else {
    aims = reference_rows(done, state, reference_loads(done, fit));
  }

  PressDesign design(root, aims);
  NextPresses result{.now = std::sqrt(design.value())};
  const std::vector<NextPress> candidates = candidates_of(done, fit);
  const PressLog log_of_candidates = imagined(log, candidates);
  const FitProblem next(model, log_of_candidates, held, left_out);
  FitState imagined_state = state_of(next, fit);
  imagined_state.presses = states_of(candidates);
  const PressReadings readings = next.readings(imagined_state, true);
  for (std::size_t p = 0; p < candidates.size(); ++p)
    design.add_candidate(press_part(next, imagined_state, readings, p));
  std::vector<std::size_t> done_before;
  for (const std::size_t one : choose(design, count, watch)) {
    done_before.push_back(one);
    design.set(done_before);
    result.presses.push_back(candidates[one]);
    result.presses.back().remaining = std::sqrt(design.value());
  }
  return result;
}

}  // namespace tactile_net
