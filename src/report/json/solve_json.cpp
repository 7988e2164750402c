#include "tactile_net/report/json/solve_json.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "report/json/answer_json.hpp"
#include "report/json/finding_json.hpp"
#include "report/json/scene_json.hpp"
#include "report/json/schemas.hpp"
#include "report/load_dimension.hpp"
#include "report/shown_numbers.hpp"
#include "tactile_net/report/words/remark_words.hpp"

namespace tactile_net {
namespace report {
namespace {

/// What became of a frame that misses readings.
enum class Incomplete { skipped, estimated };

}  // namespace

template <>
struct JsonForm<lab::Missing> : NamesForm<lab::Missing, lab::Missing::estimate> {};
template <>
struct JsonForm<lab::ContactEvent::Kind>
    : NamesForm<lab::ContactEvent::Kind, lab::ContactEvent::Kind::split> {};

}  // namespace report

template <>
struct Enumerators<report::Incomplete> {
  static constexpr Enumerator<report::Incomplete> all[] = {
      {report::Incomplete::skipped, "skipped", "It has no answer."},
      {report::Incomplete::estimated, "estimated", "It is solved without their taxels."}};
};

template <>
struct Fields<lab::ContactEvent> {
  using E = lab::ContactEvent;
  static constexpr auto all =
      std::tuple{field("frame", &E::frame, "The first frame that shows it, from 0."),
                 field("event", &E::kind, "What became of the contact."),
                 field("id", &E::id, "The contact's number, from 1."),
                 field("other", &E::other,
                       "The contact into which it has merged, or from which it has split; both "
                       "numbers go on; null: none.")};
};

namespace report {
namespace {

/// One of `shown_names`.
template <std::size_t which>
constexpr auto shown_number(Measure measure, std::string_view text, Of of = Of::both) {
  return field(
      shown_names[which], [](const auto& told) { return told.numbers[which]; }, measure, text, of);
}

/// A frame that the page shows, for the frames around it.
struct ShownTold {
  const lab::RecordingOverview& overview;
  const lab::FrameGroup& group;
  std::array<std::optional<double>, shown_names.size()> numbers = shown_numbers(overview, group);

  static constexpr auto described = std::tuple{
      field(
          "frame", [](const auto& told) { return told.group.shown; },
          "The frame, from 0: the one that presses hardest of those it stands for."),
      field(
          "t", [](const auto& told) { return if_finite(told.group.time); }, Measure::time,
          "Its time; null: it has none, or one of no known unit."),
      field(
          "first", [](const auto& told) { return told.group.first; },
          "The first frame that it stands for."),
      field(
          "count", [](const auto& told) { return told.group.count; },
          "How many frames it stands for."),
      field(
          "distrusted", [](const auto& told) { return told.group.distrusted; },
          "How many of these have a verdict that is a fault."),
      field(
          "verdict", [](const auto& told) { return told.group.answer.verdict; },
          "Whether the answer can be trusted: ok, or what is wrong."),
      field(
          "doubted", [](const auto& told) { return told.group.doubted; },
          "How many of these hold readings that cannot be true."),
      field(
          "data",
          [](const auto& told) {
            const auto& data = told.group.answer.data;
            return data ? std::optional(data->doubts) : std::nullopt;
          },
          "Why its readings cannot be a contact's, worst first; null: not judged."),
      shown_number<0>(Measure::none, "How much is smoothed; null: the method does not smooth."),
      shown_number<1>(Measure::load, "The normal force; null: there is no answer."),
      shown_number<2>(Measure::load, "Its deviation; null: not known."),
      shown_number<3>(Measure::load,
                      "The tangential force, of a skin its size; null: not solved for."),
      shown_number<4>(Measure::load, "Its deviation; null: not known."),
      shown_number<5>(Measure::length, "The centre of pressure; null: nothing presses.", Of::lines),
      shown_number<6>(Measure::length, "Its deviation; null: not known.", Of::lines),
      shown_number<7>(
          Measure::reading,
          "The noise of a reading as the residual shows it; null: deviations are not known.",
          Of::lines),
      field(
          "patches",
          [](const auto& told) {
            const auto contacts = told.overview.contacts(told.group);
            return std::vector(contacts.begin(), contacts.end());
          },
          "Each contact by itself, the strongest first; none where nothing presses for certain, or "
          "there are no bands.")};
};

/// A frame of a skin.
struct RowTold {
  const lab::FrameRow& row;
  std::optional<double> tangential_weight{};

