#include "tactile_net/report/words/skin_survey_words.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

#include "report/words/number_words.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/identify_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::report {
namespace {

using Choice = lab::SkinSensorChoice;

std::string quantity_names(const std::vector<Quantity>& reads) {
  std::vector<std::string> names;
  for (const Quantity quantity : reads) names.emplace_back(name(quantity));
  return join(names, ", ");
}

/// "a, b and c"
std::string listed(std::vector<std::string> parts) {
  if (parts.size() < 2) return join(parts, "");
  const std::string last = std::move(parts.back());
  parts.pop_back();
  return join(parts, ", ") + " and " + last;
}

std::string waves(WaveDirection direction) {
  switch (direction) {
    case WaveDirection::along_y:
      return "waves along y";
    case WaveDirection::along_z:
      return "waves along z";
    case WaveDirection::diagonal:
      return "waves along the diagonals";
    default:
      return "any wave";
  }
}

/// What waves hide, in a column of a table: "curl", "curl along y", "mean of q".
std::string waves_in_short(const HiddenWaves& hidden) {
  if (hidden.direction == WaveDirection::mean) {
    std::vector<std::string> means;
    if (hidden.normal) means.emplace_back("p");
    if (hidden.divergence && hidden.curl)
      means.emplace_back("q");
    else if (hidden.divergence || hidden.curl)
      means.emplace_back(hidden.curl ? "q_z" : "q_y");
    if (hidden.mixed > 0) means.emplace_back("a mixture");
    return "mean of " + join(means, ", ");
  }
  std::vector<std::string> parts;
  if (hidden.normal) parts.emplace_back("p");
  if (hidden.divergence) parts.emplace_back("drag along");
  if (hidden.curl) parts.emplace_back("curl");
  if (hidden.mixed > 0) parts.push_back(counted(hidden.mixed, "mixture"));
  return join(parts, ", ");
}

/// Without what one kind of wave hides because all of them do.
HiddenWaves besides(HiddenWaves one, const HiddenWaves* any) {
  if (!any || one.direction == WaveDirection::any || one.direction == WaveDirection::mean)
    return one;
  one.normal = one.normal && !any->normal;
  one.divergence = one.divergence && !any->divergence;
  one.curl = one.curl && !any->curl;
  one.mixed -= std::min(one.mixed, any->mixed);
  return one;
}

std::vector<HiddenWaves> hidden_of(const Choice& choice) {
  const auto& all = choice.told.hidden;
  const bool for_all = !all.empty() && all.front().direction == WaveDirection::any;
  std::vector<HiddenWaves> some;
  for (const HiddenWaves& one : all)
    if (const HiddenWaves rest = besides(one, for_all ? &all.front() : nullptr); rest.count() > 0)
      some.push_back(rest);
  return some;
}

/// All that waves hide, in a column of a table: "curl along y, z; mean of q".
std::string hidden_in_short(const Choice& choice) {
  std::vector<std::pair<std::string, std::string>> all;  // what, and along which axes
  for (const HiddenWaves& one : hidden_of(choice)) {
    const std::string what = waves_in_short(one);
    std::string along;
    if (one.direction == WaveDirection::along_y) along = "y";
    if (one.direction == WaveDirection::along_z) along = "z";
    if (one.direction == WaveDirection::diagonal) along = "diagonals";
    if (!along.empty() && !all.empty() && all.back().first == what && !all.back().second.empty())
      all.back().second += ", " + along;
    else
      all.emplace_back(what, along);
  }
  std::vector<std::string> parts;
  for (const auto& [what, along] : all)
    parts.push_back(along.empty() ? what : what + " along " + along);
  return join(parts, "; ");
}

std::string mean_in_words(const HiddenWaves& hidden, const std::string& reads) {
  std::vector<std::string> means;
  if (hidden.normal) means.emplace_back("the pressure p");
  if (hidden.divergence) means.emplace_back("the drag q_y");
  if (hidden.curl) means.emplace_back("the drag q_z");
  if (hidden.mixed > 0) means.emplace_back("a mixture of pressure and drag");
  return "What is uniform of " + listed(means) + " shows in " + reads +
         " only where it stops, at the ends of the skin.";
}

/// Where nothing else has a word for it: p with drags.
std::string mixture_in_words(const HiddenWaves& hidden, const std::string& reads) {
  return counted(hidden.mixed, "mixture") + " of pressure and drags in " + waves(hidden.direction) +
         (hidden.mixed == 1 ? " is" : " are") + " not shown by " + reads +
         ": what one of them adds to the readings another takes away.";
}

std::string told(const SkinScene& scene, const Choice& choice) {
  std::vector<std::string> parts;
  for (const SkinRipple ripple : lab::ripples_of(choice.components)) {
    const auto& [y, z, any] = choice.wavelengths[static_cast<std::size_t>(ripple)];
    std::vector<std::string> along;
    if (y && z && std::abs(*y - *z) <= 1e-9 * *y) {
      along.push_back("from " + length_in_words(scene.units, *y) + " on along y and z");
    } else {
      if (y) along.push_back("from " + length_in_words(scene.units, *y) + " on along y");
      if (z) along.push_back("from " + length_in_words(scene.units, *z) + " on along z");
    }
    if (any && *any > std::max(y.value_or(0.0), z.value_or(0.0)) * (1.0 + 1e-9))
      along.push_back("from " + length_in_words(scene.units, *any) + " on in every direction");
    if (!any && !along.empty()) along.emplace_back("not of every wave between");
    const std::string what = in_words(ripple);
    parts.push_back(along.empty() ? "no " + what : what + " " + join(along, ", "));
  }
  return join(parts, "; ");
}

std::string unseen(const SkinScene& scene, const Choice& choice, double traction) {
  const std::string pressing = in_unit(scene.units, Dimension::stress, traction);
  const std::string nothing =
      " in the widest gap of the taxels changes no reading by more than "
      "the noise";
  if (!choice.unseen) return "A round contact of " + pressing + nothing + ", however wide it is.";
  return "A round contact of " + pressing + " that is narrower than " +
         length_in_words(scene.units, *choice.unseen) + nothing + ".";
}

void add_finite(std::vector<std::string>& text, const SkinScene& scene,
                const lab::SkinSurvey& survey) {
  const auto& finite = survey.own.told.finite;
  if (!finite) return;
  const bool whole = survey.rows == scene.sensor.rows && survey.columns == scene.sensor.columns;
  const std::string lattice = whole ? "at the taxels"
                                    : "at " + std::to_string(survey.rows) + " x " +
                                          std::to_string(survey.columns) + " of the taxels";
  const std::string all = counted(finite->tractions, "combination") + " of tractions " + lattice;
  if (finite->hidden > 0)
    text.push_back("Of the " + all + " " + std::to_string(finite->hidden) +
                   (finite->hidden == 1 ? " shows" : " show") + " in no reading.");
  else
    text.push_back("Each of the " + all + " shows in the readings, the weakest " +
                   brief(finite->condition) +
                   " times less than the strongest; without smoothing, noise of the size assumed "
                   "becomes tractions of up to " +
                   in_unit(scene.units, Dimension::stress, finite->noise_gain) + ".");
  if (finite->boundary_only > 0)
    text.push_back(
        std::to_string(finite->boundary_only) + (finite->hidden > 0 ? " more" : " of them") +
        (finite->boundary_only == 1 ? " shows" : " show") +
        " only at the ends of the skin: treat " + (finite->boundary_only == 1 ? "it" : "them") +
        " as not measured, however good the condition looks.");
  if (finite->hidden > finite->hidden_waves)
    text.push_back("Reason for " + std::to_string(finite->hidden - finite->hidden_waves) +
                   " of those that show in no reading: the pad smooths short waves away, or the "
                   "number of rows or columns is odd, which for symmetry leaves one reading too "
                   "few.");
  if (finite->dead > 0)
    text.push_back("Dead taxels hide " + std::to_string(finite->dead) + " more.");
}

std::vector<std::string> advice_in_words(const SkinScene& scene, const lab::SkinSurvey& survey) {
  std::vector<std::string> text;
  const auto add = [&](const char* what, const std::optional<std::size_t>& index) {
    if (!index) return;
    const Choice& other = survey.alternatives[*index];
    const bool reveals = lab::hidden_waves(survey.own) > 0 && lab::hidden_waves(other) == 0 &&
                         other.components >= survey.own.components;
    text.push_back(std::string(what) + ": " + in_words(other, scene.units) + ". " +
                   (reveals ? "Every wave shows then; it" : "It") + " tells " + told(scene, other) +
                   ".");
  };
  add("Better, with no more to read", survey.exchange);
  add("Best of all compared", survey.best);
  if (text.empty()) text.emplace_back("Nothing compared tells more.");
  return text;
}

}  // namespace

