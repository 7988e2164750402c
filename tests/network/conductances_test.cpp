#include "tactile_net/network/conductances.hpp"

#include <cmath>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/network/networks.hpp"

using namespace tactile_net;

TEST_CASE("Kirchhoff's current law at every node is P v", "[conductances][property]") {
  const std::size_t n = GENERATE(as<std::size_t>{}, 1, 2, 3, 12, 40);
  const Matrix p = random_definite(n, 1);
  const ConductanceNetwork network = conductances(p);
  const Matrix v = random_definite(n, 2);  // its first row serves as voltages
  std::vector<double> current(n);
  for (std::size_t i = 0; i < n; ++i) current[i] = network.ground[i] * v(0, i);
  for (const Branch& branch : network.branches) {
    const double flow = branch.conductance * (v(0, branch.from) - v(0, branch.to));
    current[branch.from] += flow;
    current[branch.to] -= flow;
  }
  for (std::size_t i = 0; i < n; ++i) {
    double expected = 0.0;
    double size = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
      expected += p(i, j) * v(0, j);
      size += std::abs(p(i, j) * v(0, j));
    }
    CHECK_THAT(current[i], WithinAbs(expected, 1e-13 * size));
  }
}

TEST_CASE("an entry of zero has no branch", "[conductances]") {
  const ConductanceNetwork network = conductances({3, 3, {2, -1, 0, -1, 2, -1, 0, -1, 2}});
  REQUIRE(network.branches.size() == 2);
  CHECK(network.branches[0].conductance == 1.0);
  CHECK(network.ground == std::vector<double>{1.0, 0.0, 1.0});
}

TEST_CASE("row sums that cancel keep their digits", "[conductances]") {
  const ConductanceNetwork network = conductances({3, 3, {1e16, 1, -1e16, 1, 0, 0, -1e16, 0, 0}});
  CHECK(network.ground[0] == 1.0);
}

TEST_CASE("a matrix that is no network's is refused", "[conductances]") {
  CHECK_THROWS_WITH(conductances({2, 2, {1, 2, 3, 4}}), ContainsSubstring("symmetric"));
  CHECK_THROWS_AS(conductances({1, 2, {1, 2}}), std::invalid_argument);
  CHECK_THROWS_AS(conductances({0, 0, {}}), std::invalid_argument);
  CHECK_THROWS_WITH(conductances({1, 1, {std::nan("")}}), ContainsSubstring("finite"));
  CHECK_THROWS_AS(smallest_eigenvalue({1, 2, {1, 2}}), std::invalid_argument);
}

TEST_CASE("the smallest eigenvalue tells definite from indefinite", "[conductances]") {
  CHECK_THAT(smallest_eigenvalue({2, 2, {2, 1, 1, 2}}), WithinRel(1.0, 1e-14));
  CHECK_THAT(smallest_eigenvalue({2, 2, {1, 2, 2, 1}}), WithinRel(-1.0, 1e-14));
}
