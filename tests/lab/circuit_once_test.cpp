// Each thing derived from a circuit once: the linker puts a counter before what makes it (--wrap,
// see CMakeLists.txt), under their mangled names.
#include <map>
#include <string>

#include "tactile_net/lab/certification.hpp"
#include "tactile_net/lab/circuit_options.hpp"
#include "tactile_net/lab/relaxation.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/pages/certificate_page.hpp"
#include "tactile_net/report/words/deck_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

std::map<std::string, int> made_of_circuit;

Scene certified(Realization realization) {
  Scene scene = read_scene(SCENES "/circuits/rail.toml");
  scene.network.realization = realization;
  scene.network.tolerance = ToleranceOptions{.relative = 0.01, .trials = 20};
  lab::give_bandwidth(scene.network, 1e6);
  return scene;
}

}  // namespace

// The linker's names for what is counted, and for the counters.
Circuit real_realize(Realization, const NetworkProblem&, const RealizationOptions&) asm(
    "__real__ZN11tactile_net7realizeENS_11RealizationERKNS_14NetworkProblemERKNS_"
    "18RealizationOptionsE");
Circuit counted_realize(Realization, const NetworkProblem&, const RealizationOptions&) asm(
    "__wrap__ZN11tactile_net7realizeENS_11RealizationERKNS_14NetworkProblemERKNS_"
    "18RealizationOptionsE");
void real_flat(void*, const Circuit&) asm("__real__ZN11tactile_net11FlatCircuitC1ERKNS_7CircuitE");
void counted_flat(void*,
                  const Circuit&) asm("__wrap__ZN11tactile_net11FlatCircuitC1ERKNS_7CircuitE");
void real_reduction(void*, const FlatCircuit&) asm(
    "__real__ZN11tactile_net9ReductionC1ERKNS_11FlatCircuitE");
void counted_reduction(void*, const FlatCircuit&) asm(
    "__wrap__ZN11tactile_net9ReductionC1ERKNS_11FlatCircuitE");
Certificate real_certify(const NetworkCircuit&,
                         double) asm("__real__ZN11tactile_net7certifyERKNS_14NetworkCircuitEd");
Certificate counted_certify(const NetworkCircuit&,
                            double) asm("__wrap__ZN11tactile_net7certifyERKNS_14NetworkCircuitEd");
StateSpace real_states(const FlatCircuit&) asm(
    "__real__ZN11tactile_net11state_spaceERKNS_11FlatCircuitE");
StateSpace counted_states(const FlatCircuit&) asm(
    "__wrap__ZN11tactile_net11state_spaceERKNS_11FlatCircuitE");
EigenvalueRange real_eigenvalues(const Matrix&) asm(
    "__real__ZN11tactile_net16eigenvalue_rangeERKNS_6MatrixE");
EigenvalueRange counted_eigenvalues(const Matrix&) asm(
    "__wrap__ZN11tactile_net16eigenvalue_rangeERKNS_6MatrixE");

Circuit counted_realize(Realization realization, const NetworkProblem& problem,
                        const RealizationOptions& options) {
  ++made_of_circuit["circuit"];
  return real_realize(realization, problem, options);
}
void counted_flat(void* self, const Circuit& circuit) {
  ++made_of_circuit["flat circuit"];
  real_flat(self, circuit);
}
void counted_reduction(void* self, const FlatCircuit& circuit) {
  ++made_of_circuit["reduction"];
  real_reduction(self, circuit);
}
Certificate counted_certify(const NetworkCircuit& circuit, double accuracy) {
  ++made_of_circuit["certificate"];
  return real_certify(circuit, accuracy);
}
StateSpace counted_states(const FlatCircuit& circuit) {
  ++made_of_circuit["state space"];
  return real_states(circuit);
}
EigenvalueRange counted_eigenvalues(const Matrix& matrix) {
  ++made_of_circuit["eigenvalues"];
  return real_eigenvalues(matrix);
}

TEST_CASE("relax and its deck make one circuit, and each thing that is derived from it once",
          "[lab][once]") {
  const Scene scene = certified(Realization::rail);
  Ngspice ngspice;
  made_of_circuit.clear();
  const lab::SceneFrame frame(lab::SceneProblem(scene), lab::simulate(scene).readings);
  const lab::SceneCircuit circuit(frame);
  const lab::Relaxation relaxation = lab::relax(circuit, ngspice);
  CHECK_FALSE(report::deck_text(circuit, Answer::printed).empty());
  REQUIRE(relaxation.transient);
  REQUIRE(relaxation.tolerance);
  CHECK(made_of_circuit == std::map<std::string, int>{{"circuit", 1},
                                                      {"flat circuit", 1},
                                                      {"reduction", 1},
                                                      {"certificate", 1},
                                                      {"state space", 1},
                                                      {"eigenvalues", 1}});
}

TEST_CASE("certify and its report make one circuit per realisation", "[lab][once]") {
  const Realization realization = GENERATE(Realization::rail, Realization::ideal);
  CAPTURE(name(realization));
  Scene scene = certified(realization);
  scene.network.parts.node_capacitance = 1e-11;
  made_of_circuit.clear();
  const lab::Certification certification = lab::certify(scene);
  REQUIRE(certification.certificate().dynamics);
  CHECK_FALSE(pages::certificate_html(certification).html.empty());
  // Stability is each one's own: its poles, and of those that are built from P its eigenvalues.
  // The scene's own, the candidates of the recommendation, which are all from op-amps, and the one
  // that moving contacts drive.
  const int circuits = has_amplifiers(realization) ? 6 : 7;
  CHECK(certification.recommendation.candidates.size() == 6);
  CHECK(made_of_circuit == std::map<std::string, int>{{"circuit", circuits + 1},
                                                      {"flat circuit", circuits + 1},
                                                      {"reduction", circuits},
                                                      {"certificate", 1},
                                                      {"state space", circuits + 1},
                                                      {"eigenvalues", circuits - 3}});
}
