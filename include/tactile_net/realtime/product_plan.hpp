/// @file
/// How y = A x is computed, as data: the structure of A that a planner found, and its factors.
///
/// Mirror symmetry. A vector is blocks of equal length (channels of an array, unknowns), each with
/// a sign: +1 where mirroring the array mirrors the block, -1 where it mirrors and negates it
/// (shear, tangential traction). With J for that mirroring, A is symmetric if J A J = A. Then the
/// vectors with J x = x and those with J x = -x do not mix: in the basis of sums and differences
/// (x_i +- x_{n-1-i}), the centre of an odd block standing alone among the sums, A falls into two
/// blocks of half its size, class 0 (J x = x) and class 1. A class lists, block after block, the
/// sums of a block with its own sign, the differences of one with the other sign.
///
/// Skins. There a block is a grid of values, row after row (rows along y, values of a row along z),
/// and has a sign for each of two reflections, y -> -y and z -> -z. Sums and differences of the
/// four mirrored places of a grid part A into four classes, (+, +), (+, -), (-, +) and (-, -), the
/// first sign of y's reflection: a quarter of A. A class lists, block after block, the places of
/// the first half of the rows (the middle one too where the block's parity in the class is +) and
/// of their values alike, row after row. Where A is also its own image when y and z are exchanged,
/// blocks by their partners, (-, +) exchanged is (+, -) and has the same factor, which is read once
/// for both;
/// (+, +) and (-, -) part again into what the exchange leaves as it is and what it negates: an
/// eighth of A. Those list the pairs i < j that the exchange makes of a class's places, their sums
/// or differences, and the sums then the places that it leaves alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tactile_net {

enum class Structure : std::uint8_t {
  dense,            ///< one factor, A
  low_rank,         ///< two factors: A = second x first
  parity,           ///< one factor for each class
  parity_low_rank,  ///< two factors for each class: those of class 0, then those of class 1
  /// A = T + E: T a circulant's corner, by FFT; E, which corrects its ends, as parity_low_rank. Who
  /// multiplies by T is passed to the estimator (convolution.hpp): this library has no FFT.
  fft,
  /// Of skins: one factor for each class, (+, +), (+, -), (-, +), (-, -); with partners those of
  /// (+, +) left and negated, (+, -), (-, -) left and negated.
  reflections,
  reflections_low_rank,  ///< two factors for each class, one class after the other
};

enum class Precision : std::uint8_t { float64, float32 };

[[nodiscard]] std::string_view name(Structure structure) noexcept;
[[nodiscard]] std::string_view name(Precision precision) noexcept;

/// Of the factors: what is said of parity_low_rank holds for the correction of fft.
[[nodiscard]] constexpr bool has_parity(Structure structure) noexcept {
  return structure == Structure::parity || structure == Structure::parity_low_rank ||
         structure == Structure::fft;
}
[[nodiscard]] constexpr bool is_low_rank(Structure structure) noexcept {
  return structure == Structure::low_rank || structure == Structure::parity_low_rank ||
         structure == Structure::fft || structure == Structure::reflections_low_rank;
}
/// Whether classes are those of grids.
[[nodiscard]] constexpr bool has_reflections(Structure structure) noexcept {
  return structure == Structure::reflections || structure == Structure::reflections_low_rank;
}

/// What the reflections make of a vector of grids.
struct GridBlocks {
  std::size_t rows = 0;  ///< of each block's grid
  std::size_t columns = 0;
  std::vector<std::int8_t> signs_y{};  ///< of each block, 1 or -1
  std::vector<std::int8_t> signs_z{};
  /// Of each block the one that it becomes when y and z are exchanged; empty: they are not.
  std::vector<std::uint32_t> partners{};

  [[nodiscard]] std::size_t size() const noexcept { return rows * columns * signs_y.size(); }
};

/// A matrix, row-major.
struct Factor {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> values{};
};

struct ProductPlan {
  Structure structure = Structure::dense;
  /// float32: the factors hold numbers of at most 2^20 that a float holds exactly, and sums are
  /// taken in float, of readings scaled to [-2, 2] by a power of two: no overflow in any unit.
  Precision precision = Precision::float64;
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<std::int8_t> row_signs{};     ///< of each block of y; needed for parity only
  std::vector<std::int8_t> column_signs{};  ///< of each block of x
  /// Applied in the order of `Structure`. With parity they take plain sums and differences of x and
  /// give those of y: the scaling to an orthonormal basis is in them.
  std::vector<Factor> factors{};
  double scale = 1.0;  ///< A is the factors' product times this power of two; 1 for fft

  /// fft only: m, the length of the circle on which T convolves blocks of n values, the rest of it
  /// zero. Even, >= n, < 2^30, no prime factor above 7: an FFT then allocates nothing. With m >= 2
  /// n
  /// - 1 nothing wraps around; with less, what does is in the correction too.
  std::size_t transform_size = 0;
  /// fft only: row blocks x column blocks x (m / 2 + 1), the DFT of each block's convolution. It is
  /// real where the two signs are equal and i times this where they differ, by mirror symmetry.
  std::vector<double> spectra{};

  // Of reflections.
  GridBlocks row_grid{};     ///< of y
  GridBlocks column_grid{};  ///< of x
};

/// Sizes of class 0 and class 1 of a vector of `signs.size()` blocks, `size` values together.
struct ClassSizes {
  std::size_t even = 0;
  std::size_t odd = 0;
};
[[nodiscard]] ClassSizes class_sizes(const std::vector<std::int8_t>& signs,
                                     std::size_t size) noexcept;

/// Sizes of the classes of reflections: four, with partners five.
/// @pre  as many signs of z as of y, and partners that fit
[[nodiscard]] std::vector<std::size_t> class_sizes(const GridBlocks& grid);

/// @throw std::invalid_argument  sizes do not fit, a value is not finite, or is no float of at most
/// 2^20
///                               where the precision is float32
void check(const ProductPlan& plan);

/// Bytes of factors and spectra that one product streams: what its time is made of beyond a few
/// taxels.
[[nodiscard]] std::size_t streamed_bytes(const ProductPlan& plan) noexcept;

}  // namespace tactile_net
