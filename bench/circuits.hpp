/// @file
/// Circuits as the floors of circuit_bench.cpp need them.
#pragma once

#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "bench/floors.hpp"
#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/state_space.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tactile_net/simulator/step_response.hpp"

namespace bench {

/// Equal logarithms are equally likely.
inline double log_uniform(std::mt19937& generator, double low, double high) {
  return low * std::pow(high / low, static_cast<double>(generator()) / 4294967295.0);
}

/// Gives every amplifier a bandwidth of its own, up to ten times or a tenth of its model's, and
/// every capacitor and every input capacitance a value of its own, 0.1 pF to 1 nF.
inline tactile_net::Circuit scattered(const tactile_net::Circuit& circuit, bool bandwidths,
                                      bool capacitances, std::mt19937& generator) {
  tactile_net::Circuit flat = tactile_net::FlatCircuit(circuit).circuit();
  if (capacitances)
    for (tactile_net::Capacitor& one : flat.capacitors)
      one.farad = log_uniform(generator, 1e-13, 1e-9);
  if (!bandwidths) return flat;
  const std::vector<tactile_net::AmplifierModel> kinds = std::exchange(flat.amplifiers, {});
  for (tactile_net::Instance& x : flat.instances)
    for (tactile_net::AmplifierModel own : kinds) {
      if (own.name != x.subcircuit) continue;
      own.name = "own" + x.name;
      *own.opamp.bandwidth *= log_uniform(generator, 0.1, 10.0);
      if (capacitances && own.opamp.input_capacitance)
        own.opamp.input_capacitance = log_uniform(generator, 1e-13, 1e-9);
      flat.amplifiers.push_back(own);
      x.subcircuit = own.name;
      break;
    }
  return flat;
}

inline std::string deck_of(const tactile_net::Circuit& circuit,
                           const tactile_net::Analysis& analysis = tactile_net::DirectCurrent{}) {
  std::ostringstream deck;
  write_deck(deck, circuit, {.title = "bench"}, tactile_net::Answer::raw_file, analysis);
  return deck.str();
}

/// The outputs as ngspice finds them [V].
inline std::vector<double> relaxed(
    const tactile_net::Circuit& circuit,
    const tactile_net::Analysis& analysis = tactile_net::DirectCurrent{}) {
  tactile_net::Ngspice ngspice;
  return operating_point(ngspice, deck_of(circuit, analysis), output_names(circuit)).voltages;
}

/// Largest real part of a pole [1/s].
inline double slowest(const tactile_net::Circuit& circuit) {
  return tactile_net::poles(tactile_net::state_space(circuit)).front().real();
}

/// ngspice's transient of any circuit, which no certificate need be for.
inline tactile_net::Transient transient(const tactile_net::Circuit& circuit,
                                        const tactile_net::Dynamics& dynamics) {
  tactile_net::Certificate certificate;
  certificate.dynamics = dynamics;
  tactile_net::Ngspice ngspice({.time_limit = std::chrono::minutes(10)});
  return settle(ngspice, circuit, certificate, relaxed(circuit));
}

inline tactile_net::Dynamics dynamics(const tactile_net::Circuit& circuit) {
  const tactile_net::StateSpace system = tactile_net::state_space(circuit);
  tactile_net::Dynamics result{.states = system.states(),
                               .slowest = tactile_net::poles(system).front().real()};
  result.settling_seconds = settling_time(system, 1e-3, result.slowest);
  return result;
}

}  // namespace bench
