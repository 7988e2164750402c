#include "tactile_net/numeric/number_text.hpp"

#include <clocale>
#include <cmath>
#include <cstdio>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/numeric/unit_text.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

TEST_CASE("every digit is written, and read back as the same number", "[number_text]") {
  const double number = GENERATE(0.1, 1.0 / 3.0, -1e-300, 5e-324, 1.7976931348623157e308, 42.0);
  double back = 0.0;
  REQUIRE(read_number(shortest(number), back));
  CHECK(back == number);
}

TEST_CASE("three digits are those of printf in the C locale", "[number_text]") {
  for (double number = 1.2345678e-12; number < 1e12; number *= 7.3) {
    char expected[32];
    std::snprintf(expected, sizeof expected, "%.3g", number);
    CHECK(brief(number) == expected);
    CHECK(brief(-number) == std::string("-") + expected);
    std::snprintf(expected, sizeof expected, "%.1g", number);
    CHECK(brief(number, 1) == expected);
  }
  CHECK(brief(0.0) == "0");
  CHECK(brief(std::numeric_limits<double>::infinity()) == "inf");
  CHECK(brief(std::nan("")) == "-");
}

TEST_CASE("fixed digits are those of printf in the C locale, however large", "[number_text]") {
  for (const double number : {0.0, -0.04, 0.05, 0.25, 1234.56, -1e6, 1.7976931348623157e308}) {
    char expected[340];
    std::snprintf(expected, sizeof expected, "%.1f", number);
    CHECK(fixed(number, 1) == expected);
  }
  CHECK(fixed(std::nan(""), 1) == "-");
}

TEST_CASE("durations and shares carry their unit", "[number_text]") {
  CHECK(duration(2.5e-6) == "2.5 us");
  CHECK(duration(0.5) == "500 ms");
  CHECK(duration(3e-9) == "3 ns");
  CHECK(duration(90.0) == "90 s");
  CHECK(percent(0.0123) == "1.23 %");
}

TEST_CASE("a text that is not a number as a whole is refused", "[number_text]") {
  const char* text = GENERATE("", "1,5", "1.5 ", " 1", "+1", "0x10", "one", "1e", "1e999");
  CAPTURE(text);
  double number = 7.0;
  CHECK_FALSE(read_number(text, number));
}

TEST_CASE("whole numbers are counted from 0, and nothing is behind them", "[number_text]") {
  CHECK(whole_number("0") == 0);
  CHECK(whole_number("18446744073709551615") == std::numeric_limits<std::size_t>::max());
  const char* text = GENERATE("", "-1", "+1", " 1", "1 ", "1.", "1x", "18446744073709551616");
  CAPTURE(text);
  CHECK_FALSE(whole_number(text));
}

/// Numbers as a German program's streams write them: "1.234,5".
struct German : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST_CASE("a program's locale changes no number", "[number_text]") {
  const std::locale before = std::locale::global(std::locale(std::locale(), new German));
  // That of C, where the machine has one.
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"})
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  std::ostringstream stream;
  stream << 1234.5;
  const std::vector<std::string> texts = {
      brief(0.05),  fixed(0.5, 2),    shortest(1.5),          shortest(1234567),
      percent(0.5), duration(2.5e-6), with_unit(1500.0, "Pa")};
  double number = 0.0;
  const bool read = read_number("1.5", number) && !read_number("1,5", number);
  std::locale::global(before);
  std::setlocale(LC_ALL, "C");
  CHECK(stream.str() == "1.234,5");  // the locale was in force
  CHECK(texts ==
        std::vector<std::string>{"0.05", "0.50", "1.5", "1234567", "50 %", "2.5 us", "1.5 kPa"});
  CHECK(read);
}

TEST_CASE("a value is rounded by its deviation", "[number_text]") {
  CHECK(plus_minus(0.98172, 0.00166) == "0.9817 ± 0.0017");
  CHECK(plus_minus(20.24, 0.23) == "20.2 ± 0.2");
  CHECK(plus_minus(4.56e-15, 0.00785) == "0.000 ± 0.008");
  CHECK(plus_minus(-4.56e-15, 0.00785) == "0.000 ± 0.008");
  CHECK(plus_minus(1234.5, 56.0) == "1230 ± 60");
  CHECK(plus_minus(1234.5, 14.0) == "1235 ± 14");
  CHECK(plus_minus(-3.0, 0.5) == "-3.0 ± 0.5");
  CHECK(plus_minus(1.0, 0.0199) == "1.00 ± 0.02");
  CHECK(plus_minus(2.5e-5, 3e-7) == "(2.50 ± 0.03)e-5");
  CHECK(plus_minus(123456789.0, 2.5e6) == "(1.23 ± 0.03)e8");
  CHECK(plus_minus(1.5, 0.0) == "1.5");
  CHECK(plus_minus(std::nan(""), 1.0) == "-");
}

}  // namespace
}  // namespace tactile_net
