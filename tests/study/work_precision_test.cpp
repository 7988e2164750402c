#include "tactile_net/study/work_precision.hpp"

#include <random>

#include "tests/catch.hpp"

using namespace tactile_net::study;

namespace {

WorkPoint point(double seconds, double error, TimeOf time_of = TimeOf::frame) {
  WorkPoint result;
  result.seconds = seconds;
  result.error_to_solution = error;
  result.time_of = time_of;
  return result;
}

}  // namespace

TEST_CASE("a point is on the front if and only if no other beats it", "[work_precision]") {
  std::mt19937 generator(5);
  std::vector<WorkPoint> points;
  for (int i = 0; i < 200; ++i)  // from a few values: ties occur
    points.push_back(point(static_cast<double>(generator() % 20 + 1),
                           static_cast<double>(generator() % 20 + 1)));
  points.push_back(point(0.5, 0.5, TimeOf::settling));  // another kind of time beats nobody here
  points.push_back(point(0.1, 0.1));
  points.back().failure = Failure{};
  points.push_back({});
  const auto front = pareto_front(points, &WorkPoint::error_to_solution, TimeOf::frame);
  REQUIRE_FALSE(front.empty());
  const auto beats = [](const WorkPoint& a, const WorkPoint& b) {
    return a.seconds <= b.seconds && *a.error_to_solution <= *b.error_to_solution &&
           (a.seconds < b.seconds || *a.error_to_solution < *b.error_to_solution);
  };
  for (std::size_t i = 0; i < 200; ++i) {
    bool beaten = false;
    for (std::size_t k = 0; k < 200; ++k) beaten |= beats(points[k], points[i]);
    // Equal points: one stands for all.
    bool listed = false;
    for (const std::size_t k : front)
      listed |= points[k].seconds == points[i].seconds &&
                points[k].error_to_solution == points[i].error_to_solution;
    CHECK(listed == !beaten);
  }
  CHECK(std::is_sorted(front.begin(), front.end(), [&](std::size_t a, std::size_t b) {
    return points[a].seconds < points[b].seconds;
  }));
}

TEST_CASE("a choice is the fastest that is accurate and in time, or says what would be",
          "[work_precision]") {
  const std::vector<WorkPoint> points = {point(1e-6, 1e-1), point(1e-5, 1e-3), point(1e-4, 1e-6)};
  const auto asked = [&](Requirement requirement) {
    return choose(points, &WorkPoint::error_to_solution, TimeOf::frame, requirement);
  };
  CHECK(asked({}).point == 0);
  CHECK(asked({.accuracy = 1e-2}).point == 1);
  CHECK(asked({.accuracy = 1e-2, .deadline = 1e-5}).point == 1);
  CHECK(asked({.accuracy = 1e-3, .deadline = 1e-5}).point == 1);  // borders are met

  const Choice none = asked({.accuracy = 1e-4, .deadline = 5e-5});
  CHECK_FALSE(none.point);
  CHECK(none.fastest == 2);
  CHECK(none.most_accurate == 1);
  CHECK_FALSE(asked({.accuracy = 1e-9}).fastest);
  CHECK_FALSE(asked({.deadline = 1e-9}).most_accurate);
  CHECK_FALSE(choose(points, &WorkPoint::error_to_truth, TimeOf::frame, {}).point);
  CHECK_THROWS_AS(asked({.accuracy = 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(asked({.deadline = -1.0}), std::invalid_argument);
}
