/// @file
/// A = U B V', compiled once, as the decompositions of decompositions.hpp. Private.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace tactile_net {

/// B upper bidiagonal: all that A A' needs, at a fifth of what singular vectors take.
class Bidiagonalisation {
 public:
  /// @param a  square, or longer than wide
  explicit Bidiagonalisation(const Eigen::MatrixXd& a);
  Bidiagonalisation(Bidiagonalisation&&) noexcept;
  Bidiagonalisation& operator=(Bidiagonalisation&&) noexcept;
  ~Bidiagonalisation();

  [[nodiscard]] const Eigen::VectorXd& diagonal() const noexcept { return diagonal_; }
  /// b12, b23 ...
  [[nodiscard]] const Eigen::VectorXd& above() const noexcept { return above_; }
  [[nodiscard]] Eigen::MatrixXd rotate(const Eigen::MatrixXd& x) const;  ///< U' x, U square
  [[nodiscard]] Eigen::MatrixXd right_vectors() const;                   ///< V, square

 private:
  struct Factors;
  std::unique_ptr<const Factors> factors_;
  Eigen::VectorXd diagonal_, above_;
};

/// Of B, from its numbers. O(columns^2).
[[nodiscard]] double largest_singular_value(const Eigen::VectorXd& diagonal,
                                            const Eigen::VectorXd& above);

}  // namespace tactile_net
