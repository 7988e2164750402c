#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/answers.hpp"
#include "tactile_net/report/words/identify_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::report {
namespace {

Answer told(const Scene& scene, const lab::Survey& survey, std::string_view traction,
            const std::optional<double>& wavelength) {
  const std::string ripples =
      std::string(traction) + " ripples of " + in_unit(scene, Dimension::stress, survey.traction);
  if (!wavelength) return {"none", "of " + ripples + " stands out of the noise", true};
  return {"from " + in_unit(scene, Dimension::length, *wavelength),
          ripples + " are told, by their wavelength: shorter ones drown in the noise"};
}

}  // namespace

std::vector<Answer> answers(const Scene& scene, const lab::Survey& survey) {
  const lab::SensorChoice& own = survey.own;
  std::vector<Answer> all = {told(scene, survey, "normal", own.normal)};
  if (own.unknowns == 2)
    all.push_back(told(scene, survey, "tangential", own.tangential));
  else
    all.push_back(
        {"not measured",
         "tangential tractions (drag): under friction the pressure found is wrong; read a "
         "second quantity, such as shear_xy"});
  const std::size_t hidden = own.identifiability.null_space.dimension;
  const bool mean = lab::hides_mean(own, Traction::normal) ||
                    (own.unknowns == 2 && lab::hides_mean(own, Traction::tangential_y));
  if (hidden > 0)
    all.push_back({std::to_string(hidden) + (hidden == 1 ? " is hidden" : " are hidden"),
                   "of the combinations of tractions: no reading shows it", true});
  else if (mean)
    all.push_back({"the mean is hidden", "a uniform traction shows only where it ends", true});
  else
    all.push_back({"nothing hidden",
                   "every combination of tractions shows in the readings; the "
                   "weakest " +
                       brief(own.identifiability.condition) + " times less"});
  const auto& [exchange, pair_here, best] = survey.advice;
  if (const auto& index = exchange ? exchange : pair_here ? pair_here : best)
    all.push_back({in_words(survey.alternatives[*index], scene.units),
                   own.unknowns == 1 ? "would tell both tractions" : "would tell more"});
  else
    all.push_back({"keep them", "nothing compared tells more"});
  return all;
}

}  // namespace tactile_net::report
