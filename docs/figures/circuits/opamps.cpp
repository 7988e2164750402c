#include <iostream>
#include <memory>
#include <numbers>
#include <sstream>
#include <vector>

#include "docs/figures/circuits/numbers.hpp"
#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/motion.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/unit_text.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tactile_net/simulator/step_response.hpp"

namespace tactile_net::circuits {
namespace {

constexpr Realization of_opamps[] = {Realization::crossbar, Realization::lattice,
                                     Realization::least_squares};

/// The array of the page under a cylinder in the middle, and how its readings change as that moves.
struct Moving {
  std::shared_ptr<const NetworkProblem> problem;
  std::vector<double> rate;
};

Moving moving(double alpha) {
  const SensorArray array{21, 0.5, {1.5}, {Quantity::strain_x}};
  const Material pad{1.0, 0.45};
  const LinearProblem inverse = make_problem(array, pad, {.smoothing_length = 1.0});
  const auto at = [&](double y) {
    const std::vector<Contact> contacts = {RigidContact{.center = y, .half_width = 2.0}};
    return network_problem(inverse, alpha, exact_readings(array, pad, contacts));
  };
  const double step = 1e-3;
  std::vector<double> rate = at(step).readings;
  const std::vector<double> before = at(-step).readings;
  for (std::size_t i = 0; i < rate.size(); ++i) rate[i] = (rate[i] - before[i]) / (2.0 * step);
  return {std::make_shared<const NetworkProblem>(at(0.0)), rate};
}

std::string settles(const NetworkCircuit& circuit, const Certificate& certificate) {
  if (certificate.stability != Stability::stable) return "unstable | -";
  std::ostringstream deck;
  write_deck(deck, circuit.circuit(), {.title = "numbers"}, Answer::raw_file);
  Ngspice ngspice;
  const std::vector<double> rest =
      operating_point(ngspice, deck.str(), output_names(circuit.circuit())).voltages;
  const Transient seen = settle(ngspice, circuit.circuit(), certificate, rest);
  return duration(*certificate.dynamics->settling_seconds) + " | " +
         (seen.settling_seconds ? duration(*seen.settling_seconds) : std::string(name(seen.end)));
}

}  // namespace

std::string opamp_classes_table() {
  const Moving one = moving(1e-3);
  std::string text =
      "| op-amps | realisation | volts | settles (certificate) | settles (ngspice) | without slew "
      "| "
      "offset, either sign | bias, either sign | noise | volts to take |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const OpAmpClass& kind : opamp_classes())
    for (const Realization realization : of_opamps)
      for (const double volts : {1.0, 10.0}) {
        std::cerr << kind.name << ", " << name(realization) << '\n';
        const NetworkCircuit circuit(realization, one.problem,
                                     {.scale = {1e-3, volts}, .opamp = kind.opamp});
        const Certificate c = certify(circuit);
        text += "| " + std::string(kind.name) + " | " + std::string(name(realization)) + " | " +
                brief(volts) + " | " + settles(circuit, c) + " | " +
                (c.dynamics->unslewed_seconds ? duration(*c.dynamics->unslewed_seconds) : "-") +
                " | " + percent(c.errors->offset.either_sign) + " | " +
                percent(c.errors->bias_current.either_sign) + " | " +
                (c.noise ? percent(c.noise->relative) : "-") + " | " +
                (c.proposal && c.noise ? brief(c.proposal->volts) : "-") + " |\n";
      }
  return text + '\n';
}

std::string motion_table() {
  std::string text =
      "| alpha | realisation | behind | 1 % behind at | slowest direction follows to | sampled at "
      "1 "
      "kHz: 1 % at |\n|---|---|---|---|---|---|\n";
  for (const double alpha : {1e-3, 1e-5}) {
    const Moving one = moving(alpha);
    for (const Realization realization : of_opamps) {
      const NetworkCircuit circuit(realization, one.problem,
                                   {.opamp = {.gain = 1e6, .bandwidth = 10e6}});
      const MotionLag lag = motion_lag(circuit, one.rate);
      const double slowest = -circuit.poles().front().real() / (2.0 * std::numbers::pi);
      text += "| " + brief(alpha) + " | " + std::string(name(realization)) + " | " +
              duration(lag.seconds) + " | " + with_unit(1e-3 * 0.01 / lag.relative, "m/s") + " | " +
              with_unit(slowest, "Hz") + " | " +
              with_unit(1e-3 * 0.01 * 1000.0 * lag.seconds / lag.relative, "m/s") + " |\n";
    }
  }
  return text + '\n';
}

}  // namespace tactile_net::circuits
