#include "tactile_net/calibration/next_press.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "calibration/fit_problem.hpp"
#include "calibration/fit_system.hpp"
#include "numeric/decompositions.hpp"
#include "tactile_net/calibration/rod_contact.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t places = 21;  // over the array
constexpr std::size_t reference_places = 9;
constexpr double reach = 0.85;             // of the array's half length
constexpr std::size_t most_exchanges = 4;  // rounds

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
    if (like.force.value) press.force = {one.force, like.force.sd / *like.force.value * one.force};
    if (like.position.value) press.position = {one.position, like.position.sd};
    if (like.half_width.value)
      press.half_width = {one.half_width,
                          like.half_width.sd / *like.half_width.value * one.half_width};
    press.readings.assign(log.unloaded.mean.size(), 0.0);
    result.presses.push_back(std::move(press));
  }
  return result;
}

std::vector<PressState> states_of(const std::vector<NextPress>& presses) {
  std::vector<PressState> states;
  for (const NextPress& one : presses)
    states.push_back({one.shape, std::log(one.force), one.position, std::log(one.half_width)});
  return states;
}

Material pad_of(const PressModel& model, const PressFit& fit) {
  Material pad = model.material();
  pad.poisson_ratio = fit.at(PadParameter::poisson_ratio).value;
  pad.youngs_modulus = fit.at(PadParameter::youngs_modulus).value;
  if (pad.layer) pad.layer->thickness = fit.at(PadParameter::thickness).value;
  return pad;
}

std::vector<NextPress> candidates_of(const PressModel& model, const PressFit& fit) {
  std::vector<double> widths;
  double force = 0.0;
  for (const FittedPress& press : fit.presses) {
    widths.push_back(press.half_width.value);
    force = std::max(force, press.force.value);
  }
  std::sort(widths.begin(), widths.end());
  std::vector<double> tried{widths.front(), widths[widths.size() / 2], widths.back()};
  if (tried.back() < 1.2 * tried.front()) tried = {widths[widths.size() / 2]};
  const auto [first, last] =
      std::minmax_element(model.sites().begin(), model.sites().end(),
                          [](const PressSite& a, const PressSite& b) { return a.y < b.y; });
  std::vector<NextPress> candidates;
  for (std::size_t i = 0; i < places; ++i)
    for (const double half_width : tried) {
      const double share = 2.0 * static_cast<double>(i) / static_cast<double>(places - 1) - 1.0;
      candidates.push_back({.position = reach * share * 0.5 * (last->y - first->y),
                            .half_width = half_width,
                            .force = force});
    }
  return candidates;
}

/// Rows that a reading's uncertainty under reference loads is the length of, over the rms.
Eigen::MatrixXd reference_rows(const FitProblem& problem, const FitState& fitted,
                               const PressFit& fit) {
  const std::vector<NextPress> loads = candidates_of(problem.model(), fit);
  std::vector<NextPress> chosen;
  for (std::size_t i = 0; i < reference_places; ++i)
    chosen.push_back(loads[i * (loads.size() - 1) / (reference_places - 1)]);
  const std::vector<PressState> states = states_of(chosen);
  const PressReadings readings =
      problem.model().readings(fitted.pad, states, true, problem.options().at_base);
  const std::size_t n = problem.model().sites().size();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(states.size() * n),
                                               static_cast<Eigen::Index>(problem.columns()));
  double square = 0.0;
  for (std::size_t p = 0; p < states.size(); ++p)
    for (std::size_t j = 0; j < n; ++j) {
      if (!problem.used(j)) continue;
      const auto row = static_cast<Eigen::Index>(p * n + j);
      const double scale = problem.gain(fitted, j) / problem.noise(j);
      square += std::pow(scale * readings.value(p, j), 2);
      for (std::size_t i = 0; i < pad_parameter_count; ++i)
        if (const std::size_t c = problem.pad_column(static_cast<PadParameter>(i)); c != no_column)
          rows(row, static_cast<Eigen::Index>(c)) = scale * readings.by_pad[i](p, j);
      if (const std::size_t c = problem.gain_column(j); c != no_column)
        rows(row, static_cast<Eigen::Index>(c)) = scale * readings.value(p, j);
    }
  return rows / std::sqrt(square);
}

/// I + sum of B'B over chosen candidates, B in units of what is known now: inverted, and what is
/// left of the criterion.
class Design {
 public:
  /// @param aims  rows whose length the criterion is, in the same units
  Design(const std::vector<Eigen::MatrixXd>& candidates, Eigen::MatrixXd aims)
      : candidates_(candidates),
        aims_(std::move(aims)),
        inverse_(Eigen::MatrixXd::Identity(aims_.cols(), aims_.cols())) {}

  [[nodiscard]] double value() const { return (aims_ * inverse_).cwiseProduct(aims_).sum(); }

