#include "tactile_net/report/words/tradeoff_words.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"
#include "tactile_net/report/words/work_point_words.hpp"

namespace tactile_net::report {
namespace {

/// "310 kHz", "2.1 GHz".
std::string frequency(double hertz) {
  if (hertz >= 1e9) return brief(hertz / 1e9) + " GHz";
  if (hertz >= 1e6) return brief(hertz / 1e6) + " MHz";
  if (hertz >= 1e3) return brief(hertz / 1e3) + " kHz";
  return brief(hertz) + " Hz";
}

std::string timed(const study::WorkPoint& point) {
  return in_words(point) + ": " + duration(point.seconds) + ", error " +
         brief(*point.error_to_solution);
}

std::string demand_in_words(const study::Requirement& requirement) {
  std::string text = "for ";
  if (requirement.accuracy)
    text += (*requirement.accuracy >= 1e-3 ? percent(*requirement.accuracy)
                                           : brief(*requirement.accuracy)) +
            " error";
  if (requirement.accuracy && requirement.deadline) text += " within ";
  if (requirement.deadline) text += duration(*requirement.deadline);
  return text;
}

/// A factor, without an exponent up to a million: "4000", "9.12", "2.1e+07".
std::string factor_in_words(double factor) {
  if (factor < 1e3 || factor >= 1e6) return brief(factor);
  const double step = factor < 1e4 ? 100.0 : factor < 1e5 ? 1e3 : 1e4;
  return shortest(step * std::round(factor / step));
}

/// A circuit of op-amps of 10 MHz, from a step of its inputs to 1 %.
struct SettledCircuit {
  Realization realization;
  double seconds;
  std::optional<std::size_t> tractions{};  ///< of cells wider than the study's own
  std::optional<double> parts{};  ///< error that parts of 1 % leave (median); infinite: unstable
};

std::vector<SettledCircuit> settled_circuits(const study::Study& study,
                                             const std::vector<study::WorkPoint>& points) {
  std::vector<SettledCircuit> circuits;
  for (const study::WorkPoint& point : points) {
    if (!point.settled_to_one_percent()) continue;
    if (point.curve.bandwidth != study::compared_bandwidth) continue;  // the others are the same
    SettledCircuit circuit{*point.curve.realization, point.seconds, point.curve.tractions};
    for (const study::StudySection& section : study.sections)
      for (const study::PartsFloor& floor : section.floors)
        if (floor.relative == study::one_percent && floor.realization == circuit.realization)
          circuit.parts = floor.median.value_or(std::numeric_limits<double>::infinity());
    circuits.push_back(std::move(circuit));
  }
  std::stable_sort(circuits.begin(), circuits.end(),
                   [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  return circuits;
}

std::string parts_in_words(const SettledCircuit& circuit) {
  if (!circuit.parts) return "-";
  return std::isfinite(*circuit.parts) ? percent(*circuit.parts) : "unstable";
}

/// The fastest circuit, and the one that bears its parts best.
void add_circuits(std::vector<std::string>& text, const study::Study& study,
                  const std::vector<study::WorkPoint>& points) {
  const std::vector<SettledCircuit> circuits = settled_circuits(study, points);
  if (circuits.empty()) return;
  const SettledCircuit& fastest = circuits.front();
  std::string sentence = "the fastest circuit, " + std::string(name(fastest.realization)) +
                         (fastest.tractions ? " on " + std::to_string(*fastest.tractions) +
                                                  " tractions, one cell a taxel,"
                                            : std::string()) +
                         " with op-amps of 10 MHz, settles to 1 % in " + duration(fastest.seconds);
  if (const auto frame = study::fastest_frame(points)) {
    if (study.clock > 0.0)
      sentence +=
          ": faster than a controller that needs as many cycles as this machine and has a clock "
          "below " +
          frequency(study.clock * *frame / fastest.seconds);
    sentence += "; it beats this machine's " + duration(*frame) + " from a bandwidth of " +
                frequency(study::compared_bandwidth * fastest.seconds / *frame) + " on";
  }
  text.push_back(std::move(sentence));
  const auto least =
      std::min_element(circuits.begin(), circuits.end(), [](const auto& a, const auto& b) {
        return a.parts.value_or(HUGE_VAL) < b.parts.value_or(HUGE_VAL);
      });
  if (least->parts && std::isfinite(*least->parts)) {
    std::string errors = parts_in_words(*least) + " (median) with parts of 1 %";
    if (least->realization != fastest.realization)
      errors += "; " + std::string(name(fastest.realization)) +
                " with such parts: " + parts_in_words(fastest);
    text.push_back("the most accurate circuit, " + std::string(name(least->realization)) +
                   ", errs by " + errors);
  }
}

}  // namespace

std::string answer(const study::Study& study, const study::Requirement& requirement) {
  const std::vector<study::WorkPoint> points = study.points();
  const study::Choice choice =
      study::choose(points, study::to_solution, study::TimeOf::frame, requirement);
  std::string text = demand_in_words(requirement) + ": ";
  if (choice.point) {
    const study::WorkPoint& point = points[*choice.point];
    text += timed(point);
    std::vector<std::string> margins;
    if (requirement.deadline)
      margins.push_back(factor_in_words(*requirement.deadline / point.seconds) +
                        " times inside the deadline");
    if (requirement.accuracy)
      margins.push_back(factor_in_words(*requirement.accuracy / *point.error_to_solution) +
                        " times inside the error");
    return margins.empty() ? text : text + " (" + join(margins, ", ") + ")";
  }
  if (std::none_of(points.begin(), points.end(), [](const study::WorkPoint& point) {
        return point.measured() && point.time_of == study::TimeOf::frame;
      }))
    return text + "nothing is measured yet";
  text += requirement.accuracy && requirement.deadline ? "none meets both" : "none";
  if (choice.fastest)
    text += "; accurate enough, and fastest of those: " + timed(points[*choice.fastest]);
  else
    text += "; none is that accurate";
  if (choice.most_accurate)
    text += "; in time, and most accurate of those: " + timed(points[*choice.most_accurate]);
  else if (requirement.deadline)
    text += "; none is that fast";
  return text;
}

std::vector<std::string> in_words(const study::Study& study) {
  const study::StudyInput& input = study.input;
  const std::vector<study::WorkPoint> points = study.points();
  std::vector<std::string> text;
  for (const study::Requirement& requirement :
       {study::Requirement{.accuracy = study::one_percent, .deadline = 1e-3},
        study::Requirement{.accuracy = 1e-6, .deadline = 1e-4},
        study::Requirement{.accuracy = 1e-12}})
    text.push_back(answer(study, requirement));
  if (std::isfinite(input.solution_error))
    text.push_back("regularisation, sampling and the scene's own noise leave the exact solution " +
                   percent(input.solution_error) +
                   " away from the truth: no arithmetic can change that");
  else
    text.push_back(
        "the scene has no contact: its readings are noise, alpha too if a rule chose it; times and "
        "the errors against the exact solution are valid, the rest says nothing about a touch");
  if (input.constraints())
    text.push_back(
        "the exact solution is that without the scene's constraints; with them: the curve " +
        in_words(study::WorkCurve{.family = input.is_skin()
                                                ? study::WorkCurve::Family::friction_cone
                                                : study::WorkCurve::Family::active_set}));
  const Dimension dimension =
      input.with_scene([](const auto& scene) { return residual_dimension(scene); });
  text.push_back("noise of " + in_unit(input.units(), dimension, input.noise_rms) +
                 (input.noise_stated ? " per weighted reading (the scene's)"
                                     : " per reading (1 % of the largest, an assumption)") +
                 " moves the solution by " + percent(input.noise_floor) +
                 ": higher accuracy has no effect that can be seen");
  for (std::string& sentence : sizes_in_words(study)) text.push_back(std::move(sentence));
  add_circuits(text, study, points);
  if (std::string sentence = moving_in_words(study); !sentence.empty())
    text.push_back(std::move(sentence));
  return text;
}

std::vector<std::vector<std::string>> circuit_cells(const study::Study& study) {
  const std::vector<study::WorkPoint> points = study.points();
  const std::optional<double> frame = study::fastest_frame(points);
  std::vector<std::vector<std::string>> rows = {{"circuit", "settles to 1 %", "beats a clock below",
                                                 "beats this machine from", "parts of 1 % leave"}};
  for (const SettledCircuit& circuit : settled_circuits(study, points))
    rows.push_back(
        {std::string(name(circuit.realization)), duration(circuit.seconds),
         frame && study.clock > 0.0 ? frequency(study.clock * *frame / circuit.seconds) : "-",
         frame ? frequency(study::compared_bandwidth * circuit.seconds / *frame) : "-",
         parts_in_words(circuit)});
  return rows;
}

std::vector<std::vector<std::string>> front_cells(const study::Study& study) {
  const std::vector<study::WorkPoint> points = study.points();
  std::vector<std::vector<std::string>> rows = {
      {"method", "time of a frame", "quartiles", "error to exact solution", "error to truth"}};
  const auto or_dash = [](const std::optional<double>& value) {
    return value ? brief(*value) : std::string("-");
  };
  for (const std::size_t i :
       study::pareto_front(points, study::to_solution, study::TimeOf::frame)) {
    const study::WorkPoint& point = points[i];
    rows.push_back({in_words(point), duration(point.seconds),
                    duration(point.seconds_low) + " ... " + duration(point.seconds_high),
                    or_dash(point.error_to_solution), or_dash(point.error_to_truth)});
  }
  return rows;
}

std::vector<std::string> failures_in_words(const study::Study& study) {
  std::vector<std::string> text;
  for (const study::WorkPoint& point : study.points())
    if (!point.measured()) text.push_back(in_words(point) + ": " + in_words(*point.failure));
  return text;
}

}  // namespace tactile_net::report
