/// @file
/// Heat maps as PNG: one byte a pixel, an index into colours with opacity.
///
///     const std::string file = png(width, height, pixels, diverging({33, 102, 172}, {178, 88,
///     6})); html += "<img src=\"data:image/png;base64," + base64(file) + "\">";
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tactile_net::drawing {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  std::uint8_t opacity = 255;
};
using Palette = std::array<Colour, 256>;

/// Of values from -1 to 1: nothing to be seen at 0 (index 128), so that a page's own paper shows,
/// dark or light; full colours at the ends.
[[nodiscard]] Palette diverging(Colour negative, Colour positive) noexcept;

/// Colours between stops at equal distances: of values from 0 to 1, or of an odd number of stops
/// from -1 to 1, whose middle one is 0. @pre  two stops at least
[[nodiscard]] Palette ramp(std::span<const Colour> stops) noexcept;

/// The index of a value from 0 to 1 in a `ramp`; beyond them the ends, NaN as 0.
[[nodiscard]] std::uint8_t ramp_index(double value) noexcept;

/// The index of a value in a `diverging` palette, or a `ramp` from -1 to 1; beyond -1 ... 1 the
/// ends, NaN as 0.
[[nodiscard]] std::uint8_t diverging_index(double value) noexcept;

/// A PNG file (ISO 15948), its pixels stored without compression.
///
/// @param pixels  row by row from the top
/// @throw std::invalid_argument  pixels are not width x height, or a side is 0 or above 2^31 - 1
[[nodiscard]] std::string png(std::size_t width, std::size_t height,
                              std::span<const std::uint8_t> pixels, const Palette& palette);

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace tactile_net::drawing
