#include "tactile_net/network/opamp.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "network/angular_frequency.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

constexpr double transconductance = 1e-3;  // [S]; only its ratio to the core's R and C matters
/// Of the second pole's stage [S]: its resistor hisses, as no part of the model may but those that
/// stand for the op-amp's own noise, and of 1 ohm it is not heard.
constexpr double second_transconductance = 1.0;

void check(const std::optional<double>& value, const char* name) {
  if (value && !(*value > 0.0 && std::isfinite(*value)))
    throw std::invalid_argument(std::string("an op-amp's ") + name + " must be > 0 and finite");
}

void check_limit(const std::optional<double>& typical, const std::optional<double>& limit,
                 const char* name) {
  if (limit && typical && std::abs(*typical) > *limit)
    throw std::invalid_argument(std::string("an op-amp's ") + name + " must be within its limit");
}

/// A farad value that sets a pole at `hertz` with a conductance.
std::string farad(double siemens, double hertz) {
  return shortest(siemens / angular_frequency(hertz));
}

/// What is left of an output's slope while it gives all it has: of the slope, and at most so much
/// of the limit a volt.
constexpr double leak_of_slope = 1e-3;
constexpr double leak_of_limit = 1e-2;

constexpr double four_k_t = 4.0 * 1.380649e-23 * 300.15;  // at a simulator's 27 degrees

/// Of a diode, at that temperature [V].
constexpr double thermal_voltage = 1.380649e-23 * 300.15 / 1.602176634e-19;

/// Whose thermal noise is `volts` per square root of Hz: 4 k T R.
double noise_resistor(double volts) { return volts * volts / four_k_t; }

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
           (o.bias_current ? ", bias current" : "") +
           (o.common_mode_rejection ? ", finite common-mode rejection" : "") +
           (o.noise_voltage || o.noise_current ? ", input noise" : "") + (o.slew ? ", slew" : "") +
           (o.rail ? ", clamped output" : "") + (o.output_resistance ? ", output resistance" : "") +
           (o.output_resistance && o.output_current ? ", limited current" : "") + ".\n";
  return text +
         "* Pins: p = non-inverting input, n = inverting input, out = output (against ground)" +
         (model.outputs == Outputs::complementary ? ", inv = -out" : "") + ".\n";
}

/// Of op-amps on the market: an inexpensive one, an accurate one, a fast one with two outputs.
constexpr OpAmpClass classes[] = {{"general",
                                   {.gain = 1e5,
                                    .bandwidth = 1e6,
                                    .second_pole = 3e6,
                                    .offset = 2e-3,
                                    .input_capacitance = 3e-12,
                                    .noise_voltage = 30e-9,
                                    .noise_current = 0.1e-12,
                                    .bias_current = 20e-9,
                                    .slew = 0.5e6}},
                                  {"precision",
                                   {.gain = 1e6,
                                    .bandwidth = 10e6,
                                    .second_pole = 25e6,
                                    .offset = 50e-6,
                                    .input_capacitance = 4e-12,
                                    .noise_voltage = 5e-9,
                                    .noise_current = 1e-12,
                                    .bias_current = 1e-9,
                                    .slew = 10e6}},
                                  {"fast",
                                   {.gain = 1e4,
                                    .bandwidth = 200e6,
                                    .second_pole = 400e6,
                                    .offset = 1e-3,
                                    .input_capacitance = 2e-12,
                                    .noise_voltage = 5e-9,
                                    .noise_current = 2e-12,
                                    .bias_current = 1e-6,
                                    .slew = 200e6}}};

}  // namespace

std::span<const OpAmpClass> opamp_classes() noexcept { return classes; }

