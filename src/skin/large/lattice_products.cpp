#include "skin/large/lattice_products.hpp"

#include <algorithm>

namespace tactile_net {
namespace {

/// Columns that are taken out of the rows at a time: a column alone would touch a page for each
/// row.
constexpr std::size_t block = 8;

}  // namespace

std::vector<LatticeKernel> lattice_kernels(const SkinArray& skin, const Material& material,
                                           const SkinGrid& grid, std::size_t components) {
  CellKernels kernels(material, grid);
  std::vector<LatticeKernel> all;
  for (const SkinChannel& channel : channels(skin))
    for (std::size_t u = 0; u < components; ++u)
      all.emplace_back(kernels(channel.depth), channel.quantity, skin_tractions[u], grid);
  return all;
}

LatticeProducts::LatticeProducts(const SkinArray& skin, const SkinGrid& grid,
                                 std::size_t components, std::span<const LatticeKernel> kernels)
    : grid_(grid),
      components_(components),
      channels_(channel_count(skin)),
      cells_{0, 1, grid.rows, 0, 1, grid.columns},
      taxels_{grid.margin_rows,    grid.stride_rows,    skin.rows,
              grid.margin_columns, grid.stride_columns, skin.columns},
      along_row_(RealFft::fast_size(2 * grid.columns - 1)),
      back_along_row_(along_row_) {
  const ComplexFft column(RealFft::fast_size(2 * grid.rows - 1));
  const std::size_t most = std::max(components_, channels_);
  in_ = std::vector<ComplexFft>(most, column);
  out_ = std::vector<ComplexFft>(most, column);
  rows_in_ = std::vector<std::vector<Complex>>(most, std::vector<Complex>(grid.rows * bins()));
  rows_out_ = rows_in_;
  block_in_ = std::vector<std::vector<Complex>>(most, std::vector<Complex>(block * grid.rows));
  block_out_ = block_in_;
  const std::vector<SkinChannel> all = channels(skin);
  for (std::size_t c = 0; c < channels_; ++c)
    for (std::size_t u = 0; u < components_; ++u)
      add_response(kernels[c * components_ + u],
                   is_odd(all[c].quantity, skin_tractions[u], Axis::y) !=
                       is_odd(all[c].quantity, skin_tractions[u], Axis::z));
}

void LatticeProducts::add_response(const LatticeKernel& kernel, bool imaginary) {
  ComplexFft& column = in_.front();
  const std::size_t rows = column.values().size();
  const std::size_t columns = along_row_.size();
  std::vector<Complex> plane(rows * bins());
  for (std::size_t m = 0; m < rows; ++m) {
    const auto samples = along_row_.samples();
    std::fill(samples.begin(), samples.end(), 0.0);
    if (m >= grid_.rows && rows - m >= grid_.rows) continue;
    const std::size_t before = m < grid_.rows ? 0 : rows - m;
    for (std::size_t n = 0; n < grid_.columns; ++n) {
      samples[n] = kernel(before == 0 ? m : 0, n, before, 0);
      if (n > 0) samples[columns - n] = kernel(before == 0 ? m : 0, 0, before, n);
    }
    along_row_.forward();
    std::copy(along_row_.bins().begin(), along_row_.bins().end(),
              plane.begin() + static_cast<std::ptrdiff_t>(m * bins()));
  }
  const auto samples = along_row_.samples();
  std::fill(samples.begin(), samples.end(), 0.0);
  Response response{std::vector<double>(rows * bins()), imaginary};
  const double scale = 1.0 / static_cast<double>(rows) / static_cast<double>(columns);
  for (std::size_t k = 0; k < bins(); ++k) {
    for (std::size_t m = 0; m < rows; ++m) column.values()[m] = plane[m * bins() + k];
    column.forward();
    for (std::size_t m = 0; m < rows; ++m) {
      const Complex value = column.values()[m];
      response.values[k * rows + m] = scale * (imaginary ? value.imag() : value.real());
    }
  }
  responses_.push_back(std::move(response));
}

void LatticeProducts::transform_rows(std::span<const double> from, const Places& places,
                                     std::vector<Complex>& rows) noexcept {
  const auto samples = along_row_.samples();
  std::fill(samples.begin(), samples.end(), 0.0);
  for (std::size_t i = 0; i < places.rows; ++i) {
    for (std::size_t j = 0; j < places.columns; ++j)
      samples[places.column(j)] = from[i * places.columns + j];
    along_row_.forward();
    std::copy(along_row_.bins().begin(), along_row_.bins().end(),
              rows.begin() + static_cast<std::ptrdiff_t>(i * bins()));
  }
}

void LatticeProducts::transform_back(const std::vector<Complex>& rows, const Places& places,
                                     std::span<double> to) noexcept {
  for (std::size_t i = 0; i < places.rows; ++i) {
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(i * bins()), bins(),
                back_along_row_.bins().begin());
    back_along_row_.backward();
    for (std::size_t j = 0; j < places.columns; ++j)
      to[i * places.columns + j] = back_along_row_.samples()[places.column(j)];
  }
}

