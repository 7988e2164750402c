#include "calibration/fit_problem.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

/// A fit of a log that does not belong to its scene would go there, and take minutes.
constexpr double most_times = 10.0;         // the stated depth; thickness a tenth of it, too
constexpr double shallowest = 0.25;         // of the stated one
constexpr double thickest = 20.0;           // arrays' lengths: a half plane for all that they read
constexpr double most_modulus = 1e4;        // times the stated one
constexpr double most_pitch = 3.0;          // times the stated one
constexpr std::size_t many_readings = 100;  // a step's system takes them three times as long
constexpr double narrowest = 1e-3;          // of the depth: a half width that no reading sees

double& member(PadState& pad, std::size_t parameter) {
  double* const members[] = {&pad.log_depth,   &pad.log_thickness, &pad.poisson_ratio,
                             &pad.log_modulus, &pad.crosstalk,     &pad.shift,
                             &pad.log_pitch,   &pad.shift_z};
  return *members[parameter];
}

double& unknown_of(PressState& press, PressQuantity quantity) {
  double* const unknowns[] = {&press.log_force, &press.center,   &press.log_half_width,
                              &press.friction,  &press.center_z, &press.friction_z};
  return *unknowns[static_cast<std::size_t>(quantity)];
}

/// The value as the fit has it, and its sd: those of forces and widths by their logarithms.
Stated as_fitted(const Stated& stated, PressQuantity quantity) {
  if (quantity == PressQuantity::force || quantity == PressQuantity::half_width)
    return {std::log(*stated.value), stated.sd / *stated.value};
  return stated;
}

void check(const PressLog& log, std::size_t readings) {
  if (log.presses.empty()) throw std::invalid_argument("a log needs one press at least");
  if (log.unloaded.frames < 2 || log.unloaded.mean.size() != readings)
    throw std::invalid_argument("a log needs unloaded frames: its noise and its offsets");
  for (const Press& press : log.presses)
    if (press.readings.size() != readings)
      throw std::invalid_argument("press " + std::to_string(press.number) +
                                  " has another number of readings than the array");
}

}  // namespace

double value_of(PadState pad, PadParameter parameter) noexcept {
  return member(pad, static_cast<std::size_t>(parameter));
}

const Stated& stated_of(const Press& press, PressQuantity quantity) noexcept {
  const Stated* const values[] = {&press.force,    &press.position,   &press.half_width,
                                  &press.friction, &press.position_z, &press.friction_z};
  return *values[static_cast<std::size_t>(quantity)];
}

FitProblem::FitProblem(const PressModel& model, const PressLog& log,
                       const CalibrationOptions& options, std::span<const bool> unread)
    : weights(log.presses.size() * model.sites().size(), 1.0),
      model_(model),
      log_(log),
      options_(options) {
  check(options);
  check(log, model.sites().size());
  set_ranges();
  const std::size_t n = model.sites().size();
  if (!unread.empty() && unread.size() != n)
    throw std::invalid_argument("unread must have a value for each reading");
  for (std::size_t j = 0; j < n; ++j) {
    noise_.push_back(log.unloaded.rms[model.sites()[j].channel]);
    if (!(noise_.back() > 0.0))
      throw std::invalid_argument("the unloaded frames of a channel do not differ: no noise");
  }
  count_columns(unread);
  for (const Press& press : log.presses) {
    PressRows rows;
    for (const PressQuantity quantity : press_quantities)
      rows.column[static_cast<std::size_t>(quantity)] =
          stated_of(press, quantity).is_exact() ? no_column : rows.columns++;
    press_rows.push_back(rows);
  }
  number_presses();
  for (std::size_t p = 0; p < log.presses.size(); ++p) {
    const Press& press = log.presses[p];
    const Place seen = seen_middle(p).value_or(Place{});
    radius_.push_back(press.radius ? model.relative_radius(*press.radius,
                                                           press.position.value.value_or(seen.y),
                                                           press.position_z.value.value_or(seen.z))
                                   : 0.0);
  }
}

void FitProblem::number_presses() noexcept {
  std::size_t next = columns_;
  for (PressRows& rows : press_rows) {
    rows.first = next;
    next += rows.columns;
  }
}

bool FitProblem::frees_friction() const noexcept {
  return std::any_of(press_rows.begin(), press_rows.end(), [](const PressRows& rows) {
    return rows.column[static_cast<std::size_t>(PressQuantity::friction)] != no_column ||
           rows.column[static_cast<std::size_t>(PressQuantity::friction_z)] != no_column;
  });
}

