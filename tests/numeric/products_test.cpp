// Products that are compiled once: each is the sum that defines it, however its factors are stored.
#include "numeric/eigen.hpp"
#include "tests/catch.hpp"

namespace {

using namespace tactile_net;
using Eigen::Index;

Eigen::MatrixXd numbers_of(Index rows, Index columns) {
  Eigen::MatrixXd a(rows, columns);
  for (Index i = 0; i < a.size(); ++i) a(i) = std::sin(1.0 + 0.7 * static_cast<double>(i));
  return a;
}

Eigen::MatrixXd summed(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(a.rows(), b.cols());
  for (Index i = 0; i < a.rows(); ++i)
    for (Index j = 0; j < b.cols(); ++j)
      for (Index k = 0; k < a.cols(); ++k) c(i, j) += a(i, k) * b(k, j);
  return c;
}

void check_equal(const Eigen::MatrixXd& found, const Eigen::MatrixXd& wanted) {
  REQUIRE(found.rows() == wanted.rows());
  REQUIRE(found.cols() == wanted.cols());
  if (found.size() > 0) CHECK((found - wanted).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("a product is the sum that defines it, however its factors lie in memory", "[products]") {
  const Index rows = GENERATE(1, 3, 40);
  const Index inner = GENERATE(1, 5, 33);
  const Eigen::MatrixXd a = numbers_of(rows, inner);
  const Eigen::MatrixXd b = numbers_of(inner, 7);
  const RowMajor by_rows = a;
  const Eigen::MatrixXd larger = numbers_of(rows + 4, inner + 3);
  const Eigen::VectorXd x = b.col(2);

  check_equal(a * b, summed(a, b));
  check_equal(by_rows * b, summed(a, b));
  check_equal(Eigen::Map<const RowMajor>(by_rows.data(), rows, inner) * b, summed(a, b));
  check_equal(b.transpose() * a.transpose(), summed(b.transpose(), a.transpose()));
  check_equal(b.transpose() * by_rows.transpose(), summed(b.transpose(), a.transpose()));
  check_equal(larger.block(2, 1, rows, inner) * b, summed(larger.block(2, 1, rows, inner), b));
  check_equal((2.0 * a) * (b + b), summed(2.0 * a, b + b));
  check_equal(a * x.asDiagonal() * b, summed(a * x.asDiagonal(), b));
  check_equal(a * x, summed(a, x));
  check_equal(a * b.row(0).transpose().replicate(inner, 1).topRows(inner),
              summed(a, b.row(0).transpose().replicate(inner, 1).topRows(inner)));
  check_equal(a * b.transpose().row(1).transpose(), summed(a, b.col(1)));
  check_equal(x.transpose() * b, summed(x.transpose(), b));
  check_equal(a.row(rows - 1) * b, summed(a.row(rows - 1), b));
}

TEST_CASE("a product over nothing is 0, and one of no rows has none", "[products]") {
  check_equal(Eigen::MatrixXd(3, 0) * Eigen::MatrixXd(0, 2), Eigen::MatrixXd::Zero(3, 2));
  check_equal(Eigen::MatrixXd(0, 3) * numbers_of(3, 2), Eigen::MatrixXd(0, 2));
  check_equal(Eigen::MatrixXd(3, 0) * Eigen::VectorXd(0), Eigen::VectorXd::Zero(3));
}

TEST_CASE("a product has its value at once: what its factors become later does not count",
          "[products]") {
  Eigen::MatrixXd a = numbers_of(6, 6);
  const Eigen::MatrixXd before = summed(a, a);
  const auto square = a * a;
  a.setZero();
  check_equal(square, before);
}

}  // namespace