  template <class Value>
  [[nodiscard]] std::optional<Value> unless_missing(const Value& value) const {
    return row.missing ? std::nullopt : std::optional(value);
  }

  static constexpr auto described = std::tuple{
      field(
          "t", [](const auto& told) { return if_finite(told.row.time); }, Measure::time,
          "Its time; null: it has none, or one of no known unit."),
      field(
          "verdict", [](const auto& told) { return told.row.verdict; },
          "Whether the answer can be trusted: ok, or what is wrong."),
      field(
          "missing",
          [](const auto& told) -> std::optional<Incomplete> {
            if (told.row.missing) return Incomplete::skipped;
            if (told.row.estimated) return Incomplete::estimated;
            return std::nullopt;
          },
          "What became of it for readings that are missing; null: none are."),
      field(
          "alpha", [](const auto& told) { return told.unless_missing(told.row.alpha.value); },
          "How much is smoothed; null: the frame has no answer."),
      field(
          "alpha_rule",
          [](const auto& told) { return told.unless_missing(source(told.row.alpha)); },
          "The rule that chose alpha, or given; null: the frame has no answer."),
      field("tangential_weight", &RowTold::tangential_weight,
            "Of the drags' stabiliser over the pressure's: stated, or the one under which the "
            "frame is likeliest; null: only one component was solved for, or there is no answer."),
      field(
          "resultant", [](const auto& told) { return told.unless_missing(told.row.wrench); },
          "What the cells that touch amount to; null: the frame has no answer."),
      field(
          "friction", [](const auto& told) { return told.row.friction; },
          "Drag over force; null: not known."),
      field(
          "patches", [](const auto& told) { return told.row.contacts; },
          "Each contact by itself, the strongest first."),
      field(
          "data", [](const auto& told) { return told.unless_missing(told.row.data.doubts); },
          "Why its readings cannot be a contact's, worst first; null: there is no answer.")};
};

struct BadTaxel {
  std::size_t taxel = 0;
  std::size_t frames = 0;

  static constexpr auto described =
      std::tuple{field("taxel", &BadTaxel::taxel, "Its number, from 0."),
                 field("frames", &BadTaxel::frames, "In how many frames it is doubted.")};
};

/// Frames by what is said of them.
using RunsByName = std::vector<std::pair<std::string, lab::FrameRuns>>;

RunsByName runs_by_name(const auto& frames) {
  RunsByName all;
  for (const auto& [one, runs] : frames) all.emplace_back(name(one), runs);
  return all;
}

struct DataTold {
  bool noise_known = false;
  RunsByName doubted{};
  std::vector<BadTaxel> bad_taxels{};

  static constexpr auto described =
      std::tuple{field("noise_known", &DataTold::noise_known, "False: a misfit is never found."),
                 field("doubted", &DataTold::doubted, "The frames that are doubted, by the doubt."),
                 field("bad_taxels", &DataTold::bad_taxels, "The taxels that are doubted.")};
};

struct MissingTold {
  lab::Missing policy = lab::Missing::fail;
  lab::FrameRuns skipped{};
  lab::FrameRuns estimated{};

