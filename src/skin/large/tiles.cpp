#include "skin/large/tiles.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

/// Tiles solved at once.
constexpr std::size_t batch = 64;

/// What numbers of even or odd parity along one side have of the place `at`.
struct Share {
  std::size_t place;
  double size;
};

/// @param parity  1 or -1; 0: the side has no reflection, and every number stands alone
Share share(std::size_t at, std::size_t count, int parity) {
  const std::size_t mirror = count - 1 - at;
  if (parity == 0) return {at, 1.0};
  if (at == mirror) return {at, parity > 0 ? 1.0 : 0.0};
  const double half = std::sqrt(0.5);
  return at < mirror ? Share{at, half} : Share{mirror, parity * half};
}

TileClass tile_class(const TileShape& shape, int parity_y, int parity_z) {
  TileClass made;
  std::vector<Index> place_of(shape.tractions(), -1);
  for (std::size_t u = 0; u < shape.components; ++u)
    for (std::size_t m = 0; m < shape.rows; ++m)
      for (std::size_t n = 0; n < shape.columns; ++n) {
        const Share y = share(m, shape.rows, u == 1 ? -parity_y : parity_y);
        const Share z = share(n, shape.columns, u == 2 ? -parity_z : parity_z);
        const double size = y.size * z.size;
        Index& place = place_of[(u * shape.rows + y.place) * shape.columns + z.place];
        if (size != 0.0 && place < 0) place = made.size++;
        made.places.push_back(size != 0.0 ? place : 0);
        made.shares.push_back(size);
      }
  return made;
}

}  // namespace

void TileClass::fold(const Eigen::Ref<const Eigen::MatrixXd>& x,
                     Eigen::Ref<Eigen::MatrixXd> folded) const {
  folded.setZero();
  for (Index column = 0; column < x.cols(); ++column) {
    const double* from = x.col(column).data();
    double* to = folded.col(column).data();
    for (std::size_t i = 0; i < places.size(); ++i) to[places[i]] += shares[i] * from[i];
  }
}

void TileClass::add_unfolded(const Eigen::Ref<const Eigen::MatrixXd>& folded,
                             Eigen::Ref<Eigen::MatrixXd> x) const {
  for (Index column = 0; column < x.cols(); ++column) {
    const double* from = folded.col(column).data();
    double* to = x.col(column).data();
    for (std::size_t i = 0; i < places.size(); ++i) to[i] += shares[i] * from[places[i]];
  }
}

void TileClass::add_entry(std::size_t a, std::size_t b, double value,
                          Eigen::MatrixXd& folded) const {
  const auto [less, more] = std::minmax(places[a], places[b]);
  const double folded_value = shares[a] * shares[b] * value;
  // Off A's diagonal there are two, which meet on that of the class where a mirrors b.
  folded(more, less) += a != b && less == more ? 2.0 * folded_value : folded_value;
}

std::vector<TileClass> tile_classes(const TileShape& shape) {
  const auto parities = [](bool mirrors) { return mirrors ? std::vector{1, -1} : std::vector{0}; };
  std::vector<TileClass> all;
  for (const int parity_y : parities(shape.mirrors_y))
    for (const int parity_z : parities(shape.mirrors_z)) {
      TileClass made = tile_class(shape, parity_y, parity_z);
      if (made.size > 0) all.push_back(std::move(made));
    }
  return all;
}

TileBlock::TileBlock(std::vector<TileClass> classes, const std::vector<Eigen::MatrixXd>& folded)
    : classes_(std::move(classes)), factors_(folded.begin(), folded.end()) {}

bool TileBlock::is_positive_definite() const noexcept {
  return std::all_of(factors_.begin(), factors_.end(),
                     [](const Cholesky& factor) { return factor.is_positive_definite(); });
}

void TileBlock::solve_in_place(Eigen::Ref<Eigen::MatrixXd> x) const {
  if (classes_.size() == 1) return factors_.front().solve_in_place(x);
  std::vector<Eigen::MatrixXd> folded;
  for (const TileClass& one : classes_) {
    folded.emplace_back(one.size, x.cols());
    one.fold(x, folded.back());
  }
  x.setZero();
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    factors_[i].solve_in_place(folded[i]);
    classes_[i].add_unfolded(folded[i], x);
  }
}

