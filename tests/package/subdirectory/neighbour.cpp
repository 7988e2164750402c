#include <cstdio>
#include <exception>
#include <string_view>
#include <tactile_net/realtime/load_plan.hpp>

// What is no plan is refused by name.
int main() {
  try {
    (void)tactile_net::load_plan(__FILE__);
  } catch (const std::exception& refusal) {
    std::puts(refusal.what());
    return std::string_view(refusal.what()).find(__FILE__) == std::string_view::npos ? 1 : 0;
  }
  return 1;
}
