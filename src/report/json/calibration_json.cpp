#include "tactile_net/report/json/calibration_json.hpp"

#include <variant>

#include "report/json/scene_json.hpp"
#include "tactile_net/report/words/calibration_words.hpp"
#include "tactile_net/scene/calibrated_scene.hpp"

namespace tactile_net::report {
namespace {

Json value_json(const FittedValue& value) {
  return {{"nominal", value.nominal},
          {"value", value.value},
          {"sd", finite_or_null(value.sd)},
          {"prior_sd", finite_or_null(value.prior_sd)},
          {"verdict", name(value.verdict)}};
}

Json value_json(const ValueWithSd& value) {
  return {{"value", value.value}, {"sd", finite_or_null(value.sd)}};
}

/// As the calibrated scene has them: number = gain * reading + offset.
Json list_json(const std::vector<double>& values, const std::vector<double>& sds,
               const std::vector<FittedValue>& fitted) {
  Json list = Json::array();
  for (std::size_t i = 0; i < values.size(); ++i)
    list.push_back({{"value", values[i]},
                    {"sd", finite_or_null(sds[i])},
                    {"verdict", name(fitted[i].verdict)}});
  return list;
}

Json press_json(const FittedPress& press, bool is_skin) {
  Json json = {{"press", press.number},
               {"force", value_json(press.force)},
               {"centre", value_json(press.center)},
               {"half_width", value_json(press.half_width)},
               {"friction", value_json(press.friction)},
               {"weight", press.weight},
               {"rms", press.rms},
               {"rms_before", press.rms_before},
               {"put_aside", press.put_aside ? Json(name(*press.put_aside)) : Json(nullptr)}};
  if (is_skin) {
    json["centre_z"] = value_json(press.center_z);
    json["friction_z"] = value_json(press.friction_z);
  }
  return json;
}

Json next_json(const NextPress& press, bool is_skin) {
  Json json = {{"shape", is_skin ? name(press.disc) : "cylinder"},
               {"position", press.position},
               {"half_width", press.half_width},
               {"radius", press.radius > 0.0 ? Json(press.radius) : Json(nullptr)},
               {"force", press.force},
               {"unknown_then", press.remaining}};
  if (is_skin) json["position_z"] = press.position_z;
  return json;
}

/// A line has no shift along z.
std::vector<PadParameter> parameters_of(const lab::SceneCalibration& found) {
  std::vector<PadParameter> parameters;
  for (std::size_t i = 0; i < pad_parameter_count; ++i)
    if (const auto one = static_cast<PadParameter>(i);
        found.is_skin() || one != PadParameter::shift_z)
      parameters.push_back(one);
  return parameters;
}

Json fit_json(const PressFit& fit, bool forced) {
  Json starts = Json::array();
  for (const StartOutcome& start : fit.starts)
    starts.push_back({{"depth_factor", start.depth_factor},
                      {"objective", start.objective},
                      {"iterations", start.iterations},
                      {"converged", start.converged}});
  Json understated = Json::array();
  for (const UnderstatedSd& one : fit.understated)
    understated.push_back({{"quantity", name(one.quantity)},
                           {"presses", one.presses},
                           {"rms", one.rms},
                           {"p", one.p}});
  return {{"verdict", name(fit.verdict)},
          {"forced", forced},
          {"chi_squared", fit.chi_squared},
          {"dof", fit.dof},
          {"p", fit.p},
          {"rms", fit.rms},
          {"time_trend",
           {{"of", name(fit.time_trend.of)},
            {"correlation", fit.time_trend.correlation},
            {"p", fit.time_trend.p}}},
          {"understated", understated},
          {"iterations", fit.iterations},
          {"starts", starts}};
}

}  // namespace

std::string calibration_json(const lab::SceneCalibration& found, const std::string& log) {
  const PressFit& fit = found.fit;
  Json json =
      std::visit([](const auto& scene) { return scene_json(kind::calibrate, scene); }, found.scene);
  json["log"] = log;
  json["fit"] = fit_json(fit, found.forced);
  json["words"] = calibration_in_words(found);
  if (found.other_base_gain) json["other_base_gain"] = *found.other_base_gain;
  json["parameters"] = Json::object();
  for (const PadParameter parameter : parameters_of(found))
    json["parameters"][std::string(name(parameter))] = value_json(fit.at(parameter));
  if (!found.material().layer) json["parameters"]["thickness"] = nullptr;
  const std::vector<Channel>& channel = found.channels;
  json["mean_gains"] = Json::object();
  json["noise_rms"] = Json::object();
  for (std::size_t c = 0; c < channel.size(); ++c) {
    json["mean_gains"][channel[c].name] = value_json(fit.mean_gain[c]);
    json["noise_rms"][channel[c].name] = found.log.unloaded.rms[c];
  }
  const SensorScale scale = sensor_scale(found.scene, fit);
  json["gains"] = list_json(scale.gains, scale.gain_sds, fit.gain);
  for (std::size_t j = 0; j < fit.gain.size(); ++j)
    json["gains"][j]["verdict_about_mean"] = name(fit.gain_about_mean[j]);
  json["offsets"] = list_json(scale.offsets, scale.offset_sds, fit.offset);
  json["presses"] = Json::array();
  for (const FittedPress& press : fit.presses)
    json["presses"].push_back(press_json(press, found.is_skin()));
  Json free = Json::array();
  for (const PadParameter parameter : fit.free) free.push_back(name(parameter));
  json["free"] = free;
  json["covariance"] = matrix_json(fit.covariance);
  json["correlation"] = matrix_json(fit.correlation);
  json["null_directions"] = Json::array();
  for (const NullDirection& direction : fit.null_directions) {
    Json pad = Json::object();
    for (const PadParameter parameter : parameters_of(found))
      pad[std::string(name(parameter))] = direction.pad[static_cast<std::size_t>(parameter)];
    json["null_directions"].push_back(
        {{"text", in_words(found, direction)}, {"parameters", pad}, {"gains", direction.gains}});
  }
  json["outliers"] = Json::array();
  for (const OutlyingReading& one : fit.outliers)
    json["outliers"].push_back(
        {{"press", one.press}, {"reading", one.reading}, {"deviation", one.deviation}});
  json["doubtful_readings"] = fit.doubtful_readings;
  json["contradicted_presses"] = Json::array();
  for (const ContradictedPress& one : fit.contradicted_presses)
    json["contradicted_presses"].push_back({{"press", one.press},
                                            {"quantity", name(one.quantity)},
                                            {"stated", one.stated},
                                            {"deviation", one.deviation},
                                            {"readings", one.readings}});
  json["next"] = Json::array();
  for (const NextPress& press : found.next.presses)
    json["next"].push_back(next_json(press, found.is_skin()));
  json["unknown_now"] = found.next.presses.empty() ? Json(nullptr) : Json(found.next.now);
  json["profile"] = Json::array();
  for (const ProfilePoint& point : fit.profile)
    json["profile"].push_back({{"z", point.z}, {"depth", point.depth}, {"root", point.root}});
  return text_of(json);
}

}  // namespace tactile_net::report
