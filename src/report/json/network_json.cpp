#include "tactile_net/report/json/network_json.hpp"

#include "report/json/board_fields.hpp"
#include "report/json/datasheet_fields.hpp"
#include "report/json/network_values.hpp"
#include "report/json/refinement_fields.hpp"
#include "report/json/scene_json.hpp"
#include "report/json/schemas.hpp"
#include "tactile_net/report/words/macromodel_words.hpp"
#include "tactile_net/report/words/network_words.hpp"
#include "tactile_net/report/words/parts_words.hpp"

namespace tactile_net {

template <>
struct Fields<ElementCounts> {
  static constexpr auto all = std::tuple{
      field("resistors", &ElementCounts::resistors, "All resistors, negative ones included."),
      field("negative_resistors", &ElementCounts::negative_resistors,
            "Ideal resistors of negative value."),
      field("opamps", &ElementCounts::opamps,
            "Op-amps; one with complementary outputs counts as one."),
      field("inductors", &ElementCounts::inductors, "Inductors."),
      field("capacitors", &ElementCounts::capacitors, "Capacitors."),
      field("devices", &ElementCounts::devices, "Devices with an N-shaped curve."),
      field("sources", &ElementCounts::sources, "Sources of readings, currents or voltages.")};
};

template <>
struct Fields<Theorem> {
  static constexpr auto all = std::tuple{
      field("name", &Theorem::name, "Its number: docs/circuits.md has the proof."),
      field("statement", &Theorem::statement, "What it says, in a sentence."),
      field("holds", &Theorem::holds, "Whether the circuit meets all of its conditions."),
      field(
          "condition", [](const Theorem& one) { return report::condition_in_words(one); },
          "The first condition that the circuit does not meet, in words; empty: it meets all.")};
};

template <>
struct Fields<Dynamics> {
  static constexpr auto all = std::tuple{
      field("states", &Dynamics::states, "How many states the linear circuit has."),
      field("slowest_pole", &Dynamics::slowest, Measure::rate,
            "The largest real part of a pole; above 0 the circuit is unstable."),
      field("damping", &Dynamics::damping,
            "The least -Re/|s| of the poles; 1: nothing rings; below 0: it grows."),
      field("settling_seconds", &Dynamics::settling_seconds, Measure::time,
            "The settling time, with the op-amps' slew; null: it does not settle."),
      field("unslewed_seconds", &Dynamics::unslewed_seconds, Measure::time,
            "The settling time without the op-amps' slew; null: they have none."),
      field(
          "growing_mode", [](const Dynamics& one) { return report::unless_empty(one.mode); },
          "What grows in the outputs, 2-norm 1; null: nothing does.")};
};

template <>
struct Fields<CircuitNoise> {
  static constexpr auto all =
      std::tuple{field("largest_volts", &CircuitNoise::largest, Measure::voltage,
                       "The largest noise of one output, rms."),
                 field("total_volts", &CircuitNoise::total, Measure::voltage,
                       "The 2-norm of all outputs' noise."),
                 field(
                     "relative", [](const CircuitNoise& one) { return if_finite(one.relative); },
                     "The same over the answer's 2-norm; null: there is no load."),
                 field("thermal_share", &CircuitNoise::thermal,
                       "The resistors' share of the noise power, 0 to 1."),
                 field("flicker_share", &CircuitNoise::flicker,
                       "The share of the op-amps' 1/f noise from 0.1 Hz on, 0 to 1.")};
};

template <>
struct Fields<InputErrors> {
  static constexpr auto all = std::tuple{
      field("either_sign", &InputErrors::either_sign,
            "Where each op-amp's has a sign by chance: rms of the answer's relative error."),
      field("alike", &InputErrors::alike,
            "Where every op-amp's has one sign, as a deck has it: the answer's relative error.")};
};

template <>
struct Fields<StaticErrors> {
  static constexpr auto all = std::tuple{
      field("offset", &StaticErrors::offset, "Of the op-amps' offset voltages."),
      field("bias_current", &StaticErrors::bias_current, "Of the currents into their inputs."),
      field("common_mode", &StaticErrors::common_mode,
            "Of their finite common-mode rejection, relative to the answer."),
      field("output_resistance", &StaticErrors::output_resistance,
            "Of the resistance of their outputs, relative to the answer.")};
};

template <>
struct Fields<OutputCurrent> {
  static constexpr auto all =
      std::tuple{field("ampere", &OutputCurrent::largest, Measure::current,
                       "The largest current of one output."),
                 field("opamp", &OutputCurrent::opamp, "The op-amp with that output.")};
};

template <>
struct Fields<ScaleProposal> {
  static constexpr auto all = std::tuple{
      field("volts", &ScaleProposal::volts, Measure::voltage,
            "The node's voltage for 1 Pa, or for a unit of traction."),
      field("volts_by", &ScaleProposal::volts_by, "What keeps the volts from being more."),
      field("siemens", &ScaleProposal::siemens, Measure::conductance,
            "The conductance at which the resistors' noise is as large as the op-amps'."),
      field("noise", &ScaleProposal::noise,
            "The answer's noise at that scale, relative; 0: none is asked for."),
      field("offset", &ScaleProposal::offset,
            "The same of offsets and bias currents of either sign.")};
};

namespace report {
namespace {

IfAny<bool> true_if(bool yes) { return {yes ? std::optional(true) : std::nullopt}; }

constexpr std::string_view realization_text = "How the network is built.";
constexpr std::string_view ladder_text =
    "True: the form of least_squares with a ladder; absent: another circuit.";
constexpr std::string_view stable_text =
    "Whether it is known to be stable with the scene's own op-amps, second poles and capacitances "
    "included.";
constexpr std::string_view opamps_text = "How many op-amps it takes.";

struct DynamicsTold : Dynamics {
  double accuracy = 0.0;

