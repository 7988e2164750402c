#include "tools/circuits/numbers.hpp"

#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>
#include <vector>

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tactile_net/sensing/traction_field.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tactile_net/simulator/step_response.hpp"

namespace tactile_net::circuits {
namespace {

constexpr double accuracy = 1e-3;
const OpAmp one_pole{.gain = 1e6, .bandwidth = 10e6};

struct Network {
  NetworkProblem problem;
  std::vector<double> direct;
};

/// The array of the page: 21 taxels under a cylinder.
Network network(double alpha) {
  const SensorArray array{21, 0.5, {1.5}, {Quantity::strain_x}};
  const Material pad{1.0, 0.45};
  const std::vector<Contact> contacts = {RigidContact{.half_width = 2.0}};
  const std::vector<double> g = sampled_readings(array, pad, sample(contacts, array));
  const InverseProblem inverse = make_problem(array, pad, {.smoothing_length = 1.0});
  return {network_problem(inverse, alpha, g), tikhonov_solve(inverse, alpha, g)};
}

std::vector<double> at_rest(const Circuit& circuit, const Analysis& analysis) {
  std::ostringstream deck;
  write_deck(deck, circuit, {.title = "numbers"}, Answer::raw_file, analysis);
  Ngspice ngspice;
  return operating_point(ngspice, deck.str(), output_names(circuit)).voltages;
}

/// Agreement with ideal parts, certificate and transient with one-pole op-amps.
struct Row {
  ElementCounts elements;
  double agreement = 0.0;
  Certificate certificate;
  std::optional<double> settled;
  std::optional<ToleranceResult> tolerance;
};

Row measured(Realization realization, bool inverters, double alpha) {
  std::cerr << name(realization) << ", alpha " << alpha << '\n';
  const Network one = network(alpha);
  RealizationOptions options{.inverters = inverters};
  const Circuit ideal = realize(realization, one.problem, options);
  const RealizationTraits& kind = traits(realization);
  const bool lossless = kind.parts == RealizationTraits::Parts::lossless;
  const Analysis analysis =
      lossless ? Analysis{SingleFrequency{options.frequency}} : Analysis{DirectCurrent{}};
  Row row{.elements = count_elements(ideal),
          .agreement = relative_l2_error(at_rest(ideal, analysis), one.direct),
          .certificate = {},
          .settled = {},
          .tolerance = {}};
  if (kind.uses_opamps)
    options.opamp = one_pole;
  else if (!lossless)
    options.node_capacitance = 1e-11;
  const NetworkCircuit built(realization, std::make_shared<const NetworkProblem>(one.problem),
                             options);
  row.certificate = certify(built, accuracy);
  if (row.certificate.dynamics) {
    Ngspice ngspice;
    const Circuit& real = built.circuit();
    row.settled =
        settle(ngspice, real, row.certificate, at_rest(real, DirectCurrent{})).settling_seconds;
  }
  if (kind.linear()) row.tolerance = tolerate(Reduction(ideal), {.relative = 0.01, .trials = 1000});
  return row;
}

std::string error(double value) {
  return std::isfinite(value) ? brief(100.0 * value) + " %" : "unstable";
}

std::string time(const std::optional<double>& seconds) {
  return seconds ? duration(*seconds) : "-";
}

std::string cells(const Row& row) {
  const auto& dynamics = row.certificate.dynamics;
  std::string text = brief(row.agreement) + " | " + (dynamics ? brief(dynamics->slowest) : "-") +
                     " | " + (dynamics ? time(dynamics->settling_seconds) : "-") + " | " +
                     time(row.settled) + " | ";
  text += row.certificate.tolerance_margin ? error(*row.certificate.tolerance_margin) : "-";
  if (!row.tolerance) return text + " | - | - |\n";
  return text + " | " + error(row.tolerance->median) + " | " +
         std::to_string(row.tolerance->stable / 10) + " % |\n";
}

constexpr const char* head =
    "| agreement | slowest pole, 1/s | settles (certificate) | settles (ngspice) | proven margin | "
    "median error, 1 % parts | stable builds |\n";
constexpr const char* rule = "|---|---|---|---|---|---|---|---|\n";

}  // namespace

std::string table(Realization realization, bool inverters) {
  std::string text;
  for (const double alpha : {1e-3, 1e-4, 1e-5}) {
    const Row row = measured(realization, inverters, alpha);
    if (text.empty()) {
      const ElementCounts& n = row.elements;
      std::vector<std::string> parts;
      const auto add = [&](std::size_t count, const char* kind) {
        if (count > 0) parts.push_back(std::to_string(count) + ' ' + kind);
      };
      add(n.opamps, "op-amps");
      add(n.resistors, "resistors");
      add(n.capacitors, "capacitors");
      add(n.inductors, "inductors");
      add(n.devices, "N-shaped devices");
      text = "21 taxels take " + join(parts, ", ") + ".\n\n| alpha " + head + rule;
    }
    text += "| " + brief(alpha) + " | " + cells(row);
  }
  return text + '\n';
}

std::string comparison(double alpha) {
  std::string text = std::string("| realisation | op-amps ") + head + "|---" + rule;
  for (const Realization one : realizations)
    for (const bool inverters : {false, true}) {
      if (inverters && !traits(one).drives_nodes) continue;
      const Row row = measured(one, inverters, alpha);
      text += "| " + std::string(name(one)) + (inverters ? ", inverters" : "") + " | " +
              std::to_string(row.elements.opamps) + " | " + cells(row);
    }
  return text + '\n';
}

std::string devices() {
  const Network one = network(1e-3);
  double largest = 0.0;
  for (const double f : one.direct) largest = std::max(largest, std::abs(f));
  std::string text = "| largest node voltage over V | cubic | tunnel diode |\n|---|---|---|\n";
  for (const double ratio : {0.01, 0.03, 0.1, 0.3}) {
    text += "| " + brief(ratio) + " |";
    for (const Curve curve : {Curve::cubic, Curve::tunnel_diode}) {
      const Circuit circuit =
          realize(Realization::ndr, one.problem, {.curve = curve, .device_volts = largest / ratio});
      text += ' ' + brief(relative_l2_error(at_rest(circuit, DirectCurrent{}), one.direct)) + " |";
    }
    text += '\n';
  }
  return text + '\n';
}

}  // namespace tactile_net::circuits
