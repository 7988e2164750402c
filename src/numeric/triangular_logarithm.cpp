#include "numeric/triangular_logarithm.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace tactile_net {
namespace {

using Matrix = Eigen::MatrixXcd;

double off_one(const Matrix& t) {
  const Matrix difference = t - Matrix::Identity(t.rows(), t.cols());
  return difference.cwiseAbs().colwise().sum().maxCoeff();
}

/// R of R R = T, column by column, from the diagonal up.
Matrix square_root(const Matrix& t) {
  const Eigen::Index n = t.rows();
  Matrix r = Matrix::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    r(j, j) = std::sqrt(t(j, j));
    for (Eigen::Index i = j - 1; i >= 0; --i) {
      const Eigen::Index between = j - i - 1;
      const std::complex<double> sum =
          (r.row(i).segment(i + 1, between) * r.col(j).segment(i + 1, between)).value();
      r(i, j) = (t(i, j) - sum) / (r(i, i) + r(j, j));
    }
  }
  return r;
}

/// Seven points are exact to 1e-16 within 0.264 of 1 (Higham 2008, table 11.1).
constexpr double near_one = 0.264;
constexpr std::array<std::pair<double, double>, 7> rule = {
    {{0.025446043828620737, 0.064742483084434846},
     {0.129234407200302780, 0.139852695744638334},
     {0.297077424311301417, 0.190915025252559473},
     {0.5, 0.208979591836734694},
     {0.702922575688698583, 0.190915025252559473},
     {0.870765592799697220, 0.139852695744638334},
     {0.974553956171379263, 0.064742483084434846}}};

}  // namespace

Eigen::MatrixXcd triangular_logarithm(Eigen::MatrixXcd t) {
  const Eigen::VectorXcd diagonal = t.diagonal();
  double scale = 1.0;
  while (off_one(t) > near_one) {
    t = square_root(t);
    scale *= 2.0;
  }
  const Eigen::Index n = t.rows();
  const Matrix x = t - Matrix::Identity(n, n);
  Matrix result = Matrix::Zero(n, n);
  for (const auto& [point, weight] : rule) {
    const Matrix divisor = Matrix::Identity(n, n) + point * x;
    Matrix term = scale * weight * x;
    divisor.triangularView<Eigen::Upper>().solveInPlace(term);
    result += term;
  }
  result.diagonal() = diagonal.array().log();
  return result;
}

}  // namespace tactile_net