  static constexpr auto described = std::tuple{
      field("policy", &MissingTold::policy, "What is done with such frames."),
      field("skipped", &MissingTold::skipped, "Frames without an answer."),
      field("estimated", &MissingTold::estimated, "Frames solved without the taxels they miss.")};
};

/// A part of what is told of the condition number.
constexpr auto of_condition(auto lab::Condition::*part) {
  return [part](const auto& told) {
    return told.condition ? std::optional(*told.condition.*part) : std::nullopt;
  };
}

struct SolveTold {
  std::string scene{};
  std::string readings{};
  std::size_t frames = 0;
  Method method = Method::tikhonov;
  std::optional<double> alpha{};
  std::optional<std::string_view> alpha_rule{};
  std::optional<double> alpha_least{};
  std::optional<double> alpha_largest{};
  std::optional<double> tangential_weight{};
  std::optional<double> tangential_weight_least{};
  std::optional<double> tangential_weight_largest{};
  bool offset = false;
  std::string verdict{};
  std::vector<std::pair<std::string, std::size_t>> verdicts{};
  RunsByName distrusted{};
  DataTold data{};
  MissingTold missing{};
  std::optional<lab::Condition> condition{};
  std::vector<std::string> warnings{};
  std::vector<std::string> columns_ignored{};
  double seconds = 0.0;
  std::vector<FindingTold> findings{};
  std::vector<lab::ContactEvent> events{};
  SurfaceGrid grid{};
  std::optional<std::size_t> hardest{};
  std::vector<ShownTold> shown{};
  std::vector<RowTold> rows{};
  IfAny<UnitsTold> units{};

