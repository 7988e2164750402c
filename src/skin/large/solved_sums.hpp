/// @file
/// Solutions for sums over tractions, of which few are new. Private.
#pragma once

#include <cstddef>
#include <list>
#include <utility>

#include "numeric/eigen.hpp"

namespace tactile_net {

/// A linear image of weights, made only of what they have beside all that was asked before: of
/// forces, moments and what follows from them few are new.
class SolvedSums {
 public:
  /// @param make  the image of weights of length 1
  /// @return      the image of weights over the largest of them, and that one
  std::pair<Eigen::VectorXd, double> image(const Eigen::Ref<const Eigen::VectorXd>& weights,
                                           Eigen::Index rows, const auto& make) {
    if (solved_.size() >= most) solved_.clear();
    Eigen::VectorXd left = weights;
    const double largest = left.size() > 0 ? left.cwiseAbs().maxCoeff() : 0.0;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(rows);
    if (!(largest > 0.0)) return {sum, 0.0};
    left /= largest;
    const double size = left.norm();
    for (int again = 0; again < 2; ++again)  // once leaves what rounding has of the others
      for (const Solved& one : solved_) {
        const double share = one.weights.dot(left);
        left -= share * one.weights;
        sum += share * one.image;
      }
    const double rest = left.norm();
    if (rest > known * size) {
      left /= rest;
      Eigen::VectorXd made = make(left);
      sum += rest * made;
      solved_.push_back({std::move(left), std::move(made)});
    }
    return {sum, largest};
  }

  void clear() noexcept { solved_.clear(); }

 private:
  struct Solved {
    Eigen::VectorXd weights;  // orthonormal
    Eigen::VectorXd image;
  };
  static constexpr std::size_t most = 24;
  static constexpr double known = 1e-10;  // of weights: no more than rounding

  std::list<Solved> solved_{};
};

}  // namespace tactile_net
