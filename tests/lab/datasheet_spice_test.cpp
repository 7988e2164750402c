// A datasheet against ngspice: the same builds, and its figures against those of others.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "lab/circuit_loads.hpp"
#include "tactile_net/lab/datasheet.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/scene/opamp_part.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tactile_net/simulator/step_response.hpp"
#include "tests/catch.hpp"
#include "tests/lab/datasheet_scene.hpp"
#include "tests/simulator/at_rest.hpp"
#include "tests/simulator/noise.hpp"

using namespace tactile_net;
using Kind = lab::DatasheetFigure::Kind;

namespace {

constexpr const char* tolerance =
    "{ relative = 0.01, reel = 0.004, bandwidth = 0.2, temperature = { kelvin = 40, ppm = 50, "
    "tracking_ppm = 10 } }";

/// What ngspice says of a build.
struct Seen {
  double error = 0.0, offset = 0.0, settling = 0.0;
};

/// Of all outputs, over the answer.
double noise_seen(const lab::SceneCircuit& circuit, std::size_t build) {
  const Circuit built = lab::datasheet_build(circuit, nullptr, build);
  const double kelvin = lab::datasheet_kelvin(circuit, nullptr, build);
  double square = 0.0;
  for (const std::string& output : output_names(built))
    square += std::pow(noise_in_ngspice(built, output, kelvin), 2);
  return std::sqrt(square) / l2_norm(at_rest(built));
}

/// What amplifiers' outputs give off at rest, by ngspice's voltages of all nodes [A].
double sourced_in_ngspice(Circuit built) {
  built.outputs.clear();
  for (Node node = 1; node < built.nodes.size(); ++node) built.outputs.push_back(node);
  std::vector<double> volts = at_rest(built);
  volts.insert(volts.begin(), 0.0);
  std::vector<double> leaving(built.nodes.size());
  for (const Resistor& one : built.resistors) {
    const double ampere = one.siemens * (volts[one.from] - volts[one.to]);
    leaving[one.from] += ampere;
    leaving[one.to] -= ampere;
  }
  double sum = 0.0;
  for (const Instance& one : built.instances)
    for (std::size_t pin = 2; pin < one.pins.size(); ++pin)
      if (one.pins[pin] != 0) sum += std::max(leaving[one.pins[pin]], 0.0);
  return sum;
}

/// A load's sources, and the answer of exact parts.
struct Place {
  std::vector<CurrentSource> sources;
  std::vector<double> exact;
};

/// The scene's own first.
std::vector<Place> places_of(const lab::SceneCircuit& circuit) {
  const NetworkCircuit& network = circuit.network();
  RealizationOptions ideal = network.options();
  ideal.opamp = {};
  std::vector<Place> places;
  for (const auto& problem : lab::circuit_loads(circuit)) {
    const Circuit one = realize(network.realization(), *problem, ideal);
    places.push_back({one.sources, operating_voltages(FlatCircuit(one))});
  }
  return places;
}

Seen seen_in_ngspice(const lab::SceneCircuit& circuit, std::size_t build,
                     const std::vector<Place>& places) {
  Circuit built = lab::datasheet_build(circuit, nullptr, build);
  const std::vector<double> rest = at_rest(built);
  Seen seen;
  for (const Place& place : places) {
    Circuit loaded = built;
    std::copy(place.sources.begin(), place.sources.end(), loaded.sources.begin());
    seen.error += std::pow(relative_l2_error(at_rest(loaded), place.exact), 2);
  }
  seen.error = std::sqrt(seen.error / static_cast<double>(places.size()));
  Certificate certificate;
  const FlatCircuit flat(built);
  const StateSpace system = state_space(flat);
  certificate.accuracy = circuit.options().settling_accuracy.value_or(1e-3);
  certificate.dynamics = Dynamics{.states = system.states(), .poles = poles(system)};
  certificate.dynamics->slowest = certificate.dynamics->poles.front().real();
  certificate.dynamics->settling_seconds =
      settling_time(system, certificate.accuracy, certificate.dynamics->slowest);
  Ngspice ngspice;
  const Transient transient = settle(ngspice, built, certificate, rest);
  REQUIRE(transient.end == TransientEnd::settles);
  seen.settling = *transient.settling_seconds;
  CHECK_THAT(seen.settling, WithinRel(*certificate.dynamics->settling_seconds, 0.05));
  CHECK(relative_l2_error(rest, operating_voltages(flat)) < 1e-6);
  for (CurrentSource& one : built.sources) {
    if (one.name.rfind("Ib", 0) == 0) continue;  // what inputs take is no reading
    one.ampere = 0.0;
    if (one.volts) one.volts = 0.0;
  }
  const std::vector<double> idle = at_rest(built);
  for (const Place& place : places)
    seen.offset += std::pow(l2_norm(idle) / l2_norm(place.exact), 2);
  seen.offset = std::sqrt(seen.offset / static_cast<double>(places.size()));
  return seen;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

lab::DatasheetFigure figure(const lab::Datasheet& sheet, Kind kind) {
  for (const auto& one : sheet.figures)
    if (one.kind == kind) return one;
  FAIL("the figure is missing");
  return {};
}

}  // namespace

TEST_CASE("ngspice has the error, the settling time and the noise of a datasheet's builds",
          "[spice][datasheet]") {
  for (const std::string inputs : {"", "inputs = \"voltage\"\n"}) {
    CAPTURE(inputs);
    const lab::SceneCircuit circuit = datasheet_circuit(tolerance, inputs);
    const std::vector<Place> places = places_of(circuit);
    for (std::size_t build = 0; build < 3; ++build) (void)seen_in_ngspice(circuit, build, places);
    const Circuit built = lab::datasheet_build(circuit, nullptr, 1);
    const OutputNoise noise = output_noise(FlatCircuit(built));
    CHECK_THAT(noise_in_ngspice(built, "n4"),
               WithinRel(std::sqrt(noise.thermal(4, 4) + noise.amplifiers(4, 4)), 0.03));
  }
}

TEST_CASE("each figure of a datasheet is within 10 % of builds that ngspice has drawn",
          "[spice][datasheet][long]") {
  // TACTILE_NET_BUILDS: how many; a thousand take half an hour.
  const char* const asked = std::getenv("TACTILE_NET_BUILDS");
  const std::size_t builds = asked != nullptr ? std::strtoul(asked, nullptr, 10) : 24;
  const lab::SceneCircuit circuit = datasheet_circuit(tolerance, "", datasheet_opamp, 11);
  const std::vector<Place> places = places_of(circuit);
  const lab::Datasheet sheet = lab::datasheet(circuit);
  std::vector<double> error;
  std::vector<double> offset;
  std::vector<double> settling;
  std::vector<double> noise;
  for (std::size_t build = 0; build < builds; ++build) {
    // Others than the datasheet's own.
    const Seen seen = seen_in_ngspice(circuit, 10'000 + build, places);
    error.push_back(seen.error);
    offset.push_back(seen.offset);
    settling.push_back(seen.settling);
    noise.push_back(noise_seen(circuit, 10'000 + build));
  }
  // Of few builds a quantile is as uncertain as their number says; of a thousand 10 % decide.
  const double allowed = builds >= 1000 ? 0.1 : 0.1 + 1.5 / std::sqrt(static_cast<double>(builds));
  for (const auto& [kind, values] : {std::pair(Kind::error, error),
                                     {Kind::offset, offset},
                                     {Kind::settling, settling},
                                     {Kind::noise, noise}}) {
    CAPTURE(static_cast<int>(kind));
    // Builds differ little in their noise.
    const double off = kind == Kind::noise ? 0.1 : allowed;
    CHECK_THAT(figure(sheet, kind).typical, WithinRel(quantile(values, 0.5), off));
    CHECK_THAT(figure(sheet, kind).p95, WithinRel(quantile(values, 0.95), off));
  }
}

TEST_CASE("a datasheet's supply current is what ngspice's outputs give off, and the op-amps' own",
          "[spice][datasheet]") {
  // That an op-amp takes more where it gives off more, or as it gets warm, neither has.
  constexpr std::size_t builds = 24;
  const lab::SceneCircuit circuit = datasheet_circuit(
      tolerance, "", "{ part = \"THS4551\", gain = 1e5, second_pole = 270e6 }", 8);
  const lab::Datasheet sheet = lab::datasheet(circuit);
  REQUIRE(circuit.options().opamp_part != nullptr);
  const double own =
      static_cast<double>(sheet.opamps) * *circuit.options().opamp_part->supply_current;
  std::vector<double> given;
  for (std::size_t build = 0; build < builds; ++build) {
    const Circuit built = lab::datasheet_build(circuit, nullptr, 10'000 + build);
    given.push_back(sourced_in_ngspice(built));
    CHECK_THAT(sourced_current(FlatCircuit(built)), WithinRel(given.back(), 1e-3));
  }
  const lab::DatasheetFigure current = figure(sheet, Kind::supply_current);
  CHECK_THAT(current.typical - own, WithinRel(quantile(given, 0.5), 0.1));
  CHECK_THAT(current.p95 - own, WithinRel(quantile(given, 0.95), 0.1));
  CHECK(quantile(given, 0.5) > 0.05 * own);  // not lost beside them
}
