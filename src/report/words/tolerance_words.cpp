// What real parts do to a circuit, and which circuit bears them best.
#include <cmath>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/network_words.hpp"

namespace tactile_net::report {
namespace {

std::string error_in_words(double error) {
  return std::isfinite(error) ? percent(error) : "unstable";
}

}  // namespace

std::string kinds_of_errors(const ToleranceOptions& options) {
  std::vector<std::string> kinds;
  if (options.series)
    kinds.push_back("values of the series E" + std::to_string(static_cast<int>(*options.series)));
  if (options.relative)
    kinds.push_back((kinds.empty() ? "parts within " : "within ") + percent(*options.relative));
  if (const auto& reel = options.common.measured)
    kinds.push_back("parts of a reel of which " + std::to_string(reel->parts) + " were measured, " +
                    percent(reel->mean) + " off on average and spread by " + percent(reel->spread));
  if (options.common.reel) kinds.push_back("reels within " + percent(*options.common.reel));
  if (const auto& warm = options.common.temperature)
    kinds.push_back(brief(warm->kelvin) + " K either way with " + brief(1e6 * warm->coefficient) +
                    " ppm/K alike and " + brief(1e6 * warm->tracking) + " ppm/K apart");
  if (options.balance) kinds.push_back("complementary outputs within " + percent(*options.balance));
  if (options.stabiliser)
    kinds.push_back("the stabiliser's within " + percent(*options.stabiliser));
  if (options.bits) kinds.push_back("arrays of " + std::to_string(*options.bits) + " bits");
  if (options.cell_noise)
    kinds.push_back("cells off by " + percent(*options.cell_noise) + " of the largest");
  if (options.wire_resistance)
    kinds.push_back("lines of " + brief(*options.wire_resistance) + " ohm a segment");
  if (options.tare) kinds.push_back("read less their answer without readings");
  return join(kinds, ", ");
}

std::vector<std::string> in_words(const ToleranceOptions& options, const ToleranceResult& result) {
  std::vector<std::string> lines;
  const std::string drawn = kinds_of_errors(options);
  lines.push_back(std::to_string(result.trials) +
                  (result.trials == 1 ? " build of " : " builds of ") + drawn + ": " +
                  std::to_string(result.stable) + " stable, yield " + percent(result.yield()) +
                  " (within " + percent(options.accuracy) + " of the exact network); median " +
                  error_in_words(result.median) + ", 95 of 100 " +
                  (std::isfinite(result.p95) ? "within " : "") + error_in_words(result.p95) +
                  "; first order predicts " + percent(result.predicted));
  if (result.worst.empty()) return lines;
  std::vector<std::string> worst;
  for (const Contribution& one : result.worst)
    worst.push_back(one.component + " " + percent(one.share));
  lines.push_back("components that count most (share of the squared error): " + join(worst, ", "));
  return lines;
}

std::string stability_with_opamps_in_words(Stability stability) {
  return stability == Stability::not_modelled ? "not known" : "not with its op-amps";
}

std::vector<std::vector<std::string>> cells(const lab::Recommendation& recommendation) {
  std::vector<std::vector<std::string>> rows = {
      {"realisation", "op-amps", "stable", "median error", "95 of 100", "yield"}};
  for (const auto& one : recommendation.candidates)
    rows.push_back({circuit_in_words(one.realization, one.ladder), std::to_string(one.opamps),
                    one.stable() ? std::to_string(one.tolerance.stable) + " of " +
                                       std::to_string(one.tolerance.trials)
                                 : stability_with_opamps_in_words(one.stability.stability),
                    error_in_words(one.tolerance.median), error_in_words(one.tolerance.p95),
                    percent(one.tolerance.yield())});
  return rows;
}

std::string in_words(const lab::Recommendation& r) {
  using Outcome = lab::Recommendation::Outcome;
  if (r.outcome == Outcome::no_load)
    return "There is no load, so errors of components change nothing.";
  const bool arrays = r.drawn.bits || r.drawn.cell_noise || r.drawn.wire_resistance;
  std::string parts = arrays             ? kinds_of_errors(r.drawn)
                      : r.drawn.relative ? "parts of " + percent(*r.drawn.relative)
                      : !r.drawn.series  ? kinds_of_errors(r.drawn)
                                         : "parts of the series";
  if (r.inverters_replaced) parts += ", complementary outputs instead of the scene's inverters,";
  if (r.outcome == Outcome::none_stable)
    return "No realisation is known to be stable with these op-amps and capacitances: none is "
           "recommended. Raise siemens, or take op-amps with less input capacitance.";
  const std::string accuracy = percent(r.drawn.accuracy);
  const lab::Recommendation::Candidate& chosen = r.chosen();
  if (r.outcome == Outcome::reached)
    return "With " + parts + " and an accuracy of " + accuracy + ": " +
           circuit_in_words(chosen.realization, chosen.ladder) + ", the fewest amplifiers (" +
           std::to_string(chosen.opamps) + ") of those that reach it in 95 of 100 builds.";
  std::string text = "With " + parts + " no realisation is within " + accuracy +
                     " in 95 of 100 builds; " +
                     circuit_in_words(chosen.realization, chosen.ladder) + " comes closest" +
                     (std::isfinite(chosen.tolerance.p95)
                          ? " (95 of 100 within " + percent(chosen.tolerance.p95) + ")."
                          : ", and is not stable in 95 of 100 either.");
  if (r.parts_needed)
    text += " It would take parts of about " + percent(*r.parts_needed) + ", or a larger alpha.";
  return text;
}

std::vector<std::string> tolerance_in_words(const lab::Certification& c) {
  std::vector<std::string> lines = in_words(c.circuit.tolerance(), *c.tolerance);
  if (c.certificate().stability == Stability::unstable && c.tolerance->stable > 0)
    lines.push_back(
        "these builds assume infinitely fast op-amps; with the scene's own the circuit is "
        "unstable, by the certificate's poles");
  if (c.certificate().stability == Stability::not_modelled)
    lines.push_back(
        "these builds assume infinitely fast op-amps; whether the circuit is stable with the "
        "scene's own is not known");
  return lines;
}

}  // namespace tactile_net::report
