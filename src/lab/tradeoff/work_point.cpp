#include "tactile_net/lab/tradeoff/work_point.hpp"

namespace tactile_net::lab {

std::string_view name(TimeOf time_of) noexcept {
  switch (time_of) {
    case TimeOf::frame:
      return "frame";
    case TimeOf::settling:
      return "settling";
    case TimeOf::simulator:
      return "simulator";
    case TimeOf::forward:
      return "forward";
  }
  return "";
}

}  // namespace tactile_net::lab
