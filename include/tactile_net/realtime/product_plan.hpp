/// @file
/// How y = A x is computed, as data: the structure of A that a planner found, and its factors.
///
/// Reflections. A vector is blocks of equal size (channels of an array, unknowns). A block is a
/// grid of values, row after row: for a skin rows lie along y and the values of a row along z; for
/// a line there is one row, along y. Two reflections turn a grid round: y's reverses its rows, z's
/// the values in each row; a line's y -> -y is of the latter kind. For each the block has a sign:
/// +1 where reflecting the array reflects the block, -1 where it reflects and negates it (shear,
/// tangential traction). With J for a reflection, A is symmetric if J A J = A. Then the vectors
/// with J x = x and those with J x = -x do not mix: sums and differences of mirrored places part A
/// into four classes of a quarter of its size, in this order: (+, +), (+, -), (-, +), (-, -), the
/// first sign of y's reflection. For a line (+, +) and (+, -) are a half each: the others have no
/// places. A class lists, block after block, the places of the first half of the rows (the middle
/// one too where the block's parity in the class is +) and of their values alike, row after row.
///
/// Where a skin's A is also its own image when y and z are exchanged, blocks by their partners,
/// (-, +) exchanged is (+, -) and has the same factor, which is read once for both; (+, +) and
/// (-, -) part again into what the exchange leaves as it is and what it negates: an eighth of A.
/// Those list the pairs i < j that the exchange makes of a class's places, their sums or
/// differences, and the sums then the places that it leaves alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tactile_net {

/// The numbers are those of plan files; 2 and 3 stand in older ones (plan_file.hpp).
enum class Structure : std::uint8_t {
  dense = 0,     ///< one factor, A
  low_rank = 1,  ///< two factors: A = second x first
  /// For lines. A = T + E: T, the corner of a circulant, by FFT; E, which corrects its ends, as
  /// reflections_low_rank. The FFT is passed to the estimator (convolution.hpp): this library has
  /// none.
  fft = 4,
  /// One factor for each class, (+, +), (+, -), (-, +), (-, -), without values where a class has no
  /// places; with partners (+, +) left as it is, (+, +) negated, (+, -), (-, -) left as it is,
  /// (-, -) negated.
  reflections = 5,
  reflections_low_rank = 6,  ///< two factors for each class, one class after the other
};

enum class Precision : std::uint8_t { float64, float32 };

[[nodiscard]] constexpr std::string_view name(Structure structure) noexcept {
  switch (structure) {
    case Structure::dense:
      return "dense";
    case Structure::low_rank:
      return "low_rank";
    case Structure::fft:
      return "fft";
    case Structure::reflections:
      return "reflections";
    case Structure::reflections_low_rank:
      return "reflections_low_rank";
  }
  return "unknown";
}

[[nodiscard]] constexpr std::string_view name(Precision precision) noexcept {
  return precision == Precision::float64 ? "float64" : "float32";
}

/// True if a number that was read is one of the enumerators.
[[nodiscard]] constexpr bool is_known(Structure structure) noexcept {
  return structure == Structure::dense || structure == Structure::low_rank ||
         (structure >= Structure::fft && structure <= Structure::reflections_low_rank);
}
[[nodiscard]] constexpr bool is_known(Precision precision) noexcept {
  return precision <= Precision::float32;
}

/// True if each class, or A itself, has two factors.
[[nodiscard]] constexpr bool is_low_rank(Structure structure) noexcept {
  return structure == Structure::low_rank || structure == Structure::fft ||
         structure == Structure::reflections_low_rank;
}
/// True if the factors are those of the classes of reflections, as are those of fft's correction.
[[nodiscard]] constexpr bool has_reflections(Structure structure) noexcept {
  return structure == Structure::reflections || structure == Structure::reflections_low_rank ||
         structure == Structure::fft;
}

/// How the two reflections act on a vector of blocks, each a grid of values.
struct GridBlocks {
  std::size_t rows = 0;     ///< of each block's grid
  std::size_t columns = 0;  ///< of each block's grid
  /// Sign of each block under y's reflection, 1 or -1; for a line 1.
  std::vector<std::int8_t> signs_y{};
  /// Sign of each block under z's reflection, 1 or -1; for a line under y -> -y.
  std::vector<std::int8_t> signs_z{};
  /// The block that each block becomes when y and z are exchanged; empty: they are not exchanged.
  std::vector<std::uint32_t> partners{};

  [[nodiscard]] std::size_t size() const noexcept { return rows * columns * signs_y.size(); }
};

/// Blocks of a line, `count` values each.
/// @param signs  sign of each block: 1 where mirroring the line mirrors it, -1 where it negates it
///               too
[[nodiscard]] GridBlocks line_blocks(std::size_t count, std::vector<std::int8_t> signs);

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
  // For reflections and fft; empty otherwise.
  GridBlocks row_grid{};     ///< blocks of y
  GridBlocks column_grid{};  ///< blocks of x
  /// The factors, in the order that `Structure` states. Those of classes take plain sums and
  /// differences of x and give those of y: the scaling to an orthonormal basis is in them.
  std::vector<Factor> factors{};
  double scale = 1.0;  ///< A is the factors' product times this power of two; 1 for fft

  /// fft only: m, the length of the circle on which T convolves blocks of n values, the rest of it
  /// zero. An even number, >= n, < 2^30, with no prime factor above 7: an FFT then allocates
  /// nothing. With m >= 2 n - 1 nothing wraps around; with less, the correction undoes what does.
  std::size_t transform_size = 0;
  /// fft only: row blocks x column blocks x (m / 2 + 1), the DFT of each block's convolution. It is
  /// real where the two signs are equal and i times this where they differ, by mirror symmetry.
  std::vector<double> spectra{};
};

/// Sizes of the classes of reflections: four; with partners five.
/// @pre  as many signs of z as of y, and partners that fit
[[nodiscard]] std::vector<std::size_t> class_sizes(const GridBlocks& grid);

/// @throw std::invalid_argument  sizes do not fit, a value is not finite, or is no float of at most
///                               2^20 where the precision is float32
void check(const ProductPlan& plan);

/// Bytes of factors and spectra that one product streams: what its time is made of beyond a few
/// taxels.
[[nodiscard]] std::size_t streamed_bytes(const ProductPlan& plan) noexcept;

}  // namespace tactile_net
