#include "tactile_net/network/reduction.hpp"

#include <cmath>
#include <stdexcept>

#include "tactile_net/network/state_space.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

struct Variant {
  Realization realization;
  bool inverters = false;
};

const std::vector<Variant> variants = {{Realization::ideal},
                                       {Realization::nic},
                                       {Realization::rail},
                                       {Realization::crossbar},
                                       {Realization::crossbar, true},
                                       {Realization::least_squares},
                                       {Realization::least_squares, true},
                                       {Realization::lattice},
                                       {Realization::lattice, true}};

/// Solves a small dense system by elimination with row exchange.
std::vector<double> solved(Matrix a, std::vector<double> b) {
  const std::size_t n = a.rows;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < n; ++i)
      if (std::abs(a(i, k)) > std::abs(a(pivot, k))) pivot = i;
    for (std::size_t j = 0; j < n; ++j) std::swap(a(k, j), a(pivot, j));
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a(i, k) / a(k, k);
      for (std::size_t j = k; j < n; ++j) a(i, j) -= factor * a(k, j);
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a(k, j) * b[j];
    b[k] /= a(k, k);
  }
  return b;
}

}  // namespace

TEST_CASE("the equations' answer is the direct solution", "[reduction]") {
  const std::size_t unknowns = GENERATE(as<std::size_t>{}, 1, 2);
  const ArrayNetwork network = array_network(11, 1e-3, unknowns);
  for (const Variant& variant : variants) {
    CAPTURE(name(variant.realization), variant.inverters, unknowns);
    const Reduction reduction(
        realize(variant.realization, network.problem, {.inverters = variant.inverters}));
    const Equations equations = reduction.equations();
    const std::vector<double> z = solved(equations.matrix, equations.right_side);
    REQUIRE(reduction.outputs() == network.direct.size());
    for (std::size_t i = 0; i < network.direct.size(); ++i)
      CHECK_THAT(z[i], WithinAbs(network.direct[i], 1e-11));
  }
}

TEST_CASE("sensitivities are derivatives", "[reduction][property]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  for (const Variant& variant : variants) {
    CAPTURE(name(variant.realization), variant.inverters);
    const Reduction reduction(
        realize(variant.realization, network.problem, {.inverters = variant.inverters}));
    const Equations nominal = reduction.equations();
    const std::vector<double> z = solved(nominal.matrix, nominal.right_side);
    const Matrix derivatives = reduction.sensitivities(z);
    double size = 0.0;
    for (const double value : derivatives.values) size = std::max(size, std::abs(value));
    for (std::size_t r = 0; r < reduction.resistors().size(); ++r) {
      const auto residual = [&](double factor) {
        std::vector<double> siemens(reduction.siemens().begin(), reduction.siemens().end());
        siemens[r] *= factor;
        Equations moved;
        reduction.assemble(siemens, moved);
        std::vector<double> sum(reduction.rows());
        for (std::size_t i = 0; i < sum.size(); ++i)
          for (std::size_t j = 0; j < sum.size(); ++j) sum[i] += moved.matrix(i, j) * z[j];
        return sum;
      };
      const double step = 1e-5;
      const std::vector<double> up = residual(std::exp(step));
      const std::vector<double> down = residual(std::exp(-step));
      for (std::size_t i = 0; i < reduction.rows(); ++i) {
        CAPTURE(reduction.resistors()[r], i);
        CHECK_THAT((up[i] - down[i]) / (2.0 * step), WithinAbs(derivatives(r, i), 1e-6 * size));
      }
    }
  }
}

