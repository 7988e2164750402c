#include <Eigen/QR>
#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <limits>
#include <random>

#include "numeric/decompositions.hpp"

using namespace tactile_net;

namespace {

Eigen::MatrixXd rotation(Eigen::Index n, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
  return Eigen::HouseholderQR<Eigen::MatrixXd>(a).householderQ();
}

/// Two clusters of equal values, and two that are zero: arrays of equal taxels have such matrices.
Eigen::VectorXd clusters(Eigen::Index n) {
  Eigen::VectorXd values = Eigen::VectorXd::Constant(n, 0.97);
  values.head(n / 2).setConstant(4.588);
  values.tail(2).setZero();
  return values;
}

}  // namespace

TEST_CASE("singular vectors of many equal values reproduce the matrix", "[numeric]") {
  std::mt19937_64 random(4);
  for (Eigen::Index n = 10; n <= 80; n += 5)
    for (int trial = 0; trial < 6; ++trial) {
      CAPTURE(n, trial);
      const Eigen::VectorXd values = clusters(n);
      const Eigen::MatrixXd a = rotation(n, random) * values.asDiagonal() * rotation(n, random);
      const Svd svd = singular_value_decomposition(a);
      const double rounding = 1e-13 * static_cast<double>(n);
      CHECK((svd.values - values).cwiseAbs().maxCoeff() < rounding);
      CHECK((a * svd.v - svd.u * svd.values.asDiagonal()).cwiseAbs().maxCoeff() < rounding);
      CHECK((svd.v.transpose() * svd.v).isIdentity(rounding));
      CHECK((singular_values(a) - values).cwiseAbs().maxCoeff() < rounding);
    }
}

TEST_CASE("singular values are those of the decomposition, of any shape and size", "[numeric]") {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (const auto& [rows, columns] : {std::pair{1, 1}, {1, 7}, {7, 1}, {12, 5}, {5, 12}, {40, 40}})
    for (const double size : {1e-300, 1.0, 1e300}) {
      CAPTURE(rows, columns, size);
      const Eigen::MatrixXd a =
          Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return size * normal(random); });
      const Eigen::MatrixXd of_size_one = a / size;
      const Eigen::VectorXd expected = singular_value_decomposition(of_size_one).values;
      const Eigen::VectorXd found = singular_values(a) / size;
      REQUIRE(found.size() == std::min(rows, columns));
      CHECK((found - expected).cwiseAbs().maxCoeff() < 1e-13 * expected(0));
      CHECK(std::is_sorted(found.begin(), found.end(), std::greater<>()));
    }
  CHECK(singular_values(Eigen::MatrixXd::Zero(3, 2)) == Eigen::VectorXd::Zero(2));
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  CHECK(singular_values(Eigen::MatrixXd::Constant(3, 2, unknown)).array().isNaN().all());
}