std::string in_words(const Choice& choice, const std::optional<Units>& units) {
  std::vector<std::string> depths;
  for (const double depth : choice.depths)
    depths.push_back(in_unit(units, Dimension::length, depth));
  const auto [least, most] = std::minmax_element(choice.depths.begin(), choice.depths.end());
  const std::string at = depths.size() <= 4 ? join(depths, " and ")
                                            : in_unit(units, Dimension::length, *least) + " to " +
                                                  in_unit(units, Dimension::length, *most);
  return quantity_names(choice.reads) + " at " + at;
}

std::string in_words(SkinRipple ripple) {
  switch (ripple) {
    case SkinRipple::drag_along:
      return "drag along the wave";
    case SkinRipple::drag_across:
      return "drag across it (the curl)";
    default:
      return "p";
  }
}

std::vector<std::string> hidden_in_words(const Choice& choice) {
  const std::string reads = listed([&] {
    std::vector<std::string> names;
    for (const Quantity quantity : choice.reads) names.emplace_back(name(quantity));
    return names;
  }());
  std::vector<std::string> text;
  for (const HiddenWaves& one : hidden_of(choice)) {
    if (one.direction == WaveDirection::mean) {
      text.push_back(mean_in_words(one, reads));
      continue;
    }
    const std::string of = one.direction == WaveDirection::any ? "" : " of " + waves(one.direction);
    const std::string none = " is seen by no depth of " + reads;
    if (one.curl)
      text.push_back(
          "The curl of q" + of + none +
          ": drags that run around a point, or across a wave, do not change these readings.");
    if (one.normal) text.push_back("The pressure p" + of + none + ".");
    if (one.divergence) text.push_back("The drag along the wave" + of + none + ".");
    if (one.mixed > 0) text.push_back(mixture_in_words(one, reads));
  }
  return text;
}

