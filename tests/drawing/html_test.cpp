#include "tactile_net/drawing/html.hpp"

#include <map>
#include <string>

#include "tests/catch.hpp"

using namespace tactile_net::drawing;

TEST_CASE("numbers and units are written as people write them", "[html]") {
  const std::string from =
      GENERATE(as<std::string>{}, "2.5 us a frame", "0.98 +- 0.0021", "<= 1e-05", "1.09e+03",
               "1080 %", "1e+05", "1.234e+02 N", "1.2e+07", "-3.1e-14", "x1e+03",
               "-0.001 +- 0.0857, +-", "turned by 3.04 deg.");
  const std::map<std::string, std::string> to = {{"2.5 us a frame", "2.5 µs a frame"},
                                                 {"0.98 +- 0.0021", "0.98 ± 0.0021"},
                                                 {"<= 1e-05", "≤ 1e-5"},
                                                 {"1.09e+03", "1090"},
                                                 {"1080 %", "1080 %"},
                                                 {"1e+05", "100000"},
                                                 {"1.234e+02 N", "123.4 N"},
                                                 {"1.2e+07", "1.2e7"},
                                                 {"-3.1e-14", "-3.1e-14"},
                                                 {"x1e+03", "x1000"},
                                                 {"-0.001 +- 0.0857, +-", "0.00 ± 0.09, ±"},
                                                 {"turned by 3.04 deg.", "turned by 3.04°."}};
  CHECK(typeset(from) == to.at(from));
  CHECK(typeset(typeset(from)) == typeset(from));
}

TEST_CASE("what only looks like a number or a unit stays as it is", "[html]") {
  for (const char* text : {"let us go", "5 usual ones", "1e+", "2.e+03x", "e+03", "0x1e5", "a - b",
                           "v1.2.3", "ends in 3 u", ""}) {
    CAPTURE(text);
    CHECK(typeset(text) == text);
  }
}

TEST_CASE("words are typeset, names and a page's title are not", "[html]") {
  const std::string name = "run1e+03 5 us.csv";
  CHECK(element("p", name) == enclosed("p", escaped(typeset(name))));
  CHECK_THAT(html_page(name, "", ""), ContainsSubstring("<title>" + name + "</title>"));
}

TEST_CASE("nothing in a text can end its element", "[html]") {
  CHECK(element("p", "<b a=\"1\">&") == "<p>&lt;b a=&quot;1&quot;&gt;&amp;</p>\n");
  const std::string table = html_table({{"<a>", "b\""}, {"<i>", "2 us"}});
  CHECK_THAT(table, ContainsSubstring("data-label=\"b&quot;\">2 µs<") && !ContainsSubstring("<i>"));
}

TEST_CASE("a table's cells carry their column's name, and may be HTML of their own", "[html]") {
  const std::string table =
      html_table({{"method", "verdict"}, {"dft", "ok"}},
                 [](std::size_t k, const std::string& text) { return std::to_string(k) + text; });
  CHECK_THAT(table, ContainsSubstring("<th>method</th>") &&
                        ContainsSubstring("<td data-label=\"method\">0dft</td>") &&
                        ContainsSubstring("<td data-label=\"verdict\">1ok</td>"));
}
