#include "tactile_net/report/json/calibration_json.hpp"

#include "report/json/scene_json.hpp"
#include "report/json/schemas.hpp"
#include "tactile_net/report/words/calibration_words.hpp"
#include "tactile_net/scene/calibrated_scene.hpp"

namespace tactile_net {

template <>
struct Fields<FittedValue> {
  static constexpr auto all =
      std::tuple{field("nominal", &FittedValue::nominal, "What the scene says."),
                 field("value", &FittedValue::value, "What was found."),
                 field(
                     "sd", [](const FittedValue& one) { return if_finite(one.sd); },
                     "Its standard deviation; null: it is not known at all."),
                 field(
                     "prior_sd", [](const FittedValue& one) { return if_finite(one.prior_sd); },
                     "The standard deviation stated of the nominal value; null: none was stated."),
                 field("verdict", &FittedValue::verdict, "What the log says of it.")};
};

template <>
struct Fields<ValueWithSd> {
  static constexpr auto all =
      std::tuple{field("value", &ValueWithSd::value, "What was found."),
                 field(
                     "sd", [](const ValueWithSd& one) { return if_finite(one.sd); },
                     "Its standard deviation; null: it is not known at all.")};
};

template <>
struct Fields<FittedPress> {
  static constexpr auto all = std::tuple{
      field("press", &FittedPress::number, "The press's number in the log."),
      field("force", &FittedPress::force, Measure::load, "The force found."),
      field("centre", &FittedPress::center, Measure::length, "Where its middle is, along y."),
      field("half_width", &FittedPress::half_width, Measure::length, "The contact's half width."),
      field("friction", &FittedPress::friction, "Tangential over normal traction, along y."),
      field("weight", &FittedPress::weight, "The mean weight of its readings; 1: all count."),
      field("rms", &FittedPress::rms, "Its residuals, rms in units of the noise."),
      field("rms_before", &FittedPress::rms_before, "The same for the nominal pad, without gains."),
      field("put_aside", &FittedPress::put_aside,
            "The stated value that a robust fit does not use; null: it uses all.")};
};

template <>
struct Fields<StartOutcome> {
  static constexpr auto all =
      std::tuple{field("depth_factor", &StartOutcome::depth_factor,
                       "The depth to start from, over the nominal one."),
                 field("objective", &StartOutcome::objective,
                       "Half the sum of squares at the end, with those of what was stated."),
                 field("iterations", &StartOutcome::iterations, "How many steps it took."),
                 field("converged", &StartOutcome::converged, "Whether it came to an end.")};
};

template <>
struct Fields<UnderstatedSd> {
  static constexpr auto all = std::tuple{
      field("quantity", &UnderstatedSd::quantity, "What was stated."),
      field("presses", &UnderstatedSd::presses, "How many presses it was judged by."),
      field("rms", &UnderstatedSd::rms,
            "How far it lies from what the readings say, rms over the stated standard deviations; "
            "over 2 the fit is poor."),
      field("p", &UnderstatedSd::p, "The p-value of that.")};
};

template <>
struct Fields<TimeTrend> {
  static constexpr auto all = std::tuple{
      field("of", &TimeTrend::of, "What changes with the order of the presses."),
      field("correlation", &TimeTrend::correlation, "Its rank correlation with that order."),
      field("p", &TimeTrend::p, "The p-value of that.")};
};

template <>
struct Fields<OutlyingReading> {
  static constexpr auto all =
      std::tuple{field("press", &OutlyingReading::press, "The press's number in the log."),
                 field("reading", &OutlyingReading::reading, "The reading's number, from 0."),
                 field("deviation", &OutlyingReading::deviation,
                       "How far it is from the fit, in units of the noise.")};
};

template <>
struct Fields<ContradictedPress> {
  static constexpr auto all = std::tuple{
      field("press", &ContradictedPress::press, "The press's number in the log."),
      field("quantity", &ContradictedPress::quantity, "What was stated of it."),
      field("stated", &ContradictedPress::stated, "The stated value."),
      field("deviation", &ContradictedPress::deviation,
            "The value found less the stated one, in stated standard deviations; 0: it was stated "
            "as exact."),
      field("readings", &ContradictedPress::readings,
            "How many readings of the press are more than 5 standard deviations off.")};
};

template <>
struct Fields<ProfilePoint> {
  static constexpr auto all = std::tuple{
      field("z", &ProfilePoint::z,
            "The logarithm of the depth less its estimate, over its standard deviation."),
      field("depth", &ProfilePoint::depth, Measure::length, "The depth."),
      field("root", &ProfilePoint::root,
            "The signed root of twice the rise of the objective; equal to z where the standard "
            "deviation tells all.")};
};

namespace report {
namespace {

/// A value for each parameter of the pad. A line has no shift along z.
template <class T, class Thickness>
struct PadTold {
  T depth{};
  Thickness thickness{};
  T poisson_ratio{}, youngs_modulus{}, crosstalk{}, shift{}, pitch{};
  IfAny<T> shift_z{};
};

}  // namespace
}  // namespace report

template <class T, class Thickness>
struct Fields<report::PadTold<T, Thickness>> {
  using Pad = report::PadTold<T, Thickness>;

