#include <utility>
#include <vector>

#include "study/digital.hpp"
#include "study/planned_frame.hpp"
#include "study/points.hpp"

namespace tactile_net::study {
namespace {

/// Adds the product that these options plan; equal ranks would be the same point again.
void add_product(StudySection& section, const StudyInput& input, const PlannerOptions& options,
                 const lab::Clock& clock) {
  const WorkCurve curve{.family = WorkCurve::Family::product,
                        .structure = options.structure,
                        .precision = options.precision};
  attempt(section, curve, {}, [&] {
    const PlannedEstimator planned = plan_of(input, options);
    const auto [f, seconds] = timed_frame(planned.plan, input.readings, clock);
    Knob knob{.ranks = planned.candidates.front().ranks};
    if (!knob.ranks.empty()) knob.kind = Knob::Kind::ranks;
    return point(input, curve, std::move(knob), f, seconds);
  });
  auto& points = section.points;
  const auto same = [](const WorkPoint& a, const WorkPoint& b) {
    return a.measured() && b.measured() && a.curve == b.curve && a.knob == b.knob;
  };
  if (points.size() >= 2 && same(points.back(), points[points.size() - 2])) points.pop_back();
}

/// The structures that an array has, and how finely accuracies are gone through.
struct Structures {
  bool reflections = false;
  bool fft = false;
  double step = 0.2;
};

Structures structures_of(const StudyInput& input) {
  Structures structures{.fft = !input.is_skin()};
  structures.reflections =
      input.with_scene([](const auto& scene) { return is_even(scene.sensor); });
  if (input.is_skin()) structures.step = 0.1;  // each takes a decomposition of every class
  return structures;
}

}  // namespace

StudySection products(const StudyInput& input, const lab::Clock& clock) {
  StudySection section;
  const Structures structures = structures_of(input);
  const auto add = [&](Structure structure, Precision precision, double accuracy) {
    PlannerOptions options;
    options.accuracy = accuracy;
    options.structure = structure;
    options.precision = precision;
    add_product(section, input, options, clock);
  };
  for (const Precision precision : {Precision::float64, Precision::float32}) {
    add(Structure::dense, precision, PlannerOptions{}.accuracy);
    if (structures.reflections) add(Structure::reflections, precision, PlannerOptions{}.accuracy);
    for (double accuracy = 0.3; accuracy > 1e-13; accuracy *= structures.step) {
      if (precision == Precision::float32 && accuracy < 1e-7) break;
      add(structures.reflections ? Structure::reflections_low_rank : Structure::low_rank, precision,
          accuracy);
    }
  }
  if (!structures.fft) return section;
  for (double accuracy = 0.3; accuracy > 1e-13; accuracy *= 0.1) {
    add(Structure::fft, Precision::float64, accuracy);
    if (!section.points.back().measured()) break;
  }
  return section;
}

}  // namespace tactile_net::study
