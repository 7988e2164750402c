#include "tactile_net/report/words/identify_words.hpp"

#include <algorithm>

#include "report/words/number_words.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/mode_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::report {
namespace {

namespace reason = lab::hidden_reason;

std::string uniform(Traction component) {
  return "a uniform " + std::string(line_name(component)) + " traction (k = 0)";
}

std::string say(const reason::OneStrain&, const std::optional<Units>&) {
  return "Because strain_y is -strain_x at nu = 0.5: two strains at one depth are one quantity.";
}
std::string say(const reason::Proportional&, const std::optional<Units>&) {
  return "Because the quantities read answer to both tractions in the same proportion.";
}
std::string say(const reason::OddKernels& r, const std::optional<Units>&) {
  return "Because every kernel of a " + std::string(line_name(r.component)) +
         " traction read here is odd, what acts left and right of a taxel cancels: for " +
         uniform(r.component) +
         ", which shows only where it stops, and for one that alternates from taxel to taxel "
         "(Nyquist).";
}
std::string say(const reason::MeanUnread& r, const std::optional<Units>&) {
  return "Because none of the quantities read answers to " + uniform(r.component) +
         ", it shows only where it stops.";
}
std::string say(const reason::UnknownOffsets&, const std::optional<Units>&) {
  return "Because the offset of each channel is not known, what all of its taxels read alike says "
         "nothing: " +
         uniform(Traction::normal) + " shows only where it stops.";
}
std::string say(const reason::Symmetry& r, const std::optional<Units>&) {
  return "An odd number of taxels (" + std::to_string(r.taxels) + ") leaves " +
         (r.lost == 1 ? "one combination" : "some combinations") +
         " of tractions unmeasured, because of symmetry. An even number of taxels, or a second "
         "depth, would measure " +
         (r.lost == 1 ? "it." : "them.");
}
std::string say(const reason::FewReadings& r, const std::optional<Units>&) {
  return "The array has " + std::to_string(r.readings) + " readings, and " +
         std::to_string(r.tractions) + " tractions would be as many as its taxels can have.";
}
std::string say(const reason::DeadTaxels&, const std::optional<Units>&) {
  return "Dead taxels read nothing: what only they would show is lost.";
}
std::string say(const reason::Smoothing& r, const std::optional<Units>& units) {
  return "Because the pad smooths: of a ripple of wavelength " +
         length_in_words(units, r.wavelength) +
         ", about exp(-2 pi depth / wavelength) = " + brief(r.left) + " arrives at depth " +
         length_in_words(units, r.depth) + ".";
}

/// "normal ripples down to wavelength 2, no tangential ripple"
std::string told(const lab::SensorChoice& choice, const std::optional<Units>& units) {
  const auto down_to = [&](Traction traction, const std::optional<double>& wavelength) {
    return wavelength ? std::string(line_name(traction)) + " ripples down to wavelength " +
                            length_in_words(units, *wavelength)
                      : "no " + std::string(line_name(traction)) + " ripple";
  };
  std::string text = down_to(Traction::normal, choice.normal);
  if (choice.unknowns == 2) text += ", " + down_to(Traction::tangential_y, choice.tangential);
  return text;
}

/// What falls between two taxels.
std::string unseen(const lab::SensorChoice& choice, double traction,
                   const std::optional<Units>& units) {
  const std::string pressing = in_unit(units, Dimension::stress, traction);
  const std::string nothing = " between two taxels changes no reading by more than the noise";
  if (!choice.unseen) return "A contact of " + pressing + nothing + ", however wide it is.";
  return "A contact of " + pressing + " that is narrower than " +
         length_in_words(units, *choice.unseen) + nothing + ".";
}

/// The quantities that one choice reads and the other does not.
std::string difference(const lab::SensorChoice& from, const lab::SensorChoice& without) {
  std::vector<std::string> names;
  for (const Quantity quantity : from.reads)
    if (std::find(without.reads.begin(), without.reads.end(), quantity) == without.reads.end())
      names.emplace_back(name(quantity));
  return join(names, " and ");
}

std::string condition_or_singular(const Identifiability& result) {
  return result.null_space.dimension > 0 ? "singular" : brief(result.condition);
}

std::vector<std::string> advice_in_words(const lab::Survey& survey,
                                         const std::optional<Units>& units) {
  const lab::SensorChoice& own = survey.own;
  const auto& [exchange, pair_here, best] = survey.advice;
  std::vector<std::string> text;
  if (exchange) {
    const lab::SensorChoice& other = survey.alternatives[*exchange];
    const bool reveals = lab::hides_anything(own) && !lab::hides_anything(other);
    text.push_back("Read " + difference(other, own) + " instead of " + difference(own, other) +
                   ": " + (reveals ? "nothing is hidden then; " : "") + told(other, units) + ".");
  }
  if (own.unknowns == 1)
    text.emplace_back(
        "Only the normal traction is solved for. What friction adds to the readings is wrongly "
        "counted as normal traction.");
  const auto add = [&](const std::string& what, std::size_t index) {
    const lab::SensorChoice& other = survey.alternatives[index];
    text.push_back(what + (own.unknowns == 1 ? " for both tractions: " : ": ") +
                   in_words(other, units) + "; " + told(other, units) + ".");
  };
  if (pair_here) add("Best of the pairs compared at this depth", *pair_here);
  if (best) add("Best of all compared", *best);
  if (!exchange && !pair_here && !best) text.emplace_back("Nothing compared tells more.");
  return text;
}

}  // namespace

