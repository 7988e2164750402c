#include "tactile_net/sweep/summary.hpp"

#include <string>
#include <vector>

#include "tests/catch.hpp"

using namespace tactile_net;
using sweep::Row;

namespace {

Row row(std::string value, std::string method, std::optional<double> error,
        std::string verdict = "ok") {
  Row made;
  made.values = {std::move(value)};
  made.method = std::move(method);
  made.error = error;
  made.verdict = std::move(verdict);
  return made;
}

std::vector<const Row*> all_of(const sweep::Table& table) {
  std::vector<const Row*> rows;
  for (const Row& one : table.rows) rows.push_back(&one);
  return rows;
}

}  // namespace

TEST_CASE("a group is counted, and its middle is the median", "[sweep]") {
  sweep::Table table;
  for (const double error : {5.0, 1.0, 3.0}) table.rows.push_back(row("1", "dft", error));
  CHECK(sweep::group(all_of(table)).median_error == 3.0);
  table.rows.push_back(row("1", "dft", 100.0, "border"));
  table.rows.push_back(row("1", "dft", {}, "failed"));
  const sweep::Group group = sweep::group(all_of(table));
  CHECK(group.rows == 5);
  CHECK(group.trusted == 3);
  CHECK(group.failed == 1);
  CHECK(group.median_error == 4.0);  // of two in the middle their mean
  CHECK(group.largest_error == 100.0);
  CHECK_FALSE(group.median_alpha);
  CHECK_FALSE(sweep::group({}).median_error);
}

TEST_CASE("values that are numbers rise, words stay in their order", "[sweep]") {
  sweep::Table table;
  for (const char* value : {"10", "9", "1e1", "10", "-1"})
    table.rows.push_back(row(value, "dft", 1));
  const auto parts = sweep::by_value(all_of(table), 0);
  REQUIRE(parts.size() == 4);
  CHECK(parts[0].value == "-1");
  CHECK(parts[1].value == "9");
  CHECK(parts[2].rows.size() == 2);
  table.rows.push_back(row("rgcv", "dft", 1));
  CHECK(sweep::by_value(all_of(table), 0).front().value == "10");
  CHECK_FALSE(sweep::by_value(all_of(table), 0).back().number);
}

TEST_CASE("methods and failures are each named once, failures by how many there are", "[sweep]") {
  sweep::Table table;
  for (const char* why : {"rare", "often", "often"}) {
    table.rows.push_back(row("1", "", {}, "failed"));
    table.rows.back().failure = why;
  }
  table.rows.push_back(row("1", "tikhonov", 1));
  table.rows.push_back(row("1", "dft", 1));
  table.rows.push_back(row("1", "tikhonov", 1));
  CHECK(sweep::methods(table) == std::vector<std::string>{"tikhonov", "dft"});
  CHECK(sweep::of_method(table, "tikhonov").size() == 2);
  const auto failures = sweep::failures(table);
  REQUIRE(failures.size() == 2);
  CHECK(failures.front() == std::pair<std::string, std::size_t>{"often", 2});
}
