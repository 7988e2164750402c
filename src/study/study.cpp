#include "tactile_net/study/study.hpp"

#include <algorithm>

namespace tactile_net::study {

bool StudySection::whole() const noexcept {
  return std::all_of(points.begin(), points.end(),
                     [](const WorkPoint& point) { return point.measured(); });
}

std::vector<WorkPoint> Study::points() const {
  std::vector<WorkPoint> all;
  for (const StudySection& section : sections)
    all.insert(all.end(), section.points.begin(), section.points.end());
  return all;
}

}  // namespace tactile_net::study