  /// What candidate `i` takes from the value.
  [[nodiscard]] double gain(std::size_t i) const {
    const auto [inner, across] = parts(i);
    return across.cwiseProduct(Lu(inner).solve(across)).sum();
  }
  void set(const std::vector<std::size_t>& chosen) {
    Eigen::MatrixXd information = Eigen::MatrixXd::Identity(aims_.cols(), aims_.cols());
    for (const std::size_t i : chosen) information += candidates_[i].transpose() * candidates_[i];
    inverse_ = Lu(information).inverse();
  }
  [[nodiscard]] std::size_t best() const {
    std::size_t best = 0;
    double most = -1.0;
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      if (const double here = gain(i); here > most * (1.0 + 1e-9)) {
        most = here;
        best = i;
      }
    return best;
  }

 private:
  [[nodiscard]] std::pair<Eigen::MatrixXd, Eigen::MatrixXd> parts(std::size_t i) const {
    const Eigen::MatrixXd& b = candidates_[i];
    const Eigen::MatrixXd known = b * inverse_;
    return {Eigen::MatrixXd::Identity(b.rows(), b.rows()) + known * b.transpose(),
            known * aims_.transpose()};
  }

  const std::vector<Eigen::MatrixXd>& candidates_;
  Eigen::MatrixXd aims_;
  Eigen::MatrixXd inverse_;
};

}  // namespace

NextPresses next_presses(const PressModel& model, const PressLog& log,
                         const CalibrationOptions& options, const PressFit& fit, std::size_t count,
                         std::optional<PadParameter> target) {
  if (model.is_skin())
    throw std::invalid_argument(
        "presses are planned on lines alone; the plain rule of a skin: the largest force, evenly "
        "over it to its edges, small and large balls in turn");
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
    state.presses[p] = {log.presses[p].shape, std::log(press.force.value), press.center.value,
                        std::log(press.half_width.value), press.friction.value};
    if (press.put_aside) done.put_aside(p, *press.put_aside);
  }
  const PressReadings now = done.readings(state, true);
  const SystemColumns columns = system_columns(done, state, now);
  const Eigen::MatrixXd root = fit_system(done, state, now, columns, {}).triangle;
  for (Eigen::Index i = 0; i < root.cols(); ++i)
    if (root(i, i) == 0.0)
      throw std::invalid_argument("something is not known at all: state a standard deviation");

  // What each candidate would add, in units of what is known.
  const std::vector<NextPress> candidates = candidates_of(model, fit);
  const PressLog log_of_candidates = imagined(log, candidates);
  const FitProblem next(model, log_of_candidates, held, left_out);
  FitState imagined_state = state_of(next, fit);
  imagined_state.presses = states_of(candidates);
  const PressReadings readings = next.readings(imagined_state, true);
  std::vector<Eigen::MatrixXd> added;
  for (std::size_t p = 0; p < candidates.size(); ++p)
    added.push_back(divide_upper(eliminated_rows(next, imagined_state, readings, p), root));

  Eigen::MatrixXd aims;
  if (target) {
    const std::size_t column = done.pad_column(*target);
    if (column == no_column)
      throw std::invalid_argument("the target " + std::string(name(*target)) +
                                  " is fixed, or cannot be identified");
    aims = Eigen::MatrixXd::Zero(1, root.cols());
    aims(0, static_cast<Eigen::Index>(column)) = 1.0;
  } else {
    aims = reference_rows(done, state, fit);
  }
  aims = divide_upper(aims, root);
  // Only the triangle of the aims matters: their length.
  if (aims.rows() > aims.cols()) aims = HouseholderQr(aims).triangle();

  Design design(added, aims);
  NextPresses result{.now = std::sqrt(design.value())};
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < count; ++k) {
    chosen.push_back(design.best());
    design.set(chosen);
  }
  for (std::size_t round = 0; round < most_exchanges; ++round) {
    bool changed = false;
    for (std::size_t& one : chosen) {
      const double before = design.value();
      const std::size_t old = std::exchange(one, chosen.back());
      std::vector<std::size_t> others;
      for (const std::size_t& other : chosen)
        if (&other != &one) others.push_back(other);
      design.set(others);
      one = design.best();
      design.set(chosen);
      if (design.value() < before * (1.0 - 1e-6)) {
        changed = true;
      } else {
        one = old;
        design.set(chosen);
      }
    }
    if (!changed) break;
  }
  // In the order in which each buys most.
  std::vector<std::size_t> order;
  while (!chosen.empty()) {
    design.set(order);
    const auto best = std::max_element(
        chosen.begin(), chosen.end(),
        [&](std::size_t a, std::size_t b) { return design.gain(a) < design.gain(b); });
    order.push_back(*best);
    chosen.erase(best);
    design.set(order);
    result.presses.push_back(candidates[order.back()]);
    NextPress& next_one = result.presses.back();
    next_one.radius = rod_radius(pad_of(model, fit), next_one.half_width, next_one.force);
    result.presses.back().remaining = std::sqrt(design.value());
  }
  return result;
}

}  // namespace tactile_net
