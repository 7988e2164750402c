#include "tactile_net/report/words/identify_words.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

#include "report/words/hidden_words.hpp"
#include "report/words/number_words.hpp"
#include "report/words/scene_head.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/answers.hpp"
#include "tactile_net/report/words/mode_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::report {
namespace {

using Choice = lab::SensorChoice;

std::string pressing(const lab::Survey& survey, const std::optional<Units>& units) {
  return in_unit(units, Dimension::stress, survey.traction);
}

std::string line_part(SkinRipple ripple) {
  return std::string(
      line_name(ripple == SkinRipple::pressure ? Traction::normal : Traction::tangential_y));
}

/// Of a line: "normal ripples down to wavelength 2".
std::string line_ripples_told(const Choice& choice, SkinRipple ripple,
                              const std::optional<Units>& units) {
  const auto wavelength = choice.resolvable(ripple);
  return wavelength ? line_part(ripple) + " ripples down to wavelength " +
                          length_in_words(units, *wavelength)
                    : "no " + line_part(ripple) + " ripple";
}

/// Of a skin: "p from 2 mm on along y and z".
std::string waves_told(const Choice& choice, SkinRipple ripple, const std::optional<Units>& units) {
  const auto& [y, z, any] = choice.wavelengths[static_cast<std::size_t>(ripple)];
  std::vector<std::string> along;
  if (y && z && std::abs(*y - *z) <= 1e-9 * *y) {
    along.push_back("from " + length_in_words(units, *y) + " on along y and z");
  } else {
    if (y) along.push_back("from " + length_in_words(units, *y) + " on along y");
    if (z) along.push_back("from " + length_in_words(units, *z) + " on along z");
  }
  if (any && *any > std::max(y.value_or(0.0), z.value_or(0.0)) * (1.0 + 1e-9))
    along.push_back("from " + length_in_words(units, *any) + " on in every direction");
  if (!any && !along.empty()) along.emplace_back("not of every wave between");
  return along.empty() ? "no " + in_words(ripple) : in_words(ripple) + " " + join(along, ", ");
}

/// "normal ripples down to wavelength 2, no tangential ripple"
std::string told(const Choice& choice, const std::optional<Units>& units) {
  const bool line = choice.identifiability.has_value();
  std::vector<std::string> parts;
  for (const SkinRipple ripple : lab::ripples_of(choice.unknowns))
    parts.push_back(line ? line_ripples_told(choice, ripple, units)
                         : waves_told(choice, ripple, units));
  return join(parts, line ? ", " : "; ");
}

std::string nothing_hidden(const lab::Survey& survey, const std::optional<Units>& units) {
  const Choice& own = survey.own;
  if (!survey.is_skin())
    return "Every combination of tractions shows in the readings; the weakest, " +
           brief(own.array->condition) +
           " times less than the strongest: " + in_words(own.identifiability->weakest, units) + ".";
  return own.unknowns == 3 ? "Every wave of p and of both drags shows in these readings."
                           : "Every wave of p shows in these readings.";
}

/// What a skin's lattice with its ends tells.
void add_lattice(std::vector<std::string>& text, const lab::Survey& survey,
                 const std::optional<Units>& units) {
  const FiniteObservability& array = *survey.own.array;
  if (survey.rows == 1 || survey.columns == 1)
    text.emplace_back(
        "The taxels stand in one row: they do not tell how tractions change across it, and all "
        "that is said of waves holds for waves along it.");
  const std::string lattice = survey.is_whole
                                  ? "at the taxels"
                                  : "at " + std::to_string(survey.rows) + " x " +
                                        std::to_string(survey.columns) + " of the taxels";
  const std::string all = counted(array.tractions, "combination") + " of tractions " + lattice;
  if (array.hidden > 0)
    text.push_back("Of the " + all + " " + std::to_string(array.hidden) +
                   (array.hidden == 1 ? " shows" : " show") + " in no reading.");
  else
    text.push_back("Each of the " + all + " shows in the readings, the weakest " +
                   brief(array.condition) +
                   " times less than the strongest; without smoothing, noise of the size assumed "
                   "becomes tractions of up to " +
                   in_unit(units, Dimension::stress, array.noise_gain) + ".");
  if (array.boundary_only > 0)
    text.push_back(std::to_string(array.boundary_only) + (array.hidden > 0 ? " more" : " of them") +
                   (array.boundary_only == 1 ? " shows" : " show") +
                   " only at the ends of the skin: treat " +
                   (array.boundary_only == 1 ? "it" : "them") +
                   " as not measured, however good the condition looks.");
  if (array.hidden > array.hidden_waves)
    text.push_back("Reason for " + std::to_string(array.hidden - array.hidden_waves) +
                   " of those that show in no reading: the pad smooths short waves away, or the "
                   "number of rows or columns is odd, which for symmetry leaves one reading too "
                   "few.");
  if (array.dead > 0) text.push_back("Dead taxels hide " + std::to_string(array.dead) + " more.");
}

/// What falls between the taxels.
std::string unseen(const lab::Survey& survey, const std::optional<Units>& units) {
  const std::string contact =
      (survey.is_skin() ? "A round contact of " : "A contact of ") + pressing(survey, units);
  const std::string nothing =
      std::string(survey.is_skin() ? " in the widest gap of the taxels" : " between two taxels") +
      " changes no reading by more than the noise";
  const auto& width = survey.own.unseen;
  return width
             ? contact + " that is narrower than " + length_in_words(units, *width) + nothing + "."
             : contact + nothing + ", however wide it is.";
}

/// The quantities that one choice reads and the other does not.
std::string difference(const Choice& from, const Choice& without) {
  std::vector<std::string> names;
  for (const Quantity quantity : from.reads)
    if (std::find(without.reads.begin(), without.reads.end(), quantity) == without.reads.end())
      names.emplace_back(name(quantity));
  return listed(std::move(names));
}

std::vector<std::string> advice_in_words(const lab::Survey& survey,
                                         const std::optional<Units>& units) {
  const Choice& own = survey.own;
  const auto& [exchange, pair_here, best] = survey.advice;
  std::vector<std::string> text;
  if (exchange) {
    const Choice& other = survey.alternatives[*exchange];
    const std::string more = difference(other, own);
    const bool reveals = lab::hides_anything(own) && !lab::hides_anything(other);
    text.push_back((more.empty() ? "Leave out " : "Read " + more + " instead of ") +
                   difference(own, other) + ": " + (reveals ? "nothing is hidden then; " : "") +
                   told(other, units) + ".");
  }
  const bool gains_one = own.unknowns == 1 && !survey.is_skin();
  const auto add = [&](const std::string& what, std::size_t index) {
    const Choice& other = survey.alternatives[index];
    text.push_back(what + (gains_one ? " for both tractions: " : ": ") + in_words(other, units) +
                   "; " + told(other, units) + ".");
  };
  if (pair_here) add("Best of the pairs compared at this depth", *pair_here);
  if (best) add("Best of all compared", *best);
  if (text.empty()) text.emplace_back("Nothing compared tells more.");
  return text;
}

// The columns of the comparison, each told once.

using SurveyCell = std::string (*)(const Choice& choice, const std::optional<Units>& units);

bool is_singular(const Choice& choice) {
  return choice.array ? choice.array->hidden > 0 : !std::isfinite(choice.wave_condition);
}

std::string condition_cell(const Choice& choice, const std::optional<Units>&) {
  return is_singular(choice)
             ? "singular"
             : brief(choice.array ? choice.array->condition : choice.wave_condition);
}

std::string hidden_cell(const Choice& choice, const std::optional<Units>& units) {
  if (choice.identifiability) return in_short(choice.identifiability->null_space, units);
  return choice.array ? std::to_string(choice.array->hidden) : "-";
}

std::string hidden_mean_cell(const Choice& choice, const std::optional<Units>&) {
  std::vector<std::string> means;
  for (const Traction traction : {Traction::normal, Traction::tangential_y})
    if (lab::hides_mean(choice, traction)) means.emplace_back(line_name(traction));
  return means.empty() ? "-" : join(means, ", ");
}

std::string waves_cell(const Choice& choice, const std::optional<Units>&) {
  const std::string hidden = hidden_in_short(choice);
  return hidden.empty() ? "-" : hidden;
}

std::string gain_cell(const Choice& choice, const std::optional<Units>& units) {
  return choice.array && !is_singular(choice)
             ? in_unit(units, Dimension::stress, choice.array->noise_gain)
             : "-";
}

template <SkinRipple ripple>
std::string wavelength_cell(const Choice& choice, const std::optional<Units>& units) {
  if (static_cast<std::size_t>(ripple) >= choice.unknowns) return "-";
  const auto wavelength = choice.resolvable(ripple);
  return wavelength ? length_in_words(units, *wavelength) : "none";
}

struct SurveyColumn {
  std::string_view header;
  Of of;
  std::string_view meaning;  ///< empty: the header says it
  SurveyCell cell;
};

constexpr SurveyColumn survey_columns[] = {
    {"reads", Of::both, "",
     [](const Choice& choice, const std::optional<Units>& units) {
       return in_words(choice, units);
     }},
    {"unknowns", Of::both, "",
     [](const Choice& choice, const std::optional<Units>&) {
       return std::to_string(choice.unknowns);
     }},
    {"waves hide", Of::skins, "what no reading shows of waves, whatever their length", waves_cell},
    {"condition", Of::both, "", condition_cell},
    {"hidden", Of::both, "combinations of tractions at the taxels that no reading shows",
     hidden_cell},
    {"hidden mean", Of::lines, "shows only at the array's ends", hidden_mean_cell},
    {"by ends alone", Of::skins, "those that waves hide and only the skin's ends show",
     [](const Choice& choice, const std::optional<Units>&) {
       return choice.array ? std::to_string(choice.array->boundary_only) : std::string("-");
     }},
    {"noise gain", Of::both, "what noise may become without smoothing", gain_cell},
    {"normal from", Of::lines, "", wavelength_cell<SkinRipple::pressure>},
    {"tangential from", Of::lines, "", wavelength_cell<SkinRipple::drag_along>},
    {"p from", Of::skins, "", wavelength_cell<SkinRipple::pressure>},
    {"drag along from", Of::skins, "", wavelength_cell<SkinRipple::drag_along>},
    {"across from", Of::skins, "", wavelength_cell<SkinRipple::drag_across>},
    {"unseen below", Of::both,
     "a contact of that traction in the widest gap between taxels that is narrower changes no "
     "reading by more than the noise",
     [](const Choice& choice, const std::optional<Units>& units) {
       return choice.unseen ? length_in_words(units, *choice.unseen) : std::string("any width");
     }}};

}  // namespace