SkinTiles::SkinTiles(const LargeSkinSystem& system, double alpha, const Size& size)
    : system_(system), alpha_(alpha), reach_(size.reach) {
  const SurfaceGrid& grid = system.problem.grid;
  rows_ = side(grid.rows, grid.stride_rows, size.cells);
  columns_ = side(grid.columns, grid.stride_columns, size.cells);
  for (const Channel& channel : channels(system.skin)) {
    double most = 0.0;
    for (std::size_t i = 0; i < channel.count; ++i)
      most = std::max(most, system.problem.weights[channel.first + i]);
    channel_weights_.push_back(most);
  }
  const std::vector<bool> dead = dead_taxels(system.problem);
  for (const std::size_t row : starts(grid.rows, rows_, grid.stride_rows))
    for (const std::size_t column : starts(grid.columns, columns_, grid.stride_columns)) {
      const Line y =
          line(row, rows_, grid.rows, grid.margin_rows, grid.stride_rows, system.skin.rows);
      const Line z = line(column, columns_, grid.columns, grid.margin_columns, grid.stride_columns,
                          system.skin.columns);
      tiles_.push_back({.row = row,
                        .column = column,
                        .mirrored_y = y.mirrored,
                        .mirrored_z = z.mirrored,
                        .dead = {},
                        .kind = kind_of(y, z)});
      account_for_dead(tiles_.back(), dead);
    }
  std::stable_sort(tiles_.begin(), tiles_.end(),
                   [](const Tile& a, const Tile& b) { return a.kind < b.kind; });
  values_.resize(static_cast<Index>(system.problem.components * rows_ * columns_),
                 static_cast<Index>(std::min(batch, tiles_.size())));
}

/// So that the taxels of a tile away from the ends mirror themselves, as those of the grid do.
std::size_t SkinTiles::side(std::size_t cells, std::size_t stride, std::size_t most) {
  most = std::max(most, 2 * stride);
  return cells <= most ? cells : cells - (cells - most + stride - 1) / stride * stride;
}

/// Evenly, and from both ends alike, so that tiles mirror each other; they overlap by half at
/// least.
std::vector<std::size_t> SkinTiles::starts(std::size_t cells, std::size_t side,
                                           std::size_t stride) {
  const std::size_t step = std::max(side / 2 / stride, std::size_t{1});  // in strides, as `last`
  const std::size_t last = (cells - side) / stride;
  const std::size_t steps = (last + step - 1) / step;
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i <= steps; ++i) {
    const std::size_t from_end = std::min(i, steps - i);
    const std::size_t at = steps == 0 ? 0 : (last * from_end + steps - 1) / steps;
    all.push_back((2 * i <= steps ? at : last - at) * stride);
  }
  return all;
}

SkinTiles::Line SkinTiles::line(std::size_t start, std::size_t side, std::size_t cells,
                                std::size_t margin, std::size_t stride, std::size_t taxels) const {
  Line own{.at_start = start == 0, .at_end = start + side == cells};
  Line other{.at_start = own.at_end, .at_end = own.at_start, .mirrored = true};
  for (std::size_t i = 0; i < taxels; ++i) {
    const std::size_t cell = margin + i * stride;
    if (cell + reach_ < start || cell >= start + side + reach_) continue;
    const auto from = static_cast<std::ptrdiff_t>(cell) - static_cast<std::ptrdiff_t>(start);
    own.taxels.push_back(from);
    other.taxels.insert(other.taxels.begin(), static_cast<std::ptrdiff_t>(side) - 1 - from);
  }
  const auto key = [](const Line& one) {
    return std::tuple(!one.at_start, one.at_end, one.taxels);
  };
  own.mirrors_itself = other.mirrors_itself = key(other) == key(own);
  return key(other) < key(own) ? other : own;
}

std::size_t SkinTiles::kind_of(const Line& y, const Line& z) {
  const auto alike = [](const Line& a, const Line& b) {
    return a.at_start == b.at_start && a.at_end == b.at_end && a.taxels == b.taxels;
  };
  const auto found = std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& kind) {
    return alike(kind.y, y) && alike(kind.z, z);
  });
  if (found != kinds_.end()) return static_cast<std::size_t>(found - kinds_.begin());
  kinds_.push_back({y, z, block(y, z)});
  require_definite(kinds_.back().block.is_positive_definite());
  return kinds_.size() - 1;
}

