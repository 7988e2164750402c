#include "calibration/fit_doubts.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "numeric/robust.hpp"

namespace tactile_net {
namespace {

constexpr double far_off = 4.0;                 // stated sds of a parameter or a channel's mean
constexpr double silent_gain = 0.1;             // of the channel's median: a taxel that is dead
constexpr std::size_t outliers_of_a_press = 3;  // more than these: what is stated of it is wrong
constexpr double explained_share = 0.3;         // of the squares, for a value to be blamed
constexpr double light = 0.5;                   // mean robust weight of a reading that lies
constexpr double clear = 8.0;                   // sds of the noise
constexpr std::size_t fewest_of_a_trend = 8;    // presses
constexpr double too_far_apart = 1e-3;          // p of what is stated of all presses
constexpr double least_told = 0.1;              // of a stated variance, by the readings
constexpr double far_understated = 2.0;  // rms in the stated sds: the fit follows wrong values

/// Whether another value would change a reading, and each stay finite.
bool is_asked(const PressModel& model, PressQuantity quantity) {
  const bool along_z =
      quantity == PressQuantity::position_z || quantity == PressQuantity::friction_z;
  const bool drags = quantity == PressQuantity::friction || quantity == PressQuantity::friction_z;
  return (model.is_skin() || !along_z) && (!drags || model.holds_drags());
}

/// The press with one value at other places all over its range, and the force that fits each best
/// where none is stated: how small the residuals become.
class OtherValues {
 public:
  OtherValues(const FitProblem& problem, const FitState& state, const PressReadings& readings,
              std::size_t p)
      : problem_(problem), state_(state), p_(p) {
    for (std::size_t j = 0; j < problem.model().sites().size(); ++j) {
      if (!problem.used(j)) continue;
      used_.push_back(j);
      slope_.push_back(problem.gain(state, j) / problem.noise(j));
      target_.push_back(slope_.back() * readings.value(p, j) -
                        problem.residual(state, readings, p, j));
    }
    as_it_is_ = squares(readings, p, false);
  }

  [[nodiscard]] double as_it_is() const noexcept { return as_it_is_; }

  [[nodiscard]] double least(PressQuantity quantity) const {
    const PressState& at = state_.presses[p_];
    const FitProblem::Place& first = problem_.first();
    const FitProblem::Place& last = problem_.last();
    // A width that nobody stated has bent to what is wrong: others are tried beside it.
    std::vector<double> widths{at.log_half_width};
    if (problem_.press_rows[p_].column[2] != no_column && quantity != PressQuantity::half_width)
      for (const double share : {0.4, 0.8, 1.6})
        widths.push_back(std::log(share * problem_.model().depth()) + state_.pad.log_depth);
    std::vector<PressState> tried;
    constexpr int steps = 60;
    const int count = quantity == PressQuantity::force ? 0 : steps;
    for (const double log_half_width : widths)
      for (int i = -count; i <= count; ++i) {
        const double share = static_cast<double>(i) / steps;
        PressState one = at;
        one.log_half_width = log_half_width;
        if (quantity == PressQuantity::position)
          one.center = 0.5 * (first.y + last.y) + 0.5 * share * (last.y - first.y);
        if (quantity == PressQuantity::position_z)
          one.center_z = 0.5 * (first.z + last.z) + 0.5 * share * (last.z - first.z);
        if (quantity == PressQuantity::half_width) one.log_half_width += 2.0 * share;
        if (quantity == PressQuantity::friction) one.friction = share;
        if (quantity == PressQuantity::friction_z) one.friction_z = share;
        tried.push_back(one);
      }
    const PressReadings readings =
        problem_.model().readings(state_.pad, tried, false, problem_.options().at_base);
    double least = as_it_is_;
    for (std::size_t k = 0; k < tried.size(); ++k)
      least = std::min(least, squares(readings, k, quantity == PressQuantity::force));
    return least;
  }

 private:
  [[nodiscard]] double squares(const PressReadings& readings, std::size_t k, bool any_force) const {
    double own = 0.0;
    double both = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < used_.size(); ++i) {
      const double value = slope_[i] * readings.value(k, used_[i]);
      own += value * value;
      both += value * target_[i];
      all += target_[i] * target_[i];
    }
    const bool is_free = any_force || problem_.press_rows[p_].column[0] != no_column;
    const double scale = is_free && own > 0.0 ? std::max(0.0, both / own) : 1.0;
    return std::max(0.0, all - 2.0 * scale * both + scale * scale * own);
  }

  const FitProblem& problem_;
  const FitState& state_;
  std::size_t p_;
  std::vector<std::size_t> used_{};
  std::vector<double> slope_{}, target_{};
  double as_it_is_ = 0.0;
};

class Doubts {
 public:
  Doubts(const FitProblem& problem, const FitState& state, const CalibrationOptions& stated,
         PressFit& fit)
      : problem_(problem), state_(state), stated_(stated), fit_(fit) {}

