#include "tactile_net/study/work_point.hpp"

#include "numeric/named.hpp"

namespace tactile_net::study {

std::string_view name(TimeOf time_of) noexcept {
  return name_in<Enumerators<TimeOf>::all>(time_of);
}

}  // namespace tactile_net::study