std::string in_words(const Choice& choice, const std::optional<Units>& units) {
  std::vector<std::string> reads;
  std::vector<std::string> depths;
  for (const Quantity quantity : choice.reads) reads.emplace_back(name(quantity));
  for (const double depth : choice.depths) depths.push_back(length_in_words(units, depth));
  const auto [least, most] = std::minmax_element(choice.depths.begin(), choice.depths.end());
  return join(reads, ", ") + " at " +
         (depths.size() <= 4
              ? join(depths, " and ")
              : length_in_words(units, *least) + " to " + length_in_words(units, *most));
}

std::string in_words(const lab::AssumedNoise& noise) {
  return (noise.kind == lab::AssumedNoise::Kind::stated
              ? "the scene's rms; for quantities without one the same share, "
              : "") +
         brief(100.0 * noise.share) +
         " % of the largest reading that a ripple of that normal traction causes";
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

std::vector<std::string> verdict_in_words(const lab::Survey& survey,
                                          const std::optional<Units>& units) {
  std::vector<std::string> text = hidden_in_words(survey, units);
  if (text.empty()) text.push_back(nothing_hidden(survey, units));
  for (const lab::HiddenReason& reason : survey.reasons) text.push_back(in_words(reason, units));
  if (survey.own.unknowns == 1)
    text.emplace_back(
        "Only the normal traction is solved for. What friction adds to the readings is wrongly "
        "counted as normal traction.");
  if (survey.is_skin() && survey.own.array) add_lattice(text, survey, units);
  text.push_back("Of ripples with an amplitude of " + pressing(survey, units) +
                 ", under noise of " + in_words(survey.noise) + ", these sensors tell" +
                 (survey.is_skin() ? ", away from the ends of the skin: " : " ") +
                 told(survey.own, units) + ".");
  text.push_back(unseen(survey, units));
  for (std::string& sentence : advice_in_words(survey, units)) text.push_back(std::move(sentence));
  return text;
}

std::vector<std::vector<std::string>> share_cells(const lab::Survey& survey,
                                                  const std::optional<Units>& units) {
  const auto ripples = lab::ripples_of(survey.own.unknowns);
  std::vector<std::vector<std::string>> rows = {{"reading"}};
  for (const SkinRipple ripple : ripples)
    rows.front().push_back(survey.is_skin() ? in_words(ripple) : line_part(ripple));
  for (const lab::WaveShare& share : survey.shares) {
    rows.push_back(
        {std::string(name(share.quantity)) + " at " + length_in_words(units, share.depth)});
    for (const SkinRipple ripple : ripples) {
      const double signal = share.signal[static_cast<std::size_t>(ripple)];
      rows.back().push_back(signal > 0.0 ? brief(signal) : "nothing");
    }
  }
  return rows;
}

std::string shares_in_words(const lab::Survey& survey, const std::optional<Units>& units) {
  return std::string("How many times its noise each taxel reads of ") +
         (survey.is_skin() ? "an oblique wave (30 deg from y) " : "a wave ") +
         length_in_words(units, survey.wave) + " long, with an amplitude of " +
         pressing(survey, units) + " of each part: what determines it.";
}

std::vector<std::vector<std::string>> survey_cells(const lab::Survey& survey,
                                                   const std::optional<Units>& units) {
  std::vector<std::vector<std::string>> rows(2 + survey.alternatives.size());
  for (const SurveyColumn& column : survey_columns) {
    if (!is_of(column.of, survey.is_skin())) continue;
    rows[0].emplace_back(column.header);
    rows[1].push_back(column.cell(survey.own, units));
    for (std::size_t i = 0; i < survey.alternatives.size(); ++i)
      rows[2 + i].push_back(column.cell(survey.alternatives[i], units));
  }
  rows[1].front() += " (the scene's)";
  return rows;
}

std::string cells_in_words(const lab::Survey& survey, const std::optional<Units>& units) {
  const bool skin = survey.is_skin();
  std::string text = "from: the shortest wavelength from which on every ripple of amplitude " +
                     pressing(survey, units) +
                     " stands out of the noise, by its standard deviation in one frame, away from "
                     "the ends";
  for (const SurveyColumn& column : survey_columns)
    if (is_of(column.of, skin) && !column.meaning.empty())
      text += "; " + std::string(column.header) + ": " + std::string(column.meaning);
  text += ". ";
  if (skin)
    text += "No lattice tells waves along an axis that are shorter than two of its pitches. ";
  text += "Noise: " + in_words(survey.noise) + ".";
  if (!survey.own.array)
    text += " Of uneven taxels the condition is that of an oblique wave " +
            length_in_words(units, survey.wave) + " long.";
  else if (!survey.is_whole && skin)
    text += " Condition, hidden combinations and noise gain are of " + std::to_string(survey.rows) +
            " x " + std::to_string(survey.columns) + " of the taxels.";
  else if (!survey.is_whole)
    text += " Condition, hidden combinations and noise gain of the alternatives are of " +
            std::to_string(survey.rows) + " taxels.";
  return text;
}

std::vector<std::string> singular_values_in_words(const Identifiability& result,
                                                  const std::optional<Units>& units) {
  const bool singular = result.null_space.dimension > 0;
  std::vector<std::string> text;
  text.push_back("singular values: " + std::to_string(result.singular_values.size()) + ", from " +
                 brief(result.singular_values.front()) + " to " +
                 brief(result.singular_values.back()) + " in units of the noise; rank " +
                 std::to_string(result.rank) + ", condition " +
                 (singular ? "singular" : brief(result.condition)));
  text.push_back(singular ? "noise gain: unbounded without smoothing"
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

std::vector<Answer> answers(const lab::Survey& survey, const std::optional<Units>& units) {
  const Choice& own = survey.own;
  const bool skin = survey.is_skin();
  std::vector<Answer> all;
  for (const SkinRipple ripple : lab::ripples_of(own.unknowns)) {
    const std::string ripples =
        skin ? "ripples of " + pressing(survey, units) + " of " + in_words(ripple)
             : line_part(ripple) + " ripples of " + pressing(survey, units);
    if (const auto wavelength = own.resolvable(ripple))
      all.push_back({"from " + length_in_words(units, *wavelength),
                     ripples + " are told, by their wavelength: shorter ones drown in the noise"});
    else
      all.push_back({"none", "of " + ripples + " stands out of the noise", true});
  }
  if (own.unknowns == 1)
    all.push_back(
        {"not measured",
         "tangential tractions (drag): under friction the pressure found is wrong; read a "
         "second quantity, such as shear_xy"});
  const std::size_t hidden = own.array ? own.array->hidden : 0;
  if (const std::string waves = skin ? hidden_in_short(own) : ""; !waves.empty())
    all.push_back({waves, "no reading shows it: the answer there is a guess by smoothness", true});
  else if (hidden > 0)
    all.push_back({std::to_string(hidden) + (hidden == 1 ? " is hidden" : " are hidden"),
                   "of the combinations of tractions: no reading shows it", true});
  else if (lab::hidden_waves(own) > 0)
    all.push_back({"the mean is hidden", "a uniform traction shows only where it ends", true});
  else if (own.array)
    all.push_back(
        {"nothing hidden", "every combination of tractions shows in the readings; the weakest " +
                               brief(own.array->condition) + " times less"});
  else
    all.push_back({"nothing hidden", "every wave of the tractions shows"});
  const auto& [exchange, pair_here, best] = survey.advice;
  if (const auto& index = exchange ? exchange : pair_here ? pair_here : best)
    all.push_back({in_words(survey.alternatives[*index], units),
                   survey.alternatives[*index].unknowns > own.unknowns ? "would tell the drag too"
                                                                       : "would tell more"});
  else
    all.push_back({"keep them", "nothing compared tells more"});
  return all;
}

namespace {

void print_survey_of(std::ostream& out, const auto& scene, const lab::Survey& survey) {
  const std::optional<Units>& units = scene.units;
  print_head(out, scene);
  out << '\n';
  for (const std::string& sentence : verdict_in_words(survey, units)) out << sentence << '\n';
  out << '\n';
  if (survey.own.identifiability) {
    for (const std::string& line : singular_values_in_words(*survey.own.identifiability, units))
      out << line << '\n';
    out << '\n';
  }
  out << shares_in_words(survey, units) << '\n';
  print_cells(out, share_cells(survey, units));
  out << '\n';
  print_cells(out, survey_cells(survey, units));
  out << cells_in_words(survey, units) << '\n';
}

}  // namespace

void print_survey(std::ostream& out, const Scene& scene, const lab::Survey& survey) {
  print_survey_of(out, scene, survey);
}
void print_survey(std::ostream& out, const SkinScene& scene, const lab::Survey& survey) {
  print_survey_of(out, scene, survey);
}

}  // namespace tactile_net::report