  void write() {
    parameters();
    if (problem_.options().gains != GainSharing::channel) gains();
    presses();
    stated_sds();
    if (state_.presses.size() >= fewest_of_a_trend) trend();
    const bool far_off_together =
        std::any_of(fit_.understated.begin(), fit_.understated.end(),
                    [](const UnderstatedSd& one) { return one.rms > far_understated; });
    if (!fit_.contradicted.empty() || !fit_.contradicted_gains.empty() ||
        !fit_.doubtful_readings.empty() || !fit_.contradicted_presses.empty() || far_off_together)
      fit_.verdict = FitVerdict::poor_fit;
  }

 private:
  /// Units that are wrong by 1000 end as a gain of 0.001 with small residuals.
  void parameters() {
    for (const PadParameter parameter : fit_.free) {
      if (deviation_from_stated(parameter, fit_.at(parameter), stated_.sd(parameter)) > far_off ||
          ran_away(parameter))
        fit_.contradicted.push_back(parameter);
    }
    for (std::size_t c = 0; c < fit_.mean_gain.size(); ++c)
      if (stated_.mean_gain_sd > 0.0 &&
          std::abs(std::log(fit_.mean_gain[c].value)) > far_off * stated_.mean_gain_sd)
        fit_.contradicted_gains.push_back(c);
  }

  /// At an end that no pad of this array is at; a layer may be too thick to be seen, nu is 0.5.
  [[nodiscard]] bool ran_away(PadParameter parameter) const {
    if (parameter == PadParameter::thickness || parameter == PadParameter::poisson_ratio ||
        parameter == PadParameter::crosstalk)
      return false;
    const double value = value_of(state_.pad, parameter);
    const FitProblem::Range& range = problem_.range(parameter);
    return value <= range.low || value >= range.high;
  }

  void gains() {
    const std::vector<Site>& sites = problem_.model().sites();
    for (std::size_t c = 0; c < fit_.mean_gain.size(); ++c) {
      std::vector<double> logs;
      for (std::size_t j = 0; j < sites.size(); ++j)
        if (sites[j].channel == c && problem_.gain_column(j) != no_column)
          logs.push_back(std::log(fit_.gains[j]));
      if (logs.size() < 3) continue;
      const double middle = median(logs);
      for (std::size_t j = 0; j < sites.size(); ++j) {
        if (sites[j].channel != c || problem_.gain_column(j) == no_column) continue;
        const double apart = std::log(fit_.gains[j]) - middle;
        if (std::abs(apart) > outlying * stated_.gain_sd || apart < std::log(silent_gain) ||
            is_put_down(j))
          fit_.doubtful_readings.push_back(j);
      }
    }
  }

  /// A robust fit lets the readings of a dead taxel go, and keeps the gain that the scene states.
  [[nodiscard]] bool is_put_down(std::size_t j) const {
    const std::size_t n = problem_.model().sites().size();
    double weight = 0.0;
    std::size_t reached = 0;
    for (std::size_t p = 0; p < state_.presses.size(); ++p) {
      const double above = problem_.log().presses[p].readings[j] - problem_.log().unloaded.mean[j];
      const double model = above / problem_.noise(j) - fit_.residuals(p, j);
      if (std::abs(model) < clear) continue;
      ++reached;
      weight += problem_.weights[p * n + j];
    }
    return reached >= 2 && weight < light * static_cast<double>(reached);
  }

  void presses() {
    const PressReadings readings = problem_.readings(state_, false);
    for (std::size_t p = 0; p < state_.presses.size(); ++p) {
      if (problem_.press_rows[p].put_aside) continue;
      if (const auto found = contradiction(problem_, state_, readings, p))
        fit_.contradicted_presses.push_back(*found);
    }
    std::stable_sort(fit_.contradicted_presses.begin(), fit_.contradicted_presses.end(),
                     [&](const ContradictedPress& a, const ContradictedPress& b) {
                       return rms_of(a.press) > rms_of(b.press);
                     });
  }

  /// One wrong force (3 % off where 1 % is stated) is absorbed by its own prior and cannot be seen;
  /// all presses together reveal it. The fitted value lies between the stated one and the
  /// readings', so its variance is the stated variance less the variance that the fit leaves.
  void stated_sds() {
    if (stated_.robust) return;  // what stands out counts little there
    for (const PressQuantity quantity : press_quantities) {
      UnderstatedSd all{.quantity = quantity};
      double squares = 0.0;
      for (std::size_t p = 0; p < state_.presses.size(); ++p) {
        const double z = problem_.deviation(state_, p, quantity);
        if (z == 0.0 || std::abs(z) > outlying) continue;  // those are named one by one
        const double left =
            fit_.presses[p].at(quantity).sd / stated_of(problem_.log().presses[p], quantity).sd;
        const double told = 1.0 - left * left;
        if (told < least_told) continue;
        ++all.presses;
        squares += z * z / told;
      }
      if (all.presses == 0) continue;
      const auto count = static_cast<double>(all.presses);
      const boost::math::chi_squared_distribution<double> expected(count);
      all.p = boost::math::cdf(boost::math::complement(expected, squares));
      all.rms = std::sqrt(squares / count);
      if (all.p < too_far_apart) fit_.understated.push_back(all);
    }
  }

