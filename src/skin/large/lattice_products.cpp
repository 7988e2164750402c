#include "skin/large/lattice_products.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactile_net {
std::vector<LatticeKernel> lattice_kernels(const SkinArray& skin, const Material& material,
                                           const SurfaceGrid& grid, std::size_t components) {
  CellKernels kernels(material, grid);
  std::vector<LatticeKernel> all;
  for (const Channel& channel : channels(skin))
    for (std::size_t u = 0; u < components; ++u)
      all.emplace_back(kernels(channel.depth), channel.quantity, skin_tractions[u], grid);
  return all;
}

LatticeProducts::LatticeProducts(const SkinArray& skin, const SurfaceGrid& grid,
                                 std::size_t components, std::span<const LatticeKernel> kernels)
    : grid_(grid),
      components_(components),
      channels_(channel_count(skin)),
      cells_{0, 1, grid.rows, 0, 1, grid.columns},
      taxels_{grid.margin_rows,    grid.stride_rows,    skin.rows,
              grid.margin_columns, grid.stride_columns, skin.columns},
      along_row_(RealFft::fast_size(2 * grid.columns - 1)),
      back_along_row_(along_row_),
      half_(RealFft::fast_size(grid.rows)) {
  for (std::size_t m = 0; m < half_; ++m)
    half_turns_.push_back(
        std::polar(1.0, -std::numbers::pi * static_cast<double>(m) / static_cast<double>(half_)));
  const std::size_t most = std::max(components_, channels_);
  const ComplexFft half(half_);
  const Column column{half, half};
  in_ = std::vector<Column>(most, column);
  out_ = std::vector<Column>(most, column);
  const std::size_t strips = (bins() + strip - 1) / strip;
  rows_ = std::vector<std::vector<Complex>>(most, std::vector<Complex>(place(strips * strip, 0)));
  const std::vector<Channel> all = channels(skin);
  for (std::size_t c = 0; c < channels_; ++c)
    for (std::size_t u = 0; u < components_; ++u)
      add_response(kernels[c * components_ + u],
                   is_odd(all[c].quantity, skin_tractions[u], Axis::y),
                   is_odd(all[c].quantity, skin_tractions[u], Axis::z));
}

void LatticeProducts::add_response(const LatticeKernel& kernel, bool is_odd_y, bool is_odd_z) {
  const std::size_t rows = 2 * half_;
  ComplexFft column(rows);
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
  Response response{{}, is_odd_y != is_odd_z, is_odd_y ? -1.0 : 1.0};
  const double scale = 1.0 / static_cast<double>(rows) / static_cast<double>(columns);
  for (std::size_t k = 0; k < bins(); ++k) {
    for (std::size_t m = 0; m < rows; ++m) column.samples()[m] = plane[m * bins() + k];
    column.forward();
    const auto keep = [&](Complex value) {
      response.values.push_back(scale * (response.imaginary ? value.imag() : value.real()));
    };
    for (std::size_t m = 0; m <= half_; m += 2) keep(column.bins()[m]);
    for (std::size_t m = 1; m < half_; m += 2) keep(column.bins()[m]);
  }
  responses_.push_back(std::move(response));
}

void LatticeProducts::transform_rows(std::span<const double> from, const Places& places,
                                     std::span<Complex> rows) noexcept {
  const auto samples = along_row_.samples();
  std::fill(samples.begin(), samples.end(), 0.0);
  for (std::size_t i = 0; i < places.rows; ++i) {
    for (std::size_t j = 0; j < places.columns; ++j)
      samples[places.column(j)] = from[i * places.columns + j];
    along_row_.forward();
    const auto row = along_row_.bins();
    for (std::size_t k = 0; k < row.size(); k += strip) {
      Complex* to = rows.data() + place(k, i);
      const std::size_t some = std::min(strip, row.size() - k);
      for (std::size_t j = 0; j < some; ++j) to[j] = row[k + j];
    }
  }
}

void LatticeProducts::transform_back(std::span<const Complex> rows, const Places& places,
                                     std::span<double> to) noexcept {
  for (std::size_t i = 0; i < places.rows; ++i) {
    const auto row = back_along_row_.bins();
    for (std::size_t k = 0; k < row.size(); k += strip)
      std::copy_n(rows.data() + place(k, i), std::min(strip, row.size() - k), row.data() + k);
    back_along_row_.backward();
    for (std::size_t j = 0; j < places.columns; ++j)
      to[i * places.columns + j] = back_along_row_.samples()[places.column(j)];
  }
}

