#include "tactile_net/report/json/run_json.hpp"

#include <cmath>

#include "report/json/answer_json.hpp"
#include "report/json/network_values.hpp"
#include "report/json/scene_json.hpp"
#include "report/json/schemas.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/table.hpp"

namespace tactile_net {

template <>
struct Fields<lab::ComponentError> {
  using E = lab::ComponentError;
  static constexpr auto all = std::tuple{
      field("mean_abs", &E::mean_abs, Measure::stress, "Mean of |found - true|."),
      field(
          "relative", [](const E& error) { return if_finite(error.relative); },
          "Root mean square of found - true, of a line over that of the component's own truth, of "
          "a skin over that of the true normal traction; null: that is zero.")};
};

template <>
struct Fields<AlphaSweep::Curve> {
  using C = AlphaSweep::Curve;
  static constexpr auto all = std::tuple{
      field(
          "rule", [](const C& curve) { return name(curve.rule); }, "The rule's name."),
      field(
          "alpha", [](const C& curve) { return curve.choice.alpha; }, "That it chooses."),
      field(
          "verdict", [](const C& curve) { return name(curve.choice.verdict); }, "Of that choice."),
      field(
          "values",
          [](const C& curve) {
            std::vector<std::optional<double>> values;
            for (const double value : curve.values) values.push_back(if_finite(value));
            return values;
          },
          "What it minimises, at each alpha; null: not finite.")};
};

template <>
struct Fields<AlphaSweep> {
  static constexpr auto all =
      std::tuple{field("alphas", &AlphaSweep::alphas, "The values tried, rising."),
                 field("rules", &AlphaSweep::curves, "Every rule on this frame.")};
};

namespace report {

namespace {

struct TruthTold : lab::ByComponent<std::vector<double>> {
  double force = 0.0;
  SkinWrench resultant{};

  static constexpr auto described = std::tuple_cat(
      Fields<lab::ByComponent<std::vector<double>>>::all,
      std::tuple{
          field("force", &TruthTold::force, Measure::load, "The contacts' normal force, exact."),
          field("resultant", &TruthTold::resultant, "What the contacts amount to, exact.",
                Of::skins)});
};

struct MethodTimes {
  std::optional<double> setup{};
  std::optional<double> frame{};

  static constexpr auto described = std::tuple{
      field("setup", &MethodTimes::setup, Measure::time,
            "Until a frame can be solved; null: not timed."),
      field("frame", &MethodTimes::frame, Measure::time,
            "Of a frame, of the circuit of a whole run of the simulator; null: not timed.")};
};

/// Where the readings of a channel of an uneven line are taken.
struct TaxelsTold {
  std::vector<std::size_t> index{};
  std::vector<double> y{};
  std::vector<double> depth{};
  std::vector<double> width{};

  static constexpr auto described = std::tuple{
      field("index", &TaxelsTold::index, "The taxels' numbers."),
      field("y", &TaxelsTold::y, Measure::length, "Along the line."),
      field("depth", &TaxelsTold::depth, Measure::length, "Below the surface."),
      field("width", &TaxelsTold::width, Measure::length, "Over which a taxel averages.")};
};

/// A method's answer.
struct ReconstructionTold : lab::AnswerTold {
  Method method = Method::tikhonov;
  std::optional<lab::ByComponent<lab::ComponentError>> error{};
  std::optional<double> force{};
  std::optional<MethodTimes> seconds{};
  IfAny<SurfaceGrid> grid{};
  Sentences said{};
  IfAny<std::string> failure{};

  static constexpr auto described = std::tuple_cat(
      std::tuple{field("method", &ReconstructionTold::method, "The method.")},
      Fields<lab::AnswerTold>::all,
      std::tuple{
          field("error", &ReconstructionTold::error, "Beside the truth; null: there is no answer."),
          field("force", &ReconstructionTold::force, Measure::load,
                "The sum of all normal tractions; null: there is no answer."),
          field("seconds", &ReconstructionTold::seconds, "What it took; null: there is no answer."),
          field("grid", &ReconstructionTold::grid,
                "The cells of this answer; only of a circuit whose nodes stand for other cells."),
          field(
              "warnings", [](const auto& told) { return told.said.warnings; },
              "What to know before the answer is trusted."),
          field(
              "notes", [](const auto& told) { return told.said.notes; },
              "What was found beside it in the normal course."),
          field("failure", &ReconstructionTold::failure,
                "Why no answer holds; absent: one does.")});
};

struct RunTold : SceneFrameTold {
  std::vector<double> positions{};
  SurfaceGrid grid{};
  TruthTold truth{};
  std::vector<std::pair<std::string, std::vector<double>>> readings{};
  IfAny<std::vector<std::pair<std::string, TaxelsTold>>> taxels{};
  std::vector<ReconstructionTold> reconstructions{};
  std::optional<AlphaSweep> alpha_sweep{};
  std::optional<lab::Relaxation> network{};
  std::vector<std::string> warnings{};

