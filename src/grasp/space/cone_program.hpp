/// @file
/// Linear programs over cones of second order. Private.
#pragma once

#include <vector>

#include "numeric/eigen.hpp"

namespace tactile_net {

/// min c'x under A x = b, x in a product of cones x_0 >= |(x_1, x_2, ...)|, of these sizes in the
/// order of x; size 1 is x >= 0. The rows of A are independent.
struct ConeProgram {
  Eigen::VectorXd c;
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
  std::vector<Eigen::Index> cones;
};

struct ConeAnswer {
  enum class Kind {
    solved,      ///< x and y are the minimum and its multipliers: A'y + s = c, s in the cones
    infeasible,  ///< no x: y proves it, since b'y = 1 and -A'y is in the cones
    unbounded,   ///< x is a way down: A x = 0, c'x = -1
    not_found,   ///< rounding ended the search
  };
  Kind kind = Kind::not_found;
  Eigen::VectorXd x{};
  Eigen::VectorXd y{};
  Eigen::VectorXd s{};
  int iterations = 0;
};

/// By a homogeneous and self-dual interior-point method with Nesterov and Todd's scaling and
/// Mehrotra's corrector (Andersen, Roos and Terlaky, Mathematical Programming 95, 2003): one that
/// either solves or proves that there is nothing to solve. At most 100 steps, O((rows +
/// columns)^3) each.
[[nodiscard]] ConeAnswer solve(const ConeProgram& program);

}  // namespace tactile_net