  static constexpr auto described = std::tuple{
      field("scene", &SolveTold::scene,
            "The scene's file; <stdin> where it came from standard input."),
      field("readings", &SolveTold::readings, "Where the readings come from."),
      field("frames", &SolveTold::frames, "How many frames were read."),
      field("method", &SolveTold::method, "The method."),
      field("alpha", &SolveTold::alpha,
            "How much is smoothed, where it is stated; null: a rule chose it, or the method does "
            "not smooth."),
      field("alpha_rule", &SolveTold::alpha_rule,
            "The rule that chose alpha, or given; null: the method does not smooth."),
      field("alpha_least", &SolveTold::alpha_least, "The least that a rule chose; null: none did."),
      field("alpha_largest", &SolveTold::alpha_largest,
            "The largest that a rule chose; null: none did."),
      field("tangential_weight", &SolveTold::tangential_weight,
            "Of the tangential tractions' stabiliser over the normal one's, where the scene "
            "states it; null: each frame has its own, or there is one component."),
      field("tangential_weight_least", &SolveTold::tangential_weight_least,
            "The least of those estimated; null: none was."),
      field("tangential_weight_largest", &SolveTold::tangential_weight_largest,
            "The largest of those estimated; null: none was."),
      field("offset", &SolveTold::offset,
            "Whether each channel's readings have a constant that is not known: "
            "reconstruct.offset."),
      field("verdict", &SolveTold::verdict, "The verdict of all frames; mixed: they have several."),
      field("verdicts", &SolveTold::verdicts, "How many frames have each verdict."),
      field("distrusted", &SolveTold::distrusted,
            "The frames whose verdict is a fault, by the verdict."),
      field("data", &SolveTold::data, "Whether the readings can be true."),
      field("missing", &SolveTold::missing, "Frames with readings that are missing."),
      field("condition", of_condition(&lab::Condition::value),
            "The condition number of what was solved, of the last frame; null: not known."),
      field("condition_kind", of_condition(&lab::Condition::kind),
            "What that number is; null: there is none."),
      field("condition_of", of_condition(&lab::Condition::matrix),
            "The matrix it is of; null: there is none."),
      field("warnings", &SolveTold::warnings, "What to know before the answers are trusted."),
      field("columns_ignored", &SolveTold::columns_ignored,
            "Columns of the readings that no channel has."),
      field("seconds", &SolveTold::seconds, Measure::time, "What it took."),
      field("findings", &SolveTold::findings, "What is suspicious about the readings."),
      field("events", &SolveTold::events,
            "What became of the contacts, in the order in which it was known: that one has "
            "vanished is known some frames later."),
      field("grid", &SolveTold::grid, "The cells: tractions are row after row along y.", Of::skins),
      field("hardest", &SolveTold::hardest,
            "The frame that presses hardest, from 0: of a line one whose verdict is ok, if there "
            "is one; null: none has an answer."),
      field("shown", &SolveTold::shown,
            "The frames that the page shows, of all up to 1500; each stands for `count` of them "
            "from `first` on."),
      field("rows", &SolveTold::rows,
            "What every frame amounts to; of a line bands take many times as long as answers.",
            Of::skins),
      field("units", &SolveTold::units,
            "The units of these numbers; only of a scene with [units].")};
};

std::optional<double> if_positive(double value) {
  return value > 0.0 ? std::optional(value) : std::nullopt;
}

std::size_t number_of_components(const Scene& scene) { return unknowns(scene); }
std::size_t number_of_components(const SkinScene& scene) { return components(scene); }

/// What the scene itself says.
void add_scene(SolveTold& told, const auto& scene) {
  told.scene = scene.file;
  told.offset = scene.reconstruct.offset;
  if (number_of_components(scene) > 1) told.tangential_weight = scene.reconstruct.tangential_weight;
  told.units = units_told(scene.units, load_dimension(scene));
}

void add_frames(SolveTold& told, const lab::RecordingOverview& overview) {
  for (const lab::FrameGroup& group : overview.groups) told.shown.push_back({overview, group});
  for (const lab::FrameRow& row : overview.rows) {
    RowTold one{.row = row};
    if (!row.missing && number_of_components(overview.skin()) > 1)
      one.tangential_weight =
          row.alpha.tangential_weight ? row.alpha.tangential_weight : told.tangential_weight;
    told.rows.push_back(one);
  }
  if (!overview.groups.empty())
    told.hardest = overview.is_line() ? overview.peak().shown : overview.hardest;
}

void add_summary(SolveTold& told, const lab::SolvedFrames& solved) {
  told.frames = solved.frames;
  for (const auto& [verdict, count] : solved.verdicts)
    told.verdicts.emplace_back(name(verdict), count);
  told.verdict = told.verdicts.size() == 1 ? told.verdicts.front().first : "mixed";
  told.distrusted = runs_by_name(solved.distrusted);
  told.data = {.noise_known = solved.noise_known, .doubted = runs_by_name(solved.doubted)};
  for (const auto& [taxel, frames] : solved.bad_taxels)
    told.data.bad_taxels.push_back({.taxel = taxel, .frames = frames});
  told.missing.skipped = solved.skipped;
  told.missing.estimated = solved.estimated;
  if (const lab::ChosenAlpha& alpha = solved.last.alpha; alpha.value > 0.0) {
    if (!alpha.rule) told.alpha = alpha.value;
    told.alpha_rule = source(alpha);
  }
  told.alpha_least = if_positive(solved.least_alpha);
  told.alpha_largest = if_positive(solved.largest_alpha);
  told.tangential_weight_least = solved.least_weight;
  told.tangential_weight_largest = solved.largest_weight;
  told.condition = solved.last.condition;
}

}  // namespace

std::string solve_json(const lab::RecordingOverview& overview, const lab::SolvedFrames& solved,
                       const SolveReport& report) {
  SolveTold told{.readings = report.readings,
                 .method = overview.method,
                 .warnings = in_words(report.remarks),
                 .columns_ignored = {report.columns_ignored.begin(), report.columns_ignored.end()},
                 .seconds = report.seconds,
                 .findings = findings_told(overview.findings, overview.scene),
                 .events = overview.tracker.events(),
                 .grid = overview.grid};
  const Of of = overview.is_line() ? Of::lines : Of::skins;
  std::visit([&](const auto& scene) { add_scene(told, scene); }, overview.scene);
  add_summary(told, solved);
  told.missing.policy = report.missing;
  add_frames(told, overview);
  return document_text(kind::solve, of, told);
}

Json solve_schema() {
  return document_schema<SolveTold>(kind::solve, "A summary of what `solve` answered");
}

}  // namespace report
}  // namespace tactile_net