std::string in_words(const lab::SensorChoice& choice, const std::optional<Units>& units) {
  std::vector<std::string> reads;
  std::vector<std::string> depths;
  for (const Quantity quantity : choice.reads) reads.emplace_back(name(quantity));
  for (const double depth : choice.depths) depths.push_back(length_in_words(units, depth));
  return join(reads, ", ") + " at " + join(depths, " and ");
}

std::string in_words(const lab::AssumedNoise& noise) {
  return (noise.kind == lab::AssumedNoise::Kind::stated
              ? "the scene's rms; for quantities without one the same share, "
              : "") +
         brief(100.0 * noise.share) +
         " % of the largest reading that a ripple of that normal traction causes";
}

std::string in_words(const lab::HiddenReason& reason, const std::optional<Units>& units) {
  return std::visit([&](const auto& one) { return say(one, units); }, reason);
}

std::vector<std::string> verdict_in_words(const lab::Survey& survey,
                                          const std::optional<Units>& units) {
  const Identifiability& own = survey.own.identifiability;
  std::vector<std::string> text;
  if (own.null_space.dimension > 0)
    text.push_back("Cannot tell: " + in_words(own.null_space, units) + ".");
  else
    text.push_back("Every combination of tractions shows in the readings; the weakest, " +
                   brief(own.condition) +
                   " times less than the strongest: " + in_words(own.weakest, units) + ".");
  for (const lab::HiddenReason& reason : survey.reasons) text.push_back(in_words(reason, units));
  text.push_back("Of ripples with an amplitude of " +
                 in_unit(units, Dimension::stress, survey.traction) + ", under noise of " +
                 in_words(survey.noise) + ", these sensors tell " + told(survey.own, units) + ".");
  text.push_back(unseen(survey.own, survey.traction, units));
  for (std::string& sentence : advice_in_words(survey, units)) text.push_back(std::move(sentence));
  return text;
}

std::vector<std::vector<std::string>> survey_cells(const lab::Survey& survey,
                                                   const std::optional<Units>& units) {
  std::vector<std::vector<std::string>> rows = {{"reads", "unknowns", "condition", "hidden",
                                                 "hidden mean", "normal from", "tangential from",
                                                 "unseen below"}};
  const auto wavelength = [&](const std::optional<double>& value) {
    return value ? in_unit(units, Dimension::length, *value) : std::string("none");
  };
  const auto add = [&](const lab::SensorChoice& choice, const std::string& mark) {
    const bool two = choice.unknowns == 2;
    std::vector<std::string> means;
    if (lab::hides_mean(choice, Traction::normal)) means.emplace_back("normal");
    if (two && lab::hides_mean(choice, Traction::tangential_y)) means.emplace_back("tangential");
    rows.push_back(
        {in_words(choice, units) + mark, std::to_string(choice.unknowns),
         condition_or_singular(choice.identifiability),
         in_short(choice.identifiability.null_space, units),
         means.empty() ? "-" : join(means, ", "), wavelength(choice.normal),
         two ? wavelength(choice.tangential) : "-",
         choice.unseen ? in_unit(units, Dimension::length, *choice.unseen) : "any width"});
  };
  add(survey.own, " (the scene's)");
  for (const lab::SensorChoice& choice : survey.alternatives) add(choice, "");
  return rows;
}

std::string cells_in_words(const Scene& scene, const lab::Survey& survey) {
  std::string text =
      "normal from, tangential from: the shortest wavelength from which on every ripple of "
      "amplitude " +
      in_unit(scene, Dimension::stress, survey.traction) +
      " stands out of the noise, by its standard deviation in one frame; hidden mean: shows only "
      "at "
      "the array's ends; unseen below: a contact of that traction between two taxels that is "
      "narrower changes no reading by more than the noise. Noise: " +
      in_words(survey.noise) + ".";
  if (survey.taxels < scene.sensor.count)
    text += " Condition and hidden combinations of the alternatives are of " +
            std::to_string(survey.taxels) + " taxels.";
  return text;
}

std::vector<std::string> singular_values_in_words(const Identifiability& result,
                                                  const std::optional<Units>& units) {
  std::vector<std::string> text;
  text.push_back("singular values: " + std::to_string(result.singular_values.size()) + ", from " +
                 brief(result.singular_values.front()) + " to " +
                 brief(result.singular_values.back()) + " in units of the noise; rank " +
                 std::to_string(result.rank) + ", condition " + condition_or_singular(result));
  text.push_back(result.null_space.dimension > 0
                     ? "noise gain: unbounded without smoothing"
                     : "noise gain: noise of the assumed size may become a traction of " +
                           in_unit(units, Dimension::stress, result.noise_gain) +
                           " without smoothing");
  for (const ModeSpace* space : {&result.null_space, &result.nearly_null}) {
    const bool null = space == &result.null_space;
    const std::size_t shown = std::min<std::size_t>(space->modes.size(), 3);
    const std::string kind = null ? "hidden: " : "nearly hidden: ";
    for (std::size_t i = 0; i < shown; ++i)
      text.push_back(
          kind + in_words(space->modes[i], units) +
          (null ? "" : " (singular value " + brief(space->modes[i].singular_value) + ")"));
    if (space->dimension > shown)
      text.push_back(kind + std::to_string(space->dimension - shown) + " more" +
                     wavelengths_in_short(*space, units));
  }
  return text;
}

}  // namespace tactile_net::report