void check(const OpAmp& opamp) {
  check(opamp.gain, "gain");
  check(opamp.bandwidth, "bandwidth");
  check(opamp.second_pole, "second pole");
  check(opamp.rail, "rail");
  check(opamp.input_capacitance, "input capacitance");
  check(opamp.differential_capacitance, "differential capacitance");
  check(opamp.load_capacitance, "load capacitance");
  check(opamp.noise_voltage, "noise voltage");
  check(opamp.noise_corner, "noise corner");
  check(opamp.noise_current, "noise current");
  check(opamp.common_mode_rejection, "common-mode rejection");
  check(opamp.slew, "slew");
  check(opamp.output_resistance, "output resistance");
  check(opamp.output_current, "output current");
  check(opamp.offset_limit, "offset limit");
  check(opamp.offset_drift, "offset drift");
  check(opamp.bias_limit, "bias limit");
  if (opamp.bias_current && !std::isfinite(*opamp.bias_current))
    throw std::invalid_argument("an op-amp's bias current must be finite");
  if (opamp.offset && !std::isfinite(*opamp.offset))
    throw std::invalid_argument("an op-amp's offset must be finite");
  check_limit(opamp.offset, opamp.offset_limit, "offset");
  check_limit(opamp.bias_current, opamp.bias_limit, "bias current");
  if ((opamp.noise_voltage || opamp.noise_current) && !opamp.bandwidth)
    throw std::invalid_argument(
        "an op-amp's noise needs its bandwidth: white noise of any frequency has no size");
  if (opamp.noise_corner && !opamp.noise_voltage)
    throw std::invalid_argument(
        "an op-amp's noise corner needs its noise voltage, the white noise that 1/f exceeds");
  if (opamp.slew && !opamp.bandwidth)
    throw std::invalid_argument("an op-amp's slew needs its bandwidth: it bends what that makes");
  if (opamp.second_pole && !opamp.bandwidth)
    throw std::invalid_argument("an op-amp's second pole needs its bandwidth, the first one");
  if (opamp.rail && *opamp.rail <= diode_drop)
    throw std::invalid_argument("an op-amp's rail must be > 0.6 V, what its clamp's diodes drop");
}

