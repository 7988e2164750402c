#include "tactile_net/frames/csv.hpp"

#include <limits>
#include <sstream>

#include "tactile_net/numeric/text.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using namespace tactile_net::frames;

namespace {

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("columns are read in the order that is asked for, wherever they stand", "[frames]") {
  std::istringstream in("t,b,other,a\n0.5,1,x,2\n\n0.6,3,y,4\n");
  CsvFrames frames(in, "f.csv", {.names = {"a", "b"}});
  CHECK(frames.has_time());
  CHECK(Names(frames.columns().begin(), frames.columns().end()) == Names{"a", "b"});
  CHECK(Names(frames.ignored().begin(), frames.ignored().end()) == Names{"other"});
  std::vector<double> values(2);
  REQUIRE(frames.next(values));
  CHECK(values == std::vector{2.0, 1.0});
  CHECK(frames.time() == "0.5");
  REQUIRE(frames.next(values));
  CHECK(values == std::vector{4.0, 3.0});
  CHECK_FALSE(frames.next(values));
}

TEST_CASE("columns can be chosen by what the header has", "[frames]") {
  std::istringstream in("a_0,\"a_1\", b\n1,2,3\n");
  CsvFrames frames(in, "f.csv", [](std::span<const std::string> header) {
    CHECK(Names(header.begin(), header.end()) == Names{"a_0", "a_1", "b"});
    return Names{"b", "a_0"};
  });
  std::vector<double> values(2);
  REQUIRE(frames.next(values));
  CHECK(values == std::vector{3.0, 1.0});
}

TEST_CASE("values of unread columns may be any text, and are zero", "[frames]") {
  std::istringstream in("a,b\n1,broken\n");
  CsvFrames frames(in, "f.csv", {.names = {"a", "b"}, .unread = {false, true}});
  std::vector<double> values(2, 7.0);
  REQUIRE(frames.next(values));
  CHECK(values == std::vector{1.0, 0.0});
}

TEST_CASE("a bad frame is told with file, line and column", "[frames]") {
  const auto [text, line, column] = GENERATE(table<std::string, std::size_t, std::size_t>({
      {"a,b\n1,2\n1,x\n", 3, 3},
      {"a,b\n1\n", 2, 2},
      {"a,b\n1,2,3\n", 2, 5},
      {"a,a\n", 1, 3},
      {"b\n", 1, 1},
      {"", 0, 1},
  }));
  CAPTURE(text);
  std::istringstream in(text);
  const auto read = [&] {
    CsvFrames frames(in, "f.csv", {.names = {"a", "b"}});
    std::vector<double> values(2);
    while (frames.next(values)) continue;
  };
  try {
    read();
    FAIL("was read");
  } catch (const InputError& error) {
    REQUIRE(error.diagnostics().size() == 1);
    CHECK(error.diagnostics()[0].file == "f.csv");
    CHECK(error.diagnostics()[0].line == line);
    CHECK(error.diagnostics()[0].column == column);
  }
}

TEST_CASE("what is not known is an empty field, every number reads back", "[frames]") {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::ostringstream out;
  CsvSink sink(out, Names{"a", "b", "c"}, true);
  sink.add("0.5", std::vector{0.1, unknown, 1e300});
  CHECK(out.str().empty());  // a block at a time
  sink.finish();
  CHECK(out.str() == "t,a,b,c\n0.5,0.1,,1e+300\n");
}

TEST_CASE("a field in quotes keeps its own doubled", "[frames]") {
  CHECK(csv_quoted("") == "\"\"");
  CHECK(csv_quoted("a,b") == "\"a,b\"");
  CHECK(csv_quoted("say \"a\"") == "\"say \"\"a\"\"\"");
  std::istringstream in("\"say \"\"a, b\"\"\",b,c\n\"x \"\",\"\" y\",2,3\n");
  CsvFrames frames(in, "f.csv", {.names = {"b"}});
  std::vector<double> values(1);
  REQUIRE(frames.next(values));
  CHECK(values[0] == 2.0);
}
