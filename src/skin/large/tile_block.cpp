#include "skin/large/tile_block.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactile_net {
namespace {

using Eigen::Index;

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

}  // namespace tactile_net
