// Gauss and Legendre: n points integrate powers up to 2 n - 1 exactly, and not the next even one.
#include "numeric/gauss_rule.hpp"

#include <cmath>

#include "numeric/decompositions.hpp"
#include "tests/catch.hpp"

namespace {

using namespace tactile_net;

double integral_of_power(const GaussRule& rule, int power) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.abscissa.size(); ++i) {
    const double value = std::pow(rule.abscissa[i], power);
    sum += rule.weights[i] * (rule.abscissa[i] == 0.0 ? value : 2.0 * value);
  }
  return sum;
}

void check_rule(const GaussRule& rule, int points) {
  CAPTURE(points);
  CHECK(rule.abscissa.size() == static_cast<std::size_t>((points + 1) / 2));
  for (int power = 0; power < 2 * points; power += 2)
    CHECK_THAT(integral_of_power(rule, power), WithinAbs(2.0 / (power + 1.0), 1e-14));
  if (points < 10)  // beyond, the difference is below rounding
    CHECK(std::abs(integral_of_power(rule, 2 * points) - 2.0 / (2.0 * points + 1.0)) > 1e-9);
}

TEST_CASE("a rule of n points integrates powers up to 2 n - 1", "[gauss_rule]") {
  check_rule(gauss_rule<4>(), 4);
  check_rule(gauss_rule<5>(), 5);
  check_rule(gauss_rule<6>(), 6);
  check_rule(gauss_rule<7>(), 7);
  check_rule(gauss_rule<8>(), 8);
  check_rule(gauss_rule<9>(), 9);
  check_rule(gauss_rule<10>(), 10);
  check_rule(gauss_rule<12>(), 12);
  check_rule(gauss_rule<16>(), 16);
  check_rule(gauss_rule<20>(), 20);
}

TEST_CASE("the nodes of a Jacobi matrix are those of its polynomials' rule", "[gauss_rule]") {
  // Golub and Welsch: Legendre's recurrence has i / sqrt(4 i^2 - 1) beside a diagonal of zeros.
  Eigen::VectorXd beside(19);
  for (Eigen::Index i = 0; i < beside.size(); ++i) {
    const auto order = static_cast<double>(i + 1);
    beside(i) = order / std::sqrt(4.0 * order * order - 1.0);
  }
  const GaussNodes nodes = tridiagonal_nodes(Eigen::VectorXd::Zero(20), beside);
  const GaussRule rule = gauss_rule<20>();
  for (Eigen::Index i = 0; i < 10; ++i) {
    const auto from_middle = static_cast<std::size_t>(i);
    CHECK_THAT(nodes.values(10 + i), WithinAbs(rule.abscissa[from_middle], 1e-14));
    CHECK_THAT(nodes.values(9 - i), WithinAbs(-rule.abscissa[from_middle], 1e-14));
    CHECK_THAT(2.0 * nodes.weights(10 + i), WithinAbs(rule.weights[from_middle], 1e-14));
  }
}

}  // namespace