namespace {

/// to += response from, to += i response from, or to -= i response from.
void add_product(std::span<const double> response, std::span<const std::complex<double>> from,
                 double turn, std::span<std::complex<double>> to) noexcept {
  if (turn == 0.0)
    for (std::size_t m = 0; m < to.size(); ++m) to[m] += response[m] * from[m];
  else
    for (std::size_t m = 0; m < to.size(); ++m) {
      const double size = turn * response[m];
      to[m] += std::complex<double>(-size * from[m].imag(), size * from[m].real());
    }
}

}  // namespace

void LatticeProducts::gather(std::size_t first, std::size_t some, std::size_t inputs,
                             std::size_t rows) noexcept {
  for (std::size_t i = 0; i < inputs; ++i)
    for (std::size_t m = 0; m < rows; ++m) {
      const Complex* from = rows_in_[i].data() + m * bins() + first;
      Complex* to = block_in_[i].data() + m;
      for (std::size_t j = 0; j < some; ++j) to[j * rows] = from[j];
    }
}

void LatticeProducts::scatter(std::size_t first, std::size_t some, std::size_t outputs,
                              std::size_t rows) noexcept {
  for (std::size_t o = 0; o < outputs; ++o)
    for (std::size_t m = 0; m < rows; ++m) {
      const Complex* from = block_out_[o].data() + m;
      Complex* to = rows_out_[o].data() + m * bins() + first;
      for (std::size_t j = 0; j < some; ++j) to[j] = from[j * rows];
    }
}

void LatticeProducts::multiply_column(std::size_t k, std::size_t in_block, const Places& from,
                                      const Places& to, std::size_t inputs, std::size_t outputs,
                                      bool transposed) noexcept {
  for (std::size_t i = 0; i < inputs; ++i) {
    const auto column = in_[i].values();
    std::fill(column.begin(), column.end(), Complex{});
    const Complex* value = block_in_[i].data() + in_block * from.rows;
    for (std::size_t m = 0; m < from.rows; ++m) column[from.row(m)] = value[m];
    in_[i].forward();
  }
  for (std::size_t o = 0; o < outputs; ++o) {
    const auto column = out_[o].values();
    std::fill(column.begin(), column.end(), Complex{});
    for (std::size_t i = 0; i < inputs; ++i) {
      const Response& response = responses_[transposed ? i * outputs + o : o * inputs + i];
      const double turn = !response.imaginary ? 0.0 : transposed ? -1.0 : 1.0;
      add_product(std::span(response.values).subspan(k * column.size(), column.size()),
                  in_[i].values(), turn, column);
    }
    out_[o].backward();
    Complex* value = block_out_[o].data() + in_block * to.rows;
    for (std::size_t m = 0; m < to.rows; ++m) value[m] = column[to.row(m)];
  }
}

void LatticeProducts::multiply(std::span<const double> from, const Places& from_places,
                               std::size_t inputs, std::span<double> to, const Places& to_places,
                               std::size_t outputs, bool transposed) noexcept {
  for (std::size_t i = 0; i < inputs; ++i)
    transform_rows(from.subspan(i * from_places.count(), from_places.count()), from_places,
                   rows_in_[i]);
  for (std::size_t first = 0; first < bins(); first += block) {
    const std::size_t some = std::min(block, bins() - first);
    gather(first, some, inputs, from_places.rows);
    for (std::size_t j = 0; j < some; ++j)
      multiply_column(first + j, j, from_places, to_places, inputs, outputs, transposed);
    scatter(first, some, outputs, to_places.rows);
  }
  for (std::size_t o = 0; o < outputs; ++o)
    transform_back(rows_out_[o], to_places, to.subspan(o * to_places.count(), to_places.count()));
}

void LatticeProducts::readings(std::span<const double> tractions,
                               std::span<double> readings) noexcept {
  multiply(tractions, cells_, components_, readings, taxels_, channels_, false);
}

void LatticeProducts::sums(std::span<const double> readings, std::span<double> tractions) noexcept {
  multiply(readings, taxels_, channels_, tractions, cells_, components_, true);
}

}  // namespace tactile_net