void FitProblem::count_columns(std::span<const bool> unread) {
  const std::vector<Site>& sites = model_.sites();
  for (std::size_t i = 0; i < pad_parameter_count; ++i) {
    const auto parameter = static_cast<PadParameter>(i);
    bool free = options_.sd(parameter) > 0.0;
    if (parameter == PadParameter::thickness)
      free = free && model_.material().layer && !options_.at_base;
    if (parameter == PadParameter::shift_z) free = free && model_.is_skin();
    if (parameter == PadParameter::pitch && free && model_.is_curved())
      throw std::invalid_argument(
          "pitch_sd is of taxels on a plane: those of a curved skin have places in space, which "
          "are taken as exact; leave it out");
    pad_column_[i] = free ? columns_++ : no_column;
  }
  const std::size_t n = sites.size();
  used_.assign(n, true);
  for (std::size_t j = 0; j < unread.size(); ++j) used_[j] = !unread[j];

  GainSharing sharing = options_.gains;
  if (options_.gain_sd == 0.0) sharing = GainSharing::channel;
  const bool free = options_.gain_sd > 0.0 || options_.mean_gain_sd > 0.0;
  gain_of_.assign(n, no_column);
  first_gain_ = columns_;
  std::vector<std::size_t> of_key(n, no_column);
  for (std::size_t j = 0; free && j < n; ++j) {
    if (!used_[j]) continue;
    const std::size_t key = sharing == GainSharing::reading ? j
                            : sharing == GainSharing::taxel ? sites[j].taxel
                                                            : sites[j].channel;
    if (of_key[key] == no_column) {
      of_key[key] = gains_++;
      const std::size_t group = sharing == GainSharing::taxel ? 0 : sites[j].channel;
      gain_blocks_.resize(std::max(gain_blocks_.size(), group + 1));
      gain_blocks_[group].push_back(of_key[key]);
    }
    gain_of_[j] = of_key[key];
  }
  first_offset_ = first_gain_ + gains_;
  columns_ = first_offset_ + n;
}

void FitProblem::set_ranges() {
  first_ = last_ = {model_.sites().front().y, model_.sites().front().z};
  for (const Site& site : model_.sites()) {
    first_ = {std::min(first_.y, site.y), std::min(first_.z, site.z)};
    last_ = {std::max(last_.y, site.y), std::max(last_.z, site.z)};
  }
  reach_ = std::max({last_.y - first_.y, last_.z - first_.z, model_.pitch(), model_.depth()});
  const auto set = [&](PadParameter parameter, double low, double high) {
    range_[static_cast<std::size_t>(parameter)] = {low, high};
  };
  // Taxels five depths apart miss most presses, and no array sees deeper than it is long.
  const double depth = model_.depth();
  set(PadParameter::depth,
      std::log(std::max(shallowest, std::min(0.5, 0.2 * model_.pitch() / depth))),
      std::log(std::min(
          {most_times, std::max(2.0, reach_ / depth), model_.most_thickness() / deepest()})));
  const double thickness = model_.material().layer ? model_.material().layer->thickness : depth;
  set(PadParameter::thickness, -std::log(most_times),
      std::log(std::min(std::max(most_times, thickest * reach_ / thickness),
                        model_.most_thickness() / thickness)));
  set(PadParameter::poisson_ratio, 0.0, 0.5);
  set(PadParameter::youngs_modulus, -std::log(most_modulus), std::log(most_modulus));
  set(PadParameter::crosstalk, 0.0, model_.most_crosstalk());
  set(PadParameter::shift, -reach_, reach_);
  set(PadParameter::shift_z, -reach_, reach_);
  set(PadParameter::pitch, -std::log(most_pitch), std::log(most_pitch));
}

void FitProblem::put_aside(std::size_t press, PressQuantity quantity) {
  PressRows& rows = press_rows[press];
  rows.put_aside = quantity;
  std::size_t& column = rows.column[static_cast<std::size_t>(quantity)];
  if (column == no_column) column = rows.columns++;
  number_presses();
}

std::size_t FitProblem::readings_used() const noexcept {
  return static_cast<std::size_t>(std::count(used_.begin(), used_.end(), true));
}

double FitProblem::gain(const FitState& state, std::size_t reading) const noexcept {
  return gain_of_[reading] == no_column ? 1.0 : std::exp(state.log_gain[gain_of_[reading]]);
}

Material FitProblem::material_at(const PadState& pad) const {
  Material material = model_.material();
  material.poisson_ratio = pad.poisson_ratio;
  material.youngs_modulus *= std::exp(pad.log_modulus);
  if (material.layer)
    material.layer->thickness = options_.at_base
                                    ? model_.depth() * std::exp(pad.log_depth)
                                    : material.layer->thickness * std::exp(pad.log_thickness);
  return material;
}

double FitProblem::residual(const FitState& state, const PressReadings& readings, std::size_t p,
                            std::size_t j) const noexcept {
  const double above = log_.presses[p].readings[j] - log_.unloaded.mean[j];
  return (gain(state, j) * readings.value(p, j) - above) / noise_[j] + state.offset[j];
}