  static constexpr auto described = std::tuple_cat(
      Fields<Dynamics>::all, std::tuple{field("accuracy", &DynamicsTold::accuracy,
                                              "Settled means: within this of the end, relative.")});
};

}  // namespace
}  // namespace report

template <>
struct Fields<Certificate> {
  static constexpr auto all = std::tuple{
      field("realization", &Certificate::realization, report::realization_text),
      field(
          "ladder", [](const Certificate& one) { return report::true_if(one.ladder); },
          report::ladder_text),
      field("stability", &Certificate::stability, "Whether the circuit settles."),
      field("theorem", &Certificate::theorem, "The theorem on this realisation's stability."),
      field("lambda_min", &Certificate::smallest_eigenvalue, "The smallest eigenvalue of P."),
      field(
          "condition", [](const Certificate& one) { return if_finite(one.condition); },
          "The condition number of P; null: P is not positive definite."),
      field("tolerance_margin", &Certificate::tolerance_margin,
            "Every relative error of resistors up to this leaves the network stable; null: nothing "
            "is proven."),
      field("margin_for_any_bandwidth", &Certificate::margin_for_any_bandwidth,
            "Whether that margin holds whatever bandwidths the op-amps have."),
      field("elements", &Certificate::elements, "How many parts the circuit has."),
      field(
          "ohm",
          [](const Certificate& one) {
            return std::array{one.least_ohm, one.greatest_ohm};
          },
          Measure::resistance, "The least and the greatest resistance."),
      field("largest_voltage", &Certificate::largest_voltage, Measure::voltage,
            "The largest voltage of a node at rest."),
      field("power", &Certificate::power, Measure::power, "The heat in the resistors."),
      field("input_volts", &Certificate::input_volts, Measure::voltage,
            "The largest voltage of a reading; null: they come as currents."),
      field(
          "dynamics",
          [](const Certificate& one) {
            return one.dynamics ? std::optional(report::DynamicsTold{*one.dynamics, one.accuracy})
                                : std::nullopt;
          },
          "Poles and settling; null: without a bandwidth, beyond 1500 states, or with capacitance "
          "at outputs that is not modelled."),
      field("noise", &Certificate::noise,
            "Noise at the outputs; null: none is asked for, or nothing settles."),
      field("slewing", &Certificate::slewing,
            "The theorem on op-amps that slew; null: no slew, or nothing is proven."),
      field("static_errors", &Certificate::errors,
            "What the op-amps do to the answer at rest, relative, to first order; null: nothing, "
            "or there is no load."),
      field("output_current", &Certificate::output_current,
            "What the op-amps' outputs carry at rest; null: their output_current is not given, or "
            "there is no load."),
      field("proposal", &Certificate::proposal,
            "A scale that suits the op-amps; null: no noise and no offset to balance."),
      field(
          "warnings",
          [](const Certificate& one) {
            std::vector<std::string> warnings;
            for (const CircuitRemark& remark : one.remarks)
              warnings.push_back(report::in_words(remark));
            return warnings;
          },
          "The rules that the circuit breaks, and what to do.")};
};

template <>
struct Fields<Contribution> {
  static constexpr auto all = std::tuple{
      field("component", &Contribution::component, "The part's name in the circuit."),
      field("share", &Contribution::share, "Its share of the squared error, to first order.")};
};

template <>
struct Fields<ToleranceResult> {
  static constexpr auto all = std::tuple{
      field("trials", &ToleranceResult::trials, "How many builds were drawn."),
      field("stable", &ToleranceResult::stable, "How many of them are stable."),
      field("accurate", &ToleranceResult::accurate,
            "How many are stable, and within the accuracy asked for."),
      field("yield", &ToleranceResult::yield, "Their share of all, 0 to 1."),
      field(
          "median_error", [](const ToleranceResult& one) { return if_finite(one.median); },
          "The median of the relative errors; null: that build is unstable."),
      field(
          "p95_error", [](const ToleranceResult& one) { return if_finite(one.p95); },
          "The error that 95 of 100 builds stay within; null: that build is unstable."),
      field("predicted_error", &ToleranceResult::predicted,
            "The rms error that first order predicts."),
      field("worst_components", &ToleranceResult::worst, "The parts that count most.")};
};

template <>
struct Fields<Transient> {
  static constexpr auto all = std::tuple{
      field("judgement", &Transient::end, "How the simulated step ends."),
      field("settling_seconds", &Transient::settling_seconds, Measure::time,
            "The settling time in ngspice; null: it does not settle."),
      field("growth", &Transient::growth, Measure::rate,
            "How fast the outputs' 2-norm grows; 0: it does not."),
      field(
          "growing_mode", [](const Transient& one) { return report::unless_empty(one.mode); },
          "What grows in the outputs, 2-norm 1; null: nothing does."),
      field("end_error", &Transient::end_error,
            "How far the end is from the answer at rest, relative."),
      field("simulated_seconds", &Transient::simulated, Measure::time,
            "How much of the circuit's time was simulated."),
      field("ngspice_seconds", &Transient::seconds, Measure::time, "How long ngspice took.")};
};

template <>
struct Fields<lab::ContactMotion> {
  static constexpr auto all =
      std::tuple{field("delay_seconds", &lab::ContactMotion::delay, Measure::time,
                       "How far the circuit is behind contacts that move steadily."),
                 field(
                     "lag", [](const lab::ContactMotion&) { return lab::ContactMotion::lag; },
                     "The share of the answer that counts as behind."),
                 field("speed", &lab::ContactMotion::speed, Measure::speed,
                       "The speed of contacts at which the answer is behind by that share."),
                 field("slowest_hertz", &lab::ContactMotion::slowest_hertz, Measure::frequency,
                       "The frequency up to which the slowest direction follows, -3 dB."),
                 field(
                     "sampling_hertz",
                     [](const lab::ContactMotion&) { return lab::ContactMotion::sampling_hertz; },
                     Measure::frequency, "The rate of the loop that the circuit is compared with."),
                 field("sampled_speed", &lab::ContactMotion::sampled_speed, Measure::speed,
                       "The same speed of an answer that is sampled and held at that rate.")};
};

template <>
struct Fields<PartClass> {
  static constexpr auto all =
      std::tuple{field("tolerance", &PartClass::tolerance, "The parts' relative tolerance."),
                 field("price", &PartClass::price, "The price of one.")};
};

template <>
struct Fields<lab::PartsList::Candidate> {
  using One = lab::PartsList::Candidate;
  static constexpr auto all = std::tuple{
      field("realization", &One::realization, report::realization_text),
      field(
          "ladder", [](const One& one) { return report::true_if(one.ladder); },
          report::ladder_text),
      field("opamps", &One::opamps, report::opamps_text),
      field("stable_with_opamps", &One::stable, report::stable_text),
      field(
          "met", [](const One& one) { return one.list.met; },
          "Whether the finest class everywhere, or less, meets the target."),
      field(
          "counts", [](const One& one) -> const auto& { return one.list.counts; },
          "How many resistors of each class."),
      field("price", &One::price, "The price of resistors and op-amps."),
      field("pairs", &One::pairs, "How many resistors are two parts, in series or in parallel."),
      field("rounding", &One::rounding, "What values of the series do to the answer, relative."),
      field("resistors_price", &One::resistors_price, "The price of the resistors."),
      field("resistors_price_bound", &One::resistors_bound,
            "No list with these values that meets the target is cheaper."),
      field(
          "opamps_error", [](const One& one) { return one.opamps_alone.total; },
          "What the op-amps do at rest with exact resistors: rms, to first order."),
      field(
          "opamps_p95_error", [](const One& one) { return if_finite(one.opamps_p95); },
          "What 95 of 100 draws of op-amps with exact resistors are within; null: unstable."),
      field(
          "common_p95_error", [](const One& one) { return if_finite(one.common_p95); },
          "The same with what all resistors have in common, reel and temperature."),
      field(
          "p95_error",
          [](const One& one) { return one.p95 ? if_finite(*one.p95) : std::optional<double>(); },
          "What 95 of 100 draws of all parts are within; null: unstable, or none was drawn."),
      field("builds", &One::builds, "How many builds were drawn with which nothing was chosen."),
      field("within", &One::within, "How many of these are within the target."),
      field(
          "share_within",
          [](const One& one) {
            const auto [least, most] = one.interval();
            return std::array{least, most};
          },
          "The least and the largest share of all builds within the target, with a confidence of "
          "95 % (Wilson's interval).")};
};

template <>
struct Fields<lab::PartsList> {
  using List = lab::PartsList;
  static constexpr auto all = std::tuple{
      field(
          "target", [](const List& list) { return list.wanted.target; },
          "The relative error that 95 of 100 builds are to stay within."),
      field(
          "text", [](const List& list) { return report::in_words(list); },
          "What to order, in a sentence."),
      field("opamp_price", &List::opamp_price, "The price of one op-amp."),
      field(
          "series",
          [](const List& list) { return "E" + std::to_string(static_cast<int>(list.series)); },
          "The series of the resistors' values: E96 where the scene names none."),
      field("loads", &List::loads,
            "At how many places the scene's contacts were tried: errors are rms over them."),
      field(
          "classes", [](const List& list) -> const auto& { return list.wanted.classes; },
          "The classes of resistors to choose from."),
      field("candidates", &List::candidates, "What each realisation takes."),
      field(
          "choice",
          [](const List& list) {
            return list.choice ? std::optional(list.chosen().realization) : std::nullopt;
          },
          "The cheapest realisation whose draws meet the target; null: none does."),
      field(
          "choice_ladder",
          [](const List& list) { return report::true_if(list.choice && list.chosen().ladder); },
          report::ladder_text)};
};

template <>
struct Fields<decks::NodeAnswer> {
  static constexpr auto all =
      std::tuple{field("node", &decks::NodeAnswer::node, "The node's name."),
                 field("expected", &decks::NodeAnswer::expected, Measure::voltage,
                       "The voltage that the deck's header expects."),
                 field("found", &decks::NodeAnswer::found, Measure::voltage,
                       "The voltage that ngspice found.")};
};

namespace report {
namespace {

struct ToleranceTold : ToleranceResult {
  std::size_t replayed = 0;
  double difference = 0.0;