void SkinTiles::kernel_row(std::size_t channel, std::ptrdiff_t row, std::ptrdiff_t column,
                           Eigen::Ref<Eigen::VectorXd> entries) const {
  const auto up = static_cast<std::ptrdiff_t>(reach_);
  const auto at_row = static_cast<std::size_t>(row + up);
  const auto at_column = static_cast<std::size_t>(column + up);
  Index at = 0;
  for (std::size_t u = 0; u < system_.problem.components; ++u) {
    const LatticeKernel& kernel = system_.kernels[channel * system_.problem.components + u];
    for (std::size_t m = 0; m < rows_; ++m)
      for (std::size_t n = 0; n < columns_; ++n)
        entries(at++) =
            channel_weights_[channel] * kernel(at_row, at_column, m + reach_, n + reach_);
  }
}

TileBlock SkinTiles::block(const Line& y, const Line& z) const {
  const TileShape shape{system_.problem.components, rows_, columns_, y.mirrors_itself,
                        z.mirrors_itself};
  std::vector<TileClass> classes = tile_classes(shape);
  // Taxels that mirror each other tell of a class the same: one of them, for both.
  const auto taxels = [](const Line& line, std::size_t side) {
    std::vector<std::pair<std::ptrdiff_t, double>> all;  // and how many it stands for
    for (const std::ptrdiff_t at : line.taxels) {
      const std::ptrdiff_t mirror = static_cast<std::ptrdiff_t>(side) - 1 - at;
      if (line.mirrors_itself && mirror < at) break;
      all.emplace_back(at, line.mirrors_itself && mirror != at ? 2.0 : 1.0);
    }
    return all;
  };
  const auto along_y = taxels(y, rows_);
  const auto along_z = taxels(z, columns_);
  const Index count = std::ssize(channel_weights_) * std::ssize(along_y) * std::ssize(along_z);
  std::vector<Eigen::MatrixXd> rows;
  rows.reserve(classes.size());
  for (const TileClass& one : classes) rows.emplace_back(one.size, count);
  Eigen::VectorXd row(static_cast<Index>(shape.tractions()));
  Index at = 0;
  for (std::size_t c = 0; c < channel_weights_.size(); ++c)
    for (const auto& [of_row, twins_y] : along_y)
      for (const auto& [of_column, twins_z] : along_z) {
        kernel_row(c, of_row, of_column, row);
        row *= std::sqrt(twins_y * twins_z);
        for (std::size_t i = 0; i < classes.size(); ++i) classes[i].fold(row, rows[i].col(at));
        ++at;
      }
  std::vector<Eigen::MatrixXd> folded;
  for (const Eigen::MatrixXd& of_class : rows) {
    folded.emplace_back(Eigen::MatrixXd::Zero(of_class.rows(), of_class.rows()));
    // Beyond the taxels nothing is read: the stabiliser alone. Eigen divides by the columns.
    if (count > 0) folded.back().selfadjointView<Eigen::Lower>().rankUpdate(of_class);
  }
  add_stabiliser(y, z, classes, folded);
  return {std::move(classes), folded};
}

/// Cells beyond a tile are held at 0, those beyond the grid's ends do not exist.
void SkinTiles::add_stabiliser(const Line& y, const Line& z, std::span<const TileClass> classes,
                               std::span<Eigen::MatrixXd> folded) const {
  const auto add = [&](std::size_t a, std::size_t b, double value) {
    for (std::size_t i = 0; i < classes.size(); ++i) classes[i].add_entry(a, b, value, folded[i]);
  };
  const LinearProblem& problem = system_.problem;
  const double along_y = std::pow(problem.smoothing_length / problem.grid.spacing_y, 2);
  const double along_z = std::pow(problem.smoothing_length / problem.grid.spacing_z, 2);
  for (std::size_t u = 0; u < problem.components; ++u) {
    const double size = std::pow(system_.size_of(alpha_, u), 2);
    for (std::size_t m = 0; m < rows_; ++m)
      for (std::size_t n = 0; n < columns_; ++n) {
        const std::size_t at = (u * rows_ + m) * columns_ + n;
        double own = 1.0;
        if (m > 0 || !y.at_start) own += along_y;
        if (m + 1 < rows_ || !y.at_end) own += along_y;
        if (n > 0 || !z.at_start) own += along_z;
        if (n + 1 < columns_ || !z.at_end) own += along_z;
        add(at, at, size * own);
        if (m + 1 < rows_) add(at, at + columns_, -size * along_y);
        if (n + 1 < columns_) add(at, at + 1, -size * along_z);
      }
  }
}

