/// @file
/// Where a fit begins.
#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "calibration/fit_problem.hpp"

namespace tactile_net {

std::optional<FitProblem::Place> FitProblem::seen_middle(std::size_t press) const {
  const std::size_t n = model_.sites().size();
  std::vector<double> size(n);
  for (std::size_t j = 0; j < n; ++j)
    if (used_[j])
      size[j] = std::abs(log_.presses[press].readings[j] - log_.unloaded.mean[j]) / noise_[j];
  const double most = *std::max_element(size.begin(), size.end());
  double sum = 0.0;
  Place moment;
  for (std::size_t j = 0; j < n; ++j)
    if (size[j] > 0.3 * most) {
      sum += size[j];
      moment.y += size[j] * model_.sites()[j].y;
      moment.z += size[j] * model_.sites()[j].z;
    }
  if (!(sum > 0.0)) return std::nullopt;
  return Place{moment.y / sum, moment.z / sum};
}

FitState FitProblem::start(double depth_factor) const {
  const std::size_t n = model_.sites().size();
  FitState state{.pad = model_.nominal(),
                 .log_gain = std::vector<double>(gains_),
                 .offset = std::vector<double>(n)};
  if (pad_column(PadParameter::depth) != no_column) state.pad.log_depth = std::log(depth_factor);
  state = moved(state, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(columns_)), {});
  const Material material = material_at(state.pad);
  for (const Press& press : log_.presses) {
    PressState at{.shape = press.shape,
                  .log_half_width =
                      std::log(press.half_width.value.value_or(weak_width_share * model_.depth()))};
    at.friction = press.friction.value.value_or(0.0);
    at.friction_z = press.friction_z.value.value_or(0.0);
    const Place seen = seen_middle(state.presses.size()).value_or(Place{});
    at.center = press.position.value.value_or(seen.y);
    at.center_z = press.position_z.value.value_or(seen.z);
    at.disc = press.disc;
    const double radius = radius_[state.presses.size()];
    if (press.radius && !press.half_width.value && press.force.value)
      at.log_half_width = std::log(model_.contact_half_width(material, *press.force.value, radius));
    if (press.force.value) {
      at.log_force = std::log(*press.force.value);
    } else {
      // The force whose readings are nearest, all else as it is.
      for (int pass = 0; pass < (press.radius ? 4 : 1); ++pass) {
        PressState unit = at;
        unit.log_force = 0.0;
        const PressReadings one =
            model_.readings(state.pad, std::span(&unit, 1), false, options_.at_base);
        double both = 0.0;
        double square = 0.0;
        for (std::size_t j = 0; j < n; ++j) {
          if (!used_[j]) continue;
          const double r = one.value(0, j) / noise_[j];
          both += r * (press.readings[j] - log_.unloaded.mean[j]) / noise_[j];
          square += r * r;
        }
        if (!(square > 0.0)) throw std::invalid_argument("a press reaches no taxel");
        // Readings of the wrong sign say that the log is wrong: the fit will.
        at.log_force = std::log(std::max(both, 1e-3 * std::abs(both) + 1e-12 * square) / square);
        if (press.radius && !press.half_width.value)
          at.log_half_width =
              std::log(model_.contact_half_width(material, std::exp(at.log_force), radius));
      }
    }
    state.presses.push_back(at);
  }
  return state;
}

}  // namespace tactile_net
