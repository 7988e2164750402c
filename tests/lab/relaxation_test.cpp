#include "tactile_net/lab/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "tactile_net/lab/recommendation.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/lab/circuit_of_scene.hpp"

using namespace tactile_net;
using lab::Disagreement;

namespace {

/// An answer that holds: rounding explains the difference.
lab::Relaxation good() {
  lab::Relaxation result;
  result.difference = 1e-12;
  result.explained.limit = 1e-10;
  result.smallest_eigenvalue = 1e-3;
  result.stable = true;
  return result;
}

Certificate with_pole(double slowest) {
  Certificate certificate{.stability = slowest < 0.0 ? Stability::stable : Stability::unstable};
  certificate.dynamics = Dynamics{.states = 1, .slowest = slowest};
  return certificate;
}

/// A simulator that finds what the circuit's own equations say.
class AtRest : public Simulator {
 public:
  explicit AtRest(const NetworkCircuit& circuit)
      : names_(output_names(circuit.circuit())), volts_(operating_voltages(circuit.flat())) {}
  Simulation run(const std::string&) override {
    RawFile plot{.plot = "Operating Point", .points = 1};
    for (std::size_t i = 0; i < names_.size(); ++i) {
      plot.names.push_back("v(" + names_[i] + ")");
      plot.values.push_back({volts_[i]});
    }
    return {.plot = plot};
  }

 private:
  std::vector<std::string> names_;
  std::vector<double> volts_;
};

std::optional<Disagreement::Kind> kind(const lab::Relaxation& relaxation) {
  const auto disagreement = relaxation.disagreement();
  return disagreement ? std::optional(disagreement->kind) : std::nullopt;
}

}  // namespace

TEST_CASE("an answer holds, or says what is wrong with it and by how much", "[lab][relaxation]") {
  using enum Disagreement::Kind;
  CHECK_FALSE(kind(good()));

  lab::Relaxation off = good();
  off.difference = 1e-3;
  CHECK(kind(off) == difference);
  CHECK(off.disagreement()->value == 1e-3);
  off.explained.predicted = 1e-3;  // the op-amps make it: within a fifth
  CHECK_FALSE(kind(off));

  lab::Relaxation bent = good();
  bent.explained.curves = 0.7;
  CHECK(kind(bent) == curves);

  lab::Relaxation indefinite = good();
  indefinite.smallest_eigenvalue = 0.0;
  CHECK(kind(indefinite) == not_definite);

  lab::Relaxation growing = good();
  growing.certificate = with_pole(2.0);
  growing.stable = false;
  CHECK(kind(growing) == unstable);
  CHECK(growing.disagreement()->value == 2.0);

  lab::Relaxation doubted = good();
  doubted.certificate = with_pole(-2.0);
  doubted.transient = Transient{.end = TransientEnd::grows};
  CHECK(kind(doubted) == transient);
  doubted.transient->end = TransientEnd::unfinished;  // nobody has seen it grow
  CHECK_FALSE(kind(doubted));

  lab::Relaxation drawn = good();
  drawn.tolerance = lab::ToleranceStudy{};
  drawn.tolerance->difference = 1e-5;
  CHECK(kind(drawn) == draws);
}

TEST_CASE("a circuit whose stability is not known is not called stable, nor unstable",
          "[lab][relaxation]") {
  Scene scene = read_scene(SCENES "/circuits/rail.toml");
  scene.network.realization = Realization::crossbar;
  scene.network.settling_accuracy.reset();
  scene.network.parts.opamp.output_resistance = 150.0;
  scene.network.tolerance = ToleranceOptions{.relative = 0.01, .trials = 1};
  const auto relaxed = [&] {
    const lab::SceneCircuit circuit = circuit_of(scene);
    AtRest simulator(circuit.network());
    lab::Relaxation result = relax(circuit, simulator);
    std::erase_if(result.remarks, [](const lab::RelaxationRemark& one) {
      return one.kind == lab::RelaxationRemark::Kind::inaccurate;
    });
    return result;
  };
  scene.network.parts.node_capacitance.reset();
  const std::optional<double> bandwidth =
      std::exchange(scene.network.parts.opamp.bandwidth, std::nullopt);
  const lab::Relaxation without = relaxed();
  REQUIRE(without.certificate.value().stability == Stability::not_modelled);
  CHECK_FALSE(without.stable);
  CHECK(kind(without) != Disagreement::Kind::unstable);
  REQUIRE(without.remarks.size() == 2);
  CHECK(without.remarks[0].kind == lab::RelaxationRemark::Kind::stability_not_known);
  CHECK(without.remarks[1].kind == lab::RelaxationRemark::Kind::draws_without_opamps);

  scene.network.parts.opamp.bandwidth = bandwidth;
  const lab::Relaxation known = relaxed();
  CHECK(known.stable);
  CHECK(known.remarks.empty());
}

TEST_CASE("a scene's circuit hands on what it made", "[lab][scene_circuit]") {
  const lab::SceneCircuit one = circuit_of(read_scene(SCENES "/circuits/rail.toml"));
  CHECK(one.loaded());
  CHECK(&one.direct() == &one.direct());
  CHECK(&one.certificate() == &one.certificate());
  CHECK(&one.network().flat() == &one.network().flat());
  CHECK(one.condition().kind == lab::Condition::Kind::bound);
  CHECK(one.condition().value >= one.certificate().condition);
}

