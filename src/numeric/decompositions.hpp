/// @file
/// The dense decompositions, compiled once: Eigen's templates are slow to compile. Private.
///
/// Nothing here says what is singular: who asks knows his units and what rounding means.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace tactile_net {

/// A = U diag(values) V', values descending; U and V thin.
struct Svd {
  Eigen::VectorXd values;
  Eigen::MatrixXd u, v;
};
[[nodiscard]] Svd singular_value_decomposition(const Eigen::MatrixXd& a);

/// The same of a matrix that may be much longer than wide, or wider than long: by a QR first.
[[nodiscard]] Svd long_singular_value_decomposition(const Eigen::MatrixXd& a);

/// The same without vectors.
[[nodiscard]] Eigen::VectorXd singular_values(const Eigen::MatrixXd& a);

/// For the small complex matrices of one frequency: one-sided Jacobi, the most accurate.
struct ComplexSvd {
  Eigen::VectorXd values;
  Eigen::MatrixXcd u, v;
};
[[nodiscard]] ComplexSvd singular_value_decomposition(const Eigen::MatrixXcd& a);

/// Of a symmetric matrix, ascending; its lower triangle is read.
[[nodiscard]] Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a);

/// Of a symmetric tridiagonal matrix, from its diagonal and the one beside it. O(rows^2).
[[nodiscard]] double largest_tridiagonal_eigenvalue(const Eigen::VectorXd& diagonal,
                                                    const Eigen::VectorXd& beside);

/// Gauss' rule of such a matrix: its eigenvalues, ascending, and the squares of the first entries
/// of their unit eigenvectors (Golub and Welsch 1969).
struct GaussNodes {
  Eigen::VectorXd values, weights;
};
[[nodiscard]] GaussNodes tridiagonal_nodes(const Eigen::VectorXd& diagonal,
                                           const Eigen::VectorXd& beside);

[[nodiscard]] Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);

struct Eigenpairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  ///< a column each, of length 1
};
[[nodiscard]] Eigenpairs eigenpairs(const Eigen::MatrixXd& a);

/// exp(A), by scaling and squaring (Higham 2005).
[[nodiscard]] Eigen::MatrixXd exponential(const Eigen::MatrixXd& a);

/// A = Q R of a tall matrix.
class HouseholderQr {
 public:
  explicit HouseholderQr(const Eigen::MatrixXd& a);
  HouseholderQr(HouseholderQr&&) noexcept;
  ~HouseholderQr();

  [[nodiscard]] Eigen::Index rows() const noexcept;
  [[nodiscard]] Eigen::Index columns() const noexcept;
  [[nodiscard]] Eigen::MatrixXd triangle() const;                             ///< R, square
  [[nodiscard]] Eigen::MatrixXd rotate(const Eigen::MatrixXd& x) const;       ///< Q' x, Q square
  [[nodiscard]] Eigen::MatrixXd rotate_back(const Eigen::MatrixXd& x) const;  ///< Q x
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;        ///< least squares

 private:
  struct Factors;
  std::unique_ptr<const Factors> factors_;
};

/// The least-squares solution by a QR that pivots columns: also where they are dependent.
[[nodiscard]] Eigen::VectorXd pivoted_least_squares(const Eigen::MatrixXd& a,
                                                    const Eigen::VectorXd& b);

/// R^-1 B and B R^-1 for an upper triangular R.
[[nodiscard]] Eigen::MatrixXd solve_upper(const Eigen::MatrixXd& r, const Eigen::MatrixXd& b);
[[nodiscard]] Eigen::MatrixXd divide_upper(const Eigen::MatrixXd& b, const Eigen::MatrixXd& r);

/// P A = L U, rows pivoted.
class Lu {
 public:
  explicit Lu(const Eigen::MatrixXd& a);
  Lu(Lu&&) noexcept;
  ~Lu();

  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  [[nodiscard]] Eigen::MatrixXd inverse() const;
  [[nodiscard]] bool negative_determinant() const;
  [[nodiscard]] double reciprocal_condition() const;  ///< estimated, in the 1-norm

 private:
  struct Factors;
  std::unique_ptr<const Factors> factors_;
};

/// P A Q = L U, rows and columns pivoted: slower, and safe for badly scaled systems.
class CompleteLu {
 public:
  explicit CompleteLu(const Eigen::MatrixXd& a);
  CompleteLu(CompleteLu&&) noexcept;
  ~CompleteLu();

  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Factors;
  std::unique_ptr<const Factors> factors_;
};

/// By Cholesky's decomposition of the lower triangle.
[[nodiscard]] bool is_positive_definite(const Eigen::MatrixXd& symmetric);

/// A^-1 b of a symmetric matrix, definite or nearly so.
[[nodiscard]] Eigen::VectorXd solve_definite(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace tactile_net
