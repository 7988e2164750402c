#include "tactile_net/report/json/run_json.hpp"

#include <cmath>

#include "report/json/contact_json.hpp"
#include "report/json/data_json.hpp"
#include "report/json/network_values.hpp"
#include "report/json/scene_json.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/table.hpp"

namespace tactile_net::report {
namespace {

Json component(const lab::Component& component) {
  return {{"mean_abs", component.mean_abs}, {"relative_l2", component.relative_l2}};
}

Json resultant(const UncertainResultant& resultant) {
  return {{"normal", uncertain_json(resultant.normal)},
          {"tangential", uncertain_or_null(resultant.tangential)},
          {"centre", uncertain_or_null(resultant.centre)},
          {"angle", uncertain_or_null(resultant.angle)}};
}

/// What is known of an answer's errors without the truth.
void add_uncertainty(Json& json, const lab::MethodResult& result) {
  json["error_bound"] = number_or_null(result.error_bound);
  json["deviation"] = result.normal.deviation.empty()
                          ? Json(nullptr)
                          : Json{{"normal", result.normal.deviation},
                                 {"tangential", list_or_null(result.tangential.deviation)}};
  json["resultant"] = result.resultant ? resultant(*result.resultant) : Json(nullptr);
  json["patches"] = line_contacts_json(result.patches);
  json["noise"] = nullptr;
  if (result.noise)
    json["noise"] = {{"stated", number_or_null(result.noise->stated_rms)},
                     {"residual", result.noise->residual_rms},
                     {"model", result.noise->model_rms}};
  json["data"] = result.data ? data_json(*result.data) : Json(nullptr);
  if (result.constrained)
    json["constraints"] = {{"kkt_residual", result.constrained->kkt_residual},
                           {"iterations", result.constrained->iterations},
                           {"free", result.constrained->free.size()}};
}

Json tangential_weight(const Scene& scene, const lab::MethodResult& result) {
  if (!result.alpha || unknowns(scene) != 2) return nullptr;
  if (const auto estimated = result.alpha->tangential_weight) return *estimated;
  return number_or_null(scene.reconstruct.tangential_weight);
}

Json reconstruction(const lab::Experiment& experiment, const lab::MethodResult& result) {
  Json json = {{"method", name(result.method)},
               {"alpha", result.alpha ? Json(result.alpha->value) : Json(nullptr)},
               {"alpha_rule", result.alpha ? Json(source(*result.alpha)) : Json(nullptr)},
               {"tangential_weight", tangential_weight(experiment.scene, result)},
               {"offsets", result.offsets.empty() ? Json(nullptr) : Json(result.offsets)},
               {"verdict", name(result.verdict)},
               {"normal", list_or_null(result.normal.traction)},
               {"tangential", list_or_null(result.tangential.traction)}};
  if (!result.has_answer()) {
    for (const char* key : {"error", "force", "seconds", "condition"}) json[key] = nullptr;
  } else {
    json["error"] = component(result.normal);
    if (!result.tangential.traction.empty())
      json["error"]["tangential"] = component(result.tangential);
    json["force"] = result.force;
    json["seconds"] = {{"setup", result.setup_seconds}, {"frame", result.frame_seconds}};
    json["condition"] = result.condition ? Json(result.condition->value) : Json(nullptr);
    json["condition_kind"] = result.condition ? Json(name(result.condition->kind)) : Json(nullptr);
    json["condition_of"] = result.condition ? Json(name(result.condition->matrix)) : Json(nullptr);
    add_uncertainty(json, result);
  }
  add_remarks(json, remarks_in_words(experiment, result));
  if (const std::string failure = failure_in_words(experiment, result); !failure.empty())
    json["failure"] = failure;
  return json;
}

Json alpha_sweep(const AlphaSweep& sweep) {
  Json json = {{"alphas", sweep.alphas}, {"rules", Json::array()}};
  for (const AlphaSweep::Curve& curve : sweep.curves)
    json["rules"].push_back({{"rule", name(curve.rule)},
                             {"alpha", curve.choice.alpha},
                             {"verdict", name(curve.choice.verdict)},
                             {"values", curve.values}});
  return json;
}

/// Where each channel's readings are taken.
Json taxels_json(const SensorArray& array) {
  Json json = Json::object();
  const std::vector<Channel> all = channels(array);
  for (const Channel& channel : all)
    json[channel.name] = {{"index", Json::array()},
                          {"y", Json::array()},
                          {"depth", Json::array()},
                          {"width", Json::array()}};
  for (const Site& site : sites(array)) {
    Json& channel = json[all[site.channel].name];
    channel["index"].push_back(site.taxel);
    channel["y"].push_back(site.y);
    channel["depth"].push_back(site.depth);
    channel["width"].push_back(site.width);
  }
  return json;
}

}  // namespace

std::string experiment_json(const lab::Experiment& experiment) {
  const Scene& scene = experiment.scene;
  const TractionField& truth = experiment.frame.truth;
  Json json = scene_json(kind::run, scene);
  json["positions"] = positions(surface(scene));
  json["truth"] = {{"normal", truth.normal},
                   {"tangential", list_or_null(truth.tangential)},
                   {"force", experiment.frame.force}};
  json["readings"] = Json::object();
  const std::span<const double> readings = experiment.frame.readings;
  for (const Channel& channel : channels(scene.sensor)) {
    const auto line = readings.subspan(channel.first, channel.count);
    json["readings"][channel.name] = std::vector<double>(line.begin(), line.end());
  }
  if (!is_even(scene.sensor)) json["taxels"] = taxels_json(scene.sensor);
  json["reconstructions"] = Json::array();
  for (const lab::MethodResult& result : experiment.results)
    json["reconstructions"].push_back(reconstruction(experiment, result));
  json["alpha_sweep"] = experiment.sweep ? alpha_sweep(*experiment.sweep) : Json(nullptr);
  json["network"] = experiment.relaxation ? network_json(*experiment.relaxation) : Json(nullptr);
  json["warnings"] = in_words(experiment.frame);
  return text_of(json);
}

}  // namespace tactile_net::report
