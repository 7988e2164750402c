#include "tactile_net/report/words/identify_words.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/scene_words.hpp"

namespace tactile_net::report {
namespace {

std::string word(Traction traction) {
  return traction == Traction::normal ? "normal" : "tangential";
}

bool reads(const lab::SensorChoice& choice, Quantity quantity) {
  return std::find(choice.reads.begin(), choice.reads.end(), quantity) != choice.reads.end();
}

bool strains_only(const lab::SensorChoice& choice) {
  return std::all_of(choice.reads.begin(), choice.reads.end(), is_strain);
}

/// True if every kernel of that traction is odd in what is read.
bool only_odd(const lab::SensorChoice& choice, Traction traction) {
  return std::all_of(choice.reads.begin(), choice.reads.end(), [&](Quantity quantity) {
    return (quantity == Quantity::shear_xy) == (traction == Traction::normal);
  });
}

/// True if the channels answer to both tractions in one proportion, at every wavelength.
bool in_proportion(const lab::SensorChoice& choice) {
  const auto hidden = [](const Resolution& resolution) {
    return !std::isfinite(resolution.normal) && !std::isfinite(resolution.tangential);
  };
  const auto begin = choice.resolutions.begin() + 1;
  const auto end = choice.resolutions.end() - 1;  // Nyquist, where odd kernels show nothing
  return choice.unknowns == 2 && begin < end && std::all_of(begin, end, hidden);
}

std::string told(const lab::SensorChoice& choice) {
  const auto down_to = [](Traction traction, const std::optional<double>& wavelength) {
    return wavelength ? word(traction) + " ripples down to wavelength " + brief(*wavelength)
                      : "no " + word(traction) + " ripple";
  };
  std::string text = down_to(Traction::normal, choice.normal);
  if (choice.unknowns == 2) text += ", " + down_to(Traction::tangential, choice.tangential);
  return text;
}

void add_reasons(std::vector<std::string>& text, const lab::Survey& survey, const Scene& scene) {
  const lab::SensorChoice& own = survey.own;
  const ModeSpace& null_space = own.identifiability.null_space;
  const std::size_t lost = lost_by_symmetry(scene.sensor, own.unknowns);
  const bool proportional = in_proportion(own);

  if (proportional)
    text.emplace_back(scene.material.poisson_ratio == 0.5 && strains_only(own)
                          ? "Because strain_y is -strain_x at nu = 0.5: two strains at one depth "
                            "are one quantity."
                          : "Because the quantities read answer to both tractions in the same "
                            "proportion.");
  for (const Traction traction : {Traction::normal, Traction::tangential}) {
    if (own.unknowns == 1 && traction == Traction::tangential) break;
    if (!lab::hides_mean(own, traction)) continue;
    const std::string uniform = "a uniform " + word(traction) + " traction (k = 0)";
    if (only_odd(own, traction))
      text.push_back("Because every kernel of a " + word(traction) +
                     " traction read here is odd, what acts left and right of a taxel cancels: "
                     "for " +
                     uniform +
                     ", which shows only where it stops, and for one that alternates from taxel "
                     "to taxel (Nyquist).");
    else
      text.push_back("Because none of the quantities read answers to " + uniform +
                     ", it shows only where it stops.");
  }
  if (lost > 0)
    text.push_back("With " + std::to_string(scene.sensor.count) + " taxels, an odd count, " +
                   (lost == 1 ? "one combination is" : "some are") +
                   " lost exactly: of the readings that are even or odd about the centre, those "
                   "that it could show in are one fewer than their unknowns.");
  if (!scene.dead_taxels.empty() && null_space.dimension > lost)
    text.emplace_back("Dead taxels read nothing: what only they would show is lost.");
  else if (!proportional && null_space.dimension > lost && null_space.shortest > 0.0) {
    const double depth = *std::min_element(own.depths.begin(), own.depths.end());
    text.push_back("Because the pad smooths: of a ripple of wavelength " +
                   brief(null_space.shortest) + ", about exp(-2 pi depth / wavelength) = " +
                   brief(std::exp(-2.0 * std::numbers::pi * depth / null_space.shortest)) +
                   " arrives at depth " + brief(depth) + ".");
  }
}

bool hides(const lab::SensorChoice& choice) {
  return choice.identifiability.null_space.dimension > 0 ||
         lab::hides_mean(choice, Traction::normal) ||
         (choice.unknowns == 2 && lab::hides_mean(choice, Traction::tangential));
}

/// The best alternative of those that `counts`, if it is worth a change.
const lab::SensorChoice* best_of(const lab::Survey& survey, const auto& counts) {
  const lab::SensorChoice* best = nullptr;
  for (const lab::SensorChoice& choice : survey.alternatives)
    if (counts(choice) && (best == nullptr || lab::tells_more(choice, *best))) best = &choice;
  if (best == nullptr || best->unknowns != survey.own.unknowns) return best;
  const bool worth = lab::tells_more(*best, survey.own) &&
                     ((hides(survey.own) && !hides(*best)) ||
                      lab::coarsest(*best) < 0.9 * lab::coarsest(survey.own));
  return worth ? best : nullptr;
}

std::string difference(const lab::SensorChoice& from, const lab::SensorChoice& without) {
  std::vector<std::string> names;
  for (const Quantity quantity : from.reads)
    if (!reads(without, quantity)) names.emplace_back(name(quantity));
  return join(names, " and ");
}

void add_advice(std::vector<std::string>& text, const lab::Survey& survey) {
  const lab::SensorChoice& own = survey.own;
  const auto sees = [&](const lab::SensorChoice& choice) {
    return (hides(own) && !hides(choice) ? "nothing is hidden then; " : "") + told(choice) + ".";
  };
  const auto here = [&](const lab::SensorChoice& choice) {
    return choice.depths == own.depths && choice.reads.size() == own.reads.size() &&
           choice.unknowns == own.unknowns;
  };
  const lab::SensorChoice* one = best_of(survey, [&](const lab::SensorChoice& choice) {
    return here(choice) && (own.reads.size() == 1 ||
                            std::any_of(own.reads.begin(), own.reads.end(), [&](Quantity quantity) {
                              return reads(choice, quantity);
                            }));
  });
  const lab::SensorChoice* at_depth = best_of(survey, [&](const lab::SensorChoice& choice) {
    return choice.unknowns == 2 && choice.depths.size() == 1 &&
           choice.depths.front() == own.depths.front();
  });
  const lab::SensorChoice* any =
      best_of(survey, [](const lab::SensorChoice& choice) { return choice.unknowns == 2; });

  if (one != nullptr)
    text.push_back("Read " + difference(*one, own) + " instead of " + difference(own, *one) + ": " +
                   sees(*one));
  if (own.unknowns == 1)
    text.emplace_back(
        "One unknown is solved: the normal traction. What friction adds to the readings is taken "
        "for it.");
  const std::string subject = own.unknowns == 1 ? " for both tractions: " : ": ";
  if (at_depth != nullptr && at_depth != one)
    text.push_back("Best of the pairs compared at this depth" + subject + in_words(*at_depth) +
                   "; " + told(*at_depth) + ".");
  if (any != nullptr && any != one && any != at_depth)
    text.push_back("Best of all compared" + subject + in_words(*any) + "; " + told(*any) + ".");
  if (one == nullptr && at_depth == nullptr && any == nullptr)
    text.emplace_back("Nothing compared tells more.");
}

}  // namespace

std::vector<std::string> verdict_in_words(const lab::Survey& survey, const Scene& scene) {
  const Identifiability& own = survey.own.identifiability;
  std::vector<std::string> text;
  if (own.null_space.dimension > 0)
    text.push_back("Cannot tell: " + own.null_space.description + ".");
  else
    text.push_back("Every combination of tractions shows in the readings; the weakest, " +
                   brief(own.condition) +
                   " times less than the strongest: " + own.weakest.description + ".");
  add_reasons(text, survey, scene);
  text.push_back("From the noise assumed these sensors tell " + told(survey.own) + ".");
  add_advice(text, survey);
  return text;
}

}  // namespace tactile_net::report
