/// @file
/// Depth, layer, moduli, gains and offsets from a log of presses, each with what is known of it.
///
///     const PressModel model(scene.sensor, scene.material);
///     const PressFit fit = fit_presses(model, log, {.depth_sd = 0.3});
///     const FittedValue& depth = fit.at(PadParameter::depth);
///     if (fit.verdict == FitVerdict::ok && depth.verdict == ValueVerdict::identified) ...
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tactile_net/calibration/calibration_options.hpp"
#include "tactile_net/calibration/press_log.hpp"
#include "tactile_net/calibration/press_model.hpp"

namespace tactile_net {

/// What the log says of a value, besides what was stated before.
enum class ValueVerdict { identified, weak, prior_only, not_identifiable, at_bound, fixed };

template <>
struct Enumerators<ValueVerdict> {
  static constexpr Enumerator<ValueVerdict> all[] = {
      {ValueVerdict::identified, "identified", "The log tells it."},
      {ValueVerdict::weak, "weak",
       "Its standard deviation is over half of the stated one or, without one, over 10 %."},
      {ValueVerdict::prior_only, "prior_only",
       "Its standard deviation is over 0.9 of the stated one."},
      {ValueVerdict::not_identifiable, "not_identifiable",
       "The log cannot tell it from others: it keeps its nominal value."},
      {ValueVerdict::at_bound, "at_bound", "It ended at the end of its range."},
      {ValueVerdict::fixed, "fixed", "It is stated as exact, or this scene has none."}};
};
[[nodiscard]] std::string_view name(ValueVerdict verdict) noexcept;

enum class FitVerdict { ok, poor_fit, iteration_limit };

template <>
struct Enumerators<FitVerdict> {
  static constexpr Enumerator<FitVerdict> all[] = {
      {FitVerdict::ok, "ok", "The pad explains the readings."},
      {FitVerdict::poor_fit, "poor_fit",
       "Residuals are larger than noise explains, or stated values are contradicted."},
      {FitVerdict::iteration_limit, "iteration_limit", "No start converged."}};
};
[[nodiscard]] std::string_view name(FitVerdict verdict) noexcept;

struct FittedValue {
  double nominal = 0.0;
  double value = 0.0;
  double sd = 0.0;        ///< times sqrt(max(1, chi_squared / dof)); infinite: not known at all
  double prior_sd = 0.0;  ///< in the value's unit; infinite: none
  ValueVerdict verdict = ValueVerdict::fixed;
};

/// How far a value ended from the stated one, in stated sds: lengths and E by their logarithms. 0
/// where it is stated as exact, or not at all.
[[nodiscard]] double deviation_from_stated(PadParameter parameter, const FittedValue& value,
                                           double sd);

struct ValueWithSd {
  double value = 0.0;
  double sd = 0.0;
};

/// What a log states of a press, in the order in which a fit moves it.
enum class PressQuantity { force, position, half_width, friction, position_z, friction_z };

template <>
struct Enumerators<PressQuantity> {
  static constexpr Enumerator<PressQuantity> all[] = {
      {PressQuantity::force, "force", "The force."},
      {PressQuantity::position, "position", "Where the middle is, along y."},
      {PressQuantity::half_width, "half_width", "The contact's half width."},
      {PressQuantity::friction, "friction", "Tangential over normal traction, along y."},
      {PressQuantity::position_z, "position_z", "Where the middle is, along z."},
      {PressQuantity::friction_z, "friction_z", "Tangential over normal traction, along z."}};
};
[[nodiscard]] std::string_view name(PressQuantity quantity) noexcept;

struct FittedPress {
  std::size_t number = 0;
  ValueWithSd force{}, center{}, half_width{}, friction{}, center_z{}, friction_z{};
  double weight = 1.0;               ///< mean of its readings' robust weights
  double rms = 0.0;                  ///< rms of its residuals, in standard deviations of the noise
  double rms_before = 0.0;           ///< the rms under the nominal pad without gains
  bool half_width_at_bound = false;  ///< below a tenth of the depth: the width is not seen
  /// A stated value that was put aside as an outlier (`CalibrationOptions::robust`).
  std::optional<PressQuantity> put_aside{};