namespace {

/// to += response from, or i response from, the response being `size` times the numbers of the
/// first half and `mirrored` times them, backwards, of the second; or to is set so.
template <bool imaginary, bool is_first>
void add_mirrored(std::span<const double> half, double size, double mirrored,
                  std::span<const std::complex<double>> from,
                  std::span<std::complex<double>> to) noexcept {
  const auto add = [&](std::size_t m, double response) {
    const std::complex<double> product =
        imaginary ? std::complex(-response * from[m].imag(), response * from[m].real())
                  : response * from[m];
    to[m] = is_first ? product : to[m] + product;
  };
  const std::size_t last = to.size() - 1;
  for (std::size_t m = 0; m < to.size() / 2; ++m) {
    add(m, size * half[m]);
    add(last - m, mirrored * half[m]);
  }
  if (last % 2 == 0) add(last / 2, size * half[last / 2]);
}

}  // namespace

void LatticeProducts::add_product(const Response& response, std::size_t k, bool transposed,
                                  std::size_t i, std::size_t o, std::size_t parity) noexcept {
  const auto values = std::span(response.values).subspan(k * (half_ + 1), half_ + 1);
  const auto add = response.imaginary
                       ? i == 0 ? add_mirrored<true, true> : add_mirrored<true, false>
                   : i == 0 ? add_mirrored<false, true>
                            : add_mirrored<false, false>;
  const double size = response.imaginary && transposed ? -1.0 : 1.0;
  const double mirrored = size * response.mirrored;
  const std::span<const Complex> from = in_[i][parity].bins();
  const auto to = out_[o][parity].bins();
  if (parity == 1) return add(values.last(half_ / 2), size, mirrored, from, to);
  add(values.first(1), size, mirrored, from.first(1), to.first(1));
  add(values.subspan(1, half_ / 2), size, mirrored, from.subspan(1), to.subspan(1));
}

void LatticeProducts::multiply_column(std::size_t k, const Places& from, const Places& to,
                                      std::size_t inputs, std::size_t outputs,
                                      bool transposed) noexcept {
  for (std::size_t i = 0; i < inputs; ++i) {
    const auto even = in_[i][0].samples();
    const auto odd = in_[i][1].samples();
    const Complex* value = rows_[i].data() + place(k, 0);
    for (std::size_t m = 0; m < from.rows; ++m, value += strip) {
      even[from.row(m)] = *value;
      odd[from.row(m)] = product(half_turns_[from.row(m)], *value);
    }
  }
  for (const std::size_t parity : {0U, 1U}) {
    for (std::size_t i = 0; i < inputs; ++i) in_[i][parity].forward();
    for (std::size_t o = 0; o < outputs; ++o) {
      for (std::size_t i = 0; i < inputs; ++i)
        add_product(responses_[transposed ? i * outputs + o : o * inputs + i], k, transposed, i, o,
                    parity);
      out_[o][parity].backward();
    }
  }
  for (std::size_t o = 0; o < outputs; ++o) {
    const auto even = out_[o][0].samples();
    const auto odd = out_[o][1].samples();
    Complex* value = rows_[o].data() + place(k, 0);
    for (std::size_t m = 0; m < to.rows; ++m, value += strip)
      *value = even[to.row(m)] + conjugate_product(half_turns_[to.row(m)], odd[to.row(m)]);
  }
}

void LatticeProducts::multiply(std::span<const double> from, const Places& from_places,
                               std::size_t inputs, std::span<double> to, const Places& to_places,
                               std::size_t outputs, bool transposed) noexcept {
  for (std::size_t i = 0; i < inputs; ++i)
    transform_rows(from.subspan(i * from_places.count(), from_places.count()), from_places,
                   rows_[i]);
  // What is written next to it is the same for all columns.
  for (Column& column : in_)
    for (ComplexFft& half : column)
      std::fill(half.samples().begin(), half.samples().end(), Complex{});
  for (std::size_t k = 0; k < bins(); ++k)
    multiply_column(k, from_places, to_places, inputs, outputs, transposed);
  for (std::size_t o = 0; o < outputs; ++o)
    transform_back(rows_[o], to_places, to.subspan(o * to_places.count(), to_places.count()));
}

void LatticeProducts::readings(std::span<const double> tractions,
                               std::span<double> readings) noexcept {
  multiply(tractions, cells_, components_, readings, taxels_, channels_, false);
}

void LatticeProducts::sums(std::span<const double> readings, std::span<double> tractions) noexcept {
  multiply(readings, taxels_, channels_, tractions, cells_, components_, true);
}

}  // namespace tactile_net