namespace {

/// From the pin `p` to the node that its core sees, through what a real input adds.
std::string input_text(const OpAmp& o, std::string& input) {
  std::string text;
  if (o.common_mode_rejection) {
    const std::string half = shortest(0.5 / *o.common_mode_rejection);
    text += "Ecp c p p 0 " + half + "\nEcn d c n 0 " + half + '\n';
    input = "d";
  }
  if (o.offset) {
    text += "Vo q " + input + ' ' + shortest(*o.offset) + '\n';
    input = "q";
  }
  if (o.noise_voltage) {  // a resistor's own noise is the source
    text += "Rn w 0 " + shortest(noise_resistor(*o.noise_voltage)) + "\nEn z " + input + " w 0 1\n";
    input = "z";
  }
  if (o.noise_corner) {
    // A diode at 1 A: its noise current kf I / f through Vt / I. Another without takes away the
    // voltage at rest; the shot noise of both is 2e-11 V per root of Hz.
    const double volts = *o.noise_voltage / thermal_voltage;
    text +=
        "If 0 f 1\nDf f 0 flicker\nIg 0 g 1\nDg g 0 quiet\nEf v " + input +
        " f g 1\n.model flicker d(is=1e-14 af=1 kf=" + shortest(volts * volts * *o.noise_corner) +
        ")\n.model quiet d(is=1e-14)\n";
    input = "v";
  }
  for (const char* pin : {"p", "n"}) {
    if (o.bias_current)
      text += std::string("Ib") + pin + ' ' + pin + " 0 " + shortest(*o.bias_current) + '\n';
    if (o.noise_current)  // of 1 ohm
      text += std::string("Rm") + pin + " m" + pin + " 0 1\nGm" + pin + ' ' + pin + " 0 m" + pin +
              " 0 " + shortest(*o.noise_current / std::sqrt(four_k_t)) + '\n';
  }
  return text;
}

/// The current into the core: a transconductance, bent by the slew.
std::string core_text(const OpAmp& o, const std::string& input) {
  if (!o.slew) return "Ga 0 x " + input + " n " + shortest(transconductance) + '\n';
  const double ampere = *o.slew * transconductance / angular_frequency(*o.bandwidth);  // slew Ca
  const std::string difference = "(V(" + input + ")-V(n))";
  return "Bg 0 x I=" + shortest(ampere) + "*tanh(" +
         shortest((1.0 - slewing_leak) * transconductance / ampere) + '*' + difference + ")+" +
         shortest(slewing_leak * transconductance) + '*' + difference + '\n';
}

/// The current through the output resistance, bent by what the output gives, of a voltage across
/// it. Its slope never is 0: an operating point would be anywhere.
std::string limited_current(const OpAmp& o, const std::string& voltage) {
  const double limit = *o.output_current;
  const double siemens = 1.0 / *o.output_resistance;
  const double leak = std::min(leak_of_slope * siemens, leak_of_limit * limit);
  return "I=" + shortest(limit) + "*tanh(" + shortest((siemens - leak) / limit) + '*' + voltage +
         ")+" + shortest(leak) + '*' + voltage + '\n';
}

/// From the core's voltage to `out`.
std::string output_text(const OpAmp& o, const std::string& core, bool both) {
  if (!o.output_resistance) return "E1 out 0 " + core + " 0 1\n";
  if (o.output_current && !both)
    return "E1 e 0 " + core + " 0 1\nBo e out " + limited_current(o, "V(e,out)");
  if (o.output_current)  // each output by itself, measured by Ve and Vi; out is half their
                         // difference
    return "Bo 0 o " + limited_current(o, "V(" + core + ",o)") + "Fo o 0 Ve 1\nBi 0 m " +
           limited_current(o, "(-V(" + core + ")-V(m))") +
           "Fi m 0 Vi 1\nE1 e 0 o m 0.5\nVe e out 0\n";
  // Not a resistor: nothing would limit the band of its noise. Vr measures the current.
  const std::string source = "E1 e 0 " + core + " 0 1\nVr e r 0\nHr r ";
  if (!both) return source + "out Vr " + shortest(*o.output_resistance) + '\n';
  // out = core - resistance (i_out - i_inv) / 2, the latter current measured by Vi
  const std::string half = shortest(0.5 * *o.output_resistance);
  return source + "o Vr " + half + "\nHo out o Vi " + half + '\n';
}

}  // namespace

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
    text += input_text(o, input);
    if (!o.bandwidth && !o.rail && !o.output_resistance) {
      text += "E1 out 0 " + input + " n " + shortest(o.dc_gain()) + '\n';
    } else {
      text += core_text(o, input);
      text += "Ra x 0 " + shortest(o.dc_gain() / transconductance) + '\n';
      if (o.bandwidth) text += "Ca x 0 " + farad(transconductance, *o.bandwidth) + '\n';
      if (o.rail) {
        const std::string limit = shortest(*o.rail - diode_drop);
        text += "Dp x h clamp\nDn l x clamp\nVh h 0 " + limit + "\nVl 0 l " + limit +
                "\n.model clamp d(is=1e-14)\n";
      }
      if (o.second_pole)
        text += "Gb 0 y x 0 " + shortest(second_transconductance) + "\nRb y 0 " +
                shortest(1.0 / second_transconductance) + "\nCb y 0 " +
                farad(second_transconductance, *o.second_pole) + '\n';
      text += output_text(o, o.second_pole ? "y" : "x", both);
    }
  }
  if (o.input_capacitance) {
    const std::string value = shortest(*o.input_capacitance) + '\n';
    text += "Cn n 0 " + value;
    if (both) text += "Cp p 0 " + value;
  }
  if (o.differential_capacitance) text += "Cd p n " + shortest(*o.differential_capacitance) + '\n';
  if (o.load_capacitance) {
    const std::string value = shortest(*o.load_capacitance) + '\n';
    text += "Cl out 0 " + value;
    if (both) text += "Ci inv 0 " + value;
  }
  if (both) text += o.output_resistance ? "E2 i 0 0 out 1\nVi i inv 0\n" : "E2 inv 0 0 out 1\n";
  return text + ".ends " + model.name + '\n';
}

}  // namespace tactile_net
