#include "tactile_net/numeric/unit_text.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "tactile_net/numeric/number_text.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

TEST_CASE("a prefix leaves a number that is short to write", "[unit_text]") {
  CHECK(with_unit(4810.0, "Pa") == "4.81 kPa");
  CHECK(with_unit(1.2e-3, "m") == "1.2 mm");
  CHECK(with_unit(0.98, "N/m") == "0.98 N/m");
  CHECK(with_unit(-0.2e6, "Pa") == "-200 kPa");
  CHECK(with_unit(2.5e-5, "m") == "25 µm");
  CHECK(with_unit(52.7497, "Pa") == "52.7 Pa");
  CHECK(with_unit(0.0, "Pa") == "0 Pa");
  CHECK(with_unit(0.0123, "") == "0.0123");
  CHECK(with_unit(std::nan(""), "Pa") == "-");
  CHECK(with_unit(std::numeric_limits<double>::infinity(), "Pa") == "inf Pa");
}

TEST_CASE("no number is written with four digits before its point or an exponent", "[unit_text]") {
  const int digits = GENERATE(3, 4, 5);
  for (double number = 1.2345e-12; number < 9e14; number *= 1.0371) {
    const std::string text = with_unit(number, "Pa", digits);
    CAPTURE(number, text);
    double written = 0.0;
    REQUIRE(read_number(text.substr(0, text.find(' ')), written));
    CHECK(text.find('e') == std::string::npos);
    CHECK(written < 1000.0);
    CHECK(written >= 0.1);
    const ScaledUnit unit = scaled_unit(number, "Pa", digits);
    CHECK_THAT(written / unit.factor, WithinRel(number, 0.5001 * std::pow(10.0, 1 - digits)));
  }
}

TEST_CASE("what rounds up to a thousand takes the next prefix", "[unit_text]") {
  CHECK(with_unit(999.4, "Pa") == "999 Pa");
  CHECK(with_unit(999.7, "Pa") == "1 kPa");
  CHECK(with_unit(999.7, "Pa", 4) == "999.7 Pa");
  CHECK(with_unit(999.96e3, "Pa") == "1 MPa");
  CHECK(with_unit(0.09996, "m") == "0.1 m");
}

TEST_CASE("a value and its deviation share a unit", "[unit_text]") {
  CHECK(with_unit(4810.0, 21.0, "Pa") == "4.81 ± 0.02 kPa");
  CHECK(with_unit(4.56e-15, 7.85e-3, "m") == "0 ± 8 mm");
  CHECK(with_unit(4810.0, std::nan(""), "Pa") == "4.81 kPa");
  CHECK(with_unit(std::nan(""), 1.0, "Pa") == "-");
}

}  // namespace
}  // namespace tactile_net
