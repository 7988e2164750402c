#include "network/scale_proposal.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace tactile_net {
namespace {

constexpr double headroom = 0.8;     // of what is left
constexpr double usual_swing = 2.0;  // [V], what most amplifiers with two outputs reach at 5 V
constexpr double least_load = 1e3;   // [ohm], what the outputs of most op-amps still drive
constexpr double most_delay = 0.2;   // by slewing, over the settling time without it

constexpr double little_ringing = 0.7;  // damping, of a loop whose phase margin is 65 degrees

/// Whether the circuit is known to be stable at other siemens, and to ring little, or no more than
/// it does: fewer siemens wait longer for the same capacitance. Without capacitance, and with
/// outputs of no resistance, they change no pole.
bool settles_at(double siemens, const Certificate& c, const NetworkCircuit& circuit) {
  RealizationOptions options = circuit.options();
  if (!options.has_capacitance() && circuit.capacitances().empty() &&
      !options.opamp.output_resistance)
    return true;
  options.scale.siemens = siemens;
  const NetworkCircuit other(circuit.realization(), circuit.shared_problem(), options,
                             circuit.capacitances());
  if (stability_of(other).stability != Stability::stable) return false;
  if (!c.dynamics) return true;
  const double enough = std::min(little_ringing, c.dynamics->damping);
  const std::vector<std::complex<double>>& poles = other.poles();
  return std::all_of(poles.begin(), poles.end(),
                     [&](const auto& pole) { return -pole.real() >= enough * std::abs(pole); });
}

}  // namespace

std::optional<ScaleProposal> scale_proposal(const Certificate& c, const NetworkCircuit& circuit) {
  const Scale& scale = circuit.options().scale;
  const OpAmp& o = circuit.options().opamp;
  const bool noisy = c.noise && std::isfinite(c.noise->relative) && c.noise->relative > 0.0;
  const double offset =
      c.errors ? std::hypot(c.errors->offset.either_sign, c.errors->bias_current.either_sign) : 0.0;
  if (c.stability != Stability::stable || !(c.largest_voltage > 0.0) || !(noisy || offset > 0.0) ||
      circuit.flat().had_subcircuits() || !traits(c.realization).linear())
    return std::nullopt;

  // All of them fall as 1/volts: as many volts as the op-amps can give.
  ScaleProposal proposal;
  const double swing = o.rail ? headroom * (*o.rail - diode_drop) : usual_swing;
  proposal.volts_by = o.rail ? ScaleProposal::Bound::swing : ScaleProposal::Bound::supply;
  double most = swing / c.largest_voltage;  // over the volts that are
  if (o.slew && c.dynamics && c.dynamics->unslewed_seconds.value_or(0.0) > 0.0) {
    // Two full swings at the slew are the most that slewing adds.
    const double by_slew =
        0.5 * most_delay * *c.dynamics->unslewed_seconds * *o.slew / c.largest_voltage;
    if (by_slew < most) {
      most = by_slew;
      proposal.volts_by = ScaleProposal::Bound::slew;
    }
  }
  // Resistors' noise power falls as 1/siemens, the op-amps' noise voltage's does not.
  double factor = 1.0;
  if (noisy && c.noise->thermal > 0.0 && c.noise->thermal < 1.0)
    factor = c.noise->thermal / (1.0 - c.noise->thermal);
  const double by_load = c.least_ohm / least_load;
  proposal.least_ohm = factor > by_load;
  factor = std::min(factor, by_load);
  if (factor != 1.0 && !settles_at(factor * scale.siemens, c, circuit)) {
    factor = 1.0;
    proposal.least_ohm = false;
  }
  proposal.siemens = factor * scale.siemens;
  if (o.output_current && c.output_current) {
    const double by_current = *o.output_current / (c.output_current->largest * factor);
    if (by_current < most) {
      most = by_current;
      proposal.volts_by = ScaleProposal::Bound::current;
    }
  }
  proposal.volts = most * scale.volts;
  if (noisy)
    proposal.noise =
        c.noise->relative * std::sqrt(c.noise->thermal / factor + 1.0 - c.noise->thermal) / most;
  if (c.errors)
    proposal.offset =
        std::hypot(c.errors->offset.either_sign, c.errors->bias_current.either_sign / factor) /
        most;
  return proposal;
}

}  // namespace tactile_net
