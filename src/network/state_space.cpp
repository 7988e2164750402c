#include "tactile_net/network/state_space.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "network/angular_frequency.hpp"
#include "network/stamps.hpp"
#include "numeric/eigen.hpp"
#include "numeric/lyapunov.hpp"

namespace tactile_net {

std::size_t count_states(const FlatCircuit& circuit) {
  std::size_t states = circuit.circuit().capacitors.size();
  for (const FlatCircuit::Amplifier& x : circuit.amplifiers()) {
    const OpAmp& opamp = circuit.opamp(x);
    states += (opamp.second_pole ? 2U : 1U) + inputs_with_capacitance(x, opamp).size();
  }
  return states;
}

namespace {

enum class Sources { on, off };

Stamps stamps_of(const FlatCircuit& circuit, Sources sources = Sources::on) {
  const Circuit& flat = circuit.circuit();
  if (!flat.inductors.empty()) throw std::invalid_argument("an inductor has no place here");
  Stamps stamps(circuit);
  for (std::size_t k = 0; k < flat.instances.size(); ++k) {
    const FlatCircuit::Amplifier& x = circuit.amplifiers()[k];
    stamps.amplifier(x, circuit.opamp(x), flat.instances[k].name);
  }
  for (const Capacitor& c : flat.capacitors) stamps.capacitor(c);
  stamps.number();
  for (const Resistor& r : flat.resistors) stamps.resistor(r.from, r.to, r.siemens);
  for (const NShapedDevice& b : flat.devices) stamps.resistor(b.from, b.to, -b.siemens);
  if (sources == Sources::on)
    for (const CurrentSource& i : flat.sources) stamps.source(i.into, i.ampere);
  stamps.bias_currents();
  return stamps;
}

}  // namespace

StateSpace state_space(const FlatCircuit& circuit) {
  StateSpace system = stamps_of(circuit).system();
  const auto errs = [&](const FlatCircuit::Amplifier& x) {
    return circuit.opamp(x).offset || circuit.opamp(x).bias_current;
  };
  if (std::any_of(circuit.amplifiers().begin(), circuit.amplifiers().end(), errs))
    system.idle_drive = stamps_of(circuit, Sources::off).system().drive;
  return system;
}

OutputNoise output_noise(const FlatCircuit& circuit, double kelvin, double lowest_hertz) {
  if (!(kelvin >= 0.0) || !std::isfinite(kelvin))
    throw std::invalid_argument("a temperature must be >= 0 and finite");
  if (!(lowest_hertz > 0.0) || !std::isfinite(lowest_hertz))
    throw std::invalid_argument("the frequency that 1/f noise begins at must be > 0 and finite");
  Stamps stamps = stamps_of(circuit);
  const StateSpace system = stamps.system();
  const Eigen::MatrixXd a = as_eigen(system.dynamics);
  const Eigen::MatrixXd c = as_eigen(system.output);
  if (!stamps.outputs_are_states())
    throw std::domain_error("white noise at an output without capacitance has no size");
  const Lyapunov equation(a);
  if (!(equation.largest_real_part() < 0.0))
    throw std::domain_error("an unstable circuit's noise grows without end");
  const Stamps::Intensity noise = stamps.noise(circuit.circuit().resistors, kelvin);
  const auto at_outputs = [&](const Eigen::MatrixXd& covariance) {
    return from_eigen(c * covariance * c.transpose());
  };
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(a.rows(), a.cols());
  return {at_outputs(equation.solve(noise.thermal)), at_outputs(equation.solve(noise.amplifiers)),
          at_outputs(noise.flicker.isZero(0.0)
                         ? none
                         : equation.solve_flicker(noise.flicker, angular_frequency(lowest_hertz)))};
}

}  // namespace tactile_net
