/// @file
/// Private. A skin's reconstruction matrix as a sum of Kronecker products: f = M g with M = sum A_t
/// (x) B_t, the A_t along y and the B_t along z, for each pair of a traction and a channel.
///
/// The singular values of M's blocks, rearranged (Van Loan and Pitsianis 1993), say how many terms
/// an accuracy takes, and no sum of as many is nearer. It pays for coarse accuracies alone: some
/// ten terms of a thousandth where classes of the reflections are exact
/// (docs/accuracy.md, docs/internals/skin.md).
///
///     const KroneckerTerms terms(problem, family.reconstruction(alpha));
///     KroneckerSum sum = terms.sum(1e-3);
///     sum.apply(readings, tractions);
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net::study {

/// A sum that is ready to be applied. Has buffers of its own: one object a thread.
class KroneckerSum {
 public:
  struct Parts;
  explicit KroneckerSum(std::unique_ptr<Parts> parts);
  ~KroneckerSum();
  KroneckerSum(KroneckerSum&&) noexcept;
  KroneckerSum& operator=(KroneckerSum&&) noexcept;

  /// Of all blocks together.
  [[nodiscard]] std::size_t terms() const noexcept;
  /// Multiplications of one frame.
  [[nodiscard]] std::size_t multiplications() const noexcept;
  /// |M W^-1 - the sum|_F / |M W^-1|_F, of what was cut off; rounding comes to that.
  [[nodiscard]] double error() const noexcept;

  /// One frame. @pre  one value per reading, one per traction, and they do not overlap
  void apply(std::span<const double> readings, std::span<double> tractions);

 private:
  std::unique_ptr<Parts> parts_;
};

/// Every term of every block.
class KroneckerTerms {
 public:
  /// Singular values and vectors of (components x channels) matrices of (cell rows x taxel rows) x
  /// (cell columns x taxel columns).
  ///
  /// @param inverse  of the problem
  /// @throw std::invalid_argument  the taxels are not in rows and columns, the inverse is of
  ///                               another problem, or a side of a rearranged block is longer than
  ///                               `longest_side`
  KroneckerTerms(const LinearProblem& problem, const Reconstruction& inverse);
  ~KroneckerTerms();

  /// Of rearranged blocks: 16 x 16 taxels over cells of half their pitch have 560.
  static constexpr std::size_t longest_side = 640;

  /// The fewest terms whose `error` is at most this.
  /// @throw std::invalid_argument  accuracy is not > 0
  [[nodiscard]] KroneckerSum sum(double accuracy) const;

 private:
  struct Blocks;
  std::unique_ptr<const Blocks> blocks_;
};

}  // namespace tactile_net::study