  /// Single numbers are changes of scaled parameters: they have no unit.
  template <class Access>
  static constexpr Field<Access> of(PadParameter parameter, Access access,
                                    Measure measure = Measure::none) {
    const auto& row = Enumerators<PadParameter>::all[static_cast<std::size_t>(parameter)];
    return field(row.name, access, std::is_same_v<T, double> ? Measure::none : measure, row.text);
  }

  static constexpr auto all =
      std::tuple{of(PadParameter::depth, &Pad::depth, Measure::length),
                 of(PadParameter::thickness, &Pad::thickness, Measure::length),
                 of(PadParameter::poisson_ratio, &Pad::poisson_ratio),
                 of(PadParameter::youngs_modulus, &Pad::youngs_modulus, Measure::stress),
                 of(PadParameter::crosstalk, &Pad::crosstalk),
                 of(PadParameter::shift, &Pad::shift, Measure::length),
                 of(PadParameter::pitch, &Pad::pitch, Measure::length),
                 of(PadParameter::shift_z, &Pad::shift_z, Measure::length)};
};

namespace report {
namespace {

struct FitTold {
  FitVerdict verdict = FitVerdict::ok;
  bool forced = false;
  double chi_squared = 0.0;
  double dof = 0.0;
  double p = 1.0;
  double rms = 0.0;
  TimeTrend time_trend{};
  std::vector<UnderstatedSd> understated{};
  std::size_t iterations = 0;
  std::vector<StartOutcome> starts{};

  static constexpr auto described = std::tuple{
      field("verdict", &FitTold::verdict, "Whether the fit can be used."),
      field("forced", &FitTold::forced,
            "Whether the fit failed, and its scene was written all the same."),
      field("chi_squared", &FitTold::chi_squared,
            "The residuals' sum of squares, over the noise's variance."),
      field("dof", &FitTold::dof, "The degrees of freedom."),
      field("p", &FitTold::p, "The p-value of that sum."),
      field("rms", &FitTold::rms, "The residuals, rms in units of the noise."),
      field("time_trend", &FitTold::time_trend,
            "What changes most clearly with the order of the presses."),
      field("understated", &FitTold::understated,
            "What is stated of all presses and lies further from what their readings say than its "
            "stated standard deviations allow."),
      field("iterations", &FitTold::iterations, "How many steps the best start took."),
      field("starts", &FitTold::starts, "The depths that were started from.")};
};

/// As the calibrated scene has it: number = gain * reading + offset.
struct OffsetTold {
  double value = 0.0;
  std::optional<double> sd{};
  ValueVerdict verdict = ValueVerdict::fixed;

  static constexpr auto described = std::tuple{
      field("value", &OffsetTold::value, "What was found."),
      field("sd", &OffsetTold::sd, "Its standard deviation; null: it is not known at all."),
      field("verdict", &OffsetTold::verdict, "What the log says of it.")};
};

struct GainTold : OffsetTold {
  ValueVerdict about_mean = ValueVerdict::fixed;

  static constexpr auto described =
      std::tuple_cat(OffsetTold::described,
                     std::tuple{field("verdict_about_mean", &GainTold::about_mean,
                                      "What the log says of it about its channel's mean gain.")});
};

struct PressTold : FittedPress {
  IfAny<ValueWithSd> centre_z{}, friction_along_z{};

