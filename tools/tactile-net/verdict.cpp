#include "verdict.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "text.hpp"

namespace tactile_net::tool {
namespace {

std::string word(Traction traction) {
  return traction == Traction::normal ? "normal" : "tangential";
}

bool reads(const SensorChoice& choice, Quantity quantity) {
  return std::find(choice.reads.begin(), choice.reads.end(), quantity) != choice.reads.end();
}

bool strains_only(const SensorChoice& choice) {
  return std::all_of(choice.reads.begin(), choice.reads.end(), is_strain);
}

/// True if every kernel of that traction is odd in what is read.
bool only_odd(const SensorChoice& choice, Traction traction) {
  return std::all_of(choice.reads.begin(), choice.reads.end(), [&](Quantity quantity) {
    return (quantity == Quantity::shear_xy) == (traction == Traction::normal);
  });
}

/// True if the channels answer to both tractions in one proportion, at every wavelength.
bool in_proportion(const SensorChoice& choice) {
  const auto hidden = [](const Resolution& resolution) {
    return !std::isfinite(resolution.normal) && !std::isfinite(resolution.tangential);
  };
  const auto begin = choice.resolutions.begin() + 1;
  const auto end = choice.resolutions.end() - 1;  // Nyquist, where odd kernels show nothing
  return choice.unknowns == 2 && begin < end && std::all_of(begin, end, hidden);
}

std::string in_words(const ModeSpace& space) {
  std::string text = space.modes.front().description;
  if (space.dimension > 1) {
    text += "; and " + std::to_string(space.dimension - 1) + " combinations more";
    if (space.longest > 0.0)
      text += std::isinf(space.longest)
                  ? ", from constant ones to wavelength " + brief(space.shortest)
                  : ", of wavelengths " + brief(space.longest) + " to " + brief(space.shortest);
  }
  return text;
}

std::string told(const SensorChoice& choice) {
  const auto down_to = [](Traction traction, const std::optional<double>& wavelength) {
    return wavelength ? word(traction) + " ripples down to wavelength " + brief(*wavelength)
                      : "no " + word(traction) + " ripple";
  };
  std::string text = down_to(Traction::normal, choice.normal);
  if (choice.unknowns == 2) text += ", " + down_to(Traction::tangential, choice.tangential);
  return text;
}

void add_reasons(std::vector<std::string>& text, const Survey& survey, const Scene& scene) {
  const SensorChoice& own = survey.own;
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
    if (!hides_mean(own, traction)) continue;
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

/// The best choice at the same depth that keeps something of what is read now; null: none is
/// better.
const SensorChoice* neighbour(const Survey& survey) {
  const SensorChoice& own = survey.own;
  const SensorChoice* best = &own;
  for (const SensorChoice& choice : survey.alternatives) {
    const bool keeps = own.unknowns == 1 ||
                       std::any_of(own.reads.begin(), own.reads.end(),
                                   [&](Quantity quantity) { return reads(choice, quantity); });
    const bool here = own.reads.size() > 1 ? choice.depths == own.depths
                                           : choice.depths.front() == own.depths.front();
    if (choice.unknowns == own.unknowns && keeps && here && tells_more(choice, *best))
      best = &choice;
  }
  return best == &own ? nullptr : best;
}

std::string difference(const SensorChoice& from, const SensorChoice& without) {
  std::vector<std::string> names;
  for (const Quantity quantity : from.reads)
    if (!reads(without, quantity)) names.emplace_back(name(quantity));
  return join(names, " and ");
}

void add_advice(std::vector<std::string>& text, const Survey& survey) {
  const SensorChoice& own = survey.own;
  const SensorChoice* other = neighbour(survey);
  if (other == nullptr) {
    text.emplace_back("None of the quantities compared tells more at this depth.");
  } else {
    const bool exchange = other->depths == own.depths && other->reads.size() == own.reads.size();
    text.push_back(
        "Read " +
        (exchange ? difference(*other, own) + " instead of " + difference(own, *other)
                  : in_words(*other) + " instead") +
        ": " +
        (other->identifiability.null_space.dimension == 0 ? "nothing is hidden then, " : "") +
        told(*other) + ".");
  }
  if (own.unknowns == 1)
    text.emplace_back(
        "One unknown is solved: the normal traction. What friction adds to the readings would be "
        "taken for it.");

  const auto best = std::min_element(survey.alternatives.begin(), survey.alternatives.end(),
                                     [&](const auto& a, const auto& b) {
                                       if (a.unknowns != b.unknowns) return a.unknowns > b.unknowns;
                                       return tells_more(a, b);
                                     });
  if (best != survey.alternatives.end() && best->unknowns == 2 &&
      (own.unknowns == 1 || tells_more(*best, own)) && &*best != other)
    text.push_back("Of all compared, " + in_words(*best) +
                   " tells most of both tractions: " + told(*best) + ".");
}

}  // namespace

std::vector<std::string> verdict_in_words(const Survey& survey, const Scene& scene) {
  const Identifiability& own = survey.own.identifiability;
  std::vector<std::string> text;
  if (own.null_space.dimension > 0)
    text.push_back("Cannot tell: " + in_words(own.null_space) + ".");
  else
    text.push_back("Every combination of tractions shows in the readings; the weakest, " +
                   brief(own.condition) +
                   " times less than the strongest: " + own.weakest.description + ".");
  add_reasons(text, survey, scene);
  text.push_back("From the noise assumed these sensors tell " + told(survey.own) + ".");
  add_advice(text, survey);
  return text;
}

}  // namespace tactile_net::tool