  static constexpr auto described = std::tuple_cat(
      Fields<ToleranceResult>::all,
      std::tuple{field("replayed", &ToleranceTold::replayed,
                       "How many of these draws ngspice has simulated as well."),
                 field("replay_difference", &ToleranceTold::difference,
                       "How far ngspice was from the same draws, at most, relative.")});
};

struct CandidateTold : ToleranceResult {
  Realization realization = Realization::nic;
  IfAny<bool> ladder{};
  std::size_t opamps = 0;
  bool stable_with_opamps = false;

  static constexpr auto described = std::tuple_cat(
      Fields<ToleranceResult>::all,
      std::tuple{field("realization", &CandidateTold::realization, realization_text),
                 field("ladder", &CandidateTold::ladder, ladder_text),
                 field("opamps", &CandidateTold::opamps, opamps_text),
                 field("stable_with_opamps", &CandidateTold::stable_with_opamps, stable_text)});
};

std::vector<CandidateTold> candidates_told(const lab::Recommendation& recommendation) {
  std::vector<CandidateTold> all;
  for (const lab::Recommendation::Candidate& one : recommendation.candidates)
    all.push_back({one.tolerance, one.realization, true_if(one.ladder), one.opamps, one.stable()});
  return all;
}

struct DeckFileTold {
  std::string deck{};

