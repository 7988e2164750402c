#include "tactile_net/drawing/figure.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/catch.hpp"

using namespace tactile_net::drawing;

namespace {

Figure line(std::string name, std::vector<double> y) {
  return {std::move(name), "all", "A line, to be looked at, with 2 us in it.",
          Plot{"title", "x", "y", {1.0, 2.0, 3.0}, {{"a \"line\"", std::move(y), 1}}}};
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("a figure's picture bears its caption as a name, and links its numbers", "[figure]") {
  const Figures figures({line("one", {1.0, 4.0, 9.0})});
  const std::string html = figures.html("all");
  CHECK(figures.html("elsewhere").empty());
  CHECK_THAT(html, ContainsSubstring("role=\"img\" aria-label=\"A line, to be looked at") &&
                       ContainsSubstring("with 2 µs") && ContainsSubstring("href=\"one.csv\""));
  REQUIRE(figures.data().size() == 1);
  CHECK(figures.data().front().second == "x,\"a \"\"line\"\"\"\n1,1\n2,4\n3,9\n");
  CHECK(figures.pictures().size() == 1);
}

TEST_CASE("a figure without a finite value is left out", "[figure]") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Figures figures({line("none", {none, none, none}), line("one", {none, 4.0, 9.0})});
  CHECK(count(figures.html("all"), "<figure") == 1);
  CHECK(figures.data().size() == 1);
}

TEST_CASE("a picture of its own stands in a figure's place, its numbers all the same", "[figure]") {
  Figure own = line("own", {1.0, 2.0, 3.0});
  own.picture = "<svg>mine</svg>";
  Figure elsewhere = line("elsewhere", {});
  elsewhere.plot.curves.clear();
  elsewhere.picture = "<svg>too</svg>";
  elsewhere.data = "truth.csv";
  const Figures figures({own, elsewhere, line("one", {1.0, 2.0, 3.0})});
  const std::string html = figures.html("all");
  CHECK_THAT(html, ContainsSubstring("<svg>mine</svg>") && ContainsSubstring("href=\"own.csv\"") &&
                       ContainsSubstring("<svg>too</svg>") &&
                       ContainsSubstring("href=\"truth.csv\""));
  CHECK(figures.data().size() == 2);
  CHECK(figures.pictures().size() == 1);
  CHECK(figures.pictures().front().first == "one.svg");
}

TEST_CASE("a wide plot is drawn for a telephone too, in one figure", "[figure]") {
  Figure wide = line("wide", {1.0, 2.0, 3.0});
  wide.plot.wide = true;
  const Figures figures({wide, line("one", {3.0, 2.0, 1.0})});
  const std::string html = figures.html("all");
  CHECK(count(html, "<figure") == 2);
  CHECK(count(html, "<svg") == 3);
  CHECK_THAT(html, ContainsSubstring("wide-plot") && ContainsSubstring("narrow-plot"));
  CHECK(figures.pictures().size() == 2);
}

TEST_CASE("names stand beside their points, one above the other where points are close",
          "[figure]") {
  Plot plot{"", "x", "y", {}, {}, true, true};
  Curve front{"front", {1.0, 1.02, 1.04}, 1};
  front.x = {1e-3, 1e-3, 1e-3};
  front.names = {"first point", "", "it's <third>"};
  Curve quiet{"in the file alone", {2.0, 3.0}, 2};
  quiet.x = {1e-2, 1e-1};
  quiet.quiet = true;
  plot.curves = {quiet, front};
  plot.quiet_label = "others";
  const std::string svg = draw(std::vector{plot}).front();
  CHECK_THAT(svg, ContainsSubstring("first point") && ContainsSubstring("it's &lt;third>") &&
                      ContainsSubstring("others") && !ContainsSubstring("in the file alone"));
}
