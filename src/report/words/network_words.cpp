#include "tactile_net/report/words/network_words.hpp"

#include <algorithm>
#include <cmath>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/scene_words.hpp"

namespace tactile_net::report {
namespace {

std::string percent(double share) { return brief(100.0 * share) + " %"; }

std::string error_in_words(double error) {
  return std::isfinite(error) ? percent(error) : "unstable";
}

std::string stability_in_words(const Certificate& c) {
  switch (c.stability) {
    case Stability::stable:
      return "stable";
    case Stability::unstable:
      return "UNSTABLE";
    case Stability::not_definite:
      return "P IS NOT POSITIVE DEFINITE: no circuit for it settles";
    case Stability::lossless:
      return "lossless: it rings for ever, and has its answer at one frequency alone";
    case Stability::not_modelled:
      return "not known: the op-amps have no bandwidth, and no theorem's conditions are met";
  }
  return {};
}

std::string dynamics_in_words(const Certificate& c) {
  const Dynamics& d = *c.dynamics;
  std::string text = std::to_string(d.states) + " states, " +
                     (d.slowest < 0.0 ? "slowest pole at " : "a pole that does not decay at ") +
                     brief(d.slowest) + " 1/s";
  if (d.slowest < 0.0)
    text += d.damping >= 0.999999 ? ", none rings" : ", least damping " + brief(d.damping);
  if (d.settling_seconds.value_or(0.0) > 0.0)
    text += "; settles within " + brief(c.accuracy) + " in " + duration(*d.settling_seconds);
  return text;
}

std::string judged_in_words(const lab::Relaxation& relaxation) {
  const Judged& j = *relaxation.judged;
  const auto& dynamics = relaxation.certificate->dynamics;
  const std::string simulated = duration(j.simulated) + " simulated in " + duration(j.seconds);
  if (j.judgement == Judgement::settles) {
    std::string text = "ngspice's transient settles in " + duration(*j.settling_seconds);
    if (dynamics->settling_seconds)
      text += ", the certificate says " + duration(*dynamics->settling_seconds) + " (" +
              percent(std::abs(*j.settling_seconds / *dynamics->settling_seconds - 1.0)) +
              " apart)";
    return text + "; " + simulated;
  }
  if (j.judgement == Judgement::grows) {
    std::string text = "ngspice's transient GROWS";
    if (j.growth > 0.0) text += " at " + brief(j.growth) + " 1/s";
    if (dynamics->slowest > 0.0)
      text += ", the certificate's pole is at " + brief(dynamics->slowest) + " 1/s";
    if (dynamics->rings) text += " (a ringing pair)";
    if (!dynamics->rings && j.mode.size() == dynamics->mode.size() && !j.mode.empty()) {
      double overlap = 0.0;
      std::size_t largest = 0;
      for (std::size_t i = 0; i < j.mode.size(); ++i) {
        overlap += j.mode[i] * dynamics->mode[i];
        if (std::abs(j.mode[i]) > std::abs(j.mode[largest])) largest = i;
      }
      text += "; the growing mode is largest at n" + std::to_string(largest) +
              ", overlap with the certificate's " + brief(std::abs(overlap));
    }
    return text + "; " + simulated;
  }
  if (j.judgement == Judgement::unfinished)
    return "ngspice's transient did not end within the time limit: not judged; raise --time-limit";
  return "ngspice's transient has NOT SETTLED after " + duration(j.simulated);
}

}  // namespace

std::string elements_in_words(const ElementCounts& elements) {
  std::vector<std::string> parts;
  const auto add = [&](std::size_t count, const std::string& kind) {
    if (count > 1) parts.push_back(std::to_string(count) + ' ' + kind + 's');
    if (count == 1) parts.push_back("1 " + kind);
  };
  add(elements.resistors, "resistor");
  if (elements.negative_resistors > 0)
    parts.back() += " (" + std::to_string(elements.negative_resistors) + " negative)";
  add(elements.opamps, "op-amp");
  add(elements.capacitors, "capacitor");
  add(elements.inductors, "inductor");
  add(elements.devices, "N-shaped device");
  add(elements.sources, "source");
  return join(parts, ", ");
}

std::vector<std::string> in_words(const Certificate& c) {
  std::vector<std::string> lines;
  lines.push_back(std::string(name(c.realization)) + ": " + stability_in_words(c));
  lines.push_back("theorem " + std::string(c.theorem.name) + ": " +
                  std::string(c.theorem.statement) +
                  (c.theorem.holds ? " Its conditions hold."
                                   : " It does NOT apply here: " + c.theorem.condition + "."));
  lines.push_back("P: smallest eigenvalue " + brief(c.smallest_eigenvalue) + ", condition number " +
                  brief(c.condition));
  if (c.dynamics) lines.push_back(dynamics_in_words(c));
  if (c.tolerance_margin)
    lines.push_back("stable for every error of components up to " + percent(*c.tolerance_margin) +
                    (c.margin_for_any_bandwidth ? ", whatever the bandwidths"
                                                : ", if the op-amps are fast against the network"));
  std::string parts = elements_in_words(c.elements);
  if (c.greatest_ohm > 0.0)
    parts += "; resistors from " + brief(c.least_ohm) + " to " + brief(c.greatest_ohm) + " ohm";
  lines.push_back(parts);
  if (c.largest_voltage > 0.0)
    lines.push_back("largest voltage at rest " + brief(c.largest_voltage) + " V; " +
                    (c.power < 1.0 ? brief(1e3 * c.power) + " mW" : brief(c.power) + " W") +
                    " in the resistors");
  for (const std::string& warning : c.warnings) lines.push_back("warning: " + warning);
  return lines;
}

std::vector<std::string> in_words(const ToleranceOptions& options, const ToleranceResult& result) {
  std::vector<std::string> lines;
  std::string drawn;
  if (options.series)
    drawn = "values of the series E" + std::to_string(static_cast<int>(*options.series));
  if (options.relative)
    drawn += (drawn.empty() ? "parts within " : ", within ") + percent(*options.relative);
  lines.push_back(std::to_string(result.trials) +
                  (result.trials == 1 ? " build of " : " builds of ") + drawn + ": " +
                  std::to_string(result.stable) + " stable, yield " + percent(result.yield()) +
                  " (within " + percent(options.accuracy) + " of the exact network); median " +
                  error_in_words(result.median) + ", 95 of 100 " +
                  (std::isfinite(result.p95) ? "within " : "") + error_in_words(result.p95) +
                  "; first order predicts " + percent(result.predicted));
  std::vector<std::string> worst;
  for (const Contribution& one : result.worst)
    worst.push_back(one.component + " " + percent(one.share));
  lines.push_back("components that count most (share of the squared error): " + join(worst, ", "));
  return lines;
}

std::vector<std::string> in_words(const lab::Relaxation& relaxation) {
  std::vector<std::string> lines;
  lines.push_back("ngspice against the direct solve of P f = b: " + brief(relaxation.difference) +
                  (!relaxation.agrees()    ? " (DIFFERS"
                   : relaxation.resolved() ? " (agrees"
                                           : " (NOT RESOLVED") +
                  (relaxation.predicted
                       ? "; the op-amps' gain and offset explain " + brief(*relaxation.predicted)
                       : "") +
                  (relaxation.curves > 0.0
                       ? "; the devices' curves explain up to " + brief(relaxation.curves)
                       : "") +
                  "; rounding explains up to " + brief(relaxation.limit) + ")");
  if (relaxation.certificate) {
    for (const std::string& line : in_words(*relaxation.certificate)) lines.push_back(line);
  } else {
    const std::string settles = relaxation.realization == Realization::lc
                                    ? " > 0; lossless: it rings for ever, and never settles"
                                    : " > 0: settles with capacitance at its nodes";
    lines.push_back("smallest eigenvalue of P: " + brief(relaxation.smallest_eigenvalue) +
                    (relaxation.stable ? settles : ": NOT positive definite, would not settle"));
  }
  if (relaxation.judged) lines.push_back(judged_in_words(relaxation));
  if (relaxation.tolerance) {
    const lab::ToleranceStudy& study = *relaxation.tolerance;
    for (const std::string& line : in_words(study.options, study.result)) lines.push_back(line);
    lines.push_back(std::to_string(study.replayed) +
                    " of these draws in ngspice: voltages agree to " + brief(study.difference));
  }
  for (const std::string& warning : relaxation.warnings)
    if (!relaxation.certificate ||
        std::find(relaxation.certificate->warnings.begin(), relaxation.certificate->warnings.end(),
                  warning) == relaxation.certificate->warnings.end())
      lines.push_back("warning: " + warning);
  lines.push_back("ngspice took " + duration(relaxation.ngspice_seconds) +
                  " for the operating point");
  return lines;
}

std::vector<std::vector<std::string>> cells(const lab::Recommendation& recommendation) {
  std::vector<std::vector<std::string>> rows = {
      {"realisation", "op-amps", "stable", "median error", "95 of 100", "yield"}};
  for (const auto& one : recommendation.candidates)
    rows.push_back(
        {std::string(name(one.realization)), std::to_string(one.opamps),
         std::to_string(one.tolerance.stable) + " of " + std::to_string(one.tolerance.trials),
         error_in_words(one.tolerance.median), error_in_words(one.tolerance.p95),
         percent(one.tolerance.yield())});
  return rows;
}

}  // namespace tactile_net::report