  static constexpr auto described =
      std::tuple{field("deck", &DeckFileTold::deck, "The deck's file.")};
};

/// Of the documents with a network alone.
struct NetworkTold {
  lab::Relaxation network{};

  static constexpr auto described =
      std::tuple{field("network", &NetworkTold::network, "The circuit, and its voltages.")};
};

}  // namespace
}  // namespace report

template <>
struct Fields<lab::Recommendation> {
  static constexpr auto all = std::tuple{
      field(
          "text", [](const lab::Recommendation& one) { return report::in_words(one); },
          "Which realisation to build, in a sentence."),
      field(
          "candidates", [](const lab::Recommendation& one) { return report::candidates_told(one); },
          "Draws of each realisation, the fewest op-amps first.")};
};

template <>
struct Fields<lab::Certification> {
  static constexpr auto all = std::tuple{
      field("certificate", &lab::Certification::certificate, "What is known of the circuit."),
      field("motion", &lab::Certification::motion,
            "How it follows contacts that move along y; null: no contact, nothing takes time, or "
            "it does not settle."),
      field("tolerance", &lab::Certification::tolerance,
            "Draws of this circuit's parts; null: the scene gives no tolerance, or the circuit is "
            "not linear."),
      field("refinement", &lab::Certification::refinement,
            "The circuit as the inner solver of a refinement in numbers; null: it was not asked "
            "for."),
      field("recommendation", &lab::Certification::recommendation,
            "Which realisation suits the scene's tolerances."),
      field(
          "curves_warning",
          [](const lab::Certification& one) {
            return one.curves ? std::optional(report::in_words(*one.curves)) : std::nullopt;
          },
          "Why devices' curves leave no answer of what is said of the linear circuit; null: they "
          "leave it."),
      field("parts", &lab::Certification::parts,
            "What to order for an accuracy; null: none was asked for."),
      field("board", &lab::Certification::board,
            "The circuit with what its board's copper loads it with; null: there is no board."),
      field(
          "board_written", [](const lab::Certification& one) { return one.writes_board(); },
          "Whether a board is written, where there is a folder for it."),
      field("datasheet", &lab::Certification::datasheet,
            "What 95 of 100 builds do; null: it was not asked for.")};
};

template <>
struct Fields<lab::Relaxation> {
  using One = lab::Relaxation;
  static constexpr auto all = std::tuple{
      field("realization", &One::realization, report::realization_text),
      field("nodes", &One::nodes, "How many nodes have a traction as their voltage."),
      field("elements", &One::elements, "How many parts the circuit has."),
      field("names", &One::names,
            "The nodes: n0, n1, ... of a line; p_3_5, qy_3_5, qz_3_5 of a skin's cell in row 3 and "
            "column 5."),
      field("voltages", &One::voltages, Measure::voltage, "Their voltages."),
      field("difference_to_direct", &One::difference,
            "How far they are from the direct solve: |v - f|_2 / |f|_2; without a load |v|_2."),
      field(
          "difference_limit", [](const One& one) { return one.explained.limit; },
          "The largest difference that rounding explains."),
      field(
          "difference_of_devices", [](const One& one) { return one.explained.curves; },
          "The largest difference that the devices' curves explain."),
      field(
          "difference_predicted", [](const One& one) { return one.explained.predicted; },
          "The difference that the op-amps' gain and offset make; null: ideal op-amps, or none."),
      field("lambda_min", &One::smallest_eigenvalue, "The smallest eigenvalue of P."),
      field("stable", &One::stable,
            "Whether the circuit is known to be stable: by its certificate, else since P is "
            "positive definite."),
      field(
          "settling_seconds",
          [](const One& one) {
            return one.transient ? one.transient->settling_seconds : std::nullopt;
          },
          Measure::time, "As in `transient`; null: not simulated, or it does not settle."),
      field("ngspice_seconds", &One::ngspice_seconds, Measure::time,
            "How long ngspice took for the operating point."),
      field("certificate", &One::certificate,
            "What is known of the circuit; null: without op-amps, parasitics, settling and "
            "tolerances."),
      field("transient", &One::transient, "The step in ngspice; null: not asked for."),
      field(
          "tolerance",
          [](const One& one) {
            return one.tolerance ? std::optional(report::ToleranceTold{one.tolerance->result,
                                                                       one.tolerance->replayed,
                                                                       one.tolerance->difference})
                                 : std::nullopt;
          },
          "Draws of this circuit's parts; null: the scene gives no tolerance."),
      field(
          "warnings", [](const One& one) { return report::warnings_of(one); },
          "What to know before the voltages are trusted, a sentence each.")};
};

template <>
struct Fields<decks::DeckAnswer> {
  using One = decks::DeckAnswer;
  static constexpr auto all = std::tuple{
      field("nodes", &One::nodes, "The nodes that its header names."),
      field(
          "difference", [](const One& one) { return if_finite(one.difference); },
          "|found - expected|_2 / |expected|_2; null: not finite."),
      field("within", &One::within, "The difference that its header allows."),
      field("ngspice_seconds", &One::ngspice_seconds, Measure::time, "How long ngspice took.")};
};

template <>
struct Fields<lab::MacromodelComparison> {
  using One = lab::MacromodelComparison;
  static constexpr auto all = std::tuple{
      field(
          "verdict", [](const One& one) { return one.verdict(); },
          "Whether the macromodel does as the certificate says."),
      field(
          "text", [](const One& one) { return report::in_words(one); }, "The same in sentences."),
      field("macromodel", &One::macromodel, "Its sub-circuit."),
      field("names", &One::names, "The nodes."),
      field("voltages", &One::voltages, Measure::voltage, "Their voltages at rest."),
      field("difference_to_direct", &One::difference,
            "How far they are from the direct solve: |v - f|_2 / |f|_2, its offset and gain "
            "included."),
      field("certificate", &One::certificate, "What is known of the circuit with its op-amps."),
      field("transient", &One::transient, "The step in ngspice, with the macromodel.")};
};

namespace report {

Json network_json(const lab::Relaxation& relaxation) { return fields_json(relaxation); }

Json network_schema() { return object_schema<lab::Relaxation>(); }

std::string relaxation_json(const AnyScene& scene, const lab::Relaxation& relaxation) {
  return document_text(kind::relax, scene_told(scene), NetworkTold{relaxation});
}

std::string macromodel_json(const AnyScene& scene, const lab::MacromodelComparison& comparison) {
  return document_text(kind::macromodel, scene_told(scene), comparison);
}

std::string refinement_json(const AnyScene& scene, const lab::SimulatedRefinement& refinement) {
  return document_text(kind::refinement, scene_told(scene), refinement);
}

std::string certificate_json(const lab::Certification& certification) {
  return document_text(kind::certify, scene_told(certification.scene()), certification);
}

std::string datasheet_json(const AnyScene& scene, const lab::Datasheet& sheet) {
  return document_text(kind::datasheet, scene_told(scene), sheet);
}

std::string deck_answer_json(const std::string& file, const decks::DeckAnswer& answer) {
  return document_text(kind::deck, DeckFileTold{file}, answer);
}

Json certify_schema() {
  return document_schema<SceneFrameTold, lab::Certification>(kind::certify,
                                                             "The certificate of a circuit");
}
Json datasheet_schema() {
  return document_schema<SceneFrameTold, lab::Datasheet>(kind::datasheet,
                                                         "The datasheet of a circuit");
}
Json relax_schema() {
  return document_schema<SceneFrameTold, NetworkTold>(kind::relax, "What `relax SCENE` has found");
}
Json macromodel_schema() {
  return document_schema<SceneFrameTold, lab::MacromodelComparison>(
      kind::macromodel, "What relaxing with a vendor's macromodel has found");
}
Json refinement_schema() {
  return document_schema<SceneFrameTold, lab::SimulatedRefinement>(
      kind::refinement, "A build refined through the simulator, beside numbers");
}
Json deck_schema() {
  return document_schema<DeckFileTold, decks::DeckAnswer>(kind::deck,
                                                          "What `relax FILE.cir` has found");
}

}  // namespace report
}  // namespace tactile_net
