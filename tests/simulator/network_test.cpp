// Analog against digital: what ngspice finds is the solution of P v = b.
#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <sstream>

#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/realization.hpp"
#include "tactile_net/simulator/child_process.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/network/networks.hpp"
#include "tests/simulator/at_rest.hpp"

using namespace tactile_net;

namespace {

struct Case {
  Matrix p;
  Eigen::MatrixXd dense{};
  Eigen::VectorXd b{};
  Eigen::VectorXd answer{};
};

Case make_case(std::size_t n, unsigned seed) {
  Case one{.p = random_definite(n, seed)};
  const auto size = static_cast<Eigen::Index>(n);
  one.dense = view(one.p);
  one.b = one.dense.col(0).cwiseAbs() - Eigen::VectorXd::Constant(size, 0.3);
  one.answer = one.dense.ldlt().solve(one.b);
  return one;
}

Circuit realized(Realization realization, const Case& one, const RealizationOptions& options = {}) {
  const NetworkProblem problem{.matrix = one.p, .right_side = {one.b.begin(), one.b.end()}};
  return realize(realization, problem, options);
}

Eigen::VectorXd relaxed(const Circuit& circuit) {
  const std::vector<double> voltages = at_rest(circuit);
  return Eigen::Map<const Eigen::VectorXd>(voltages.data(), std::ssize(voltages));
}

}  // namespace

TEST_CASE("the ideal network's voltages solve P v = b", "[spice][ideal]") {
  const std::size_t n = GENERATE(as<std::size_t>{}, 2, 3, 5, 12, 30);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    CAPTURE(n, seed);
    const Case one = make_case(n, seed);
    const Eigen::VectorXd v = relaxed(realized(Realization::ideal, one));
    CHECK((v - one.answer).norm() <= 1e-10 * one.answer.norm());
  }
}

TEST_CASE("the op-amp network's voltages solve it too, negative row sums included",
          "[spice][nic]") {
  const std::size_t n = GENERATE(as<std::size_t>{}, 2, 3, 5, 12, 30);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    CAPTURE(n, seed);
    const Case one = make_case(n, seed);
    const Eigen::VectorXd v = relaxed(realized(Realization::nic, one));
    CHECK((v - one.answer).norm() <= 1e-9 * one.answer.norm());
  }
}

TEST_CASE("some of those networks have negative row sums", "[spice][nic]") {
  bool negative = false;
  for (const double ground : conductances(random_definite(12, 1)).ground)
    negative = negative || ground < 0.0;
  CHECK(negative);
}

TEST_CASE("the answer is free of the scale", "[spice][property]") {
  const double siemens = GENERATE(1e-9, 1e3);
  const double volts = GENERATE(0.1, 10.0);
  const Realization realization = GENERATE(Realization::ideal, Realization::nic, Realization::rail);
  CAPTURE(siemens, volts);
  const Case one = make_case(5, 4);
  const Eigen::VectorXd v =
      relaxed(realized(realization, one, {.scale = {siemens, volts}, .divider = 10.0 / siemens}));
  CHECK((v / volts - one.answer).norm() <= 1e-9 * one.answer.norm());
}

TEST_CASE("the resistors dissipate what the sources deliver", "[spice][property]") {
  const Case one = make_case(12, 5);
  const ConductanceNetwork network = conductances(one.p);
  const Eigen::VectorXd v = relaxed(realized(Realization::ideal, one, {.scale = {.siemens = 1.0}}));
  double dissipated = 0.0;
  for (const Branch& branch : network.branches)
    dissipated += branch.conductance * std::pow(v(static_cast<Eigen::Index>(branch.from)) -
                                                    v(static_cast<Eigen::Index>(branch.to)),
                                                2);
  for (std::size_t i = 0; i < network.nodes; ++i)
    dissipated += network.ground[i] * std::pow(v(static_cast<Eigen::Index>(i)), 2);
  CHECK_THAT(dissipated, WithinRel(one.b.dot(v), 1e-10));
}

TEST_CASE("the voltages minimise the power", "[spice][property]") {
  const Case one = make_case(12, 6);
  const Eigen::VectorXd v = relaxed(realized(Realization::ideal, one));
  const auto power = [&](const Eigen::VectorXd& x) {
    return 0.5 * x.dot(one.dense * x) - one.b.dot(x);
  };
  std::mt19937 generator(7);
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::VectorXd step(12);
    for (double& value : step) value = static_cast<double>(generator()) / 4294967295.0 - 0.5;
    CHECK(power(v + 1e-3 * step) > power(v));
  }
}

TEST_CASE("plain `ngspice -b` prints the digits that the raw file holds", "[spice][deck]") {
  const Case one = make_case(5, 8);
  const Circuit circuit = realized(Realization::ideal, one);
  const Eigen::VectorXd v = relaxed(circuit);
  std::ostringstream deck;
  write_deck(deck, circuit, {.title = "test"}, Answer::printed);
  const ProcessResult result =
      run_process({"sh", "-c", "f=$(mktemp) && cat > $f && ngspice -b $f; s=$?; rm $f; exit $s"},
                  {.input = deck.str()});
  CHECK(result.code == 0);
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const std::string label = "v(n" + std::to_string(i) + ") = ";
    const std::size_t at = result.output.find(label);
    REQUIRE(at != std::string::npos);
    CHECK(std::stod(result.output.substr(at + label.size())) == v(i));
  }
}
