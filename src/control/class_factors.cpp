#include "control/class_factors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactile_net {

double rounding(Precision precision, std::size_t terms) {
  const double unit = precision == Precision::float64 ? 0x1p-53 : 0x1p-24;
  const double k = static_cast<double>(terms + 3) * unit;
  return k < 1.0 ? k / (1.0 - k) : std::numeric_limits<double>::infinity();
}

Factor factor_of(const Eigen::MatrixXd& a) {
  Factor factor{static_cast<std::size_t>(a.rows()), static_cast<std::size_t>(a.cols()), {}};
  factor.values.reserve(factor.rows * factor.columns);
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j) factor.values.push_back(a(i, j));
  return factor;
}

double largest(const std::vector<Eigen::MatrixXd>& matrices) {
  double size = 0.0;
  for (const Eigen::MatrixXd& matrix : matrices)
    size = std::max(size, matrix.size() > 0 ? matrix.cwiseAbs().maxCoeff() : 0.0);
  return size;
}

double power_of_two(double size) {
  return size > 0.0 ? std::ldexp(1.0, -std::ilogb(size) - 1) : 1.0;
}

double norm_from_below(const Eigen::MatrixXd& a) {
  Eigen::Index widest = 0;
  a.colwise().norm().maxCoeff(&widest);
  Eigen::VectorXd x = Eigen::VectorXd::Unit(a.cols(), widest);
  double norm = 0.0;
  for (int i = 0; i < 50; ++i) {
    const Eigen::VectorXd y = a * x;
    norm = y.norm();
    if (!(norm > 0.0)) break;
    x = (a.transpose() * y).normalized();
  }
  return norm;
}

double norm_bound(const Eigen::MatrixXd& a) {
  if (a.size() == 0) return 0.0;
  return std::sqrt(a.cwiseAbs().rowwise().sum().maxCoeff()) *
         std::sqrt(a.cwiseAbs().colwise().sum().maxCoeff());
}

void fold(const std::vector<MatrixClass>& parts, std::vector<Eigen::MatrixXd>& first,
          std::vector<Eigen::MatrixXd>& second) {
  for (std::size_t c = 0; c < parts.size(); ++c) {
    first[c] = first[c] * parts[c].column_scale.asDiagonal();
    Eigen::MatrixXd& last = second.empty() ? first[c] : second[c];
    last = parts[c].row_scale.asDiagonal() * last;
  }
}

ProductError error_of(const MatrixClass& part, Eigen::MatrixXd first, const Eigen::MatrixXd* second,
                      Precision precision, double explained_norm, double negligible) {
  const Eigen::VectorXd rows = part.row_scale.cwiseInverse();
  first = first * part.column_scale.cwiseInverse().asDiagonal();
  double rounded = rounding(precision, static_cast<std::size_t>(first.cols()));
  Eigen::MatrixXd difference;
  if (second == nullptr) {
    first = rows.asDiagonal() * first;
    difference = part.matrix - first;
    rounded *= norm_bound(first);
  } else {
    const Eigen::MatrixXd last = rows.asDiagonal() * *second;
    difference = part.matrix - last * first;
    const double again = rounding(precision, static_cast<std::size_t>(last.cols()));
    rounded = (rounded + again + rounded * again) * norm_bound(last) * norm_bound(first);
  }
  ProductError error{difference.norm() * std::sqrt(static_cast<double>(part.images)), 0.0, rounded};
  if (part.reach.size() > 0) {
    const double bound = error.matrix * norm_bound(part.reach);
    error.matrix = bound <= negligible ? bound : (difference * part.reach).norm();
  }
  if (part.explained.size() > 0) {
    const double bound = error.matrix * explained_norm;
    error.explained = bound <= negligible ? bound : (difference * part.explained).norm();
  }
  return error;
}

}  // namespace tactile_net
