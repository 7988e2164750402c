/// @file
/// The noise at a node, as ngspice has it.
#pragma once

#include <cmath>
#include <span>
#include <sstream>
#include <string>

#include "tactile_net/network/deck.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/simulator/ngspice.hpp"

namespace tactile_net {

/// Root mean square, from the integral over ngspice's spectrum [V].
inline double noise_of(const Simulation& seen) {
  const std::span<const double> hertz = seen.plot.vector("frequency");
  const std::span<const double> density = seen.plot.vector("onoise_spectrum");
  double square = 0.0;
  for (std::size_t k = 1; k < hertz.size(); ++k)
    square += 0.5 * (hertz[k] - hertz[k - 1]) *
              (density[k] * density[k] + density[k - 1] * density[k - 1]);
  return std::sqrt(square);
}

/// `noise_of` a node, from 1 Hz on.
///
/// @param kelvin  of the circuit's resistors; op-amps have the noise of their figures at any
inline double noise_in_ngspice(const Circuit& circuit, const std::string& node,
                               double kelvin = 300.15) {
  std::ostringstream out;
  write_deck(out, circuit, {.title = "noise"}, Answer::raw_file);
  std::string deck = out.str();
  for (const Resistor& one : circuit.resistors)
    deck.insert(deck.find('\n', deck.find('\n' + one.name + ' ') + 1),
                " temp=" + shortest(kelvin - 273.15));
  const std::string source = circuit.sources.front().name;
  deck.replace(deck.find(".op\n"), 4, ".noise v(" + node + ") " + source + " dec 40 1 1e11\n");
  deck.insert(deck.find('\n', deck.find('\n' + source + ' ') + 1), " AC 1");
  Ngspice ngspice;
  return noise_of(ngspice.run(deck));
}

}  // namespace tactile_net