  static constexpr auto described = std::tuple_cat(
      SceneFrameTold::described,
      std::tuple{field("positions", &RunTold::positions, Measure::length,
                       "Where the tractions are along the line.", Of::lines),
                 field("grid", &RunTold::grid, "The cells: tractions are row after row along y.",
                       Of::skins),
                 field("truth", &RunTold::truth, "What presses, at the same places."),
                 field("readings", &RunTold::readings, "Of each channel, taxel by taxel."),
                 field("taxels", &RunTold::taxels,
                       "Where these are taken, of each channel; only of taxels that are not even.",
                       Of::lines),
                 field("reconstructions", &RunTold::reconstructions, "Each method's answer."),
                 field("alpha_sweep", &RunTold::alpha_sweep,
                       "Every rule for alpha on this frame; null: nobody asked."),
                 field("network", &RunTold::network,
                       "The circuit in the simulator; null: there was none."),
                 field("warnings", &RunTold::warnings, "What to know of the readings.")});
};

std::vector<std::pair<std::string, TaxelsTold>> taxels_told(const SensorArray& array) {
  std::vector<std::pair<std::string, TaxelsTold>> all;
  for (const Channel& channel : channels(array)) all.emplace_back(channel.name, TaxelsTold{});
  for (const Site& site : sites(array)) {
    TaxelsTold& one = all[site.channel].second;
    one.index.push_back(site.taxel);
    one.y.push_back(site.y);
    one.depth.push_back(site.depth);
    one.width.push_back(site.width);
  }
  return all;
}

std::vector<std::pair<std::string, std::vector<double>>> readings_told(
    const auto& sensor, std::span<const double> readings) {
  std::vector<std::pair<std::string, std::vector<double>>> all;
  for (const Channel& channel : channels(sensor)) {
    const auto one = readings.subspan(channel.first, channel.count);
    all.emplace_back(channel.name, std::vector<double>(one.begin(), one.end()));
  }
  return all;
}

ReconstructionTold reconstruction_told(const lab::Experiment& experiment,
                                       const lab::MethodResult& result) {
  const std::optional<double> weight = std::visit(
      [](const auto& scene) { return scene.reconstruct.tangential_weight; }, experiment.scene);
  const std::size_t places = result.grid ? result.grid->count() : experiment.places();
  ReconstructionTold told{lab::answer_told(result.answer, places, weight)};
  told.method = result.method;
  told.grid.value = result.grid;
  told.said = remarks_in_words(experiment, result);
  if (result.has_answer()) {
    told.error.emplace();
    for (std::size_t c = 0; c < result.errors.size(); ++c) told.error->all[c] = result.errors[c];
    told.force = result.force;
    told.seconds = MethodTimes{.setup = if_finite(result.setup_seconds),
                               .frame = if_finite(result.frame_seconds)};
  }
  if (std::string failure = failure_in_words(experiment, result); !failure.empty())
    told.failure.value = std::move(failure);
  return told;
}

RunTold run_told(const lab::Experiment& experiment) {
  const lab::SimulatedFrame& frame = experiment.frame;
  RunTold told{std::visit([](const auto& scene) { return scene_told(scene); }, experiment.scene)};
  told.grid = experiment.grid;
  told.truth = {lab::by_component(frame.truth, experiment.places()), frame.force, frame.wrench};
  told.alpha_sweep = experiment.sweep;
  told.warnings = in_words(frame);
  std::visit(
      [&](const auto& scene) { told.readings = readings_told(scene.sensor, frame.readings); },
      experiment.scene);
  if (!experiment.of_skin()) {
    told.positions = positions(surface(experiment.line()));
    if (const SensorArray& sensor = experiment.line().sensor; !is_even(sensor))
      told.taxels.value = taxels_told(sensor);
  }
  for (const lab::MethodResult& result : experiment.results)
    told.reconstructions.push_back(reconstruction_told(experiment, result));
  if (experiment.relaxation) told.network = experiment.relaxation;
  return told;
}

}  // namespace

std::string experiment_json(const lab::Experiment& experiment) {
  return document_text(kind::run, experiment.of_skin() ? Of::skins : Of::lines,
                       run_told(experiment));
}

Json run_schema() { return document_schema<RunTold>(kind::run, "What `run` has found"); }

}  // namespace report
}  // namespace tactile_net
