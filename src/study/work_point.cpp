#include "tactile_net/study/work_point.hpp"

#include "numeric/named.hpp"

namespace tactile_net::study {
namespace {

constexpr Named<TimeOf> time_names[] = {{TimeOf::frame, "frame"},
                                        {TimeOf::settling, "settling"},
                                        {TimeOf::simulator, "simulator"},
                                        {TimeOf::forward, "forward"}};

}  // namespace

std::string_view name(TimeOf time_of) noexcept { return name_in<time_names>(time_of); }

}  // namespace tactile_net::study
