#include "tactile_net/lab/sensor_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace tactile_net::lab {
namespace {

bool hides_a_mean(const SensorChoice& choice) {
  return hides_mean(choice, Traction::normal) ||
         (choice.unknowns == 2 && hides_mean(choice, Traction::tangential_y));
}

}  // namespace

bool hides_mean(const SensorChoice& choice, Traction component) {
  const Resolution& mean = choice.resolutions.front();
  return !std::isfinite(component == Traction::normal ? mean.normal : mean.tangential);
}

bool hides_anything(const SensorChoice& choice) {
  return choice.identifiability.null_space.dimension > 0 || hides_a_mean(choice);
}

double coarsest(const SensorChoice& choice) {
  const double none = std::numeric_limits<double>::infinity();
  return std::max(choice.normal.value_or(none),
                  choice.unknowns == 2 ? choice.tangential.value_or(none) : 0.0);
}

bool tells_more(const SensorChoice& a, const SensorChoice& b) {
  const auto key = [](const SensorChoice& choice) {
    return std::tuple(hides_a_mean(choice), coarsest(choice),
                      choice.identifiability.null_space.dimension > 0,
                      choice.identifiability.condition);
  };
  return key(a) < key(b);
}

}  // namespace tactile_net::lab