bool FitProblem::holds(std::size_t press, PressQuantity quantity) const noexcept {
  const Stated& stated = stated_of(log_.presses[press], quantity);
  return stated.value && stated.sd > 0.0 && press_rows[press].put_aside != quantity;
}

double FitProblem::deviation(const FitState& state, std::size_t p, PressQuantity quantity) const {
  if (!holds(p, quantity)) return 0.0;
  const Stated stated = as_fitted(stated_of(log_.presses[p], quantity), quantity);
  PressState at = state.presses[p];
  return (unknown_of(at, quantity) - *stated.value) / stated.sd;
}

std::vector<PressPrior> FitProblem::press_priors(const FitState& state, std::size_t p) const {
  const Press& press = log_.presses[p];
  const PressState& at = state.presses[p];
  const PressRows& rows = press_rows[p];
  std::vector<PressPrior> priors;
  for (const PressQuantity quantity : press_quantities) {
    if (!holds(p, quantity)) continue;
    const auto i = static_cast<std::size_t>(quantity);
    const double root = std::sqrt(rows.weight[i]);
    PressPrior prior{.residual = root * deviation(state, p, quantity)};
    prior.by_press[i] = root / as_fitted(stated_of(press, quantity), quantity).sd;
    priors.push_back(prior);
  }
  if (press.radius) {
    const ContactForce rod =
        model_.contact_force(material_at(state.pad), std::exp(at.log_half_width), radius_[p]);
    const double sd = std::max(options_.half_width_sd, least_tie_sd) * rod.by_log_half_width;
    PressPrior tie{.residual = (rod.log_force - at.log_force) / sd};
    tie.by_press[0] = -1.0 / sd;
    tie.by_press[2] = rod.by_log_half_width / sd;
    const auto thickness =
        static_cast<std::size_t>(options_.at_base ? PadParameter::depth : PadParameter::thickness);
    tie.by_pad[thickness] = rod.by_log_thickness / sd;
    tie.by_pad[static_cast<std::size_t>(PadParameter::poisson_ratio)] = rod.by_poisson_ratio / sd;
    tie.by_pad[static_cast<std::size_t>(PadParameter::youngs_modulus)] = 1.0 / sd;
    priors.push_back(tie);
  } else if (!press.half_width.value || rows.put_aside == PressQuantity::half_width) {
    const double difference = at.log_half_width - std::log(weak_width_share * model_.depth());
    PressPrior weak{.residual = difference / weak_width_sd, .is_weak = true};
    weak.by_press[2] = 1.0 / weak_width_sd;
    priors.push_back(weak);
  }
  return priors;
}

Eigen::MatrixXd FitProblem::pad_priors(const FitState& state) const {
  const auto width = static_cast<Eigen::Index>(pad_columns() + 1);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(pad_parameter_count, width);
  Eigen::Index row = 0;
  const PadState nominal = model_.nominal();
  for (std::size_t i = 0; i < pad_parameter_count; ++i) {
    const double sd = options_.sd(static_cast<PadParameter>(i));
    if (pad_column_[i] == no_column || std::isinf(sd)) continue;
    PadState from = nominal;
    PadState to = state.pad;
    rows(row, static_cast<Eigen::Index>(pad_column_[i])) = 1.0 / sd;
    rows(row++, width - 1) = (member(to, i) - member(from, i)) / sd;
  }
  return rows.topRows(row);
}

FitProblem::GainPrior FitProblem::gain_prior() const noexcept {
  const bool alone = options_.gain_sd == 0.0 || options_.gains == GainSharing::channel;
  return alone ? GainPrior{options_.mean_gain_sd, 0.0}
               : GainPrior{options_.gain_sd, options_.mean_gain_sd};
}

bool FitProblem::gains_are_local() const noexcept {
  return options_.gain_sd > 0.0 && options_.gains != GainSharing::channel;
}

bool FitProblem::readings_first() const noexcept {
  return readings_used() > many_readings && unknowns() - columns_ < gains_ + readings_used();
}

