#include "tactile_net/network/opamp.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

constexpr double transconductance = 1e-3;  // [S]; only its ratio to the core's R and C matters
constexpr double diode_drop = 0.6;         // [V], of the clamp's diodes as they begin to conduct

void check(const std::optional<double>& value, const char* name) {
  if (value && !(*value > 0.0 && std::isfinite(*value)))
    throw std::invalid_argument(std::string("an op-amp's ") + name + " must be > 0 and finite");
}

/// A farad value that sets a pole at `hertz` with the transconductance.
std::string farad(double hertz) {
  return shortest(transconductance / (2.0 * std::numbers::pi * hertz));
}

/// Whose thermal noise is `volts` per square root of Hz at a simulator's 27 degrees: 4 k T R.
double noise_resistor(double volts) { return volts * volts / (4.0 * 1.380649e-23 * 300.15); }

std::string description(const AmplifierModel& model) {
  const OpAmp& o = model.opamp;
  const std::string kind = model.outputs == Outputs::complementary
                               ? "amplifier with complementary outputs"
                               : "operational amplifier";
  std::string text;
  if (o.is_nullor())
    text = "* Ideal " + kind + " (nullor): no input current, no input voltage, whatever output " +
           "it takes.\n* For operating points: it knows neither polarity nor stability.\n";
  else
    text = "* " + std::string(1, model.outputs == Outputs::complementary ? 'A' : 'O') +
           kind.substr(1) + " of finite gain" + (o.bandwidth ? ", one pole" : "") +
           (o.second_pole ? " and a second" : "") + (o.offset ? ", input offset" : "") +
           (o.noise_voltage ? ", input noise" : "") + (o.rail ? ", clamped output" : "") + ".\n";
  return text +
         "* Pins: p = non-inverting input, n = inverting input, out = output (against ground)" +
         (model.outputs == Outputs::complementary ? ", inv = -out" : "") + ".\n";
}

}  // namespace

void check(const OpAmp& opamp) {
  check(opamp.gain, "gain");
  check(opamp.bandwidth, "bandwidth");
  check(opamp.second_pole, "second pole");
  check(opamp.rail, "rail");
  check(opamp.input_capacitance, "input capacitance");
  check(opamp.noise_voltage, "noise voltage");
  if (opamp.offset && !std::isfinite(*opamp.offset))
    throw std::invalid_argument("an op-amp's offset must be finite");
  if (opamp.noise_voltage && !opamp.bandwidth)
    throw std::invalid_argument(
        "an op-amp's noise voltage needs its bandwidth: white noise of any "
        "frequency has no size");
  if (opamp.second_pole && !opamp.bandwidth)
    throw std::invalid_argument("an op-amp's second pole needs its bandwidth, the first one");
  if (opamp.rail && *opamp.rail <= diode_drop)
    throw std::invalid_argument("an op-amp's rail must be > 0.6 V, what its clamp's diodes drop");
}

std::string subcircuit_text(const AmplifierModel& model) {
  const OpAmp& o = model.opamp;
  check(o);
  const bool both = model.outputs == Outputs::complementary;
  std::string text =
      description(model) + ".subckt " + model.name + " p n out" + (both ? " inv" : "") + '\n';
  if (o.is_nullor()) {
    // 1e21 V/A: smaller gains show in the last digits of the answer.
    text += "Vn p n 0\nH1 out 0 Vn 1e21\n";
  } else {
    std::string input = "p";
    if (o.offset) {
      text += "Vo q p " + shortest(*o.offset) + '\n';
      input = "q";
    }
    if (o.noise_voltage) {  // a resistor's own noise is the source
      text +=
          "Rn w 0 " + shortest(noise_resistor(*o.noise_voltage)) + "\nEn z " + input + " w 0 1\n";
      input = "z";
    }
    if (!o.bandwidth && !o.rail) {
      text += "E1 out 0 " + input + " n " + shortest(o.dc_gain()) + '\n';
    } else {
      text += "Ga 0 x " + input + " n " + shortest(transconductance) + '\n';
      text += "Ra x 0 " + shortest(o.dc_gain() / transconductance) + '\n';
      if (o.bandwidth) text += "Ca x 0 " + farad(*o.bandwidth) + '\n';
      if (o.rail) {
        const std::string limit = shortest(*o.rail - diode_drop);
        text += "Dp x h clamp\nDn l x clamp\nVh h 0 " + limit + "\nVl 0 l " + limit +
                "\n.model clamp d(is=1e-14)\n";
      }
      if (o.second_pole)
        text += "Gb 0 y x 0 " + shortest(transconductance) + "\nRb y 0 " +
                shortest(1.0 / transconductance) + "\nCb y 0 " + farad(*o.second_pole) + '\n';
      text += std::string("E1 out 0 ") + (o.second_pole ? "y" : "x") + " 0 1\n";
    }
  }
  if (o.input_capacitance) {
    const std::string value = shortest(*o.input_capacitance) + '\n';
    text += "Cn n 0 " + value;
    if (both) text += "Cp p 0 " + value;
  }
  if (both) text += "E2 inv 0 0 out 1\n";
  return text + ".ends " + model.name + '\n';
}

}  // namespace tactile_net
