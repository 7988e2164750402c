#include "calibration/fit_summary.hpp"

#include <algorithm>
#include <array>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <limits>

#include "calibration/fit_covariance.hpp"
#include "calibration/fit_doubts.hpp"
#include "calibration/fit_system.hpp"
#include "calibration/null_space.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double poor_rms = 1.1;  // with thousands of readings p alone condemns every real pad
constexpr double poor_p = 1e-3;

ValueVerdict verdict_of(double sd, double prior_sd) {
  if (std::isinf(sd)) return ValueVerdict::not_identifiable;
  if (std::isinf(prior_sd)) return sd > 0.1 ? ValueVerdict::weak : ValueVerdict::identified;
  if (sd > 0.9 * prior_sd) return ValueVerdict::prior_only;
  return sd > 0.5 * prior_sd ? ValueVerdict::weak : ValueVerdict::identified;
}

class Summary {
 public:
  Summary(const FitProblem& problem, const Descent& best, const CalibrationOptions& stated,
          PressFit& fit)
      : problem_(problem),
        state_(best.state),
        stated_(stated),
        fit_(fit),
        readings_(problem.readings(state_, true)),
        columns_(system_columns(problem, state_, readings_)),
        parts_(active_bounds(problem, state_, columns_)),
        covariance_(fit_covariance(problem, state_, readings_, columns_, parts_)) {}

  void write() {
    residuals();
    presses();
    goodness();
    pad();
    gains();
    matrices();
  }

 private:
  void residuals() {
    const std::size_t n = problem_.model().sites().size();
    const std::size_t count = state_.presses.size();
    fit_.residuals = fit_.residuals_before = {count, n, std::vector<double>(count * n)};
    const PressReadings nominal =
        problem_.model().readings(problem_.model().nominal(), state_.presses, false);
    FitState plain = state_;
    std::fill(plain.log_gain.begin(), plain.log_gain.end(), 0.0);
    std::fill(plain.offset.begin(), plain.offset.end(), 0.0);
    for (std::size_t p = 0; p < count; ++p)
      for (std::size_t j = 0; j < n; ++j) {
        if (!problem_.used(j)) continue;
        const double r = -problem_.residual(state_, readings_, p, j);  // measured minus model
        fit_.residuals(p, j) = r;
        fit_.residuals_before(p, j) = -problem_.residual(plain, nominal, p, j);
        const double w = problem_.weights[p * n + j];
        fit_.chi_squared += w * r * r;
        fit_.dof += w;
        if (std::abs(r) > outlying)
          fit_.outliers.push_back({problem_.log().presses[p].number, j, r});
      }
  }

