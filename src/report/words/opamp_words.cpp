#include "tactile_net/report/words/opamp_words.hpp"

#include <cmath>
#include <variant>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/numeric/unit_text.hpp"
#include "tactile_net/report/words/network_words.hpp"

namespace tactile_net::report {
namespace {

std::string errors_in_words(const StaticErrors& errors) {
  std::vector<std::string> parts;
  const auto add = [&](const char* of, const InputErrors& one) {
    if (one.either_sign > 0.0)
      parts.push_back(std::string(of) + ' ' + percent(one.either_sign) +
                      " of the answer, of either sign by chance (" + percent(one.alike) +
                      " if all are alike)");
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

std::string proposal_in_words(const ScaleProposal& proposal) {
  std::string text = "a scale to take: volts = " + brief(proposal.volts) + " (as much as " +
                     bound_in_words(proposal.volts_by) + "), siemens = " + brief(proposal.siemens) +
                     (proposal.least_ohm     ? " (no resistor below 1 kilo-ohm)"
                      : proposal.noise > 0.0 ? " (resistors' noise as large as the op-amps')"
                                             : "");
  if (proposal.noise > 0.0) text += ": noise " + percent(proposal.noise);
  if (proposal.offset > 0.0)
    text += (proposal.noise > 0.0 ? ", " : ": ") + ("offset and bias " + percent(proposal.offset));
  return text + " of the answer";
}

/// "1.34 m/s", and a bare number where the scene states no units.
std::string speed(double value, const std::optional<Units>& units) {
  return units ? with_unit(value, "m/s") : brief(value) + " of the pitch's units a second";
}

}  // namespace

std::string bound_in_words(ScaleProposal::Bound bound) {
  switch (bound) {
    case ScaleProposal::Bound::swing:
      return "the rail leaves";
    case ScaleProposal::Bound::ten_volts:
      return "10 V at a node leave";
    case ScaleProposal::Bound::slew:
      return "slewing by a fifth of the settling time leaves";
  }
  return {};
}

std::vector<std::string> opamps_in_words(const Certificate& c) {
  std::vector<std::string> lines;
  if (c.slewing) lines.push_back(in_words(*c.slewing));
  if (c.dynamics && c.dynamics->unslewed_seconds)
    lines.push_back(c.dynamics->settling_seconds
                        ? "with its slew; without one it would settle in " +
                              duration(*c.dynamics->unslewed_seconds)
                        : "while it slews it does NOT come to rest; without slew it would in " +
                              duration(*c.dynamics->unslewed_seconds));
  if (c.errors) lines.push_back(errors_in_words(*c.errors));
  if (c.noise)
    lines.push_back("noise: " + brief(c.noise->largest) + " V rms at the noisiest output" +
                    (std::isfinite(c.noise->relative)
                         ? ", " + percent(c.noise->relative) + " of the answer"
                         : "") +
                    "; " + percent(c.noise->thermal) + " of its power is the resistors'");
  if (c.proposal) lines.push_back(proposal_in_words(*c.proposal));
  return lines;
}

std::string in_words(const lab::ContactMotion& motion, const std::optional<Units>& units) {
  return "moving contacts: the answer is " + duration(motion.delay) + " behind, " +
         percent(lab::ContactMotion::lag) + " of it at " + speed(motion.speed, units) +
         "; its slowest direction follows up to " + with_unit(motion.slowest_hertz, "Hz") +
         "; sampled and held at " + with_unit(lab::ContactMotion::sampling_hertz, "Hz") +
         " an answer is up to " + duration(1.0 / lab::ContactMotion::sampling_hertz) +
         " behind: " + percent(lab::ContactMotion::lag) + " at " +
         speed(motion.sampled_speed, units);
}

std::vector<std::string> facts_in_words(const lab::Certification& c) {
  std::vector<std::string> lines;
  if (c.motion)
    lines.push_back(
        in_words(*c.motion, std::visit([](const auto& scene) { return scene.units; }, c.scene())));
  return lines;
}

}  // namespace tactile_net::report
