#include "docs/figures/circuits/numbers.hpp"

#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>
#include <vector>

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/inverse/line_problem.hpp"
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

/// The array of the page, 21 taxels under a cylinder; or more of them, closer together.
Network network(double alpha, std::size_t taxels = 21, double pitch = 0.5) {
  const SensorArray array{taxels, pitch, {1.5}, {Quantity::strain_x}};
  const Material pad{1.0, 0.45};
  const std::vector<Contact> contacts = {RigidContact{.half_width = 2.0}};
  const std::vector<double> g = sampled_readings(array, pad, sample(contacts, array));
  const LinearProblem inverse = make_problem(array, pad, {.smoothing_length = 1.0});
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

Row measured(Realization realization, RealizationOptions options, double alpha) {
  std::cerr << name(realization) << ", alpha " << alpha << '\n';
  const Network one = network(alpha);
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

std::string table(Realization realization, const RealizationOptions& options) {
  std::string text;
  for (const double alpha : {1e-3, 1e-4, 1e-5}) {
    const Row row = measured(realization, options, alpha);
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
  const auto add = [&](Realization one, const RealizationOptions& options, const char* form) {
    const Row row = measured(one, options, alpha);
    text += "| " + std::string(name(one)) + form + " | " + std::to_string(row.elements.opamps) +
            " | " + cells(row);
  };
  for (const Realization one : realizations) {
    add(one, {}, "");
    if (has_ladder(one, {.ladder = true})) add(one, {.ladder = true}, ", ladder");
    if (traits(one).drives_nodes) add(one, {.inverters = true}, ", inverters");
  }
  return text + '\n';
}

std::string ladder_tolerances() {
  struct Taxels {
    std::size_t count;
    double pitch;
    std::size_t trials;
  };
  std::string text =
      "| taxels, pitch | alpha | least_squares | with a ladder | lattice "
      "|\n|---|---|---|---|---|\n";
  for (const double alpha : {1e-3, 1e-5})
    for (const Taxels taxels :
         {Taxels{21, 0.5, 400}, Taxels{41, 0.25, 400}, Taxels{81, 0.25, 60}}) {
      const Network one = network(alpha, taxels.count, taxels.pitch);
      std::cerr << "ladder, " << taxels.count << " taxels, alpha " << alpha << '\n';
      const auto median = [&](Realization realization, bool ladder) {
        const Circuit circuit = realize(realization, one.problem, {.ladder = ladder});
        const ToleranceResult result =
            tolerate(Reduction(circuit), {.relative = 0.01, .trials = taxels.trials});
        return error(result.median) + ", " + error(result.p95) + " | ";
      };
      text += "| " + std::to_string(taxels.count) + ", " + brief(taxels.pitch) + " | " +
              brief(alpha) + " | " + median(Realization::least_squares, false) +
              median(Realization::least_squares, true) + median(Realization::lattice, false);
      text.back() = '\n';
    }
  return text + '\n';
}

std::string ladder_lags() {
  const Network one = network(1e-3);
  const auto stable = [&](const RealizationOptions& options) {
    const Circuit circuit = realize(Realization::least_squares, one.problem, options);
    return poles(state_space(FlatCircuit(circuit))).front().real() < 0.0;
  };
  // Where a circuit that is stable at `good` and not at `bad` turns, halving logarithms.
  const auto turn = [](double good, double bad, const auto& is_stable) {
    for (int halving = 0; halving < 20; ++halving) {
      const double middle = std::sqrt(good * bad);
      (is_stable(middle) ? good : bad) = middle;
    }
    return good;
  };
  std::string text =
      "| residual_gain | settles | second pole from, of the bandwidth | capacitance at the nodes "
      "up to |\n|---|---|---|---|\n";
  for (const double gain : {1.0, 3.0, 10.0}) {
    const RealizationOptions options{.opamp = one_pole, .residual_gain = gain, .ladder = true};
    const double pole = turn(1e5, 0.01, [&](double ratio) {
      RealizationOptions slow = options;
      slow.opamp.second_pole = ratio * *one_pole.bandwidth;
      return stable(slow);
    });
    const double farad = turn(1e-15, 1e-8, [&](double capacitance) {
      RealizationOptions loaded = options;
      loaded.node_capacitance = capacitance;
      return stable(loaded);
    });
    const Certificate c = certify(Realization::least_squares, one.problem, options, accuracy);
    text += "| " + brief(gain) + " | " + time(c.dynamics->settling_seconds) + " | " + brief(pole) +
            " | " + brief(1e12 * farad) + " pF |\n";
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
