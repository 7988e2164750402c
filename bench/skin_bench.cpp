// Every floor of skins: frames in a controller, with constraints, their jitter, batches,
// recordings, products and steps of large skins, a run.
//
//     bench_skin [frames [16x1 | 32x1 | 16x3 | 24x3 | 32x3] ... | cone | latency | batches |
//     recordings |
//                 products | steps [LARGEST, 64 [LEAST, 16]] | run]; all without
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "bench/skin/sections.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

int main(int count, char** arguments) {
  using bench::Floors;
  const std::vector<std::string> asked(arguments + 1, arguments + count);
  const auto rest = [&] {
    return asked.empty() ? asked : std::vector<std::string>(asked.begin() + 1, asked.end());
  };
  const auto side = [&](std::size_t at, std::size_t otherwise) {
    return at < asked.size() ? static_cast<std::size_t>(std::stoul(asked[at])) : otherwise;
  };
  const std::vector<std::pair<std::string, std::function<void(Floors&)>>> sections{
      {"frames", [&](Floors& floors) { bench::single_frames(floors, rest()); }},
      {"cone", bench::cones},
      {"batches", bench::batches},
      {"recordings", bench::recordings},
      {"products", bench::products},
      {"steps", [&](Floors& floors) { bench::steps(floors, side(2, 16), side(1, 64)); }},
      {"run", bench::whole_run},
      {"latency", bench::latency}};  // last: it stays on one core
  std::printf("%s\n", std::string(name(tactile_net::widest_instruction_set())).c_str());
  Floors floors;
  bool any = false;
  for (const auto& [name, measure] : sections) {
    if (!asked.empty() && asked.front() != name) continue;
    any = true;
    measure(floors);
  }
  if (!any) {
    std::fprintf(stderr, "bench_skin: there is no section '%s'\n", asked.front().c_str());
    return 2;
  }
  return floors.all_hold() ? 0 : 1;
}
