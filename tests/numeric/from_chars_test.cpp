// How a text becomes a double: by the standard library, and by fast_float where that is installed.
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tactile_net/numeric/number_text.hpp"
#include "tests/catch.hpp"
#if __has_include(<fast_float/fast_float.h>)
#include "src/numeric/by_fast_float.hpp"
#endif

namespace tactile_net {
namespace {

using Reader = std::from_chars_result (*)(const char*, const char*, double&) noexcept;

const std::vector<Reader> readers {
  number_from_chars,
#if __has_include(<fast_float/fast_float.h>)
      from_chars_by_fast_float,
#endif
};

struct Answer {
  std::ptrdiff_t read = 0;
  std::errc error{};
  double number = 7.0;  ///< what it was before, where there is an error
};

/// The text's end is not the end of its memory.
Answer answer(Reader read, const std::string& text) {
  Answer found;
  const std::string longer = text + "123";
  const auto [stop, error] = read(longer.data(), longer.data() + text.size(), found.number);
  found.read = stop - longer.data();
  found.error = error;
  return found;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

TEST_CASE("what is a number, where it ends and what it is", "[from_chars]") {
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    std::string text;
    std::ptrdiff_t read;
    double number;
  };
  const auto [text, read, number] = GENERATE(values<Case>({
      {"1 ", 1, 1.0},
      {"1.5", 3, 1.5},
      {"-1.5", 4, -1.5},
      {".5", 2, 0.5},
      {"5.", 2, 5.0},
      {"1e5", 3, 1e5},
      {"1e", 1, 1.0},
      {"1e+", 1, 1.0},
      {"1e-5x", 4, 1e-5},
      {"1E+05", 5, 1e5},
      {"0x10", 1, 0.0},
      {"-0X1p3", 2, -0.0},
      {"0", 1, 0.0},
      {"-0", 2, -0.0},
      {"0e999", 5, 0.0},
      {"-0.000e-999", 11, -0.0},
      {"1,5", 1, 1.0},
      {"1_000", 1, 1.0},
      {"1-2", 1, 1.0},
      {"1..2", 2, 1.0},
      {"1e5e5", 3, 1e5},
      {"00012.5", 7, 12.5},
      {"inf", 3, inf},
      {"-INF", 4, -inf},
      {"infinity", 8, inf},
      {"infinite", 3, inf},
      {"nan", 3, nan},
      {"-nan", 4, nan},
      {"5e-324", 6, std::numeric_limits<double>::denorm_min()},
      {"2.5e-324", 8, std::numeric_limits<double>::denorm_min()},
      {"1e-310", 6, 1e-310},
      {"17976931348623157e292", 21, std::numeric_limits<double>::max()},
  }));
  for (const Reader reader : readers) {
    const Answer found = answer(reader, text);
    CAPTURE(text, found.number);
    CHECK(found.error == std::errc{});
    CHECK(found.read == read);
    CHECK((std::isnan(number) ? std::isnan(found.number) : same_bits(found.number, number)));
  }
}

TEST_CASE("what is no number leaves the number as it was", "[from_chars]") {
  const std::string text = GENERATE("", "-", "+1", "--1", "-+1", " 1", "\t1", ".", "-.", "in", "n",
                                    "x", "e5", "_1", ",5");
  for (const Reader reader : readers) {
    const Answer found = answer(reader, text);
    CAPTURE(text);
    CHECK(found.error == std::errc::invalid_argument);
    CHECK(found.read == 0);
    CHECK(found.number == 7.0);
  }
}

TEST_CASE("what is too large or too small is an error, behind all of its digits", "[from_chars]") {
  const auto [text, read] =
      GENERATE(table<std::string, std::ptrdiff_t>({{"1e999", 5},
                                                   {"-1e999", 6},
                                                   {"1e400junk", 5},
                                                   {"1.7976931348623159e308", 22},
                                                   {"1e-400", 6},
                                                   {"-1e-400", 7},
                                                   {"2.4e-324", 8},
                                                   {"0.0001e-330x", 11},
                                                   {std::string(400, '9'), 400}}));
  for (const Reader reader : readers) {
    const Answer found = answer(reader, text);
    CAPTURE(text);
    CHECK(found.error == std::errc::result_out_of_range);
    CHECK(found.read == read);
    CHECK(found.number == 7.0);
  }
}

TEST_CASE("every bit is that of the C library, near ties too", "[from_chars][property]") {
  const auto check = [](const char* text) {
    const double expected = std::strtod(text, nullptr);
    for (const Reader reader : readers) {
      CAPTURE(text);
      REQUIRE(same_bits(answer(reader, text).number, expected));
    }
  };
  std::mt19937_64 generator(1);
  for (int i = 0; i < 20000; ++i) {
    const double number = std::bit_cast<double>(generator());
    if (!(number - number == 0.0)) continue;
    char text[1100];
    // Up to all digits of the exact value: what lies halfway must go to the even neighbour.
    const int digits = static_cast<int>(generator() % 40);
    std::snprintf(text, sizeof text, "%.*e", digits, number);
    if (std::isfinite(std::strtod(text, nullptr))) check(text);
  }
  for (std::uint64_t bits = 0x3ff0000000000000; bits < 0x3ff0000000000400; ++bits) {
    const double low = std::bit_cast<double>(bits);
    const double high = std::bit_cast<double>(bits + 1);
    char text[128];
    std::snprintf(text, sizeof text, "%.60Lf",
                  (static_cast<long double>(low) + static_cast<long double>(high)) / 2.0L);
    check(text);
  }
}

}  // namespace
}  // namespace tactile_net
