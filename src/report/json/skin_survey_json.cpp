#include "tactile_net/report/json/skin_survey_json.hpp"

#include "report/json/document.hpp"
#include "report/json/scene_json.hpp"
#include "tactile_net/report/words/identify_words.hpp"
#include "tactile_net/report/words/skin_survey_words.hpp"

namespace tactile_net::report {
namespace {

Json hidden_json(const std::vector<HiddenWaves>& all) {
  Json json = Json::array();
  for (const HiddenWaves& one : all)
    json.push_back({{"waves", name(one.direction)},
                    {"pressure", one.normal},
                    {"drag_along", one.divergence},
                    {"drag_across", one.curl},
                    {"mixed", one.mixed}});
  return json;
}

Json finite_json(const std::optional<FiniteObservability>& finite) {
  if (!finite) return nullptr;
  return {{"tractions", finite->tractions},
          {"hidden", finite->hidden},
          {"hidden_by_dead_taxels", finite->dead},
          {"hidden_waves", finite->hidden_waves},
          {"by_ends_alone", finite->boundary_only},
          {"condition", finite_or_null(finite->condition)},
          {"noise_gain", finite_or_null(finite->noise_gain)}};
}

Json choice_json(const lab::SkinSensorChoice& choice) {
  Json reads = Json::array();
  for (const Quantity quantity : choice.reads) reads.push_back(name(quantity));
  Json wavelengths = Json::object();
  for (const SkinRipple ripple : skin_ripples) {
    const auto& [y, z, any] = choice.wavelengths[static_cast<std::size_t>(ripple)];
    wavelengths[std::string(name(ripple))] = {{"along_y", number_or_null(y)},
                                              {"along_z", number_or_null(z)},
                                              {"any", number_or_null(any)}};
  }
  return {{"reads", reads},
          {"depths", choice.depths},
          {"components", choice.components},
          {"hidden", hidden_json(choice.told.hidden)},
          {"array", finite_json(choice.told.finite)},
          {"wave_condition", finite_or_null(choice.wave_condition)},
          {"resolvable_wavelength", wavelengths},
          {"unseen_width", number_or_null(choice.unseen)}};
}

Json index_or_null(const std::optional<std::size_t>& index) {
  return index ? Json(*index) : Json(nullptr);
}

}  // namespace

std::string survey_json(const SkinScene& scene, const lab::SkinSurvey& survey) {
  Json json = scene_json(kind::skin_identify, scene);
  json["verdict"] = verdict_in_words(scene, survey);
  json["traction"] = survey.traction;
  json["noise"] = in_words(survey.noise);
  json.update(choice_json(survey.own));
  json["wave"] = {{"wavelength", survey.wave}, {"readings", Json::array()}};
  for (const lab::WaveShare& share : survey.shares)
    json["wave"]["readings"].push_back({{"quantity", name(share.quantity)},
                                        {"depth", share.depth},
                                        {"pressure", share.signal[0]},
                                        {"drag_along", share.signal[1]},
                                        {"drag_across", share.signal[2]}});
  json["waves"] = Json::array();
  for (const SkinResolution& one : survey.own.resolutions)
    json["waves"].push_back({{"wavenumber", {one.wavenumber_y, one.wavenumber_z}},
                             {"wavelength", finite_or_null(one.wavelength())},
                             {"deviation",
                              {{"pressure", finite_or_null(one.of_wave[0])},
                               {"drag_along", finite_or_null(one.of_wave[1])},
                               {"drag_across", finite_or_null(one.of_wave[2])}}}});
  json["alternatives_taxels"] = {survey.rows, survey.columns};
  json["alternatives"] = Json::array();
  for (const lab::SkinSensorChoice& choice : survey.alternatives)
    json["alternatives"].push_back(choice_json(choice));
  json["advice"] = {{"exchange", index_or_null(survey.exchange)},
                    {"best", index_or_null(survey.best)}};
  return text_of(json);
}

}  // namespace tactile_net::report
