#include "tactile_net/system/memory.hpp"

#include <unistd.h>

#include <fstream>
#include <string>

namespace tactile_net {

double available_memory() {
  std::ifstream file("/proc/meminfo");
  for (std::string word; file >> word;)
    if (double kibibytes = 0.0; word == "MemAvailable:" && file >> kibibytes)
      return 1024.0 * kibibytes;
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace tactile_net
