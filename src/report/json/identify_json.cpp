#include "tactile_net/report/json/identify_json.hpp"

#include <cmath>

#include "report/json/scene_json.hpp"
#include "tactile_net/report/words/identify_words.hpp"
#include "tactile_net/report/words/mode_words.hpp"

namespace tactile_net::report {
namespace {

Json modes_of(const Identifiability& result) {
  Json modes = Json::array();
  for (const ModeSpace* space : {&result.null_space, &result.nearly_null})
    for (const TractionMode& mode : space->modes)
      modes.push_back({{"unknown", !mode.unknown                       ? "both"
                                   : *mode.unknown == Traction::normal ? "normal"
                                                                       : "tangential"},
                       {"wavelength", number_or_null(mode.wavelength)},
                       {"description", in_words(mode)},
                       {"singular_value", mode.singular_value},
                       {"exact", space == &result.null_space}});
  return modes;
}

Json space_json(const ModeSpace& space) {
  const bool empty = space.longest == 0.0;
  return {{"dimension", space.dimension},
          {"longest", empty ? Json(nullptr) : finite_or_null(space.longest)},
          {"shortest", empty ? Json(nullptr) : finite_or_null(space.shortest)},
          {"constant", std::isinf(space.longest)}};
}

Json choice_json(const lab::SensorChoice& choice) {
  const Identifiability& result = choice.identifiability;
  Json reads = Json::array();
  for (const Quantity quantity : choice.reads) reads.push_back(name(quantity));
  return {{"reads", reads},
          {"depths", choice.depths},
          {"unknowns", choice.unknowns},
          {"condition", finite_or_null(result.condition)},
          {"rank", result.rank},
          {"rank_deficiency", result.null_space.dimension},
          {"noise_gain", finite_or_null(result.noise_gain)},
          {"null_modes", modes_of(result)},
          {"null_space", space_json(result.null_space)},
          {"nearly_null", space_json(result.nearly_null)},
          {"resolvable_wavelength",
           {{"normal", number_or_null(choice.normal)},
            {"tangential", number_or_null(choice.tangential)}}},
          {"unseen_width", number_or_null(choice.unseen)}};
}

}  // namespace

std::string survey_json(const Scene& scene, const lab::Survey& survey) {
  Json json = scene_json(kind::identify, scene);
  json["verdict"] = verdict_in_words(survey, scene.units);
  json["traction"] = survey.traction;
  json["noise"] = in_words(survey.noise);
  json.update(choice_json(survey.own));
  json["singular_values"] = survey.own.identifiability.singular_values;
  json["wavelengths"] = Json::array();
  json["deviation"] = {{"normal", Json::array()}, {"tangential", Json::array()}};
  for (const Resolution& resolution : survey.own.resolutions) {
    json["wavelengths"].push_back(finite_or_null(resolution.wavelength));
    json["deviation"]["normal"].push_back(finite_or_null(resolution.normal));
    json["deviation"]["tangential"].push_back(finite_or_null(resolution.tangential));
  }
  json["alternatives_taxels"] = survey.taxels;
  json["alternatives"] = Json::array();
  for (const lab::SensorChoice& choice : survey.alternatives)
    json["alternatives"].push_back(choice_json(choice));
  return text_of(json);
}

}  // namespace tactile_net::report