  void presses() {
    const std::size_t n = problem_.model().sites().size();
    double leverage = 0.0;  // of what is stated of presses
    double unknowns = 0.0;
    for (std::size_t p = 0; p < state_.presses.size(); ++p) {
      const PressState& at = state_.presses[p];
      const Press& log = problem_.log().presses[p];
      const PressRows& rows = problem_.press_rows[p];
      const auto m = eigen_index(rows.columns);
      FittedPress press{.number = log.number,
                        .force = {std::exp(at.log_force)},
                        .center = {at.center},
                        .half_width = {std::exp(at.log_half_width)},
                        .friction = {at.friction},
                        .center_z = {at.center_z},
                        .friction_z = {at.friction_z},
                        .put_aside = rows.put_aside};
      const auto& [all, cross, regular] = covariance_.presses[p];
      if (m > 0 && regular) {
        const double scale[] = {press.force.value, 1.0, press.half_width.value, 1.0, 1.0, 1.0};
        ValueWithSd* const values[] = {&press.force,    &press.center,   &press.half_width,
                                       &press.friction, &press.center_z, &press.friction_z};
        for (std::size_t i = 0; i < press_unknowns; ++i)
          if (rows.column[i] != no_column)
            values[i]->sd =
                scale[i] * std::sqrt(all(eigen_index(rows.column[i]), eigen_index(rows.column[i])));
        unknowns += static_cast<double>(m);
        for (const PressPrior& prior : problem_.press_priors(state_, p))
          leverage += leverage_of(prior, rows, all, cross);
      }
      double sum = 0.0;
      double before = 0.0;
      double weight = 0.0;
      for (std::size_t j = 0; j < n; ++j) {
        sum += fit_.residuals(p, j) * fit_.residuals(p, j);
        before += fit_.residuals_before(p, j) * fit_.residuals_before(p, j);
        weight += problem_.used(j) ? problem_.weights[p * n + j] : 0.0;
      }
      const auto used = static_cast<double>(problem_.readings_used());
      press.rms = std::sqrt(sum / used);
      press.rms_before = std::sqrt(before / used);
      press.weight = weight / used;
      press.half_width_at_bound =
          rows.column[2] != no_column &&
          press.half_width.value < 0.1 * problem_.model().depth() * std::exp(state_.pad.log_depth);
      fit_.presses.push_back(press);
    }
    const Eigen::MatrixXd priors = problem_.common_priors(state_);
    leverage += covariance_.leverage(priors.leftCols(priors.cols() - 1));
    fit_.dof -= covariance_.rank + unknowns - leverage;
  }

  /// l' C l of one prior row.
  [[nodiscard]] double leverage_of(const PressPrior& prior, const PressRows& rows,
                                   const Eigen::MatrixXd& own, const Eigen::MatrixXd& cross) const {
    Eigen::VectorXd press = Eigen::VectorXd::Zero(eigen_index(rows.columns));
    for (std::size_t i = 0; i < press_unknowns; ++i)
      if (rows.column[i] != no_column) press(eigen_index(rows.column[i])) = prior.by_press[i];
    Eigen::VectorXd common = Eigen::VectorXd::Zero(covariance_.matrix.cols());
    for (std::size_t i = 0; i < pad_parameter_count; ++i)
      if (const std::size_t c = problem_.pad_column(static_cast<PadParameter>(i)); c != no_column)
        common(eigen_index(c)) = prior.by_pad[i];
    return press.dot(own * press) + 2.0 * press.dot(cross * common) +
           common.dot(covariance_.matrix * common);
  }

  void goodness() {
    const double noise_dof = static_cast<double>(problem_.log().unloaded.frames - 1) *
                             static_cast<double>(problem_.readings_used());
    if (!(fit_.dof >= 1.0)) {  // fewer rows than unknowns: the priors alone hold them
      fit_.dof = std::max(fit_.dof, 0.0);
      return;
    }
    fit_.rms = std::sqrt(fit_.chi_squared / fit_.dof);
    const boost::math::fisher_f_distribution<double> distribution(fit_.dof, noise_dof);
    fit_.p = boost::math::cdf(boost::math::complement(distribution, fit_.rms * fit_.rms));
    if (fit_.p < poor_p && fit_.rms > poor_rms) fit_.verdict = FitVerdict::poor_fit;
    scale_ = std::max(1.0, fit_.rms);
  }

  [[nodiscard]] double log_sd(std::size_t column) const {
    if (covariance_.unknown[column]) return infinity;
    return scale_ * std::sqrt(covariance_.matrix(eigen_index(column), eigen_index(column)));
  }