Eigen::MatrixXd FitProblem::common_priors(const FitState& state) const {
  const std::size_t n = model_.sites().size();
  const auto width = static_cast<Eigen::Index>(columns_ + 1);
  Eigen::MatrixXd rows =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(pad_parameter_count + gains_ + n), width);
  const Eigen::MatrixXd pad = pad_priors(state);
  Eigen::Index row = pad.rows();
  rows.topLeftCorner(row, pad.cols() - 1) = pad.leftCols(pad.cols() - 1);
  rows.topRightCorner(row, 1) = pad.rightCols(1);
  // (a I + b 11')^(-1/2) = (I - kappa 11'/size) / sqrt(a) for every block that shares a mean.
  for (const std::vector<std::size_t>& block : gain_blocks_) {
    const auto size = static_cast<double>(block.size());
    const double a = std::pow(gain_prior().sd, 2);
    if (std::isinf(a) || block.empty()) continue;
    const double kappa = 1.0 - std::sqrt(a / (a + size * std::pow(gain_prior().mean_sd, 2)));
    double mean = 0.0;
    for (const std::size_t gain : block) mean += state.log_gain[gain] / size;
    for (const std::size_t gain : block) {
      for (const std::size_t other : block)
        rows(row, eigen_index(first_gain_ + other)) = -kappa / size / std::sqrt(a);
      rows(row, eigen_index(first_gain_ + gain)) += 1.0 / std::sqrt(a);
      rows(row++, width - 1) = (state.log_gain[gain] - kappa * mean) / std::sqrt(a);
    }
  }
  const double root = std::sqrt(static_cast<double>(log_.unloaded.frames));
  for (std::size_t j = 0; j < n; ++j) {
    rows(row, eigen_index(first_offset_ + j)) = root;
    rows(row++, width - 1) = root * state.offset[j];
  }
  return rows.topRows(row);
}

double FitProblem::objective(const FitState& state, const PressReadings& readings) const {
  const std::size_t n = model_.sites().size();
  double sum = common_priors(state).rightCols(1).squaredNorm();
  for (std::size_t p = 0; p < log_.presses.size(); ++p) {
    for (std::size_t j = 0; j < n; ++j) {
      if (!used_[j]) continue;
      const double r = residual(state, readings, p, j);
      sum += weights[p * n + j] * r * r;
    }
    for (const PressPrior& prior : press_priors(state, p)) sum += prior.residual * prior.residual;
  }
  return 0.5 * sum;
}

FitState FitProblem::moved(const FitState& state, const Eigen::VectorXd& common,
                           std::span<const std::array<double, press_unknowns>> presses) const {
  FitState next = state;
  for (std::size_t i = 0; i < pad_parameter_count; ++i)
    if (pad_column_[i] != no_column) {
      double& value = member(next.pad, i);
      value = std::clamp(value + common(static_cast<Eigen::Index>(pad_column_[i])), range_[i].low,
                         range_[i].high);
    }
  for (std::size_t g = 0; g < gains_; ++g)
    next.log_gain[g] += common(static_cast<Eigen::Index>(first_gain_ + g));
  for (std::size_t j = 0; j < next.offset.size(); ++j)
    next.offset[j] += common(static_cast<Eigen::Index>(first_offset_ + j));
  for (std::size_t p = 0; p < presses.size(); ++p)
    for (const PressQuantity quantity : press_quantities)
      unknown_of(next.presses[p], quantity) += presses[p][static_cast<std::size_t>(quantity)];
  hold_thickness(next.pad);
  follow_exact_ties(next);
  for (std::size_t p = 0; p < presses.size(); ++p) hold_press(next.presses[p], press_rows[p]);
  return next;
}

void FitProblem::hold_press(PressState& state, const PressRows& rows) const {
  if (rows.column[static_cast<std::size_t>(PressQuantity::position)] != no_column)
    state.center = std::clamp(state.center, first_.y - reach_, last_.y + reach_);
  if (rows.column[static_cast<std::size_t>(PressQuantity::position_z)] != no_column)
    state.center_z = std::clamp(state.center_z, first_.z - reach_, last_.z + reach_);
  if (rows.column[static_cast<std::size_t>(PressQuantity::half_width)] != no_column)
    state.log_half_width = std::clamp(state.log_half_width, std::log(narrowest * model_.depth()),
                                      std::log(2.0 * reach_));
}

double FitProblem::deepest() const {
  double deepest = 0.0;
  for (const Site& site : model_.sites()) deepest = std::max(deepest, site.depth);
  return deepest;
}

double FitProblem::log_room(const PadState& pad) const {
  return std::log(model_.material().layer->thickness / deepest()) + pad.log_thickness -
         pad.log_depth;
}

void FitProblem::hold_thickness(PadState& pad) const {
  if (!model_.material().layer || options_.at_base) return;
  const double missing = std::max(0.0, -log_room(pad));
  if (pad_column(PadParameter::thickness) != no_column)
    pad.log_thickness += missing;
  else
    pad.log_depth -= missing;
}

void FitProblem::follow_exact_ties(FitState& state) const {
  if (options_.half_width_sd >= soft_tie_sd) return;
  const Material material = material_at(state.pad);
  for (std::size_t p = 0; p < state.presses.size(); ++p)
    if (log_.presses[p].radius && press_rows[p].column[2] != no_column)
      state.presses[p].log_half_width = std::log(
          model_.contact_half_width(material, std::exp(state.presses[p].log_force), radius_[p]));
}

}  // namespace tactile_net