std::vector<std::string> verdict_in_words(const SkinScene& scene, const lab::SkinSurvey& survey) {
  std::vector<std::string> text = hidden_in_words(survey.own);
  if (text.empty())
    text.emplace_back(survey.own.components == 3
                          ? "Every wave of p and of both drags shows in these readings."
                          : "Every wave of p shows in these readings.");
  if (survey.own.components == 1)
    text.emplace_back(
        "Only the pressure p is solved for. What friction adds to the readings is wrongly counted "
        "as pressure.");
  if (is_even(scene.sensor) && (scene.sensor.rows == 1 || scene.sensor.columns == 1))
    text.emplace_back(
        "The taxels stand in one row: they do not tell how tractions change across it, and all "
        "that is said of waves holds for waves along it.");
  add_finite(text, scene, survey);
  text.push_back("Of ripples with an amplitude of " +
                 in_unit(scene.units, Dimension::stress, survey.traction) + ", under noise of " +
                 in_words(survey.noise) + ", these sensors tell, away from the ends of the skin: " +
                 told(scene, survey.own) + ".");
  text.push_back(unseen(scene, survey.own, survey.traction));
  for (std::string& sentence : advice_in_words(scene, survey)) text.push_back(std::move(sentence));
  return text;
}

std::vector<std::vector<std::string>> share_cells(const SkinScene& scene,
                                                  const lab::SkinSurvey& survey) {
  std::vector<std::vector<std::string>> rows = {{"reading"}};
  for (const SkinRipple ripple : lab::ripples_of(survey.own.components))
    rows.front().push_back(in_words(ripple));
  for (const lab::WaveShare& share : survey.shares) {
    rows.push_back(
        {std::string(name(share.quantity)) + " at " + length_in_words(scene.units, share.depth)});
    for (const SkinRipple ripple : lab::ripples_of(survey.own.components)) {
      const double signal = share.signal[static_cast<std::size_t>(ripple)];
      rows.back().push_back(signal > 0.0 ? brief(signal) : "nothing");
    }
  }
  return rows;
}

std::string shares_in_words(const SkinScene& scene, const lab::SkinSurvey& survey) {
  return "How many times its noise each taxel reads of an oblique wave (30 deg from y) " +
         length_in_words(scene.units, survey.wave) + " long, with an amplitude of " +
         in_unit(scene.units, Dimension::stress, survey.traction) +
         " of each part: what determines it.";
}

