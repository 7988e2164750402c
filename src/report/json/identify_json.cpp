#include "tactile_net/report/json/identify_json.hpp"

#include <cmath>

#include "numeric/named.hpp"
#include "report/json/scene_json.hpp"
#include "report/json/schemas.hpp"
#include "tactile_net/report/words/identify_words.hpp"
#include "tactile_net/report/words/mode_words.hpp"

namespace tactile_net {
namespace report {

/// Which traction holds most of a combination.
enum class ModeTraction { both, normal, tangential };
constexpr Enumerator<ModeTraction> mode_tractions[] = {
    {ModeTraction::both, "both", "Neither traction holds 90 % of it."},
    {ModeTraction::normal, "normal", "The normal traction holds at least 90 % of it."},
    {ModeTraction::tangential, "tangential", "The tangential traction holds at least 90 % of it."}};

}  // namespace report

template <>
struct Enumerators<report::ModeTraction> {
  static constexpr const auto& all = report::mode_tractions;
};

template <>
struct Fields<HiddenWaves> {
  static constexpr auto all = std::tuple{
      field("waves", &HiddenWaves::direction, "Of which waves it is hidden."),
      field("pressure", &HiddenWaves::normal, "Whether the normal traction is."),
      field("drag_along", &HiddenWaves::divergence, "Whether the drag along the wave is."),
      field("drag_across", &HiddenWaves::curl, "Whether the drag across the wave is, the curl."),
      field("mixed", &HiddenWaves::mixed, "How many combinations of several are, besides.")};
};

namespace report {
namespace {

struct ModeTold {
  ModeTraction unknown = ModeTraction::both;
  std::optional<double> wavelength{};
  std::string description{};
  double singular_value = 0.0;
  bool exact = false;

  static constexpr auto described = std::tuple{
      field("unknown", &ModeTold::unknown, "Of which traction it is."),
      field("wavelength", &ModeTold::wavelength, Measure::length, "Its wave; null: a constant."),
      field("description", &ModeTold::description, "All of it as a sentence."),
      field("singular_value", &ModeTold::singular_value, "How strongly it shows."),
      field("exact", &ModeTold::exact,
            "True: no reading shows it in double precision; false: it is nearly hidden.")};
};

struct SpaceTold {
  std::size_t dimension = 0;
  std::optional<double> longest{};
  std::optional<double> shortest{};
  bool constant = false;

  static constexpr auto described = std::tuple{
      field("dimension", &SpaceTold::dimension, "How many combinations are in it."),
      field("longest", &SpaceTold::longest, Measure::length,
            "The longest wave that is half or more of one of them; null: a constant, or none is."),
      field("shortest", &SpaceTold::shortest, Measure::length,
            "The shortest such wave; null: none is."),
      field("constant", &SpaceTold::constant, "Whether a constant is in it.")};
};

struct ResolvableTold {
  std::optional<double> normal{};
  std::optional<double> tangential{};

  static constexpr auto described = std::tuple{
      field("normal", &ResolvableTold::normal, Measure::length,
            "Of normal traction, waves of every direction; null: none is told."),
      field("tangential", &ResolvableTold::tangential, Measure::length,
            "Of tangential traction, of a skin the drag that is told worse; null: none is told, "
            "or it is not solved for.")};
};

struct DirectionsTold {
  std::optional<double> along_y{}, along_z{}, any{};

  static constexpr auto described = std::tuple{
      field("along_y", &DirectionsTold::along_y, Measure::length, "Of waves along y."),
      field("along_z", &DirectionsTold::along_z, Measure::length, "Of waves along z."),
      field("any", &DirectionsTold::any, Measure::length, "Of waves of every direction.")};
};

/// One of each part of a ripple.
template <class T>
struct PartsTold {
  T pressure{}, drag_along{}, drag_across{};

