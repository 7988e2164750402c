#include "src/numeric/strtod.hpp"

#include <bit>
#include <cerrno>
#include <clocale>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>

#include "tactile_net/numeric/number_text.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

/// A text whose end is not the end of its memory.
struct Answer {
  std::ptrdiff_t read = 0;
  std::errc error{};
  std::uint64_t bits = 0;
  bool operator==(const Answer&) const = default;
};

Answer answer(const auto& read, const std::string& text) {
  double number = 7.0;
  const std::string longer = text + "123";
  const std::from_chars_result result = read(longer.data(), longer.data() + text.size(), number);
  return {result.ptr - longer.data(), result.ec, std::bit_cast<std::uint64_t>(number)};
}

Answer by_strtod(const std::string& text) { return answer(from_chars_by_strtod, text); }
Answer by_library(const std::string& text) { return answer(number_from_chars, text); }

TEST_CASE("what is a number and where it ends is decided as by std::from_chars", "[strtod]") {
  const std::string text =
      GENERATE("", "-", "+1", "--1", "-+1", " 1", "\t1", "1 ", "1.5", "-1.5", ".5", "5.", ".", "-.",
               "1e5", "1e", "1e+", "1e-5x", "1E+05", "0x10", "-0X1p3", "0", "-0", "1,5", "1_000",
               "1-2", "1..2", "1e5e5", "inf", "-INF", "infinity", "infinite", "nan", "-nan", "in",
               "n", "x", "e5", "1e999", "-1e999", "1e400junk", "5e-324", "1e-310", "2.5e-324",
               "17976931348623157e292", "1.7976931348623159e308", "00012.5");
  CAPTURE(text);
  const Answer expected = by_library(text);
  CHECK(by_strtod(text).read == expected.read);
  CHECK(by_strtod(text).error == expected.error);
  if (text.find("nan") == std::string::npos) CHECK(by_strtod(text) == expected);
}

TEST_CASE("every bit is that of std::from_chars, near ties too", "[strtod][property]") {
  std::mt19937_64 generator(1);
  for (int i = 0; i < 20000; ++i) {
    const double number = std::bit_cast<double>(generator());
    if (!(number - number == 0.0)) continue;
    char text[1100];
    // Up to all digits of the exact value: what lies halfway must go to the even neighbour.
    const int digits = static_cast<int>(generator() % 40);
    std::snprintf(text, sizeof text, "%.*e", digits, number);
    CAPTURE(text);
    REQUIRE(by_strtod(text) == by_library(text));
  }
  for (std::uint64_t bits = 0x3ff0000000000000; bits < 0x3ff0000000000400; ++bits) {
    const double low = std::bit_cast<double>(bits);
    const double high = std::bit_cast<double>(bits + 1);
    char text[128];
    std::snprintf(text, sizeof text, "%.60Lf",
                  (static_cast<long double>(low) + static_cast<long double>(high)) / 2.0L);
    REQUIRE(by_strtod(text) == by_library(text));
  }
}

TEST_CASE("it reads the same in a German program, and leaves errno alone", "[strtod]") {
  const char* found = nullptr;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE"})
    if (found == nullptr) found = std::setlocale(LC_ALL, name);
  errno = EDOM;
  CHECK(by_strtod("1.5").read == 3);
  CHECK(by_strtod("1,5").read == 1);
  CHECK(by_strtod("1e999").error == std::errc::result_out_of_range);
  CHECK(errno == EDOM);
  std::setlocale(LC_ALL, "C");
}

}  // namespace
}  // namespace tactile_net