  static constexpr auto described = std::tuple_cat(
      Fields<FittedPress>::all,
      std::tuple{field("centre_z", &PressTold::centre_z, Measure::length,
                       "Where its middle is, along z; of a skin alone."),
                 field("friction_z", &PressTold::friction_along_z,
                       "Tangential over normal traction, along z; of a skin alone.")});
};

struct DirectionTold {
  std::string text{};
  PadTold<double, double> parameters{};
  std::vector<double> gains{};

  static constexpr auto described = std::tuple{
      field("text", &DirectionTold::text, "What changes together, in words."),
      field("parameters", &DirectionTold::parameters,
            "By how much each parameter of the pad changes, columns scaled to unit length."),
      field("gains", &DirectionTold::gains, "By how much the gain of each reading does.")};
};

struct NextTold {
  std::string_view shape{};
  double position = 0.0;
  double half_width = 0.0;
  std::optional<double> radius{};
  double force = 0.0;
  double unknown_then = 0.0;
  IfAny<double> position_z{};

  static constexpr auto described = std::tuple{
      field("shape", &NextTold::shape, "The indenter."),
      field("position", &NextTold::position, Measure::length, "Where its middle is, along y."),
      field("half_width", &NextTold::half_width, Measure::length, "The contact's half width."),
      field("radius", &NextTold::radius, Measure::length,
            "The radius of the rod or ball with that contact under that force; null: a punch or a "
            "cone."),
      field("force", &NextTold::force, Measure::load, "The force."),
      field("unknown_then", &NextTold::unknown_then,
            "What is unknown, as in `unknown_now`, once this press and those before are done."),
      field("position_z", &NextTold::position_z, Measure::length,
            "Where its middle is, along z; of a skin alone.")};
};

struct CalibrationTold {
  std::string log{};
  FitTold fit{};
  std::vector<std::string> words{};
  IfAny<double> other_base_gain{};
  PadTold<FittedValue, std::optional<FittedValue>> parameters{};
  std::vector<std::pair<std::string, FittedValue>> mean_gains{};
  std::vector<std::pair<std::string, double>> noise_rms{};
  std::vector<GainTold> gains{};
  std::vector<OffsetTold> offsets{};
  std::vector<PressTold> presses{};
  std::vector<PadParameter> free{};
  Matrix covariance{}, correlation{};
  std::vector<DirectionTold> null_directions{};
  std::vector<OutlyingReading> outliers{};
  std::vector<std::size_t> doubtful_readings{};
  std::vector<ContradictedPress> contradicted_presses{};
  std::vector<NextTold> next{};
  std::optional<double> unknown_now{};
  std::vector<ProfilePoint> profile{};

