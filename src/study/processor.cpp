#include "tactile_net/study/processor.hpp"

#include <cstddef>
#include <fstream>

namespace tactile_net::study {

double processor_clock([[maybe_unused]] const lab::Clock& clock) {
#if defined(__x86_64__)
  const lab::Pinned pinned;
  constexpr std::size_t additions = 1 << 20;  // one a cycle, each needs the one before
  const lab::Seconds seconds = lab::time_of(
      [] {
        std::size_t sum = 0;
        for (std::size_t i = 0; i < additions / 16; ++i)
          asm volatile(".rept 16\n\tadd %1, %0\n\t.endr" : "+r"(sum) : "r"(i));
      },
      0.03, clock);
  return static_cast<double>(additions) / seconds.low;
#else
  return 0.0;
#endif
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) {
      const std::size_t at = line.find_first_not_of(" \t", line.find(':') + 1);
      return at == std::string::npos ? "" : line.substr(at);
    }
  return "";
}

}  // namespace tactile_net::study
