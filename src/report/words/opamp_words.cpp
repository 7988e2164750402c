#include "tactile_net/report/words/opamp_words.hpp"

#include <cmath>
#include <variant>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/numeric/unit_text.hpp"
#include "tactile_net/report/words/network_words.hpp"

namespace tactile_net::report {
namespace {

std::string static_errors_in_words(const StaticErrors& errors) {
  std::vector<std::string> parts;
  const auto add = [&](const char* of, const InputErrors& one) {
    if (one.either_sign > 0.0)
      parts.push_back(std::string(of) + ' ' + percent(one.either_sign) +
                      " of the answer, if signs are random (" + percent(one.alike) +
                      " if all have one sign)");
  };
  add("offset", errors.offset);
  add("bias current", errors.bias_current);
  if (errors.common_mode > 0.0)
    parts.push_back("common-mode rejection " + percent(errors.common_mode));
  if (errors.output_resistance > 0.0)
    parts.push_back("output resistance " + percent(errors.output_resistance));
  return parts.empty() ? "op-amps at rest: their errors do not reach the answer"
                       : "op-amps at rest: " + join(parts, ", ");
}

std::string bound_in_words(ScaleProposal::Bound bound) {
  switch (bound) {
    case ScaleProposal::Bound::swing:
      return "the rail allows no more";
    case ScaleProposal::Bound::supply:
      return "2 V at the largest node, as fits a supply of 5 V; state rail for another supply";
    case ScaleProposal::Bound::slew:
      return "with more volts, slewing would take more than a fifth of the settling time";
    case ScaleProposal::Bound::current:
      return "the outputs can give no more current";
  }
  return {};
}

}  // namespace

std::string in_words(const ScaleProposal& proposal, const Scale& scale) {
  std::string text = "recommended scale for these op-amps: " + brief(proposal.volts / scale.volts) +
                     " times the volts (" + bound_in_words(proposal.volts_by) + ")";
  if (proposal.siemens != scale.siemens)
    text += ", " + brief(proposal.siemens / scale.siemens) + " times the siemens" +
            (proposal.least_ohm ? " (no resistor below 1 kilo-ohm)" : "");
  if (proposal.noise > 0.0) text += "; noise then " + percent(proposal.noise);
  if (proposal.offset > 0.0) text += "; offset and bias then " + percent(proposal.offset);
  return text + " of the answer";
}

std::vector<std::string> opamps_in_words(const Certificate& c) {
  std::vector<std::string> lines;
  if (c.slewing) lines.push_back(in_words(*c.slewing));
  if (c.dynamics && c.dynamics->unslewed_seconds)
    lines.push_back(
        c.dynamics->settling_seconds
            ? "the settling time includes the op-amps' slew; without slew it is " +
                  duration(*c.dynamics->unslewed_seconds)
            : "with the op-amps' slew it does NOT come to rest; without slew it would, in " +
                  duration(*c.dynamics->unslewed_seconds));
  if (c.errors) lines.push_back(static_errors_in_words(*c.errors));
  if (c.noise)
    lines.push_back("noise: " + brief(c.noise->largest) + " V rms at the noisiest output" +
                    (std::isfinite(c.noise->relative)
                         ? ", " + percent(c.noise->relative) + " of the answer"
                         : "") +
                    "; " + percent(c.noise->thermal) + " of its power is from the resistors" +
                    (c.noise->flicker > 0.0 ? ", " + percent(c.noise->flicker) +
                                                  " from the op-amps' 1/f noise above " +
                                                  brief(lowest_noise_hertz) + " Hz"
                                            : ""));
  if (c.output_current)
    lines.push_back("an output carries at most " + with_unit(c.output_current->largest, "A") +
                    " at rest, that of " + c.output_current->opamp);
  return lines;
}

std::string speed_in_words(double speed, const std::optional<Units>& units) {
  return units ? with_unit(speed, "m/s") : brief(speed) + " length units/s";
}

std::string in_words(const lab::ContactMotion& motion, const std::optional<Units>& units) {
  return "moving contacts: delay " + duration(motion.delay) + ", which costs " +
         percent(lab::ContactMotion::lag) + " of the answer at " +
         speed_in_words(motion.speed, units) + "; bandwidth of the slowest mode " +
         with_unit(motion.slowest_hertz, "Hz") + "; for comparison, a computer that samples at " +
         with_unit(lab::ContactMotion::sampling_hertz, "Hz") + " and holds: delay up to " +
         duration(1.0 / lab::ContactMotion::sampling_hertz) + ", " +
         percent(lab::ContactMotion::lag) + " at " + speed_in_words(motion.sampled_speed, units);
}

std::vector<std::string> facts_in_words(const lab::Certification& c) {
  std::vector<std::string> lines;
  // On its board it asks for another.
  if (const auto& proposal = c.certificate().proposal; proposal && !c.board)
    lines.push_back(in_words(*proposal, c.circuit.options().parts.scale));
  if (c.motion)
    lines.push_back(
        in_words(*c.motion, std::visit([](const auto& scene) { return scene.units; }, c.scene())));
  return lines;
}

}  // namespace tactile_net::report