  [[nodiscard]] const ValueWithSd& at(PressQuantity quantity) const noexcept;
};

/// A change of the parameters that changes no reading, columns scaled to unit length. The first pad
/// parameter that changes by at least half of what any does, or gain where none does, grows.
struct NullDirection {
  std::array<double, pad_parameter_count> pad{};
  std::vector<double> gains{};  ///< change of each reading's gain
};

struct OutlyingReading {
  std::size_t press = 0;    ///< its number
  std::size_t reading = 0;  ///< index
  double deviation = 0.0;   ///< in standard deviations of the noise
};

/// A stated value that the readings contradict.
struct ContradictedPress {
  std::size_t press = 0;  ///< its number
  PressQuantity quantity = PressQuantity::force;
  double stated = 0.0;
  /// The fitted value minus the stated one, in its stated sds; 0: it was stated as exact, and
  /// `readings` of the press are more than 5 off.
  double deviation = 0.0;
  std::size_t readings = 0;
};

/// A quantity whose stated values, over all presses, lie further from what the readings say than
/// their stated standard deviations allow.
struct UnderstatedSd {
  PressQuantity quantity = PressQuantity::force;
  std::size_t presses = 0;  ///< presses that state it with an sd, and whose readings tell it
  double rms = 0.0;         ///< of deviations over stated sds, without those beyond 5; 1: they hold
  double p = 1.0;           ///< p-value of chi-squared
};

/// What changes with the order of the presses.
enum class TrendOf { size, gain, offset };

template <>
struct Enumerators<TrendOf> {
  static constexpr Enumerator<TrendOf> all[] = {
      {TrendOf::size, "size", "The size of the residuals."},
      {TrendOf::gain, "gain", "A common factor on the readings, under the stated forces."},
      {TrendOf::offset, "offset", "A common constant in the readings."}};
};
[[nodiscard]] std::string_view name(TrendOf trend) noexcept;

/// Residuals that change with the order of the presses, the clearest of the three.
struct TimeTrend {
  TrendOf of = TrendOf::size;
  double correlation = 0.0;  ///< rank correlation (Spearman's)
  double p = 1.0;            ///< by Student's t, times three: the number of tests

  [[nodiscard]] bool is_significant() const noexcept { return p < 1e-3; }
};

struct StartOutcome {
  double depth_factor = 1.0;
  double objective = 0.0;  ///< half the sum of squares, priors included
  std::size_t iterations = 0;
  bool converged = false;
};

/// The misfit's rise over the depth: straight where the sd tells all.
struct ProfilePoint {
  double z = 0.0;      ///< log depth minus its estimate, over its sd
  double depth = 0.0;  ///< [m]
  double root = 0.0;   ///< signed root of twice the objective's rise; equal to z for a parabola
};

struct PressFit {
  PadState pad{};
  std::vector<double> gains{}, offsets{};  ///< of each reading: number = gain * reading + offset
  std::array<FittedValue, pad_parameter_count> parameters{};  ///< depth and thickness in m, E in Pa
  std::vector<FittedValue> gain{}, offset{};                  ///< of each reading
  /// Verdict on each reading's gain about its channel's mean, which a log without forces tells too.
  std::vector<ValueVerdict> gain_about_mean{};
  std::vector<FittedValue> mean_gain{};  ///< of each channel
  std::vector<FittedPress> presses{};
  std::vector<NullDirection> null_directions{};
  std::vector<PadParameter> free{};        ///< rows and columns of the two matrices
  Matrix covariance{}, correlation{};      ///< depth, thickness, E and pitch by their logarithms
  Matrix residuals{}, residuals_before{};  ///< presses x readings, in sds of the noise
  /// Parameters that ended more than 4 stated sds away: the log and the scene contradict each
  /// other.
  std::vector<PadParameter> contradicted{};
  std::vector<std::size_t> contradicted_gains{};  ///< channels, by their mean gain
  /// Readings whose gain ended more than 5 stated sds from the others, or near 0: dead or loose
  /// taxels, or a gain_sd that is too small.
  std::vector<std::size_t> doubtful_readings{};
  std::vector<ContradictedPress> contradicted_presses{};  ///< the worst first
  /// Quantities with p below 1e-3; with an rms over 2 the fit is poor.
  std::vector<UnderstatedSd> understated{};
  std::vector<OutlyingReading> outliers{};
  std::vector<StartOutcome> starts{};
  std::vector<ProfilePoint> profile{};
  double chi_squared = 0.0, dof = 0.0;
  double p = 1.0;    ///< p-value of F(dof, (frames - 1) readings)
  double rms = 0.0;  ///< sqrt(chi_squared / dof)
  TimeTrend time_trend{};
  std::size_t iterations = 0;
  FitVerdict verdict = FitVerdict::ok;

  [[nodiscard]] const FittedValue& at(PadParameter parameter) const noexcept {
    return parameters[static_cast<std::size_t>(parameter)];
  }
};

/// Fits pad, gains and offsets: penalised least squares on all of them and the unknowns of each
/// press, by Levenberg-Marquardt on orthogonal factors; linear in presses in time, presses x
/// readings in memory: presses' own unknowns are eliminated press by press. Where readings are
/// many, as on a skin, what belongs to a reading is eliminated instead, reading by reading: linear
/// in readings, and in time as the cube of the presses. Where every load is stated the first start
/// alone is made: all find the one minimum.
///
/// Depth, thickness, pitch and every indenter stay in their possible range on this array, and steps
/// are counted: a log that does not belong to the scene ends in seconds, too.
///
/// @param unread  of each reading, true: leave it out (dead taxels); empty: none
/// @param watch   called before every step with its number, from 1 in each start; may throw
/// @throw std::invalid_argument  no press, sizes that do not fit, values out of range, a channel
///                               without noise; readings of the other sign or a thousand times as
///                               large as the model's, positions that run against the array or are
///                               in other units than it
[[nodiscard]] PressFit fit_presses(const PressModel& model, const PressLog& log,
                                   const CalibrationOptions& options = {},
                                   std::span<const bool> unread = {},
                                   const std::function<void(std::size_t)>& watch = {});

}  // namespace tactile_net
