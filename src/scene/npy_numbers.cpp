#include "scene/npy_numbers.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

template <typename Word, bool big_endian>
Word word_at(const unsigned char* bytes) {
  if constexpr (std::endian::native == (big_endian ? std::endian::big : std::endian::little)) {
    Word as_it_stands;
    std::memcpy(&as_it_stands, bytes, sizeof as_it_stands);
    return as_it_stands;
  }
  std::uint64_t word = 0;  // small words would be promoted to a signed one
  for (std::size_t i = 0; i < sizeof(Word); ++i)
    word = word << 8 | bytes[big_endian ? i : sizeof(Word) - 1 - i];
  return static_cast<Word>(word);
}

/// IEEE 754's binary16.
double of_half(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31;
  const double fraction = bits & 1023;
  const double size = exponent == 31  ? (fraction == 0.0 ? std::numeric_limits<double>::infinity()
                                                         : std::numeric_limits<double>::quiet_NaN())
                      : exponent == 0 ? std::ldexp(fraction, -24)
                                      : std::ldexp(1024.0 + fraction, exponent - 25);
  return (bits & 0x8000) != 0 ? -size : size;
}

struct Half {};

template <typename Number>
using WordOf = std::conditional_t<
    std::is_same_v<Number, Half> || sizeof(Number) == 2, std::uint16_t,
    std::conditional_t<sizeof(Number) == 8, std::uint64_t,
                       std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint8_t>>>;

template <typename Number, bool big_endian>
void read(const unsigned char* bytes, std::span<const std::size_t> at, double* values) {
  using Word = WordOf<Number>;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Word word = word_at<Word, big_endian>(bytes + at[k]);
    if constexpr (std::is_same_v<Number, Half>)
      values[k] = of_half(word);
    else
      values[k] = static_cast<double>(std::bit_cast<Number>(word));
  }
}

template <typename Number, bool big_endian>
std::string text_at(const unsigned char* bytes) {
  if constexpr (std::is_integral_v<Number>) {
    return std::to_string(std::bit_cast<Number>(word_at<WordOf<Number>, big_endian>(bytes)));
  } else {
    constexpr std::array<std::size_t, 1> first = {0};
    double value = 0.0;
    read<Number, big_endian>(bytes, first, &value);
    return std::isfinite(value) ? shortest(value) : std::string();
  }
}

template <typename Number>
NpyNumbers numbers(bool big_endian) {
  return {sizeof(WordOf<Number>), big_endian ? read<Number, true> : read<Number, false>,
          big_endian ? text_at<Number, true> : text_at<Number, false>};
}

}  // namespace

NpyNumbers npy_numbers(std::string_view type) {
  if (type.size() != 3 || (type[0] != '<' && type[0] != '>' && type[0] != '|' && type[0] != '='))
    return {};
  const bool big = type[0] == '>';
  const std::string_view kind = type.substr(1);
  if (kind == "f8") return numbers<double>(big);
  if (kind == "f4") return numbers<float>(big);
  if (kind == "f2") return numbers<Half>(big);
  if (kind == "i1") return numbers<std::int8_t>(big);
  if (kind == "i2") return numbers<std::int16_t>(big);
  if (kind == "i4") return numbers<std::int32_t>(big);
  if (kind == "i8") return numbers<std::int64_t>(big);
  if (kind == "u1") return numbers<std::uint8_t>(big);
  if (kind == "u2") return numbers<std::uint16_t>(big);
  if (kind == "u4") return numbers<std::uint32_t>(big);
  if (kind == "u8") return numbers<std::uint64_t>(big);
  return {};
}

std::string_view kind_of_type(std::string_view type) {
  if (type.starts_with('[')) return "records of several fields";
  switch (type.size() > 1 ? type[1] : '\0') {
    case 'b':
      return "truth values";
    case 'c':
      return "complex numbers";
    case 'O':
      return "Python objects";
    case 'U':
    case 'S':
      return "text";
    case 'M':
    case 'm':
      return "dates or durations";
    case 'V':
      return "records";
    default:
      return "numbers";
  }
}

}  // namespace tactile_net
