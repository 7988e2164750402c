/// @file
/// Which of many presses to do: what each would tell beside what is known. Private.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <functional>
#include <vector>

#include "calibration/fit_system.hpp"

namespace tactile_net {

/// A least-squares problem of common unknowns, R x = rhs, and presses that may be added to it.
///
/// A press adds rows B of the common unknowns x and O of its own, whose noise is 1. With C the
/// covariance of x before, and K = I + B C B', it takes
///
///     |L^-1 B C A'|^2 - |Q' L^-1 B C A'|^2,    L L' = K,    Q an orthonormal basis of L^-1 O
///
/// from the criterion |A C^(1/2)|^2. K is no smaller than I: its factor is safe however much is
/// known.
class PressDesign {
 public:
  /// @param root  R, regular
  /// @param aims  A, rows whose sum of variances the criterion is
  PressDesign(Eigen::MatrixXd root, Eigen::MatrixXd aims);

  /// @param rows  of one press that may be done
  void add_candidate(const PressPart& rows);

  /// As if these candidates had been done. O(unknowns^3).
  void set(const std::vector<std::size_t>& chosen);
  [[nodiscard]] double value() const noexcept { return value_; }
  /// What candidate `i` would take from the value. O(its rows^3).
  [[nodiscard]] double gain(std::size_t i) const;
  /// The candidate that takes most, the first of equal ones.
  [[nodiscard]] std::size_t best() const;

 private:
  struct Candidate {
    Eigen::SparseMatrix<double, Eigen::RowMajor> common{};  // a reading has its own gain and offset
    Eigen::MatrixXd own{};
  };
  std::vector<Candidate> candidates_{};
  Eigen::MatrixXd root_, aims_;
  Eigen::MatrixXd covariance_{};  // C
  Eigen::MatrixXd aimed_{};       // C A'
  double value_ = 0.0;
};

/// Greedily `count` candidates, then one exchanged for another until nothing improves; in the order
/// in which each buys most.
///
/// @param watch  called before every search with its number, from 1; may throw
[[nodiscard]] std::vector<std::size_t> choose(PressDesign& design, std::size_t count,
                                              const std::function<void(std::size_t)>& watch);

}  // namespace tactile_net