  void pad() {
    fit_.pad = state_.pad;
    const Material& nominal = problem_.model().material();
    const double h = nominal.layer ? nominal.layer->thickness : 0.0;
    std::array<double, pad_parameter_count> units{};  // of those that are fitted by logarithms
    units[static_cast<std::size_t>(PadParameter::depth)] = problem_.model().depth();
    units[static_cast<std::size_t>(PadParameter::thickness)] = h;
    units[static_cast<std::size_t>(PadParameter::youngs_modulus)] = nominal.youngs_modulus;
    units[static_cast<std::size_t>(PadParameter::pitch)] = problem_.model().pitch();
    for (std::size_t i = 0; i < pad_parameter_count; ++i) {
      const auto parameter = static_cast<PadParameter>(i);
      FittedValue& result = fit_.parameters[i];
      const bool is_log = units[i] > 0.0;
      const double value = value_of(state_.pad, parameter);
      result.nominal = is_log ? units[i] : value_of(problem_.model().nominal(), parameter);
      result.value = is_log ? units[i] * std::exp(value) : value;
      if (parameter == PadParameter::thickness && stated_.at_base && h > 0.0)
        result.value = fit_.parameters[0].value;
      const double unit = is_log ? result.value : 1.0;
      result.prior_sd = stated_.sd(parameter) * (is_log ? result.nominal : 1.0);
      const std::size_t column = problem_.pad_column(parameter);
      if (column == no_column) {
        if (takes_part(fit_.null_directions, parameter)) {
          result.verdict = ValueVerdict::not_identifiable;
          result.sd = infinity;
        } else if (parameter == PadParameter::thickness && stated_.at_base) {
          result.sd = fit_.parameters[0].sd;
          result.verdict = fit_.parameters[0].verdict;
        }
        continue;
      }
      if (parts_.frozen[i] || (parameter == PadParameter::thickness && parts_.thickness_follows)) {
        result.verdict = ValueVerdict::at_bound;
        continue;
      }
      result.sd = unit * log_sd(column);
      result.verdict = verdict_of(log_sd(column), stated_.sd(parameter));
    }
  }

  void gains() {
    const std::vector<Site>& sites = problem_.model().sites();
    const std::size_t n = sites.size();
    const std::vector<Channel>& channel = problem_.model().channels();
    const double prior = std::hypot(stated_.gain_sd, stated_.mean_gain_sd);
    fit_.mean_gain.resize(channel.size());
    for (std::size_t c = 0; c < channel.size(); ++c) {
      std::vector<std::size_t> members;
      for (std::size_t j = 0; j < n; ++j)
        if (sites[j].channel == c && problem_.gain_column(j) != no_column) members.push_back(j);
      mean_gain(c, members, prior);
    }
    fit_.gain_about_mean = relative_;
    for (std::size_t j = 0; j < n; ++j) {
      const double gain = problem_.gain(state_, j);
      fit_.gains.push_back(gain);
      FittedValue value{.nominal = 1.0, .value = gain, .prior_sd = prior};
      if (const std::size_t column = problem_.gain_column(j); column != no_column) {
        value.sd = gain * log_sd(column);
        // A channel's gains that scale together are none of them known, however well apart.
        const ValueVerdict mean = fit_.mean_gain[sites[j].channel].verdict;
        value.verdict = mean == ValueVerdict::not_identifiable
                            ? mean
                            : std::max(relative_[j], verdict_of(log_sd(column), prior));
      }
      fit_.gain.push_back(value);
      const double mean = problem_.log().unloaded.mean[j];
      const double frames = std::sqrt(static_cast<double>(problem_.log().unloaded.frames));
      FittedValue offset{.nominal = 0.0,
                         .value = mean + state_.offset[j] * problem_.noise(j),
                         .sd = problem_.noise(j) / frames,
                         .prior_sd = infinity,
                         .verdict = ValueVerdict::identified};
      if (const std::size_t column = problem_.offset_column(j); column != no_column)
        offset.sd = problem_.noise(j) * log_sd(column);
      fit_.offsets.push_back(offset.value);
      fit_.offset.push_back(offset);
    }
  }

