#include "tactile_net/lab/certification.hpp"

#include <algorithm>

namespace tactile_net::lab {

bool Certification::loaded() const noexcept {
  return std::any_of(plan.direct.begin(), plan.direct.end(), [](double f) { return f != 0.0; });
}

}  // namespace tactile_net::lab
