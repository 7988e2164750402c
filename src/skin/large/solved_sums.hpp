/// @file
/// Solutions for sums over tractions, of which few are new. Private.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <list>
#include <span>
#include <utility>
#include <vector>

#include "numeric/eigen.hpp"
#include "numeric/kept_or_made.hpp"
#include "tactile_net/skin/grid.hpp"

namespace tactile_net {

/// A linear image of weights, by a solve each. Forces, moments and what follows from them weigh the
/// cells of a contact by polynomials of their place: the images of few polynomials serve them all.
///
/// What a sum's image is made of depends on its weights alone, and so do its bits: what was asked
/// for before only saves solves.
class SolvedSums {
 public:
  /// @param weights  components x cells of the grid
  /// @param make     the image of weights of length 1; without a value: there is none
  /// @return         the image of weights over the largest of them, and that one; the image is
  ///                 without a value where one that it is made of is
  std::pair<Eigen::VectorXd, double> image(const SurfaceGrid& grid, std::span<const double> weights,
                                           Eigen::Index rows, const auto& make) {
    double largest = 0.0;
    for (const double weight : weights) largest = std::max(largest, std::abs(weight));
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(rows);
    if (!(largest > 0.0)) return {std::move(sum), 0.0};
    Eigen::VectorXd own = as_eigen(weights) / largest;
    const double size = own.norm();
    for (const auto& [direction, share] : shares(grid, own, size)) {
      const Eigen::VectorXd& one = solved(direction, own.size(), make);
      if (one.size() == 0) return {Eigen::VectorXd(), largest};
      sum += share * one;
    }
    return {std::move(sum), largest};
  }

  void clear() noexcept { solved_.clear(); }

 private:
  /// Weights that are not 0, by their place.
  using Direction = std::vector<std::pair<Eigen::Index, double>>;
  static constexpr std::size_t most = 24;
  static constexpr double known = 1e-10;  // of weights: no more than rounding

  /// Orthonormal directions, and how much of each the weights are; they themselves where they are
  /// no polynomial on the cells that they weigh.
  static std::vector<std::pair<Direction, double>> shares(const SurfaceGrid& grid,
                                                          const Eigen::VectorXd& weights,
                                                          double size) {
    const auto cells = static_cast<Eigen::Index>(grid.count());
    std::vector<Eigen::Index> weighed;
    for (Eigen::Index cell = 0; cell < cells; ++cell) {
      bool any = false;
      for (Eigen::Index i = cell; i < weights.size(); i += cells) any = any || weights(i) != 0.0;
      if (any) weighed.push_back(cell);
    }
    std::vector<std::pair<Direction, double>> all;
    double rest = 0.0;
    for (Eigen::Index first = 0; first < weights.size(); first += cells) {
      Eigen::VectorXd left(std::ssize(weighed));
      for (Eigen::Index k = 0; k < left.size(); ++k)
        left(k) = weights(first + weighed[static_cast<std::size_t>(k)]);
      if (left.isZero(0.0)) continue;
      for (const Eigen::VectorXd& one : polynomials(grid, weighed, first == cells)) {
        const double share = one.dot(left);
        left -= share * one;
        if (!(std::abs(share) > known * size)) continue;
        Direction direction;
        for (Eigen::Index k = 0; k < one.size(); ++k)
          direction.emplace_back(first + weighed[static_cast<std::size_t>(k)], one(k));
        all.emplace_back(std::move(direction), share);
      }
      rest = std::hypot(rest, left.norm());
    }
    if (rest <= known * size) return all;
    Direction own;
    for (Eigen::Index i = 0; i < weights.size(); ++i)
      if (weights(i) != 0.0) own.emplace_back(i, weights(i) / size);
    return {{std::move(own), size}};
  }

  /// Orthonormal ones on some cells, up to squares of the place.
  ///
  /// @param z_first  torsion weighs the drag along y by z, and that along z by y
  static std::vector<Eigen::VectorXd> polynomials(const SurfaceGrid& grid,
                                                  std::span<const Eigen::Index> cells,
                                                  bool z_first) {
    const auto columns = static_cast<Eigen::Index>(grid.columns);
    const auto centred_places = [&](const auto& place) {
      Eigen::ArrayXd all(std::ssize(cells));
      for (Eigen::Index k = 0; k < all.size(); ++k)
        all(k) = static_cast<double>(place(cells[static_cast<std::size_t>(k)]));
      all -= all.mean();
      return Eigen::ArrayXd(all / std::max(all.abs().maxCoeff(), 1.0));
    };
    Eigen::ArrayXd y = centred_places([&](Eigen::Index cell) { return cell / columns; });
    Eigen::ArrayXd z = centred_places([&](Eigen::Index cell) { return cell % columns; });
    if (z_first) std::swap(y, z);
    const std::array<Eigen::VectorXd, 6> powers{
        Eigen::VectorXd::Ones(y.size()), y, z, y * y, y * z, z * z};
    std::vector<Eigen::VectorXd> all;
    for (Eigen::VectorXd left : powers) {
      const double size = left.norm();
      for (int again = 0; again < 2; ++again)  // once leaves what rounding has of the others
        for (const Eigen::VectorXd& one : all) left -= one.dot(left) * one;
      if (left.norm() > 1e-8 * size) all.push_back(left.normalized());
    }
    return all;
  }

  /// Valid until the next call.
  const Eigen::VectorXd& solved(const Direction& direction, Eigen::Index weights,
                                const auto& make) {
    const auto is = [&](const Direction& kept) { return kept == direction; };
    return kept_or_made(solved_, most, is, [&] {
      Eigen::VectorXd all = Eigen::VectorXd::Zero(weights);
      for (const auto& [place, weight] : direction) all(place) = weight;
      return std::pair<Direction, Eigen::VectorXd>(direction, make(all));
    });
  }

  std::list<std::pair<Direction, Eigen::VectorXd>>
      solved_{};  // the one asked for last is the first
};

/// The product of two images over their sizes, as `SolvedSums` gives them, times these sizes: rows
/// of readings count as they are, those of the stabiliser times `share`.
[[nodiscard]] inline double image_product(const std::pair<Eigen::VectorXd, double>& a,
                                          const std::pair<Eigen::VectorXd, double>& b,
                                          Eigen::Index readings, double share) {
  const Eigen::Index rest = a.first.size() - readings;
  const double known = a.first.head(readings).dot(b.first.head(readings));
  const double smoothed = a.first.tail(rest).dot(b.first.tail(rest));
  return a.second * (b.second * (known + share * smoothed));
}

}  // namespace tactile_net
