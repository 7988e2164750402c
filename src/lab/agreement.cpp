#include "tactile_net/lab/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactile_net::lab {

double difference(const MethodResult& first, const MethodResult& second) {
  const std::vector<double>& a = first.answer.tractions;
  const std::vector<double>& b = second.answer.tractions;
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double apart = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    apart = std::max(apart, std::abs(a[i] - b[i]));
    largest = std::max(largest, std::abs(a[i]));
  }
  return apart == 0.0 ? 0.0 : apart / largest;
}

std::vector<Agreement> agreements(std::span<const MethodResult> results, double within) {
  std::vector<Agreement> groups;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i].has_answer()) continue;
    const auto same = [&](const Agreement& group) {
      return difference(results[group.results.front()], results[i]) <= within;
    };
    const auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end()) {
      groups.push_back({{i}, 0.0});
    } else {
      group->difference =
          std::max(group->difference, difference(results[group->results.front()], results[i]));
      group->results.push_back(i);
    }
  }
  return groups;
}

}  // namespace tactile_net::lab
