/// @file
/// K f and K' g of taxels on the lattice of the cells, by FFT. Private.
#pragma once

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
                                                         const SkinGrid& grid,
                                                         std::size_t components);

/// Transforms on a plane of at least twice the cells, so that nothing meets what it should not: row
/// by row, and only of rows that hold something; then column by column, from the transform of the
/// components over the kernels' spectra to what the channels read, while a column is at hand. A
/// kernel is even or odd, so that its spectrum is a real number times 1, i or -1.
class LatticeProducts {
 public:
  /// @pre  the taxels lie on the grid's lattice
  /// @param kernels  as `lattice_kernels`
  LatticeProducts(const SkinArray& skin, const SkinGrid& grid, std::size_t components,
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
  /// A column's numbers one after the other: the spectrum, or that over i.
  struct Response {
    std::vector<double> values;
    bool imaginary;
  };

  [[nodiscard]] std::size_t bins() noexcept { return along_row_.bins().size(); }
  /// Of all rows, and half of the columns.
  void add_response(const LatticeKernel& kernel, bool imaginary);
  void transform_rows(std::span<const double> from, const Places& places,
                      std::vector<Complex>& rows) noexcept;
  void transform_back(const std::vector<Complex>& rows, const Places& places,
                      std::span<double> to) noexcept;
  /// Columns [first, first + some) of the rows that came in, one after the other in `block_in_`.
  void gather(std::size_t first, std::size_t some, std::size_t inputs, std::size_t rows) noexcept;
  /// From `block_out_` to the rows that go out.
  void scatter(std::size_t first, std::size_t some, std::size_t outputs, std::size_t rows) noexcept;
  /// Column k, number `in_block` of its block.
  void multiply_column(std::size_t k, std::size_t in_block, const Places& from, const Places& to,
                       std::size_t inputs, std::size_t outputs, bool transposed) noexcept;
  void multiply(std::span<const double> from, const Places& from_places, std::size_t inputs,
                std::span<double> to, const Places& to_places, std::size_t outputs,
                bool transposed) noexcept;

  SkinGrid grid_;
  std::size_t components_, channels_;
  Places cells_, taxels_;
  RealFft along_row_, back_along_row_;
  std::vector<ComplexFft> in_, out_;  // a column each, of each input and output
  std::vector<std::vector<Complex>> rows_in_, rows_out_;
  std::vector<std::vector<Complex>> block_in_, block_out_;  // some columns at a time
  std::vector<Response> responses_;                         // channels x components
};

}  // namespace tactile_net
