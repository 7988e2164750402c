#include <algorithm>
#include <cmath>
#include <cstdio>

#include "study.hpp"
#include "text.hpp"

namespace tactile_net::tool {
namespace {

constexpr ErrorOf to_solution = &WorkPoint::error_to_solution;
constexpr double percent = 0.01;  // the accuracy at which circuits are compared

std::string in_percent(double share) { return brief(100.0 * share) + " %"; }

/// "310 kHz", "2.1 GHz".
std::string frequency(double hertz) {
  if (hertz >= 1e9) return brief(hertz / 1e9) + " GHz";
  if (hertz >= 1e6) return brief(hertz / 1e6) + " MHz";
  if (hertz >= 1e3) return brief(hertz / 1e3) + " kHz";
  return brief(hertz) + " Hz";
}

std::string timed(const WorkPoint& point) {
  return in_words(point) + ": " + duration(point.seconds) + ", error " +
         brief(*point.error_to_solution);
}

std::string demand_in_words(const Requirement& requirement) {
  std::string text = "for ";
  if (requirement.accuracy)
    text += (*requirement.accuracy >= 1e-3 ? in_percent(*requirement.accuracy)
                                           : brief(*requirement.accuracy)) +
            " error";
  if (requirement.accuracy && requirement.deadline) text += " within ";
  if (requirement.deadline) text += duration(*requirement.deadline);
  return text;
}

void add_circuits(std::vector<std::string>& text, const Study& study,
                  const std::vector<WorkPoint>& points) {
  const Choice digital = choose(points, to_solution, TimeOf::frame, {.accuracy = percent});
  if (!digital.point) return;
  const double frame = points[*digital.point].seconds;
  for (const WorkPoint& point : points) {
    if (point.time_of != TimeOf::settling || !point.measured() ||
        point.error_to_solution != percent)
      continue;
    const auto comma = point.curve.find(", 10 MHz");
    if (comma == std::string::npos) continue;  // others are the same, scaled
    const std::string circuit = point.curve.substr(0, comma);
    std::string sentence =
        circuit + " with op-amps of 10 MHz settles to 1 % in " + duration(point.seconds) + "; ";
    if (study.clock > 0.0)
      sentence +=
          "a controller that needs as many cycles as this machine is slower below a clock of " +
          frequency(study.clock * frame / point.seconds) + ", and ";
    sentence += "this machine's " + duration(frame) + " is beaten from a bandwidth of " +
                frequency(10e6 * point.seconds / frame) + " on";
    text.push_back(std::move(sentence));
  }
  std::string floors;
  for (const StudySection& section : study.sections)
    for (const PartsFloor& floor : section.floors)
      if (floor.relative == percent)
        floors += (floors.empty() ? "" : ", ") + floor.realization + ' ' +
                  (floor.median ? in_percent(*floor.median) : "unstable");
  if (!floors.empty())
    text.push_back("with parts of 1 % no circuit comes closer than its parts let it (median): " +
                   floors);
}

}  // namespace

std::string answer(const Study& study, const Requirement& requirement) {
  const std::vector<WorkPoint> points = study.points();
  const Choice choice = choose(points, to_solution, TimeOf::frame, requirement);
  std::string text = demand_in_words(requirement) + ": ";
  if (choice.point) {
    const WorkPoint& point = points[*choice.point];
    text += timed(point);
    std::vector<std::string> margins;
    if (requirement.deadline)
      margins.push_back(brief(*requirement.deadline / point.seconds) +
                        " times inside the deadline");
    if (requirement.accuracy)
      margins.push_back(brief(*requirement.accuracy / *point.error_to_solution) +
                        " times inside the error");
    return margins.empty() ? text : text + " (" + join(margins, ", ") + ")";
  }
  text += "none meets both";
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

std::vector<std::string> in_words(const Study& study) {
  const StudyInput& input = study.input;
  const std::vector<WorkPoint> points = study.points();
  std::vector<std::string> text;
  for (const Requirement& requirement :
       {Requirement{.accuracy = percent, .deadline = 1e-3},
        Requirement{.accuracy = 1e-6, .deadline = 1e-4}, Requirement{.accuracy = 1e-12}})
    text.push_back(answer(study, requirement));
  if (std::isfinite(input.solution_error))
    text.push_back("regularisation, sampling and the scene's own noise leave the exact solution " +
                   in_percent(input.solution_error) +
                   " from the truth: no arithmetic takes that back");
  text.push_back("noise of " + brief(input.noise_rms) +
                 (input.noise_stated ? " per weighted reading (the scene's)"
                                     : " per reading (1 % of the largest, an assumption)") +
                 " moves the solution by " + in_percent(input.noise_floor) +
                 ": more accuracy than that cannot be seen");
  add_circuits(text, study, points);
  return text;
}

}  // namespace tactile_net::tool
