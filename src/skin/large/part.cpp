#include "tactile_net/skin/large/part.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "skin/large/system.hpp"

namespace tactile_net {
namespace {

/// Along one axis: taxels [first, first + count).
struct Range {
  std::size_t first, count;
};

/// The taxels within `reach` of the cells [least, most].
Range taxels_about(std::size_t least, std::size_t most, std::size_t margin, std::size_t stride,
                   std::size_t taxels, double reach) {
  const auto cells_out = static_cast<std::size_t>(std::min(std::ceil(reach), 1e6));
  const std::size_t before = margin + cells_out;
  const std::size_t first = least > before ? (least - before) / stride : 0;
  const std::size_t end = most + cells_out > margin ? (most + cells_out - margin) / stride + 2 : 1;
  // A part of a single row would have a spacing of its own along it.
  const std::size_t last = std::max(std::min(end, taxels), std::min(taxels, std::size_t{2}));
  const std::size_t from = std::min(first, last - std::min(last, std::size_t{2}));
  return {from, last - from};
}

}  // namespace

LargeSkinPart::LargeSkinPart(SkinArray skin, const Material& material, SkinProblemOptions options,
                             const LinearProblem& whole, std::span<const std::size_t> cells,
                             double reach)
    : whole_(whole.grid) {
  std::size_t least_row = whole_.rows;
  std::size_t most_row = 0;
  std::size_t least_column = whole_.columns;
  std::size_t most_column = 0;
  for (const std::size_t cell : cells) {
    if (cell >= whole_.count()) throw std::invalid_argument("a cell of another grid");
    least_row = std::min(least_row, cell / whole_.columns);
    most_row = std::max(most_row, cell / whole_.columns);
    least_column = std::min(least_column, cell % whole_.columns);
    most_column = std::max(most_column, cell % whole_.columns);
  }
  if (least_row > most_row) throw std::invalid_argument("a part of a skin needs a cell");
  const Range rows = taxels_about(least_row, most_row, whole_.margin_rows, whole_.stride_rows,
                                  skin.rows, reach / whole_.spacing_y);
  const Range columns = taxels_about(least_column, most_column, whole_.margin_columns,
                                     whole_.stride_columns, skin.columns, reach / whole_.spacing_z);
  first_row_ = rows.first * whole_.stride_rows;
  first_column_ = columns.first * whole_.stride_columns;
  for (const Channel& channel : channels(skin))
    for (std::size_t row = rows.first; row < rows.first + rows.count; ++row)
      for (std::size_t column = columns.first; column < columns.first + columns.count; ++column)
        readings_.push_back(channel.first + row * skin.columns + column);

  skin.rows = rows.count;
  skin.columns = columns.count;
  options.dead_taxels.clear();
  options.smoothing_length = whole.smoothing_length;
  system_ = std::make_shared<LargeSkinSystem>(skin, material, options);
  system_->problem.weights = readings(whole.weights);
}

std::vector<double> LargeSkinPart::readings(std::span<const double> whole) const {
  std::vector<double> part;
  part.reserve(readings_.size());
  for (const std::size_t at : readings_) part.push_back(whole[at]);
  return part;
}

std::vector<double> LargeSkinPart::tractions(std::span<const double> whole) const {
  const SurfaceGrid& own = system_->problem.grid;
  std::vector<double> part;
  part.reserve(system_->tractions());
  for (std::size_t u = 0; u < system_->problem.components; ++u)
    for (std::size_t row = 0; row < own.rows; ++row) {
      const auto from = whole.begin() + static_cast<std::ptrdiff_t>(
                                            u * whole_.count() +
                                            (first_row_ + row) * whole_.columns + first_column_);
      part.insert(part.end(), from, from + static_cast<std::ptrdiff_t>(own.columns));
    }
  return part;
}

std::vector<double> LargeSkinPart::among_all(std::span<const double> part) const {
  const SurfaceGrid& own = system_->problem.grid;
  std::vector<double> whole(system_->problem.components * whole_.count());
  auto from = part.begin();
  for (std::size_t u = 0; u < system_->problem.components; ++u)
    for (std::size_t row = 0; row < own.rows; ++row) {
      std::copy_n(from, own.columns,
                  whole.begin() + static_cast<std::ptrdiff_t>(u * whole_.count() +
                                                              (first_row_ + row) * whole_.columns +
                                                              first_column_));
      from += static_cast<std::ptrdiff_t>(own.columns);
    }
  return whole;
}

bool LargeSkinPart::has(std::size_t whole_cell) const noexcept {
  const SurfaceGrid& own = system_->problem.grid;
  const std::size_t row = whole_cell / whole_.columns;
  const std::size_t column = whole_cell % whole_.columns;
  return row >= first_row_ && row < first_row_ + own.rows && column >= first_column_ &&
         column < first_column_ + own.columns;
}

std::size_t LargeSkinPart::cell(std::size_t whole_cell) const noexcept {
  return (whole_cell / whole_.columns - first_row_) * system_->problem.grid.columns +
         whole_cell % whole_.columns - first_column_;
}

ActiveFace LargeSkinPart::face(const ActiveFace& whole) const {
  ActiveFace part;
  for (const ActiveFace::Direction& one : whole.free)
    if (has(one.cell)) part.free.push_back({cell(one.cell), one.along});
  return part;
}

}  // namespace tactile_net