void SkinTiles::account_for_dead(Tile& tile, const std::vector<bool>& dead) const {
  const SurfaceGrid& grid = system_.problem.grid;
  std::vector<LatticeCell> places;
  for (std::size_t taxel = 0; taxel < dead.size(); ++taxel) {
    if (!dead[taxel]) continue;
    const LatticeCell cell = cell_of(system_.skin, grid, taxel);
    const auto in_reach = [&](std::size_t at, std::size_t start, std::size_t side) {
      return at + reach_ >= start && at < start + side + reach_;
    };
    if (in_reach(cell.row, tile.row, rows_) && in_reach(cell.column, tile.column, columns_))
      places.push_back(cell);
  }
  if (places.empty()) return;
  const auto ranks = static_cast<Index>(places.size() * channel_weights_.size());
  Eigen::MatrixXd rows(static_cast<Index>(system_.problem.components * rows_ * columns_), ranks);
  Eigen::VectorXd row(rows.rows());
  Index at = 0;
  for (const LatticeCell& cell : places)
    for (std::size_t c = 0; c < channel_weights_.size(); ++c, ++at) {
      kernel_row(
          c, static_cast<std::ptrdiff_t>(cell.row) - static_cast<std::ptrdiff_t>(tile.row),
          static_cast<std::ptrdiff_t>(cell.column) - static_cast<std::ptrdiff_t>(tile.column), row);
      // In the kind's order, with its signs.
      Index to = 0;
      visit(tile, [&](std::size_t, std::size_t local, double sign) {
        rows(to++, at) = sign * row(static_cast<Index>(local));
      });
    }
  Eigen::MatrixXd images = rows;
  kinds_[tile.kind].block.solve_in_place(images);
  Cholesky core(Eigen::MatrixXd::Identity(ranks, ranks) - rows.transpose() * images);
  require_definite(core.is_positive_definite());
  tile.dead = Dead{std::move(images), std::move(core)};
}

template <typename Each>
void SkinTiles::visit(const Tile& tile, Each&& each) const {
  const SurfaceGrid& grid = system_.problem.grid;
  for (std::size_t u = 0; u < system_.problem.components; ++u) {
    const double sign = (tile.mirrored_y && u == 1) != (tile.mirrored_z && u == 2) ? -1.0 : 1.0;
    for (std::size_t m = 0; m < rows_; ++m)
      for (std::size_t n = 0; n < columns_; ++n) {
        const std::size_t row = tile.mirrored_y ? rows_ - 1 - m : m;
        const std::size_t column = tile.mirrored_z ? columns_ - 1 - n : n;
        each((u * grid.rows + tile.row + row) * grid.columns + tile.column + column,
             (u * rows_ + row) * columns_ + column, sign);
      }
  }
}

void SkinTiles::apply(std::span<const double> x, std::span<double> z) {
  std::fill(z.begin(), z.end(), 0.0);
  for (std::size_t first = 0; first < tiles_.size();) {
    const std::size_t kind = tiles_[first].kind;
    std::size_t last = first;
    while (last < tiles_.size() && last - first < batch && tiles_[last].kind == kind) ++last;
    auto values = values_.leftCols(static_cast<Index>(last - first));
    for (std::size_t t = first; t < last; ++t) {
      double* to = values.col(static_cast<Index>(t - first)).data();
      visit(tiles_[t], [&](std::size_t at, std::size_t, double sign) { *to++ = sign * x[at]; });
    }
    kinds_[kind].block.solve_in_place(values);
    for (std::size_t t = first; t < last; ++t) {
      auto own = values.col(static_cast<Index>(t - first));
      if (const auto& dead = tiles_[t].dead) {
        // Y' x = U A^-1 x.
        Index from = 0;
        Eigen::VectorXd given(own.size());
        visit(tiles_[t],
              [&](std::size_t at, std::size_t, double sign) { given(from++) = sign * x[at]; });
        Eigen::MatrixXd share = dead->images.transpose() * given;
        dead->core.solve_in_place(share);
        own += dead->images * share;
      }
      const double* value = own.data();
      visit(tiles_[t], [&](std::size_t at, std::size_t, double sign) { z[at] += sign * *value++; });
    }
    first = last;
  }
}

}  // namespace tactile_net