  static constexpr auto described =
      std::tuple{field("pressure", &PartsTold::pressure, "Of the normal traction."),
                 field("drag_along", &PartsTold::drag_along,
                       "Of the drag along the wave, of a line its tangential traction."),
                 field("drag_across", &PartsTold::drag_across,
                       "Of the drag across the wave, which a line does not have.")};

  PartsTold() = default;
  PartsTold(const auto& parts, const auto& told)
      : pressure(told(parts[0])), drag_along(told(parts[1])), drag_across(told(parts[2])) {}
};

struct ChoiceTold {
  std::vector<std::string_view> reads{};
  std::vector<double> depths{};
  std::size_t unknowns = 1;
  std::vector<HiddenWaves> hidden{};
  std::optional<double> condition{};
  std::optional<std::size_t> rank{};
  std::optional<std::size_t> rank_deficiency{};
  std::optional<double> noise_gain{};
  std::optional<std::size_t> hidden_by_dead_taxels{};
  std::optional<std::size_t> hidden_waves{};
  std::optional<std::size_t> by_ends_alone{};
  std::optional<double> wave_condition{};
  std::optional<std::vector<ModeTold>> null_modes{};
  std::optional<SpaceTold> null_space{};
  std::optional<SpaceTold> nearly_null{};
  ResolvableTold resolvable_wavelength{};
  std::optional<PartsTold<DirectionsTold>> by_direction{};
  std::optional<double> unseen_width{};

  static constexpr auto described = std::tuple{
      field("reads", &ChoiceTold::reads, "The quantities that are read."),
      field("depths", &ChoiceTold::depths, Measure::length, "Where they are read."),
      field("unknowns", &ChoiceTold::unknowns,
            "Tractions of each place: 1, the normal one alone; with drag 2 of a line, 3 of a "
            "skin."),
      field("hidden", &ChoiceTold::hidden,
            "What no reading shows of waves, whatever their length; of a line of means alone."),
      field("condition", &ChoiceTold::condition,
            "The largest singular value over the least, of a skin over the least that shows; null: "
            "infinite, or taxels anywhere on a skin."),
      field("rank", &ChoiceTold::rank,
            "Combinations of tractions at the taxels that show; null: taxels anywhere on a skin."),
      field("rank_deficiency", &ChoiceTold::rank_deficiency,
            "Combinations that no reading shows; null: taxels anywhere on a skin."),
      field("noise_gain", &ChoiceTold::noise_gain, Measure::stress,
            "What noise may become without smoothing; null: without bound, or not known."),
      field("hidden_by_dead_taxels", &ChoiceTold::hidden_by_dead_taxels,
            "Combinations that only dead taxels would show; null: a line, or taxels anywhere."),
      field(
          "hidden_waves", &ChoiceTold::hidden_waves,
          "Combinations that a lattice without ends would hide; null: a line, or taxels anywhere."),
      field("by_ends_alone", &ChoiceTold::by_ends_alone,
            "Those of them that show only at the skin's ends; null: a line, or taxels anywhere."),
      field("wave_condition", &ChoiceTold::wave_condition,
            "The condition of the tractions of `wave` itself; null: infinite, or a line."),
      field("null_modes", &ChoiceTold::null_modes,
            "The first few combinations that no reading shows, or nearly none; null: a skin."),
      field("null_space", &ChoiceTold::null_space, "All that no reading shows; null: a skin."),
      field("nearly_null", &ChoiceTold::nearly_null,
            "Those below 1.5e-8 of the largest singular value, which K'K loses; null: a skin."),
      field("resolvable_wavelength", &ChoiceTold::resolvable_wavelength,
            "The shortest wavelength from which on every ripple of `traction` stands out of the "
            "noise, away from the ends."),
      field("by_direction", &ChoiceTold::by_direction,
            "The same by the direction of the wave; null: a line, and of each where none is told."),
      field("unseen_width", &ChoiceTold::unseen_width, Measure::length,
            "A contact of `traction` in the widest gap of the taxels that is narrower changes no "
            "reading by more than the noise; null: none does, however wide.")};
};

struct ShareTold {
  std::string_view quantity{};
  double depth = 0.0;
  double pressure = 0.0, drag_along = 0.0, drag_across = 0.0;

