/// @file
/// P f = b as a network of conductances (thesis 5.18-5.20).
#pragma once

#include <cstddef>
#include <vector>

#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

/// Conductance between two nodes, in units of P: -P_ij, negative where P_ij > 0.
struct Branch {
  std::size_t from = 0;
  std::size_t to = 0;  ///< > from
  double conductance = 0.0;
};

/// With a current b_i into each node i, Kirchhoff's current law reads P v = b: the node voltages
/// are the tractions. Values are in units of P; `Scale` turns them into siemens and volts.
struct ConductanceNetwork {
  std::size_t nodes = 0;
  std::vector<Branch> branches{};  ///< by (from, to); zero entries of P have none
  std::vector<double> ground{};    ///< per node: sum_j P_ij; may be zero or negative
};

/// @param matrix  P, symmetric
/// @throw std::invalid_argument  P is not square, not finite or not symmetric (to 1e-12 of its
///                               largest entry)
[[nodiscard]] ConductanceNetwork conductances(const Matrix& matrix);

/// The largest sum of a row's entries in size, which bounds the largest eigenvalue.
[[nodiscard]] double largest_row_sum(const Matrix& matrix);

struct EigenvalueRange {
  double smallest = 0.0;
  double largest = 0.0;
};

/// The extreme eigenvalues of a symmetric matrix. O(n^3).
///
/// @throw std::invalid_argument  the matrix is not square, empty or not finite
[[nodiscard]] EigenvalueRange eigenvalue_range(const Matrix& matrix);

/// With capacitance at its nodes the network settles if and only if this is positive:
/// C dv/dt = -P v + b. O(n^3).
///
/// @throw std::invalid_argument  as `eigenvalue_range`
[[nodiscard]] double smallest_eigenvalue(const Matrix& matrix);

/// x of P x = b for a symmetric P. O(n^3).
///
/// @throw std::invalid_argument  sizes differ, P is not square, empty or not finite
[[nodiscard]] std::vector<double> solve_symmetric(const Matrix& matrix,
                                                  const std::vector<double>& right_side);

}  // namespace tactile_net
