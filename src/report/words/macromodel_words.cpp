#include "tactile_net/report/words/macromodel_words.hpp"

#include <ostream>

#include "numeric/named.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::report {

std::vector<std::string> in_words(const lab::MacromodelComparison& comparison) {
  using lab::MacromodelVerdict;
  const Dynamics& said = *comparison.certificate.dynamics;
  const Transient& seen = comparison.transient;
  const std::string certified =
      said.slowest < 0.0 && said.settling_seconds
          ? "the certificate says " + duration(*said.settling_seconds)
          : "the certificate has a pole at " + brief(said.slowest) + " 1/s";
  const std::string model =
      seen.settling_seconds
          ? "with " + comparison.macromodel + " it settles in " + duration(*seen.settling_seconds)
          : "with " + comparison.macromodel + " it does not settle";
  std::string verdict;
  switch (comparison.verdict()) {
    case MacromodelVerdict::as_certified:
      verdict = "as certified: ";
      break;
    case MacromodelVerdict::settles_otherwise:
      verdict = "SETTLES OTHERWISE: ";
      break;
    case MacromodelVerdict::does_not_settle:
      verdict = "DOES NOT SETTLE, though certified: ";
      break;
    case MacromodelVerdict::settles_uncertified:
      verdict = "SETTLES, though not certified: ";
      break;
    case MacromodelVerdict::answers_otherwise:
      verdict = "ANSWERS OTHERWISE at rest: are its pins as mapped, its supply enough? ";
      break;
    case MacromodelVerdict::not_known:
      verdict = "NOT KNOWN: ";
      break;
  }
  return {verdict + model + ", " + certified + " (within " +
              brief(comparison.certificate.accuracy) + ")",
          "at rest it is " + brief(comparison.difference) +
              " off the direct solve, its own offset and gain included",
          duration(seen.simulated) + " simulated in " + duration(seen.seconds)};
}

void print_macromodel(std::ostream& out, const lab::MacromodelComparison& comparison) {
  out << "macromodel " << comparison.macromodel << '\n';
  for (const std::string& line : in_words(comparison)) out << "  " << line << '\n';
}

}  // namespace tactile_net::report
