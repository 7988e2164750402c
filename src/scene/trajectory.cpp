#include <optional>
#include <vector>

#include "scene/sections.hpp"

namespace tactile_net {

PiecewiseLinear read_trajectory(const Value& trajectory, bool timed) {
  PiecewiseLinear result;
  if (!timed)
    trajectory.problem("changes over time, and this scene has none",
                       "add [time], or give one change = 10.0");
  auto knots = trajectory.tables();
  if (knots && knots->empty())
    trajectory.problem("must hold at least one knot", "trajectory = [{ t = 0.0, change = 0.0 }]");
  for (Table& knot : knots.value_or(std::vector<Table>{})) {
    const auto t = knot.required("t", "when, in seconds from the first frame: t = 0.5");
    const auto change = knot.required("change", "in kelvin: change = 10.0");
    const double time = t ? t->number(not_negative, in_seconds).value_or(0.0) : 0.0;
    if (t && !result.times.empty() && time <= result.times.back())
      t->misfit("must be later than the knot before");
    result.times.push_back(time);
    result.values.push_back(change ? change->number(any_number, in_kelvin).value_or(0.0) : 0.0);
    knot.finish();
  }
  return result;
}

}  // namespace tactile_net