std::vector<std::vector<std::string>> survey_cells(const SkinScene& scene,
                                                   const lab::SkinSurvey& survey) {
  std::vector<std::vector<std::string>> rows = {{"reads", "waves hide", "condition", "hidden",
                                                 "by ends alone", "noise gain", "p from",
                                                 "drag along from", "across from", "unseen below"}};
  const auto add = [&](const Choice& choice, const char* mark) {
    const std::string hidden = hidden_in_short(choice);
    const auto& finite = choice.told.finite;
    const auto from = [&](SkinRipple ripple) {
      if (ripple != SkinRipple::pressure && choice.components == 1) return std::string("-");
      const auto wavelength = choice.resolvable(ripple);
      return wavelength ? length_in_words(scene.units, *wavelength) : std::string("none");
    };
    const bool singular = finite ? finite->hidden > 0 : !std::isfinite(choice.wave_condition);
    rows.push_back(
        {in_words(choice, scene.units) + mark, hidden.empty() ? "-" : hidden,
         singular ? "singular" : brief(finite ? finite->condition : choice.wave_condition),
         finite ? std::to_string(finite->hidden) : "-",
         finite ? std::to_string(finite->boundary_only) : "-",
         finite && !singular ? in_unit(scene.units, Dimension::stress, finite->noise_gain) : "-",
         from(SkinRipple::pressure), from(SkinRipple::drag_along), from(SkinRipple::drag_across),
         choice.unseen ? length_in_words(scene.units, *choice.unseen) : "any width"});
  };
  add(survey.own, " (the scene's)");
  for (const Choice& choice : survey.alternatives) add(choice, "");
  return rows;
}

std::string cells_in_words(const SkinScene& scene, const lab::SkinSurvey& survey) {
  std::string text =
      "waves hide: what no reading shows of waves, whatever their length; hidden: combinations of "
      "tractions at the taxels that no reading shows; by ends alone: those that waves hide and "
      "only "
      "the skin's ends show; noise gain: what noise may become without smoothing; p from, drag "
      "along from, across from: the shortest wavelength from which on every ripple of amplitude " +
      in_unit(scene.units, Dimension::stress, survey.traction) +
      " stands out of the noise, away from the ends; unseen below: a round contact of that "
      "traction in the widest gap that is narrower changes no reading by more than the noise. No "
      "lattice tells waves along an axis that are shorter than two of its pitches. Noise: " +
      in_words(survey.noise) + ".";
  if (!survey.own.told.finite)
    text += " Of uneven taxels the condition is that of an oblique wave " +
            length_in_words(scene.units, survey.wave) + " long.";
  else if (survey.rows < scene.sensor.rows || survey.columns < scene.sensor.columns)
    text += " Condition, hidden combinations and noise gain are of " + std::to_string(survey.rows) +
            " x " + std::to_string(survey.columns) + " of the taxels.";
  return text;
}

std::vector<Answer> answers(const SkinScene& scene, const lab::SkinSurvey& survey) {
  const Choice& own = survey.own;
  std::vector<Answer> all;
  const std::string ripples = in_unit(scene.units, Dimension::stress, survey.traction);
  for (const SkinRipple ripple : lab::ripples_of(own.components)) {
    const auto wavelength = own.resolvable(ripple);
    const std::string what = "ripples of " + ripples + " of " + in_words(ripple);
    if (wavelength)
      all.push_back({"from " + length_in_words(scene.units, *wavelength),
                     what + " are told, by their wavelength"});
    else
      all.push_back({"none", "of " + what + " stands out of the noise", true});
  }
  const std::string hidden = hidden_in_short(own);
  if (hidden.empty())
    all.push_back({"nothing hidden", own.components == 3
                                         ? "every wave of p and of the drags shows"
                                         : "every wave of p shows; drags are counted as pressure"});
  else
    all.push_back({hidden, "no reading shows it: the answer there is a guess by smoothness", true});
  if (const auto& index = survey.exchange ? survey.exchange : survey.best)
    all.push_back({in_words(survey.alternatives[*index], scene.units), "would tell more"});
  else
    all.push_back({"keep them", "nothing compared tells more"});
  return all;
}

void print_survey(std::ostream& out, const SkinScene& scene, const lab::SkinSurvey& survey) {
  out << scene.file << ": " << (scene.title.empty() ? "" : scene.title + "\n  ")
      << sensor_in_words(scene) << "; " << material_in_words(scene) << "\n\n";
  for (const std::string& sentence : verdict_in_words(scene, survey)) out << sentence << '\n';
  out << '\n' << shares_in_words(scene, survey) << '\n';
  print_cells(out, share_cells(scene, survey));
  out << '\n';
  print_cells(out, survey_cells(scene, survey));
  out << cells_in_words(scene, survey) << '\n';
}

}  // namespace tactile_net::report
