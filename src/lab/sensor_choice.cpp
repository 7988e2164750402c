#include "tactile_net/lab/sensor_choice.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace tactile_net::lab {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

std::optional<double> SensorChoice::resolvable(SkinRipple ripple) const noexcept {
  const auto& [y, z, any] = wavelengths[static_cast<std::size_t>(ripple)];
  if (!any) return any;
  return std::max({*any, y.value_or(0.0), z.value_or(0.0)});
}

std::span<const SkinRipple> ripples_of(std::size_t unknowns) noexcept {
  return std::span(skin_ripples).first(unknowns);
}

bool hides_mean(const SensorChoice& choice, Traction component) {
  return std::any_of(choice.hidden.begin(), choice.hidden.end(), [&](const HiddenWaves& one) {
    return one.direction == WaveDirection::mean &&
           (component == Traction::normal         ? one.normal
            : component == Traction::tangential_y ? one.divergence
                                                  : one.curl);
  });
}

std::size_t hidden_waves(const SensorChoice& choice) noexcept {
  std::size_t hidden = 0;
  for (const HiddenWaves& one : choice.hidden) hidden += one.count();
  return hidden;
}

bool hides_anything(const SensorChoice& choice) noexcept {
  return hidden_waves(choice) > 0 || (choice.array && choice.array->hidden > 0);
}

std::optional<double> resolvable_drag(const SensorChoice& choice) noexcept {
  std::optional<double> coarser;
  for (const SkinRipple ripple : ripples_of(choice.unknowns).subspan(1)) {
    const std::optional<double> one = choice.resolvable(ripple);
    if (!one) return std::nullopt;
    coarser = std::max(*one, coarser.value_or(0.0));
  }
  return coarser;
}

double coarsest(const SensorChoice& choice) noexcept {
  double most = 0.0;
  for (const SkinRipple ripple : ripples_of(choice.unknowns))
    most = std::max(most, choice.resolvable(ripple).value_or(infinite));
  return most;
}

bool tells_more(const SensorChoice& a, const SensorChoice& b) {
  const auto of_line = [](const SensorChoice& choice) {
    return std::tuple(hidden_waves(choice) > 0, coarsest(choice), choice.array->hidden > 0,
                      choice.array->condition);
  };
  const auto of_skin = [](const SensorChoice& choice) {
    return std::tuple(3 - choice.unknowns, hidden_waves(choice), coarsest(choice),
                      choice.unseen.value_or(infinite), choice.wave_condition);
  };
  return a.identifiability ? of_line(a) < of_line(b) : of_skin(a) < of_skin(b);
}

}  // namespace tactile_net::lab
