// A .npy of any type, order and shape gives the same frames, or says what it is.
#include "frames/npy.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

#include "tactile_net/scene/diagnostic.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using namespace tactile_net::frames;

namespace {

using Names = std::vector<std::string>;
using Frames = std::vector<std::vector<double>>;

/// A .npy by hand.
std::string npy(const std::string& type, bool fortran, const std::string& shape,
                const std::string& bytes, char version = 1) {
  const std::string header = "{'descr': " + type +
                             ", 'fortran_order': " + (fortran ? "True" : "False") +
                             ", 'shape': " + shape + ", }\n";
  std::string file = "\x93NUMPY";
  file += version;
  file += '\0';
  for (std::size_t i = 0, size = header.size(); i < (version == 1 ? 2U : 4U); ++i, size >>= 8)
    file += static_cast<char>(size & 255);
  return file + header + bytes;
}

template <typename Word>
std::string bytes_of(Word word, bool big_endian) {
  std::string bytes;
  for (std::size_t i = 0; i < sizeof(Word); ++i) {
    const std::size_t shift = 8 * (big_endian ? sizeof(Word) - 1 - i : i);
    bytes += static_cast<char>(static_cast<std::uint64_t>(word) >> shift & 255);
  }
  return bytes;
}

/// Numbers as bytes, of a type's spelling without its byte order.
std::string bytes_of(const std::vector<double>& numbers, const std::string& kind, bool big) {
  std::string bytes;
  for (const double x : numbers) {
    if (kind == "f8") bytes += bytes_of(std::bit_cast<std::uint64_t>(x), big);
    if (kind == "f4") bytes += bytes_of(std::bit_cast<std::uint32_t>(static_cast<float>(x)), big);
    if (kind == "i1" || kind == "u1") bytes += static_cast<char>(static_cast<int>(x));
    if (kind == "i2")
      bytes += bytes_of(std::bit_cast<std::uint16_t>(static_cast<std::int16_t>(x)), big);
    if (kind == "u2") bytes += bytes_of(static_cast<std::uint16_t>(x), big);
    if (kind == "i4")
      bytes += bytes_of(std::bit_cast<std::uint32_t>(static_cast<std::int32_t>(x)), big);
    if (kind == "u4") bytes += bytes_of(static_cast<std::uint32_t>(x), big);
    if (kind == "i8")
      bytes += bytes_of(std::bit_cast<std::uint64_t>(static_cast<std::int64_t>(x)), big);
    if (kind == "u8") bytes += bytes_of(static_cast<std::uint64_t>(x), big);
  }
  return bytes;
}

const Names channel_columns{"a_0", "a_1", "a_2",
                            "b_0", "b_1", "b_2"};  // two channels of three taxels

Frames read_npy(const std::string& file, const std::string& places = {}, bool missing = false,
                Names* times = nullptr) {
  std::istringstream in(file);
  NpyFrames source(
      in, "f.npy",
      {.names = channel_columns, .taxels = 3, .places = places, .accept_missing = missing});
  Frames frames;
  std::vector<double> values(channel_columns.size());
  while (source.next(values)) {
    frames.push_back(values);
    if (times != nullptr) times->emplace_back(source.time());
  }
  CHECK(source.frames() == frames.size());
  CHECK(source.bytes_read() == file.size());
  return frames;
}

std::string npy_refusal(const std::string& file) {
  try {
    (void)read_npy(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "was read";
}

Frames counting(std::size_t frames, std::size_t columns) {
  Frames all(frames, std::vector<double>(columns));
  for (std::size_t i = 0; i < frames; ++i)
    for (std::size_t j = 0; j < columns; ++j)
      all[i][j] = static_cast<double>((i * columns + j) % 120);
  return all;
}

/// In C order, or with the first index fastest.
std::vector<double> flat(const Frames& frames, bool fortran) {
  std::vector<double> numbers;
  if (!fortran) {
    for (const auto& frame : frames) numbers.insert(numbers.end(), frame.begin(), frame.end());
  } else {
    for (std::size_t j = 0; j < frames[0].size(); ++j)
      for (const auto& frame : frames) numbers.push_back(frame[j]);
  }
  return numbers;
}

}  // namespace

TEST_CASE("an array of any type, byte order and index order holds the same frames",
          "[frames][npy]") {
  const std::string kind = GENERATE("f8", "f4", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8");
  const bool big = GENERATE(false, true);
  const bool fortran = GENERATE(false, true);
  CAPTURE(kind, big, fortran);
  const Frames frames = counting(5, 6);
  const std::string type = std::string(big ? "'>" : "'<") + kind + "'";
  CHECK(read_npy(npy(type, fortran, "(5, 6)", bytes_of(flat(frames, fortran), kind, big))) ==
        frames);
}

TEST_CASE("numbers with a sign keep it, and halves are halves", "[frames][npy]") {
  CHECK(read_npy(npy("'|i1'", false, "(1, 6)", "\xff\x80\x7f\x01\x02\x03")) ==
        Frames{{-1, -128, 127, 1, 2, 3}});
  CHECK(read_npy(npy("'|u1'", false, "(1, 6)", "\xff\x80\x7f\x01\x02\x03")) ==
        Frames{{255, 128, 127, 1, 2, 3}});
  std::string halves;  // 1, -2, 65504, the least normal, the least of all, -0
  for (const int bits : {0x3c00, 0xc000, 0x7bff, 0x0400, 0x0001, 0x8000})
    halves += bytes_of(static_cast<std::uint16_t>(bits), false);
  CHECK(read_npy(npy("'<f2'", false, "(1, 6)", halves)) ==
        Frames{{1.0, -2.0, 65504.0, std::ldexp(1.0, -14), std::ldexp(1.0, -24), -0.0}});
}

TEST_CASE("Fortran's order is read across blocks", "[frames][npy]") {
  const Frames frames = counting(200'000, 6);  // 9.6 MB: more than is held at once
  CHECK(read_npy(npy("'<f8'", true, "(200000, 6)", bytes_of(flat(frames, true), "f8", false))) ==
        frames);
}

TEST_CASE("(frames, channels, taxels) is one frame after another", "[frames][npy]") {
  const Frames frames = counting(4, 6);
  CHECK(read_npy(npy("'<f8'", false, "(4, 2, 3)", bytes_of(flat(frames, false), "f8", false))) ==
        frames);
  std::vector<double> numbers;  // the frame fastest, then the channel, then the taxel
  for (std::size_t taxel = 0; taxel < 3; ++taxel)
    for (std::size_t channel = 0; channel < 2; ++channel)
      for (const auto& frame : frames) numbers.push_back(frame[3 * channel + taxel]);
  CHECK(read_npy(npy("'<f8'", true, "(4, 2, 3)", bytes_of(numbers, "f8", false))) == frames);
  const Frames one = counting(1, 6);
  CHECK(read_npy(npy("'<f8'", false, "(6,)", bytes_of(one[0], "f8", false))) == one);
  CHECK(read_npy(npy("'<f8'", true, "(6,)", bytes_of(one[0], "f8", false))) == one);
  CHECK(read_npy(npy("'<f8'", false, "(4, 1, 6)", bytes_of(flat(frames, false), "f8", false))) ==
        frames);
}

TEST_CASE("columns of an array are read where a list of columns says, times too", "[frames][npy]") {
  const bool fortran = GENERATE(false, true);
  const Frames stored = counting(4, 8);
  const std::string file =
      npy("'<f8'", fortran, "(4, 8)", bytes_of(flat(stored, fortran), "f8", false));
  Names times;
  const Frames frames = read_npy(file, "t=1,3-8", false, &times);
  CHECK(times == Names{"0", "8", "16", "24"});
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(frames[i] == std::vector<double>(stored[i].begin() + 2, stored[i].end()));
  CHECK(read_npy(file, "8,7,6,5,4,3")[0] == std::vector<double>{7, 6, 5, 4, 3, 2});
}

TEST_CASE("NaN and infinity are missing where that is accepted", "[frames][npy]") {
  const double inf = std::numeric_limits<double>::infinity();
  const std::string file =
      npy("'<f8'", false, "(1, 6)", bytes_of({1, std::nan(""), inf, -inf, 5, 6}, "f8", false));
  const Frames frames = read_npy(file, {}, true);
  for (const std::size_t i : {1u, 2u, 3u}) CHECK(std::isnan(frames[0][i]));
  CHECK(frames[0][4] == 5.0);
  CHECK_THAT(npy_refusal(file), ContainsSubstring("frame 0: column 1 (a_1) is not finite") &&
                                    ContainsSubstring("missing = skip"));
}

TEST_CASE("an array that does not fit is refused with the line that mends it", "[frames][npy]") {
  const auto [type, shape, message, hint] =
      GENERATE(table<std::string, std::string, std::string, std::string>({
          {"'|b1'", "(1, 6)", "holds truth values of type '|b1'", "astype"},
          {"'<c16'", "(1, 6)", "complex numbers", "astype"},
          {"'|O'", "(1, 6)", "Python objects", "astype"},
          {"'<U5'", "(1, 6)", "text", "astype"},
          {"[('a', '<f8')]", "(1, 6)", "records of several fields", "astype"},
          {"'<f8'", "(2, 7)", "has 7 columns, the scene reads 6", "columns = 2-7"},
          {"'<f8'", "(6, 9)", "has 9 columns", "numpy.save(file, frames.T)"},
          {"'<f8'", "(2, 3, 2)", "has the shape (2, 3, 2), not (frames, 2, 3)",
           "frames.transpose(0, 2, 1)"},
          {"'<f8'", "(12,)", "has the shape (12,), not (frames, 6)", "frames.reshape(-1, 6)"},
          {"'<f8'", "(1, 2, 2, 2)", "has the shape", "frames.reshape(-1, 6)"},
          {"'<f8'", "()", "has the shape ()", "reshape"},
          {"'<f8'", "(99999999999999999999, 6)", "has the shape", "reshape"},
          {"'<f8'", "(999999999999999999, 6)", "larger than any recording", ""},
      }));
  CAPTURE(type, shape);
  CHECK_THAT(npy_refusal(npy(type, false, shape, "")),
             StartsWith("f.npy: error: ") && ContainsSubstring(message) && ContainsSubstring(hint));
}

TEST_CASE("versions 1 to 3 are read, and what is none of them is refused", "[frames][npy]") {
  const Frames frames = counting(2, 6);
  const std::string bytes = bytes_of(flat(frames, false), "f8", false);
  for (const char version : {'\1', '\2', '\3'})
    CHECK(read_npy(npy("'<f8'", false, "(2, 6)", bytes, version)) == frames);
  const std::string later = npy("'<f8'", false, "(2, 6)", bytes, 9);
  CHECK_THAT(npy_refusal(later), ContainsSubstring("version 9, not 1 to 3"));
  CHECK_THAT(npy_refusal(later.substr(0, 3)), ContainsSubstring("is not a .npy file"));
  CHECK_THAT(npy_refusal(npy("'<f8'", false, "(2, 6)", bytes).substr(0, 30)),
             ContainsSubstring("header that is cut off"));
}

TEST_CASE("an array that ends early is told so, in either order", "[frames][npy]") {
  const std::string bytes = bytes_of(flat(counting(4, 6), false), "f8", false);
  CHECK_THAT(npy_refusal(npy("'<f8'", false, "(5, 6)", bytes)),
             ContainsSubstring("ends within frame 4 of 5"));
  CHECK_THAT(npy_refusal(npy("'<f8'", true, "(5, 6)", bytes)),
             ContainsSubstring("ends within column 5 of 6"));
  for (const bool fortran : {false, true})
    CHECK_THAT(npy_refusal(npy("'<f8'", fortran, "(3, 6)", bytes)),
               ContainsSubstring("goes on after the 3 frames"));
  CHECK_THAT(npy_refusal(npy("'<f8'", true, "(1000000000000, 6)", bytes)),
             ContainsSubstring("ends within column 1"));
}