  static constexpr auto described =
      std::tuple{field("quantity", &ShareTold::quantity, "What is read."),
                 field("depth", &ShareTold::depth, Measure::length, "Where."),
                 field("pressure", &ShareTold::pressure, "Of a wave of normal traction."),
                 field("drag_along", &ShareTold::drag_along, "Of one of drag along it."),
                 field("drag_across", &ShareTold::drag_across, "Of one of drag across it.")};
};

struct SharesTold {
  double wavelength = 0.0;
  std::vector<ShareTold> readings{};

  static constexpr auto described =
      std::tuple{field("wavelength", &SharesTold::wavelength, Measure::length,
                       "Of the wave; that of a skin is oblique, 30 deg from y."),
                 field("readings", &SharesTold::readings,
                       "How many times its noise each reading is, for a ripple of `traction`.")};
};

struct WaveTold {
  std::array<double, 2> wavenumber{};
  std::optional<double> wavelength{};
  PartsTold<std::optional<double>> deviation{};

  static constexpr auto described = std::tuple{
      field("wavenumber", &WaveTold::wavenumber, "Along y and along z [rad/m]."),
      field("wavelength", &WaveTold::wavelength, Measure::length, "Null: the mean."),
      field("deviation", &WaveTold::deviation,
            "Standard deviation of a ripple's amplitude in one frame, away from the ends; null: "
            "not seen, or not solved for.")};
};

struct AdviceTold {
  std::optional<std::size_t> exchange{}, pair_here{}, best{};

  static constexpr auto described = std::tuple{
      field("exchange", &AdviceTold::exchange, "Better at the same depths, with no more to read."),
      field("pair_here", &AdviceTold::pair_here,
            "Of a line: the best for both tractions at its first depth."),
      field("best", &AdviceTold::best, "The best of all that were compared.")};
};

struct SurveyHead : SceneFrameTold {
  std::vector<std::string> verdict{};
  double traction = 0.0;
  std::string noise{};

  static constexpr auto described = std::tuple_cat(
      SceneFrameTold::described,
      std::tuple{field("verdict", &SurveyHead::verdict, "What these sensors tell, in sentences."),
                 field("traction", &SurveyHead::traction, Measure::stress,
                       "The amplitude of the ripple to be told."),
                 field("noise", &SurveyHead::noise, "The noise that is assumed.")});
};

struct IdentifyTold : SurveyHead, ChoiceTold {
  std::optional<std::vector<double>> singular_values{};
  SharesTold wave{};
  std::vector<WaveTold> waves{};
  std::array<std::size_t, 2> alternatives_taxels{};
  std::vector<ChoiceTold> alternatives{};
  AdviceTold advice{};

