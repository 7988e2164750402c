#include "tactile_net/study/work_precision.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace tactile_net::study {
namespace {

/// Points with that error, fastest first; of equally fast ones the most accurate first.
std::vector<std::size_t> by_time(std::span<const WorkPoint> points, ErrorOf error, TimeOf time_of) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].measured() && points[i].time_of == time_of && points[i].*error)
      order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(points[a].seconds, *(points[a].*error)) <
           std::pair(points[b].seconds, *(points[b].*error));
  });
  return order;
}

void check(const std::optional<double>& demand, const char* what) {
  if (demand && !(*demand > 0.0 && std::isfinite(*demand)))
    throw std::invalid_argument(std::string(what) + " must be > 0 and finite");
}

}  // namespace

std::vector<std::size_t> pareto_front(std::span<const WorkPoint> points, ErrorOf error,
                                      TimeOf time_of) {
  std::vector<std::size_t> front;
  for (const std::size_t i : by_time(points, error, time_of))
    if (front.empty() || *(points[i].*error) < *(points[front.back()].*error)) front.push_back(i);
  return front;
}

Choice choose(std::span<const WorkPoint> points, ErrorOf error, TimeOf time_of,
              const Requirement& requirement) {
  check(requirement.accuracy, "accuracy");
  check(requirement.deadline, "deadline");
  Choice choice;
  for (const std::size_t i : by_time(points, error, time_of)) {
    const double now = *(points[i].*error);
    const bool accurate = !requirement.accuracy || now <= *requirement.accuracy;
    const bool in_time = !requirement.deadline || points[i].seconds <= *requirement.deadline;
    if (accurate && !choice.fastest) choice.fastest = i;
    if (in_time && (!choice.most_accurate || now < *(points[*choice.most_accurate].*error)))
      choice.most_accurate = i;
    if (accurate && in_time && !choice.point) choice.point = i;
  }
  return choice;
}

std::optional<double> fastest_frame(std::span<const WorkPoint> points) {
  const Choice choice =
      choose(points, &WorkPoint::error_to_solution, TimeOf::frame, {.accuracy = one_percent});
  return choice.point ? std::optional(points[*choice.point].seconds) : std::nullopt;
}

}  // namespace tactile_net::study
