/// @file
/// K f and K' g of taxels on the lattice of the cells, by FFT. Private.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "numeric/real_fft.hpp"
#include "skin/cell_kernel.hpp"

namespace tactile_net {

/// One kernel for each channel and component, channel after channel.
[[nodiscard]] std::vector<LatticeKernel> lattice_kernels(const SkinArray& skin,
                                                         const Material& material,
                                                         const SurfaceGrid& grid,
                                                         std::size_t components);

/// Transforms on a plane of at least twice the cells, so that nothing meets what it should not: row
/// by row, and only of rows that hold something; then column by column, from the transform of the
/// components over the kernels' spectra to what the channels read, while a column is at hand. Half
/// of a column is empty: bins of even number are the transform of the other half, those of odd
/// number that of the half turned by what half a bin turns; no transform is as long as a column.
///
/// A kernel is even or odd, so that its spectrum is a real number times 1, i or -1.
class LatticeProducts {
 public:
  /// @pre  the taxels lie on the grid's lattice
  /// @param kernels  as `lattice_kernels`
  LatticeProducts(const SkinArray& skin, const SurfaceGrid& grid, std::size_t components,
                  std::span<const LatticeKernel> kernels);

  /// K f. @param tractions, readings  components x cells and channels x taxels
  void readings(std::span<const double> tractions, std::span<double> readings) noexcept;

  /// K' g.
  void sums(std::span<const double> readings, std::span<double> tractions) noexcept;

 private:
  using Complex = std::complex<double>;
  /// Where values lie on the plane.
  struct Places {
    std::size_t first_row, row_step, rows, first_column, column_step, columns;

    [[nodiscard]] std::size_t row(std::size_t i) const noexcept { return first_row + i * row_step; }
    [[nodiscard]] std::size_t column(std::size_t i) const noexcept {
      return first_column + i * column_step;
    }
    [[nodiscard]] std::size_t count() const noexcept { return rows * columns; }
  };
  /// The spectrum, or that over i, column by column: of even bins 0 to half_ / 2 and of odd ones
  /// the first half. The others mirror them, as the kernel does itself along y.
  struct Response {
    std::vector<double> values;
    bool imaginary;
    double mirrored;  // 1 or -1
  };
  /// A column of one input or output: bins of even number, bins of odd number.
  using Column = std::array<ComplexFft, 2>;

  [[nodiscard]] std::size_t bins() noexcept { return along_row_.bins().size(); }
  /// Of all rows, and half of the columns.
  void add_response(const LatticeKernel& kernel, bool is_odd_y, bool is_odd_z);
  /// Where bin k of row m is: columns are taken out of rows some at a time, which lie together; a
  /// column alone would touch a page for each row. One row more than there are, for with a power of
  /// two all bins of a row would want one place of the cache.
  [[nodiscard]] std::size_t place(std::size_t k, std::size_t m) const noexcept {
    return (k / strip * (grid_.rows + 1) + m) * strip + k % strip;
  }
  void transform_rows(std::span<const double> from, const Places& places,
                      std::span<Complex> rows) noexcept;
  void transform_back(std::span<const Complex> rows, const Places& places,
                      std::span<double> to) noexcept;
  /// out_[o] += column k of a response times in_[i]; of input 0 first it is what there is.
  void add_product(const Response& response, std::size_t k, bool transposed, std::size_t i,
                   std::size_t o, std::size_t parity) noexcept;
  void multiply_column(std::size_t k, const Places& from, const Places& to, std::size_t inputs,
                       std::size_t outputs, bool transposed) noexcept;
  void multiply(std::span<const double> from, const Places& from_places, std::size_t inputs,
                std::span<double> to, const Places& to_places, std::size_t outputs,
                bool transposed) noexcept;

  static constexpr std::size_t strip = 16;

  SurfaceGrid grid_;
  std::size_t components_, channels_;
  Places cells_, taxels_;
  RealFft along_row_, back_along_row_;
  std::size_t half_;                 // of a column
  std::vector<Complex> half_turns_;  // exp(-i pi m / half_)
  std::vector<Column> in_, out_;
  std::vector<std::vector<Complex>> rows_;  // of each input, then of each output
  std::vector<Response> responses_;         // channels x components
};

}  // namespace tactile_net
