#include "control/grid_classes.hpp"

#include <Eigen/SparseCore>
#include <cmath>
#include <cstddef>
#include <utility>

#include "realtime/folding.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;

struct SignedPlace {
  Index at;
  double sign;
};
/// Of each coordinate of a class the places that it is a sum of.
using Sums = std::vector<std::vector<SignedPlace>>;

Sums sums_of(const GridBlocks& grid, GridClass of) {
  Sums sums;
  for (std::size_t b = 0; b < grid.signs_y.size(); ++b) {
    const HalfGrid half = half_grid(grid, b, of);
    const double y = grid.signs_y[b] * of.y;
    const double z = grid.signs_z[b] * of.z;
    const auto at = [&](std::size_t i, std::size_t j) {
      return static_cast<Index>((b * grid.rows + i) * grid.columns + j);
    };
    for (std::size_t i = 0; i < half.rows; ++i)
      for (std::size_t j = 0; j < half.columns; ++j) {
        const std::size_t back_i = grid.rows - 1 - i;
        const std::size_t back_j = grid.columns - 1 - j;
        std::vector<SignedPlace> places{{at(i, j), 1.0}};
        if (back_j != j) places.push_back({at(i, back_j), z});
        if (back_i != i) places.push_back({at(back_i, j), y});
        if (back_i != i && back_j != j) places.push_back({at(back_i, back_j), y * z});
        sums.push_back(std::move(places));
      }
  }
  return sums;
}

/// What the exchange leaves (sign 1) or negates (-1) of a class.
Sums exchanged(const Sums& sums, const std::vector<std::uint32_t>& places, double sign) {
  Sums pairs;
  Sums alone;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (places[k] == k && sign > 0.0) alone.push_back(sums[k]);
    if (places[k] <= k) continue;
    std::vector<SignedPlace> both = sums[k];
    for (const SignedPlace& place : sums[places[k]]) both.push_back({place.at, sign * place.sign});
    pairs.push_back(std::move(both));
  }
  pairs.insert(pairs.end(), alone.begin(), alone.end());
  return pairs;
}

/// Classes in the order of the plan; of (+, -) where y and z are exchanged (-, +) too.
std::vector<std::vector<Sums>> classes_of(const GridBlocks& grid) {
  std::vector<std::vector<Sums>> all;
  for (const GridClass of : grid_classes) {
    const Sums sums = sums_of(grid, of);
    if (grid.partners.empty()) {
      all.push_back({sums});
      continue;
    }
    const std::vector<std::uint32_t> places = exchanged_places(grid, of);
    if (of.y == of.z) {
      all.push_back({exchanged(sums, places, 1.0)});
      all.push_back({exchanged(sums, places, -1.0)});
    } else if (of.y > of.z) {
      all.push_back({sums});
    } else {
      Sums turned(sums.size());
      for (std::size_t k = 0; k < sums.size(); ++k) turned[places[k]] = sums[k];
      all[2].push_back(std::move(turned));
    }
  }
  return all;
}

double scale_of(const std::vector<SignedPlace>& places) {
  return 1.0 / std::sqrt(static_cast<double>(places.size()));
}

Sparse basis_of(const Sums& sums, Index size) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < sums.size(); ++k)
    for (const SignedPlace& place : sums[k])
      entries.emplace_back(place.at, static_cast<Index>(k), place.sign * scale_of(sums[k]));
  Sparse basis(size, std::ssize(sums));
  basis.setFromTriplets(entries.begin(), entries.end());
  return basis;
}

/// @param factors  constant in each block
Eigen::VectorXd scales_of(const Sums& sums, const Eigen::VectorXd& factors) {
  Eigen::VectorXd scales(std::ssize(sums));
  for (std::size_t k = 0; k < sums.size(); ++k)
    scales(static_cast<Index>(k)) = scale_of(sums[k]) * factors(sums[k].front().at);
  return scales;
}

void append(Eigen::MatrixXd& all, const Eigen::MatrixXd& more) {
  if (more.size() == 0) return;
  all.conservativeResize(more.rows(), all.cols() + more.cols());
  all.rightCols(more.cols()) = more;
}

}  // namespace

GridClasses grid_classes_of(const ProductTask& task, const GridBlocks& rows,
                            const GridBlocks& columns) {
  const auto of_rows = classes_of(rows);
  const auto of_columns = classes_of(columns);
  GridClasses result;
  Eigen::MatrixXd rest = task.matrix;
  for (std::size_t c = 0; c < of_rows.size(); ++c) {
    MatrixClass part;
    part.row_scale = scales_of(of_rows[c].front(), task.row_factors);
    part.column_scale = scales_of(of_columns[c].front(), task.column_factors);
    part.images = of_rows[c].size();
    for (std::size_t image = 0; image < part.images; ++image) {
      const Sparse q = basis_of(of_rows[c][image], task.matrix.rows());
      const Sparse x = basis_of(of_columns[c][image], task.matrix.cols());
      if (image == 0) part.matrix = Eigen::MatrixXd(q.transpose() * task.matrix) * x;
      rest -= Eigen::MatrixXd(q * part.matrix) * x.transpose();
      if (task.fill.size() > 0) append(part.reach, x.transpose() * task.fill);
      if (task.explained.size() == 0) continue;
      if (task.fill.size() > 0)
        append(part.explained, Eigen::MatrixXd(x.transpose() * task.fill) * task.explained);
      else
        append(part.explained, x.transpose() * task.explained);
    }
    result.classes.push_back(std::move(part));
  }
  result.asymmetry = rest.norm();
  return result;
}

}  // namespace tactile_net