  /// The mean of a channel's gains, and each about it.
  void mean_gain(std::size_t c, const std::vector<std::size_t>& members, double prior) {
    relative_.resize(problem_.model().sites().size(), ValueVerdict::fixed);
    FittedValue& mean = fit_.mean_gain[c];
    mean = {.nominal = 1.0, .value = 1.0, .prior_sd = stated_.mean_gain_sd};
    if (members.empty()) return;
    const auto size = static_cast<double>(members.size());
    const auto column = [&](std::size_t j) { return eigen_index(problem_.gain_column(j)); };
    double log_mean = 0.0;
    Eigen::VectorXd by_mean = Eigen::VectorXd::Zero(covariance_.matrix.cols());
    for (const std::size_t j : members) {
      log_mean += std::log(problem_.gain(state_, j)) / size;
      by_mean(column(j)) += 1.0 / size;
    }
    const Eigen::VectorXd along = covariance_.matrix * by_mean;
    const double variance = by_mean.dot(along);
    mean.value = std::exp(log_mean);
    // A change of all of the channel's gains alike, as null directions have it, columns scaled.
    Eigen::VectorXd alike(eigen_index(members.size()));
    for (std::size_t i = 0; i < members.size(); ++i)
      alike(eigen_index(i)) = columns_.seen(column(members[i]));
    if (alike.norm() > 0.0) alike.normalize();
    double common = 0.0;
    Eigen::VectorXd apart = Eigen::VectorXd::Zero(alike.size());
    for (const NullDirection& direction : fit_.null_directions) {
      Eigen::VectorXd own(alike.size());
      for (std::size_t i = 0; i < members.size(); ++i)
        own(eigen_index(i)) = direction.gains[members[i]];
      const double share = own.dot(alike);
      common = std::hypot(common, share);
      apart = apart.cwiseMax((own - share * alike).cwiseAbs());
    }
    const double log_mean_sd = scale_ * std::sqrt(std::max(0.0, variance));
    mean.sd = mean.value * log_mean_sd;
    mean.verdict = common > 0.1 ? ValueVerdict::not_identifiable
                                : verdict_of(log_mean_sd, stated_.mean_gain_sd);
    const bool alone = members.size() == 1 || stated_.gains == GainSharing::channel;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const Eigen::Index at = column(members[i]);
      const double about = covariance_.matrix(at, at) - 2.0 * along(at) + variance;
      const double sd = scale_ * std::sqrt(std::max(0.0, about));
      relative_[members[i]] = alone                          ? verdict_of(log_mean_sd, prior)
                              : apart(eigen_index(i)) > 0.01 ? ValueVerdict::not_identifiable
                                                             : verdict_of(sd, stated_.gain_sd);
    }
  }

  void matrices() {
    for (std::size_t i = 0; i < pad_parameter_count; ++i)
      if (const auto parameter = static_cast<PadParameter>(i);
          problem_.pad_column(parameter) != no_column)
        fit_.free.push_back(parameter);
    const std::size_t n = fit_.free.size();
    fit_.covariance = fit_.correlation = {n, n, std::vector<double>(n * n)};
    const auto column = [&](std::size_t i) {
      return eigen_index(problem_.pad_column(fit_.free[i]));
    };
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        const double c = covariance_.matrix(column(a), column(b));
        const double root = std::sqrt(covariance_.matrix(column(a), column(a)) *
                                      covariance_.matrix(column(b), column(b)));
        fit_.covariance(a, b) = scale_ * scale_ * c;
        fit_.correlation(a, b) = root > 0.0 ? c / root : a == b ? 1.0 : 0.0;
      }
  }

  const FitProblem& problem_;
  const FitState& state_;
  const CalibrationOptions& stated_;
  PressFit& fit_;
  PressReadings readings_;
  SystemColumns columns_;
  SystemParts parts_;
  FitCovariance covariance_;
  double scale_ = 1.0;
  std::vector<ValueVerdict> relative_{};
};

}  // namespace

void summarise(const FitProblem& problem, const Descent& best, const CalibrationOptions& stated,
               PressFit& fit) {
  Summary(problem, best, stated, fit).write();
}

}  // namespace tactile_net
