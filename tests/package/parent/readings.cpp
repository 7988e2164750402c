#include <cstddef>
#include <tactile_net/realtime/load_plan.hpp>

std::size_t readings_of(const char* plan) { return tactile_net::load_plan(plan).readings(); }
