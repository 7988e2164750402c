#include <algorithm>
#include <cmath>
#include <limits>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/answers.hpp"
#include "tactile_net/report/words/work_point_words.hpp"
#include "tactile_net/study/work_precision.hpp"

namespace tactile_net::report {
namespace {

/// The fastest that is within one percent of the exact solution.
const study::WorkPoint* fastest(const std::vector<study::WorkPoint>& points) {
  const study::Choice choice =
      study::choose(points, &study::WorkPoint::error_to_solution, study::TimeOf::frame,
                    {.accuracy = study::one_percent});
  return choice.point ? &points[*choice.point] : nullptr;
}

/// Of op-amps of 10 MHz; null: none was simulated.
const study::WorkPoint* fastest_circuit(const std::vector<study::WorkPoint>& points) {
  const study::WorkPoint* best = nullptr;
  for (const study::WorkPoint& point : points)
    if (point.settled_to_one_percent() && point.curve.bandwidth == study::compared_bandwidth &&
        (best == nullptr || point.seconds < best->seconds))
      best = &point;
  return best;
}

bool has_alpha(const study::StudyInput& input) {
  return input.with_scene([](const auto& scene) { return scene.reconstruct.alpha.has_value(); });
}

/// A frame by classes of the array that is asked for by its longer side.
const study::WorkPoint* frame_of(const std::vector<study::WorkPoint>& points, std::size_t side,
                                 Precision precision) {
  for (const study::WorkPoint& point : points)
    if (point.measured() && point.knob.kind == study::Knob::Kind::array &&
        std::max(point.knob.rows, point.knob.columns) == side &&
        point.curve.structure == Structure::reflections && point.curve.precision == precision)
      return &point;
  return nullptr;
}

}  // namespace

std::vector<Answer> answers(const study::Study& study) {
  const study::StudyInput& input = study.input;
  const std::vector<study::WorkPoint> points = study.points();
  std::vector<Answer> all;
  if (const study::WorkPoint* const point = fastest(points)) {
    all.push_back({duration(point->seconds) + " a frame",
                   in_words(*point) + ", within 1 % of the exact solution. Use tactile-net plan " +
                       shell_word(input.file()) + " --accuracy 1e-2 " +
                       (has_alpha(input) ? "" : "--readings FILE ") + "-o pad.plan"});
  } else {
    all.push_back({"none", "is within 1 % of the exact solution", true});
  }
  if (std::isfinite(input.solution_error))
    all.push_back({percent(input.solution_error) + " from the truth",
                   "is the exact solution itself: regularisation, sampling and noise, which no "
                   "arithmetic can change"});
  else
    all.push_back({"no contact",
                   "times and errors against the exact solution are valid; the readings say "
                   "nothing about a touch",
                   true});
  all.push_back(
      {percent(input.noise_floor),
       "is what noise moves the solution by: higher accuracy has no effect that can be seen"});
  const study::WorkPoint* const exact = frame_of(points, 32, Precision::float64);
  const study::WorkPoint* const single = frame_of(points, 32, Precision::float32);
  if (exact != nullptr && single != nullptr)
    all.push_back({duration(exact->seconds) + " at " + std::to_string(exact->knob.rows) + " x " +
                       std::to_string(exact->knob.columns),
                   "is an exact frame of as many such taxels, " + duration(single->seconds) +
                       " one in single precision; a loop of 1 kHz has 1 ms",
                   std::min(exact->seconds, single->seconds) > 1e-3});
  if (const study::WorkPoint* const circuit = fastest_circuit(points))
    all.push_back({duration(circuit->seconds) + " to settle",
                   "to 1 %: the fastest circuit, " +
                       std::string(name(*circuit->curve.realization)) + " with op-amps of 10 MHz"});
  return all;
}

}  // namespace tactile_net::report
