#include "tactile_net/drawing/figure.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tactile_net/drawing/html.hpp"
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
  CHECK_THAT(html, ContainsSubstring("\"name\":\"A line, to be looked at") &&
                       ContainsSubstring("with 2 µs") && ContainsSubstring("href=\"one.csv\""));
  REQUIRE(figures.data().size() == 1);
  CHECK(figures.data().front().second == "x,\"a \"\"line\"\"\"\n1,1\n2,4\n3,9\n");
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
  CHECK(count(html, "class=\"chart\"") == 1);
}

TEST_CASE("a chart's data are JSON whatever its labels hold, and hold every value", "[figure]") {
  Plot plot{"</script><b>", "x \"quoted\" \\ back", "y\n", {1.0, 2.0}, {}, true};
  const double none = std::numeric_limits<double>::quiet_NaN();
  plot.curves = {{"first <curve>", {1.25e-7, none}, 1}};
  plot.curves.front().low = {0.5, 0.25};
  plot.curves.front().high = {1.5, 0.75};
  const std::string html = chart_html(plot, "what \"it\" shows");
  CHECK(count(html, "<script") == 1);
  CHECK(count(html, "</script>") == 1);
  CHECK(html.find("<b>") == std::string::npos);
  const std::string begin(data_element);
  const std::size_t at = html.find(begin) + begin.size();
  const std::string json = html.substr(at, html.find("</script>") - at);
  CHECK_THAT(json, ContainsSubstring("\"label\":\"x \\\"quoted\\\" \\\\ back\",\"log\":true") &&
                       ContainsSubstring("\"label\":\"y\\u000a\"") &&
                       ContainsSubstring("\"y\":[1.25e-07,null]") &&
                       ContainsSubstring("\"low\":[0.5,0.25],\"high\":[1.5,0.75]") &&
                       ContainsSubstring("\"xs\":[1,2]") &&
                       ContainsSubstring("first \\u003ccurve>"));
}