  static constexpr auto described = std::tuple{
      field("log", &CalibrationTold::log, "The file of presses."),
      field("fit", &CalibrationTold::fit, "How well the pad explains the readings."),
      field("words", &CalibrationTold::words, "What was found, a sentence each."),
      field("other_base_gain", &CalibrationTold::other_base_gain,
            "How much less the sum of squares would be were the layer on the other base; absent "
            "without a layer, of robust fits, and where either did not converge."),
      field("parameters", &CalibrationTold::parameters, "The pad and the array as a whole."),
      field("mean_gains", &CalibrationTold::mean_gains, "The mean gain of each channel."),
      field("noise_rms", &CalibrationTold::noise_rms, Measure::reading,
            "The noise of each channel, rms, without a load."),
      field("gains", &CalibrationTold::gains,
            "Of each reading, as the calibrated scene has them: number = gain * reading + "
            "offset."),
      field("offsets", &CalibrationTold::offsets, "The same of the offsets."),
      field("presses", &CalibrationTold::presses, "What was found of each press."),
      field("free", &CalibrationTold::free,
            "The rows and columns of the two matrices; depth, thickness, E and pitch are by their "
            "logarithms."),
      field("covariance", &CalibrationTold::covariance, "The covariance of these parameters."),
      field("correlation", &CalibrationTold::correlation, "Their correlation."),
      field("null_directions", &CalibrationTold::null_directions,
            "Changes of the parameters that no reading shows."),
      field("outliers", &CalibrationTold::outliers, "Readings far from the fit."),
      field("doubtful_readings", &CalibrationTold::doubtful_readings,
            "Readings whose gain no sound taxel has."),
      field("contradicted_presses", &CalibrationTold::contradicted_presses,
            "Stated values that the readings contradict, the worst first."),
      field("next", &CalibrationTold::next, "The presses that would tell most next."),
      field("unknown_now", &CalibrationTold::unknown_now,
            "What is unknown now: of readings under reference loads, or of the target; null: next "
            "presses were not asked for."),
      field("profile", &CalibrationTold::profile,
            "How the misfit rises over the depth; empty: it was not asked for.")};
};

template <class T, class Thickness>
PadTold<T, Thickness> pad_told(const std::array<T, pad_parameter_count>& values, bool is_skin) {
  const auto& [depth, thickness, poisson_ratio, youngs_modulus, crosstalk, shift, pitch, shift_z] =
      values;
  PadTold<T, Thickness> told{depth,     thickness, poisson_ratio, youngs_modulus,
                             crosstalk, shift,     pitch};
  if (is_skin) told.shift_z.value = shift_z;
  return told;
}

FitTold fit_told(const PressFit& fit, bool forced) {
  return {fit.verdict, forced,         fit.chi_squared, fit.dof,        fit.p,
          fit.rms,     fit.time_trend, fit.understated, fit.iterations, fit.starts};
}

PressTold press_told(const FittedPress& press, bool is_skin) {
  PressTold told{press};
  if (!is_skin) return told;
  told.centre_z.value = press.center_z;
  told.friction_along_z.value = press.friction_z;
  return told;
}

NextTold next_told(const NextPress& press, bool is_skin) {
  NextTold told{.shape = is_skin ? name(press.disc) : "cylinder",
                .position = press.position,
                .half_width = press.half_width,
                .force = press.force,
                .unknown_then = press.remaining};
  if (press.radius > 0.0) told.radius = press.radius;
  if (is_skin) told.position_z.value = press.position_z;
  return told;
}

}  // namespace

std::string calibration_json(const lab::SceneCalibration& found, const std::string& log) {
  const PressFit& fit = found.fit;
  const bool is_skin = found.is_skin();
  CalibrationTold told{
      .log = log,
      .fit = fit_told(fit, found.forced),
      .words = calibration_in_words(found),
      .other_base_gain = {found.other_base_gain},
      .parameters = pad_told<FittedValue, std::optional<FittedValue>>(fit.parameters, is_skin),
      .free = fit.free,
      .covariance = fit.covariance,
      .correlation = fit.correlation,
      .outliers = fit.outliers,
      .doubtful_readings = fit.doubtful_readings,
      .contradicted_presses = fit.contradicted_presses,
      .profile = fit.profile};
  if (!found.material().layer) told.parameters.thickness.reset();
  for (std::size_t c = 0; c < found.channels.size(); ++c) {
    told.mean_gains.emplace_back(found.channels[c].name, fit.mean_gain[c]);
    told.noise_rms.emplace_back(found.channels[c].name, found.log.unloaded.rms[c]);
  }
  const SensorScale scale = sensor_scale(found.scene, fit);
  for (std::size_t j = 0; j < fit.gain.size(); ++j) {
    told.gains.push_back({{scale.gains[j], if_finite(scale.gain_sds[j]), fit.gain[j].verdict},
                          fit.gain_about_mean[j]});
    told.offsets.push_back(
        {scale.offsets[j], if_finite(scale.offset_sds[j]), fit.offset[j].verdict});
  }
  for (const FittedPress& press : fit.presses) told.presses.push_back(press_told(press, is_skin));
  for (const NullDirection& one : fit.null_directions)
    told.null_directions.push_back(
        {in_words(found, one), pad_told<double, double>(one.pad, is_skin), one.gains});
  for (const NextPress& press : found.next.presses) told.next.push_back(next_told(press, is_skin));
  if (!told.next.empty()) told.unknown_now = found.next.now;
  return document_text(kind::calibrate, scene_told(found.scene), told);
}

Json calibrate_schema() {
  return document_schema<SceneFrameTold, CalibrationTold>(kind::calibrate,
                                                          "What `calibrate` found");
}

}  // namespace report
}  // namespace tactile_net
