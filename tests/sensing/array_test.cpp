#include "tactile_net/sensing/array.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tactile_net/inverse/line_problem.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

const SensorArray good_array{.count = 4,
                             .pitch = 0.5,
                             .depths = {1.0, 1.5},
                             .reads = {Quantity::strain_x, Quantity::shear_xy}};

std::string refusal(const SensorArray& array) {
  try {
    check(array);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

/// `good_array` with one member replaced.
template <class Member>
SensorArray with(Member SensorArray::*member, Member value) {
  SensorArray array = good_array;
  array.*member = std::move(value);
  return array;
}

}  // namespace

TEST_CASE("taxels are centred on y = 0 and a pitch apart", "[array]") {
  CHECK(positions(good_array) == std::vector{-0.75, -0.25, 0.25, 0.75});
  CHECK(positions(with(&SensorArray::count, std::size_t{3})) == std::vector{-0.5, 0.0, 0.5});
  CHECK(positions(with(&SensorArray::count, std::size_t{2})) == std::vector{-0.25, 0.25});
}

TEST_CASE("positions are symmetric to the bit", "[array][property]") {
  const auto array =
      with(&SensorArray::count, static_cast<std::size_t>(GENERATE(2, 3, 80, 81, 1000)));
  for (std::size_t j = 0; j < array.count; ++j)
    CHECK(position(array, j) == -position(array, array.count - 1 - j));
}

TEST_CASE("channels run quantity by quantity, each through the depths", "[array]") {
  const auto all = channels(good_array);
  REQUIRE(all.size() == 4);
  CHECK(all[0].name == "strain_x@0");
  CHECK(all[1].name == "strain_x@1");
  CHECK(all[2].name == "shear_xy@0");
  CHECK(all[3].name == "shear_xy@1");
  CHECK(all[1].quantity == Quantity::strain_x);
  CHECK(all[1].depth == 1.5);
  CHECK(all[2].quantity == Quantity::shear_xy);
  CHECK(all[2].depth == 1.0);
}

TEST_CASE("with one depth a channel is named after its quantity", "[array]") {
  const auto all = channels(with(&SensorArray::depths, {2.0}));
  REQUIRE(all.size() == 2);
  CHECK(all[0].name == "strain_x");
  CHECK(all[1].name == "shear_xy");
}

TEST_CASE("a refusal names field, rule and value of an array", "[array]") {
  CHECK(refusal(good_array).empty());
  CHECK(refusal(with(&SensorArray::count, std::size_t{1})) == "count must be >= 2 (got 1)");
  CHECK(refusal(with(&SensorArray::count, std::size_t{0})) == "count must be >= 2 (got 0)");
  CHECK(refusal(with(&SensorArray::pitch, 0.0)) == "pitch must be > 0 (got 0)");
  CHECK(refusal(with(&SensorArray::pitch, -1.0)) == "pitch must be > 0 (got -1)");
  CHECK(refusal(with(&SensorArray::pitch, infinity)) == "pitch must be finite (got inf)");
  CHECK(refusal(with(&SensorArray::depths, {1.0, 0.0})) == "depth must be > 0 (got 0)");
  CHECK(refusal(with(&SensorArray::depths, {not_a_number})) == "depth must be finite (got nan)");
  CHECK(refusal(with(&SensorArray::depths, {})) == "depths must hold at least one value");
  CHECK(refusal(with(&SensorArray::reads, {})) == "reads must hold at least one quantity");
  CHECK(refusal(with(&SensorArray::reads,
                     {Quantity::stress_x, Quantity::shear_xy, Quantity::stress_x})) ==
        "reads must name a quantity once (got stress_x twice)");
}

TEST_CASE("a line array reads the quantities of plane strain alone", "[array]") {
  for (const Quantity quantity : skin_quantities) {
    const bool is_own = std::find(line_quantities.begin(), line_quantities.end(), quantity) !=
                        line_quantities.end();
    const SensorArray even{.count = 3, .pitch = 0.5, .depths = {1.0}, .reads = {quantity}};
    const std::vector<Taxel> taxels{{.y = 0.0, .depth = 1.0, .reads = {quantity}},
                                    {.y = 0.5, .depth = 1.0, .reads = {quantity}}};
    CAPTURE(name(quantity));
    if (is_own) {
      CHECK_NOTHROW(check(even));
      CHECK_NOTHROW(uneven_array(taxels));
    } else {
      CHECK_THROWS_AS(check(even), std::invalid_argument);
      CHECK_THROWS_AS(uneven_array(taxels), std::invalid_argument);
      CHECK_THROWS_AS(make_problem(even, Material{}), std::invalid_argument);
    }
  }
}

TEST_CASE(
    "a channel of an uneven array counts the taxels that read it, and begins where the last ends",
    "[array][uneven]") {
  const SensorArray array =
      uneven_array({{.y = -2.0, .depth = 1.5, .reads = {Quantity::stress_x, Quantity::shear_xy}},
                    {.y = 0.0, .depth = 1.2, .reads = {Quantity::shear_xy}},
                    {.y = 0.0, .depth = 1.4, .reads = {Quantity::stress_x}},
                    {.y = 3.0, .depth = 1.3, .reads = {Quantity::shear_xy}}});
  const std::vector<Channel> all = channels(array);
  REQUIRE(all.size() == 2);
  CHECK(all[0].quantity == Quantity::stress_x);
  CHECK(all[0].first == 0);
  CHECK(all[0].count == 2);
  CHECK(all[0].depth == 1.4);
  CHECK(all[1].first == 2);
  CHECK(all[1].count == 3);
  CHECK(all[1].depth == 1.2);
  CHECK(reading_count(array) == 5);
  const std::vector<Site> where = sites(array);
  REQUIRE(where.size() == 5);
  for (std::size_t c = 0; c < all.size(); ++c)
    for (std::size_t i = 0; i < all[c].count; ++i) CHECK(where[all[c].first + i].channel == c);
  CHECK(where[1].taxel == 2);
  CHECK(where[4].y == 3.0);
}