TEST_CASE("the largest of the answer's voltages is 1 V unless the scene states a scale",
          "[lab][scene_circuit]") {
  Scene scene = read_scene(SCENES "/fingertip.toml");  // tractions of kilopascals
  const auto largest = [](const lab::SceneCircuit& one) {
    double volts = 0.0;
    for (const double v : operating_voltages(one.network().flat()))
      volts = std::max(volts, std::abs(v));
    return volts;
  };
  for (const Realization realization : {Realization::nic, Realization::least_squares}) {
    scene.network.realization = realization;
    CHECK_THAT(largest(circuit_of(scene)), WithinRel(1.0, 1e-3));  // amplifiers of gain 1e6
  }
  // The unit of stress makes no difference to a circuit.
  scene.noise.reset();
  Scene in_kilopascal = scene;
  in_kilopascal.material.youngs_modulus *= 1e-3;
  for (Contact& contact : in_kilopascal.contacts) std::get<RigidContact>(contact).force *= 1e-3;
  CHECK_THAT(circuit_of(in_kilopascal).options().parts.scale.volts,
             WithinRel(1e3 * circuit_of(scene).options().parts.scale.volts, 1e-9));

  scene.contacts.clear();
  CHECK_THAT(circuit_of(scene).options().parts.scale.volts,
             WithinRel(10.0 / scene.material.youngs_modulus, 1e-12));
  scene.network.one_volt = false;
  scene.network.parts.scale.volts = 0.25;
  CHECK(circuit_of(scene).options().parts.scale.volts == 0.25);
}

TEST_CASE("a deck has the resistors that one can buy, and says what they do to the answer",
          "[lab][scene_circuit]") {
  Scene scene = read_scene(SCENES "/circuits/rail.toml");
  scene.network.tolerance.reset();
  CHECK_FALSE(circuit_of(scene).ordered());
  double before = 0.0;
  for (const Series series : {Series::e192, Series::e24}) {
    scene.network.tolerance = ToleranceOptions{.series = series};
    const lab::SceneCircuit one = circuit_of(scene);
    const Circuit& nominal = one.network().circuit();
    REQUIRE(one.ordered());
    const lab::SceneCircuit::Ordered& ordered = *one.ordered();
    REQUIRE(ordered.circuit.resistors.size() == nominal.resistors.size());
    for (std::size_t r = 0; r < nominal.resistors.size(); ++r) {
      const double siemens = ordered.circuit.resistors[r].siemens;
      CHECK_THAT(nearest_in(series, 1.0 / std::abs(siemens)),
                 WithinRel(1.0 / std::abs(siemens), 1e-12));
      CHECK(std::abs(std::log(siemens / nominal.resistors[r].siemens)) <
            std::log(10.0) / static_cast<double>(series));
    }
    REQUIRE(ordered.moved);
    CHECK(*ordered.moved > before);  // coarser steps move it further
    CHECK(*ordered.moved < 0.2);
    before = *ordered.moved;
  }
}

TEST_CASE("a recommendation says which, or what it would take", "[lab][recommendation]") {
  Scene scene = read_scene(SCENES "/circuits/rail.toml");
  using enum lab::Recommendation::Outcome;
  scene.network.tolerance = ToleranceOptions{.relative = 1e-9, .trials = 20};
  const lab::Recommendation exact = recommend(circuit_of(scene));
  CHECK(exact.outcome == reached);
  CHECK(exact.choice == 0);  // the fewest op-amps
  CHECK_FALSE(exact.parts_needed);

  scene.network.tolerance = ToleranceOptions{.relative = 0.05, .trials = 20, .accuracy = 1e-6};
  const lab::Recommendation rough = recommend(circuit_of(scene));
  CHECK(rough.outcome == none_reaches);
  for (const auto& candidate : rough.candidates)
    if (candidate.stable()) CHECK(rough.chosen().tolerance.p95 <= candidate.tolerance.p95);

  scene.contacts.clear();
  const lab::Recommendation idle = recommend(circuit_of(scene));
  CHECK(idle.outcome == no_load);
  CHECK_FALSE(idle.choice);
}

TEST_CASE("a ladder is recommended where parts of 1 % leave no other circuit its accuracy",
          "[lab][recommendation][ladder]") {
  Scene scene = read_scene(SCENES "/circuits/ladder.toml");
  const lab::SceneCircuit own = circuit_of(scene);
  CHECK(own.certificate().ladder);
  const lab::Recommendation found = recommend(own);
  REQUIRE(found.outcome == lab::Recommendation::Outcome::reached);
  CHECK(found.chosen().realization == Realization::least_squares);
  CHECK(found.chosen().ladder);
  CHECK(found.chosen().tolerance.p95 < 4e-3);
  for (const auto& one : found.candidates)
    CHECK((one.ladder || one.tolerance.p95 > found.drawn.accuracy));

  // Whichever form the scene has, both are drawn, each once and alike.
  scene = read_scene(SCENES "/circuits/ladder.toml");
  scene.network.parts.ladder = false;
  const lab::Recommendation other = recommend(circuit_of(scene));
  REQUIRE(other.candidates.size() == found.candidates.size());
  CHECK(other.chosen().ladder);
  CHECK(other.chosen().tolerance.p95 == found.chosen().tolerance.p95);
}