TEST_CASE("no draw of errors moves an entry by more than its bound", "[reduction][property]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  const double error = 1e-4;
  for (const Variant& variant : variants) {
    CAPTURE(name(variant.realization), variant.inverters);
    const Reduction reduction(
        realize(variant.realization, network.problem, {.inverters = variant.inverters}));
    const Equations nominal = reduction.equations();
    const Matrix bound = reduction.sensitivity_bound();
    double reached = 0.0;
    for (unsigned draw = 0; draw < 64; ++draw) {
      std::vector<double> siemens(reduction.siemens().begin(), reduction.siemens().end());
      for (std::size_t r = 0; r < siemens.size(); ++r)
        siemens[r] *= 1.0 + ((draw + 1) * (2 * r + 7) % 13 % 2 == 0 ? error : -error);
      Equations moved;
      reduction.assemble(siemens, moved);
      for (std::size_t i = 0; i < bound.values.size(); ++i) {
        const double change = std::abs(moved.matrix.values[i] - nominal.matrix.values[i]);
        CHECK(change <= bound.values[i] * error * (1.0 + 10.0 * error) + 1e-18);
        if (bound.values[i] > 0.0) reached = std::max(reached, change / (bound.values[i] * error));
      }
    }
    CHECK(reached > 0.9);  // a bound that nothing comes near would say little
  }
}

TEST_CASE("resistors stand in the order of the flattened circuit", "[reduction]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  for (const Variant& variant : variants) {
    const Circuit circuit =
        realize(variant.realization, network.problem, {.inverters = variant.inverters});
    const Reduction reduction(circuit);
    const Circuit flat = FlatCircuit(circuit).circuit();
    REQUIRE(flat.resistors.size() == reduction.resistors().size());
    for (std::size_t r = 0; r < flat.resistors.size(); ++r) {
      CHECK(flat.resistors[r].name == reduction.resistors()[r]);
      CHECK(flat.resistors[r].siemens == reduction.siemens()[r]);
    }
  }
}

TEST_CASE("the load is that of a circuit solved by hand", "[reduction]") {
  // 2 S to ground from a converter's -1 S and a resistor of 3 S: 1 A makes 0.5 V, the output 1 V.
  const NetworkProblem problem{.matrix = {1, 1, {-1.0}}, .right_side = {1.0}};
  Circuit circuit = realize(Realization::nic, problem, {.scale = {.siemens = 1.0}, .divider = 4.0});
  circuit.resistors.push_back({"R3", circuit.outputs[0], 0, 3.0});
  const Reduction reduction(circuit);
  const Equations equations = reduction.equations();
  CHECK_THAT(equations.matrix(0, 0), WithinRel(2.0, 1e-14));
  const Reduction::Load load = reduction.load(std::vector{0.5});
  CHECK_THAT(load.largest_voltage, WithinRel(1.0, 1e-14));
  // 3 S and 1 S at 0.5 V, and two of 1/4 S.
  CHECK_THAT(load.power, WithinRel(0.25 * (3.0 + 1.0 + 0.5), 1e-14));
}

TEST_CASE("what has no such equations is refused", "[reduction]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  CHECK_THROWS_WITH(Reduction(realize(Realization::lc, network.problem)),
                    ContainsSubstring("inductors"));
  Circuit circuit = realize(Realization::crossbar, network.problem);
  circuit.instances[0].pins[0] = circuit.outputs[1];
  CHECK_THROWS_WITH(Reduction(circuit), ContainsSubstring("'+' input is not grounded"));
}

TEST_CASE("a sub-circuit that nobody knows is refused by name, wherever it would count",
          "[reduction][flat_circuit]") {
  Circuit circuit = realize(Realization::nic, array_network(5, 1e-3).problem);
  circuit.instances[0].subcircuit = "gyrator";
  for (const std::string& part :
       {"element " + circuit.instances[0].name, std::string("'gyrator'")}) {
    CHECK_THROWS_WITH(Reduction(circuit), ContainsSubstring(part));
    CHECK_THROWS_WITH(FlatCircuit(circuit), ContainsSubstring(part));
  }
  circuit.instances[0].subcircuit = "inverter";  // two pins, where four are connected
  CHECK_THROWS_WITH(Reduction(circuit), ContainsSubstring("its pins do not fit 'inverter'"));
  CHECK_THROWS_WITH(FlatCircuit(circuit), ContainsSubstring("its pins do not fit 'inverter'"));
}