  static constexpr auto described = std::tuple_cat(
      SurveyHead::described, ChoiceTold::described,
      std::tuple{
          field("singular_values", &IdentifyTold::singular_values,
                "Of the kernel with its rows divided by the noise: their inverses are tractions; "
                "null: a skin."),
          field("wave", &IdentifyTold::wave, "Which reading determines what."),
          field("waves", &IdentifyTold::waves,
                "How well each ripple is known, the mean first; those of a line run along y."),
          field("alternatives_taxels", &IdentifyTold::alternatives_taxels,
                "Rows and columns of the taxels that singular values of the alternatives are of, "
                "of a skin those of its own too; a line has one column."),
          field("alternatives", &IdentifyTold::alternatives,
                "Other quantities and depths in the place of the scene's."),
          field("advice", &IdentifyTold::advice,
                "Indices of `alternatives`; null: it would change little, or is named before.")});
};

void add_modes(std::vector<ModeTold>& modes, const ModeSpace& space, bool exact) {
  for (const TractionMode& mode : space.modes)
    modes.push_back({.unknown = !mode.unknown                       ? ModeTraction::both
                                : *mode.unknown == Traction::normal ? ModeTraction::normal
                                                                    : ModeTraction::tangential,
                     .wavelength = mode.wavelength,
                     .description = in_words(mode),
                     .singular_value = mode.singular_value,
                     .exact = exact});
}

SpaceTold space_told(const ModeSpace& space) {
  const bool empty = space.longest == 0.0;
  return {.dimension = space.dimension,
          .longest = empty ? std::nullopt : if_finite(space.longest),
          .shortest = empty ? std::nullopt : if_finite(space.shortest),
          .constant = std::isinf(space.longest)};
}

ChoiceTold choice_told(const lab::SensorChoice& choice) {
  ChoiceTold told{.depths = choice.depths,
                  .unknowns = choice.unknowns,
                  .hidden = choice.hidden,
                  .resolvable_wavelength = {.normal = choice.resolvable(SkinRipple::pressure),
                                            .tangential = lab::resolvable_drag(choice)},
                  .unseen_width = choice.unseen};
  for (const Quantity quantity : choice.reads) told.reads.push_back(name(quantity));
  if (const auto& array = choice.array) {
    told.condition = if_finite(array->condition);
    told.rank = array->tractions - array->hidden;
    told.rank_deficiency = array->hidden;
    told.noise_gain = if_finite(array->noise_gain);
  }
  if (const auto& modes = choice.identifiability) {
    add_modes(told.null_modes.emplace(), modes->null_space, true);
    add_modes(*told.null_modes, modes->nearly_null, false);
    told.null_space = space_told(modes->null_space);
    told.nearly_null = space_told(modes->nearly_null);
    return told;
  }
  if (const auto& array = choice.array) {
    told.hidden_by_dead_taxels = array->dead;
    told.hidden_waves = array->hidden_waves;
    told.by_ends_alone = array->boundary_only;
  }
  told.wave_condition = if_finite(choice.wave_condition);
  told.by_direction.emplace(choice.wavelengths, [](const auto& of) {
    return DirectionsTold{of[0], of[1], of[2]};
  });
  return told;
}

std::string identify_json(const auto& scene, const lab::Survey& survey) {
  IdentifyTold told;
  static_cast<SceneFrameTold&>(told) = scene_told(scene);
  static_cast<ChoiceTold&>(told) = choice_told(survey.own);
  told.verdict = verdict_in_words(survey, scene.units);
  told.traction = survey.traction;
  told.noise = in_words(survey.noise);
  if (survey.own.identifiability)
    told.singular_values = survey.own.identifiability->singular_values;
  told.wave.wavelength = survey.wave;
  for (const lab::WaveShare& share : survey.shares)
    told.wave.readings.push_back({.quantity = name(share.quantity),
                                  .depth = share.depth,
                                  .pressure = share.signal[0],
                                  .drag_along = share.signal[1],
                                  .drag_across = share.signal[2]});
  for (const SkinResolution& one : survey.own.resolutions)
    told.waves.push_back({.wavenumber = {one.wavenumber_y, one.wavenumber_z},
                          .wavelength = if_finite(one.wavelength()),
                          .deviation = {one.of_wave, if_finite}});
  told.alternatives_taxels = {survey.rows, survey.columns};
  for (const lab::SensorChoice& choice : survey.alternatives)
    told.alternatives.push_back(choice_told(choice));
  told.advice = {.exchange = survey.advice.exchange,
                 .pair_here = survey.advice.pair_here,
                 .best = survey.advice.best};
  return document_text(kind::identify, told);
}

}  // namespace

std::string survey_json(const Scene& scene, const lab::Survey& survey) {
  return identify_json(scene, survey);
}
std::string survey_json(const SkinScene& scene, const lab::Survey& survey) {
  return identify_json(scene, survey);
}

Json identify_schema() {
  return document_schema<IdentifyTold>(kind::identify, "What `identify` writes");
}

}  // namespace report
}  // namespace tactile_net
