#include "tactile_net/frames/source.hpp"

namespace tactile_net::frames {

std::vector<std::string> reading_columns(const SensorArray& array) { return reading_names(array); }

std::vector<std::string> traction_columns(std::size_t count, bool with_tangential) {
  std::vector<std::string> columns;
  for (const char* component : {"normal_", "tangential_"})
    for (std::size_t i = 0; i < count && (with_tangential || component[0] == 'n'); ++i)
      columns.push_back(component + std::to_string(i));
  return columns;
}

}  // namespace tactile_net::frames
