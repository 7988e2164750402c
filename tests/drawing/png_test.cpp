#include "tactile_net/drawing/png.hpp"

#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/catch.hpp"

namespace tactile_net::drawing {
namespace {

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
}

/// CRC-32 bit by bit, as ISO 3309 defines it.
std::uint32_t crc_by_bits(const std::string& bytes) {
  std::uint32_t c = 0xffffffffU;
  for (const char byte : bytes) {
    c ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) c = (c & 1U) != 0 ? 0xedb88320U ^ (c >> 1) : c >> 1;
  }
  return ~c;
}

/// The content of the chunks of that type; every chunk's checksum is looked at.
std::string chunk(const std::string& file, const std::string& type) {
  std::string found;
  for (std::size_t at = 8; at < file.size();) {
    const std::size_t size = big_endian(file, at);
    const std::string body = file.substr(at + 4, 4 + size);
    CHECK(big_endian(file, at + 8 + size) == crc_by_bits(body));
    if (body.starts_with(type)) found += body.substr(4);
    at += 12 + size;
  }
  return found;
}

}  // namespace

TEST_CASE("a PNG holds its pixels and colours, with checksums that hold", "[png]") {
  const std::size_t width = 700;
  const std::size_t height = 200;  // more than one block of 65535
  std::vector<std::uint8_t> pixels(width * height);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = static_cast<std::uint8_t>(i * 31 % 251);
  const Palette palette = diverging({1, 2, 3}, {4, 5, 6});
  const std::string file = png(width, height, pixels, palette);

  CHECK(file.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  const std::string header = chunk(file, "IHDR");
  CHECK(big_endian(header, 0) == width);
  CHECK(big_endian(header, 4) == height);
  CHECK(chunk(file, "PLTE").size() == 768);
  CHECK(static_cast<std::uint8_t>(chunk(file, "tRNS")[128]) == 0);
  CHECK(static_cast<std::uint8_t>(chunk(file, "tRNS")[255]) == 255);

  const std::string data = chunk(file, "IDAT");
  std::string rows;
  bool last = false;
  std::size_t at = 2;
  while (!last) {
    last = data[at] == 1;
    const auto size = static_cast<std::size_t>(static_cast<std::uint8_t>(data[at + 1]) |
                                               static_cast<std::uint8_t>(data[at + 2]) << 8);
    rows += data.substr(at + 5, size);
    at += 5 + size;
  }
  CHECK(at + 4 == data.size());
  REQUIRE(rows.size() == height * (width + 1));
  for (std::size_t row = 0; row < height; ++row) {
    REQUIRE(rows[row * (width + 1)] == 0);
    for (std::size_t x = 0; x < width; ++x)
      REQUIRE(static_cast<std::uint8_t>(rows[row * (width + 1) + 1 + x]) ==
              pixels[row * width + x]);
  }
}

TEST_CASE("a picture without sides or of another size is refused", "[png]") {
  const std::vector<std::uint8_t> six(6);
  CHECK_THROWS_AS(png(0, 6, {}, {}), std::invalid_argument);
  CHECK_THROWS_AS(png(2, 2, six, {}), std::invalid_argument);
  CHECK_NOTHROW(png(2, 3, six, {}));
}

TEST_CASE("a diverging palette shows nothing at zero and full colours at the ends", "[png]") {
  const Palette palette = diverging({9, 8, 7}, {1, 2, 3});
  CHECK(palette[diverging_index(0.0)].opacity == 0);
  CHECK(palette[diverging_index(std::numeric_limits<double>::quiet_NaN())].opacity == 0);
  CHECK(palette[diverging_index(1.0)].opacity == 255);
  CHECK(palette[diverging_index(7.0)].red == 1);
  CHECK(palette[diverging_index(-1.0)].opacity == 255);
  CHECK(palette[diverging_index(-1.0)].red == 9);
  for (int i = 129; i < 255; ++i)
    CHECK(palette[static_cast<std::size_t>(i)].opacity <=
          palette[static_cast<std::size_t>(i + 1)].opacity);
}

TEST_CASE("base64 as RFC 4648 gives it", "[png]") {
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foob") == "Zm9vYg==");
  CHECK(base64("fooba") == "Zm9vYmE=");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64(std::string("\xff\x00\xfe", 3)) == "/wD+");
}

TEST_CASE("a ramp runs from its first stop to its last, its middle stop at 0", "[png]") {
  constexpr std::array stops = {Colour{200, 0, 0}, Colour{255, 255, 255}, Colour{0, 0, 100}};
  const Palette palette = ramp(stops);
  const auto is = [&](std::size_t index, const Colour& colour) {
    CAPTURE(index);
    CHECK(palette[index].red == colour.red);
    CHECK(palette[index].green == colour.green);
    CHECK(palette[index].blue == colour.blue);
    CHECK(palette[index].opacity == 255);
  };
  is(diverging_index(-1.0), stops[0]);
  is(diverging_index(0.0), stops[1]);
  is(diverging_index(1.0), stops[2]);
  is(ramp_index(0.0), stops[0]);
  is(ramp_index(1.0), stops[2]);
  is(ramp_index(0.5), stops[1]);
  CHECK(ramp_index(7.0) == ramp_index(1.0));
}

}  // namespace tactile_net::drawing
