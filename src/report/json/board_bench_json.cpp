#include "tactile_net/report/json/board_bench_json.hpp"

#include "report/json/scene_json.hpp"
#include "report/json/schemas.hpp"
#include "report/json/self_test_fields.hpp"
#include "tactile_net/report/words/board_bench_words.hpp"

namespace tactile_net::report {
namespace {

struct FaultTold {
  PartFault kind = PartFault::open;
  std::string part{};
  std::optional<std::string> other{};
  double factor = 0.0;
  double evidence = 0.0;
  bool named = false;

  static constexpr auto described =
      std::tuple{field("kind", &FaultTold::kind, "What is wrong."),
                 field("part", &FaultTold::part, "The resistor, by its name in the deck."),
                 field("other", &FaultTold::other, "The one that it is swapped with; null: none."),
                 field("factor", &FaultTold::factor,
                       "Its conductance over that of the circuit; of another value as estimated."),
                 field("evidence", &FaultTold::evidence,
                       "log10 of the responses' likelihood over that of no fault."),
                 field("named", &FaultTold::named, "Whether it is what the verdict names.")};
};

std::vector<FaultTold> faults_told(const lab::BoardBench& bench) {
  std::vector<FaultTold> all;
  for (std::size_t k = 0; k < bench.diagnosis.candidates.size(); ++k) {
    const auto& [fault, evidence] = bench.diagnosis.candidates[k];
    all.push_back({.kind = fault.kind,
                   .part = bench.parts[fault.part],
                   .factor = fault.factor,
                   .evidence = evidence,
                   .named = k < bench.diagnosis.named});
    if (fault.kind == PartFault::swapped) all.back().other = bench.parts[fault.other];
  }
  return all;
}

std::vector<std::vector<double>> rows_of(const Matrix& matrix) {
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < matrix.rows; ++i)
    rows.emplace_back(
        matrix.values.begin() + static_cast<std::ptrdiff_t>(i * matrix.columns),
        matrix.values.begin() + static_cast<std::ptrdiff_t>((i + 1) * matrix.columns));
  return rows;
}

}  // namespace
}  // namespace tactile_net::report

namespace tactile_net {

template <>
struct Fields<lab::BoardBench> {
  using One = lab::BoardBench;
  static constexpr auto all = std::tuple{
      field(
          "verdict", [](const One& one) { return one.verdict(); }, "What the responses say."),
      field(
          "text", [](const One& one) { return report::in_words(one); }, "The same in sentences."),
      field("patterns", &One::patterns, "How many patterns were measured."),
      field("noise", &One::noise, Measure::voltage,
            "The standard deviation of a voltage that was assumed."),
      field(
          "misfit", [](const One& one) { return one.diagnosis.misfit; },
          "|voltages - expected|_2 over what tolerances and noise lead to, without a fault."),
      field(
          "misfit_with_fault", [](const One& one) { return one.diagnosis.misfit_with_fault; },
          "The same with the fault that is named; without one as `misfit`."),
      field(
          "evidence_needed", [](const One& one) { return one.diagnosis.needed; },
          "The `evidence` from which a fault is named: 5 of 100 healthy boards have as much."),
      field(
          "faults", [](const One& one) { return report::faults_told(one); },
          "Single faults, the most likely first."),
      field("parts", &One::parts, "All resistors, by their names in the deck."),
      field(
          "part_errors", [](const One& one) { return one.diagnosis.part_errors; },
          "Of each the relative error of its conductance that the responses tell."),
      field(
          "part_deviations", [](const One& one) { return one.diagnosis.part_deviations; },
          "The standard deviations of these."),
      field("outputs", &One::outputs, "The outputs, the order of the correction."),
      field(
          "correction", [](const One& one) { return report::rows_of(one.diagnosis.correction); },
          "The voltages as they should be are this matrix times those that the board shows."),
      field(
          "error", [](const One& one) { return one.diagnosis.error; },
          "How far the board's voltages are from exact ones, relative."),
      field(
          "remaining", [](const One& one) { return one.diagnosis.remaining; },
          "The same behind the correction, of the board as fitted."),
      field(
          "noise_gain", [](const One& one) { return one.diagnosis.noise_gain; },
          "By how much the correction enlarges noise at most."),
      field("self_test", &One::self_test, "The board's error by its own converters.")};
};

namespace report {

std::string bench_json(const AnyScene& scene, const lab::BoardBench& bench) {
  return document_text(kind::bench, scene_told(scene), bench);
}

Json bench_schema() {
  return document_schema<SceneFrameTold, lab::BoardBench>(kind::bench, "A board on the bench");
}

}  // namespace report
}  // namespace tactile_net
