#include "tactile_net/lab/agreement.hpp"

#include <limits>
#include <vector>

#include "tests/catch.hpp"

namespace tactile_net::lab {
namespace {

MethodResult method_result(Method method, std::vector<double> normal,
                           std::vector<double> tangential = {}) {
  normal.insert(normal.end(), tangential.begin(), tangential.end());
  return {.method = method, .answer = {.tractions = std::move(normal)}};
}

}  // namespace

TEST_CASE("methods that found the same are one group, others have their own", "[lab][agreement]") {
  const std::vector<MethodResult> results = {
      method_result(Method::dft, {0.0, 1.5, 0.0}), method_result(Method::tikhonov, {0.0, 2.0, 1.0}),
      method_result(Method::network, {}),
      method_result(Method::closed_form, {0.0, 2.0, 1.0 + 2e-3})};
  const std::vector<Agreement> groups = agreements(results);
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].results == std::vector<std::size_t>{0});
  CHECK(groups[0].difference == 0.0);
  CHECK(groups[1].results == std::vector<std::size_t>{1, 3});
  CHECK_THAT(groups[1].difference, WithinRel(1e-3, 1e-9));  // 2e-3 of the largest, 2
  CHECK(agreements(results, 1e-4).size() == 3);
}

TEST_CASE("an answer of both tractions is not one of the normal alone", "[lab][agreement]") {
  const MethodResult one = method_result(Method::tikhonov, {1.0, 2.0});
  const MethodResult two = method_result(Method::closed_form, {1.0, 2.0}, {0.0, 4.0});
  const MethodResult other = method_result(Method::network, {1.0, 2.0}, {0.0, 5.0});
  CHECK(difference(one, two) == std::numeric_limits<double>::infinity());
  CHECK(difference(two, other) == 0.25);
  CHECK(agreements(std::vector{one, two, other}).size() == 3);
  // Two answers of nothing are the same.
  CHECK(difference(method_result(Method::dft, {0.0}), method_result(Method::tikhonov, {0.0})) ==
        0.0);
}

}  // namespace tactile_net::lab
