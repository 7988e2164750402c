#include <cmath>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/answers.hpp"
#include "tactile_net/report/words/network_words.hpp"

namespace tactile_net::report {
namespace {

Answer stability(const lab::Certification& c) {
  const Certificate& certificate = c.certificate();
  const std::string circuit = circuit_in_words(certificate.realization, certificate.ladder);
  switch (certificate.stability) {
    case Stability::stable:
      if (c.tolerance && 2 * c.tolerance->stable <= c.tolerance->trials)
        return {"stable",
                circuit + ", with exact parts; of " + std::to_string(c.tolerance->trials) +
                    " builds with real ones " + std::to_string(c.tolerance->stable) + " are",
                true};
      return {"stable",
              certificate.theorem.holds()
                  ? circuit + ", proven by theorem " + std::string(certificate.theorem.name)
                  : circuit + ", by its poles; no theorem speaks of it"};
    case Stability::unstable:
      return {"unstable", circuit + ": it runs away from the answer", true};
    case Stability::not_definite:
      return {"no circuit",
              "P is not positive definite: no circuit of ideal op-amps settles for it", true};
    case Stability::lossless:
      return {"rings", circuit + ", lossless: it has its answer at one frequency alone"};
    case Stability::not_modelled:
      return {"not known", circuit + ": " + unknown_in_words(certificate), true};
  }
  return {};
}

Answer settling(const Certificate& certificate) {
  const auto& dynamics = certificate.dynamics;
  if (!dynamics || dynamics->settling_seconds.value_or(-1.0) == 0.0)
    return {"settling not known",
            "the scene states no bandwidth and no capacitance, or the circuit has too many states"};
  if (!dynamics->settling_seconds) return {"never", "comes to rest", true};
  return {duration(*dynamics->settling_seconds),
          "to settle within " + percent(certificate.accuracy) + " after a step of all inputs"};
}

Answer cost(const Certificate& certificate) {
  const ElementCounts& elements = certificate.elements;
  Answer answer{.meaning = elements_in_words(elements)};
  answer.value = elements.opamps > 0 ? std::to_string(elements.opamps) + " op-amps"
                                     : std::to_string(elements.resistors) + " resistors";
  if (certificate.largest_voltage > 0.0) {
    answer.meaning += "; at most " + brief(certificate.largest_voltage) + " V, " +
                      (certificate.power < 1.0 ? brief(1e3 * certificate.power) + " mW"
                                               : brief(certificate.power) + " W") +
                      " in the resistors";
    answer.doubtful = certificate.largest_voltage > 100.0;
  }
  return answer;
}

}  // namespace

std::vector<Answer> answers(const lab::Certification& c) {
  std::vector<Answer> all = {stability(c), settling(c.certificate()), cost(c.certificate())};
  const lab::Recommendation& r = c.recommendation;
  using Outcome = lab::Recommendation::Outcome;
  const std::string chosen =
      r.choice ? circuit_in_words(r.chosen().realization, r.chosen().ladder) : "";
  if (c.tolerance) {
    const bool other = r.choice && (r.chosen().realization != c.circuit.options().realization ||
                                    r.chosen().ladder != c.certificate().ladder);
    all.push_back({percent(c.tolerance->yield()) + " yield",
                   "builds with real parts within " + percent(c.circuit.tolerance().accuracy) +
                       " of the exact network" +
                       (other ? "; " + chosen + " is less sensitive to its parts" : ""),
                   c.tolerance->yield() < 0.5});
  } else if (r.outcome == Outcome::reached) {
    all.push_back({"build " + chosen, "the fewest amplifiers (" +
                                          std::to_string(r.chosen().opamps) + ") within " +
                                          percent(r.drawn.accuracy) + " in 95 of 100 builds"});
  } else if (r.outcome == Outcome::none_reaches) {
    all.push_back({"none reaches " + percent(r.drawn.accuracy),
                   "with such parts; " + chosen + " comes closest", true});
  } else if (r.outcome == Outcome::none_stable) {
    all.push_back({"none is stable", "with the scene's op-amps: none is recommended", true});
  }
  return all;
}

}  // namespace tactile_net::report
