#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "study/digital.hpp"
#include "study/points.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/sensing/spectral.hpp"

namespace tactile_net::study {

StudySection forward_models(const StudyInput& input, const lab::Clock& clock) {
  StudySection section;
  const Scene& scene = input.line().scene();
  if (scene.contacts.empty()) return section;
  const std::vector<double> exact = exact_readings(scene.sensor, scene.material, scene.contacts,
                                                   {.points = 61, .error_limit = 1e-9});
  const auto add = [&](WorkCurve::Family family, const Knob& knob, const auto& forward) {
    const WorkCurve curve{.family = family};
    attempt(section, curve, knob, [&] {
      std::vector<double> g;
      const lab::Seconds seconds = lab::time_of([&] { g = forward(); }, 0.03, clock);
      WorkPoint result;
      result.curve = curve;
      result.knob = knob;
      result.time_of = TimeOf::forward;
      result.seconds = seconds.median;
      result.seconds_low = seconds.low;
      result.seconds_high = seconds.high;
      result.error_to_truth = relative_l2_error(g, exact);
      return result;
    });
  };
  using Family = WorkCurve::Family;
  constexpr double any = std::numeric_limits<double>::infinity();
  for (const int points : {15, 21, 31, 41, 51})
    add(Family::integral,
        {.kind = Knob::Kind::panel_points, .count = static_cast<std::size_t>(points)}, [&] {
          return exact_readings(scene.sensor, scene.material, scene.contacts,
                                {.points = points, .halvings = 0, .error_limit = any});
        });
  add(Family::integral, {.kind = Knob::Kind::halved_panels}, [&] {
    return exact_readings(scene.sensor, scene.material, scene.contacts, {.error_limit = any});
  });
  add(Family::discrete_sum, {}, [&] {
    return fast_sampled_readings(scene.sensor, scene.material,
                                 sample(scene.contacts, scene.sensor));
  });
  return section;
}

}  // namespace tactile_net::study