  /// Of the fitted force over the stated one, where a stated sd lets it give way.
  [[nodiscard]] double log_of_force(std::size_t p) const {
    if (!problem_.holds(p, PressQuantity::force)) return 0.0;
    return state_.presses[p].log_force - std::log(*problem_.log().presses[p].force.value);
  }

  [[nodiscard]] double rms_of(std::size_t number) const {
    for (const FittedPress& press : fit_.presses)
      if (press.number == number) return press.rms;
    return 0.0;
  }

  /// Spearman's correlation with the order, whose t = r sqrt((n - 2) / (1 - r^2)) is Student's.
  void trend() {
    const std::size_t n = state_.presses.size();
    std::vector<double> sizes;
    std::vector<double> factors;
    std::vector<double> constants;
    for (std::size_t p = 0; p < n; ++p) {
      double both = 0.0;
      double own = 0.0;
      double sum = 0.0;
      for (std::size_t j = 0; j < problem_.model().sites().size(); ++j) {
        if (!problem_.used(j)) continue;
        const double above =
            (problem_.log().presses[p].readings[j] - problem_.log().unloaded.mean[j]) /
            problem_.noise(j);
        const double model = above - fit_.residuals(p, j);
        both += model * fit_.residuals(p, j);
        own += model * model;
        sum += fit_.residuals(p, j);
      }
      sizes.push_back(fit_.presses[p].rms);
      factors.push_back((own > 0.0 ? both / own : 0.0) + log_of_force(p));
      constants.push_back(sum);
    }
    const auto take = [&](TrendOf of, const std::vector<double>& values) {
      const double r = rank_correlation(values);
      const auto dof = static_cast<double>(n - 2);
      const double t = std::abs(r) * std::sqrt(dof / std::max(1e-12, 1.0 - r * r));
      const boost::math::students_t_distribution<double> student(dof);
      const double p =
          std::min(1.0, 3.0 * 2.0 * boost::math::cdf(boost::math::complement(student, t)));
      if (p < fit_.time_trend.p) fit_.time_trend = {of, r, p};
    };
    take(TrendOf::size, sizes);
    take(TrendOf::gain, factors);
    take(TrendOf::offset, constants);
  }

  static double rank_correlation(const std::vector<double>& values) {
    const std::size_t n = values.size();
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    double squares = 0.0;
    for (std::size_t rank = 0; rank < n; ++rank)
      squares += std::pow(static_cast<double>(rank) - static_cast<double>(order[rank]), 2);
    const auto count = static_cast<double>(n);
    return 1.0 - 6.0 * squares / (count * (count * count - 1.0));
  }

  const FitProblem& problem_;
  const FitState& state_;
  const CalibrationOptions& stated_;
  PressFit& fit_;
};

}  // namespace

double deviation_from_stated(PadParameter parameter, const FittedValue& value, double sd) {
  if (!(sd > 0.0)) return 0.0;
  const bool is_log = value.nominal > 0.0 && parameter != PadParameter::poisson_ratio;
  return (is_log ? std::abs(std::log(value.value / value.nominal))
                 : std::abs(value.value - value.nominal)) /
         sd;
}

std::optional<ContradictedPress> contradiction(const FitProblem& problem, const FitState& state,
                                               const PressReadings& readings, std::size_t press) {
  const Press& log = problem.log().presses[press];
  ContradictedPress found{.press = log.number};
  for (std::size_t j = 0; j < problem.model().sites().size(); ++j)
    if (problem.used(j) && std::abs(problem.residual(state, readings, press, j)) > outlying)
      ++found.readings;
  for (const PressQuantity quantity : press_quantities)
    if (const double z = problem.deviation(state, press, quantity);
        std::abs(z) > std::max(outlying, std::abs(found.deviation))) {
      found.quantity = quantity;
      found.deviation = z;
    }
  if (found.deviation == 0.0) {
    if (found.readings <= outliers_of_a_press) return std::nullopt;
    const OtherValues others(problem, state, readings, press);
    double least = (1.0 - explained_share) * others.as_it_is();
    bool any = false;
    for (const PressQuantity quantity : press_quantities) {
      const Stated& stated = stated_of(log, quantity);
      if (!stated.value || !is_asked(problem.model(), quantity)) continue;
      if (const double squares = others.least(quantity); squares < least) {
        least = squares;
        found.quantity = quantity;
        any = true;
      }
    }
    if (!any) return std::nullopt;
  }
  found.stated = *stated_of(log, found.quantity).value;
  return found;
}

void doubt(const FitProblem& problem, const FitState& state, const CalibrationOptions& stated,
           PressFit& fit) {
  Doubts(problem, state, stated, fit).write();
}

}  // namespace tactile_net
