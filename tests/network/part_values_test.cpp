#include "tactile_net/network/part_values.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tactile_net/network/arrays.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/network/soldered_error.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

double off(const PartValue& value, double ohm) { return std::abs(value.ohm() / ohm - 1.0); }

/// Of values chosen for every resistor alike.
std::vector<double> siemens_with(const Reduction& reduction, bool pairs) {
  const PartChoice choice(reduction, Series::e96);
  return siemens_of(choice.values(std::vector<bool>(choice.groups().size(), pairs)));
}

}  // namespace

TEST_CASE("a pair comes as near as the best of all pairs does", "[part_values][property]") {
  std::vector<double> e24;  // four decades
  for (double ohm = 10.0; ohm < 1e5; ohm *= std::pow(10.0, 1.0 / 96.0)) {
    const double value = nearest_in(Series::e24, ohm);
    if (e24.empty() || value > e24.back()) e24.push_back(value);
  }
  for (double ohm = 500.0; ohm < 5000.0; ohm *= 1.0137) {
    double best = off({.first = nearest_in(Series::e24, ohm)}, ohm);
    for (const double a : e24)
      for (const double b : e24) {
        best = std::min(best, std::abs((a + b) / ohm - 1.0));
        best = std::min(best, std::abs(1.0 / (1.0 / a + 1.0 / b) / ohm - 1.0));
      }
    CAPTURE(ohm);
    CHECK(off(nearest_pair(Series::e24, ohm), ohm) <= best * (1.0 + 1e-9) + 1e-15);
  }
}

TEST_CASE("one part of E96 is within 1.5 %, a pair within 2e-4, of common values both",
          "[part_values]") {
  double one = 0.0;
  double two = 0.0;
  double ends = 0.0;
  for (double ohm = 1.0; ohm < 1e7; ohm *= 1.00731) {
    one = std::max(one, off(nearest_part(Series::e96, ohm), ohm));
    const PartValue pair = nearest_pair(Series::e96, ohm);
    // Near the ends of what is common there are fewer pairs.
    double& worst = ohm < 100.0 || ohm > 1e5 ? ends : two;
    worst = std::max(worst, off(pair, ohm));
    CHECK(is_common(pair.first));
    CHECK((pair.joint == PartValue::Joint::single || is_common(pair.second)));
  }
  CHECK(one < 0.0151);
  CHECK(two < 2e-4);
  CHECK(ends < 3e-4);
  CHECK(two > 5e-5);  // it is a measurement
  CHECK(nearest_part(Series::e96, 22600.4).ohm() == 22600.0);
  CHECK(nearest_part(Series::e96, 2.26e-3).ohm() == 2.26e-3);
  CHECK(nearest_pair(Series::e96, 1e4).joint == PartValue::Joint::single);
  // And one that is the series' own but for rounding.
  CHECK(nearest_pair(Series::e96, std::nextafter(1e3, 0.0)).ohm() == 1e3);
  CHECK_THROWS_AS(nearest_pair(Series::e96, 0.0), std::invalid_argument);
}

TEST_CASE("entries of K and K' keep their ratio, which costs less than one of them rounded",
          "[part_values]") {
  for (const Realization one : {Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    const Circuit circuit = realize(one, array_network(21, 1e-3).problem);
    const Reduction reduction(circuit);
    const PartChoice choice(reduction, Series::e96);
    const std::vector<PartValue> values =
        choice.values(std::vector<bool>(choice.groups().size(), false));
    std::size_t partners = 0;
    for (const std::vector<std::size_t>& group : choice.groups()) {
      if (group.size() == 1) continue;
      ++partners;
      const double ratio = values[group[1]].ohm() / values[group[0]].ohm();
      if (one == Realization::least_squares) CHECK(ratio == 1.0);
      if (one == Realization::lattice) CHECK_THAT(ratio, WithinRel(4.0, 0.0155));
    }
    CHECK(partners == (one == Realization::lattice ? 2U : 1U) * 441U);

    // Against K rounded alone, its errors not shared; the other arrays have their own values.
    const std::vector<Load> load = {circuit.sources};
    const LoadedNetwork network(reduction, load);
    std::vector<double> together = siemens_of(values);
    for (std::size_t r = 0; r < together.size(); ++r) {
      const Array array = place_of(reduction.resistors()[r]).array;
      if (array != Array::kernel && array != Array::transposed)
        together[r] = reduction.siemens()[r];
    }
    std::vector<double> apart = together;
    for (std::size_t r = 0; r < apart.size(); ++r)
      if (place_of(reduction.resistors()[r]).array == Array::transposed)
        apart[r] = reduction.siemens()[r];
    CHECK(network.error(together) < network.error(apart));
    CHECK(network.error(siemens_with(reduction, true)) < network.error(siemens_of(values)));
  }
}

TEST_CASE("a soldered circuit has the answer of its values", "[part_values]") {
  const FlatCircuit circuit(realize(Realization::lattice, array_network(9, 1e-3).problem));
  const Reduction reduction(circuit.circuit());
  const PartChoice choice(reduction, Series::e24);
  std::vector<bool> pairs(choice.groups().size());
  for (std::size_t g = 0; g < pairs.size(); ++g) pairs[g] = g % 2 == 0;
  const std::vector<PartValue> values = choice.values(pairs);
  const SolderedCircuit built = soldered(circuit, values, std::vector<double>(values.size(), 0.01));

  CHECK(built.parts.size() == built.circuit.resistors.size());
  CHECK(built.parts.size() > values.size());
  for (std::size_t r = 0; r < built.parts.size(); ++r) {
    CHECK(built.partner[built.partner[r]] == r);
    CHECK(built.parts[r].ohm == nearest_in(Series::e24, built.parts[r].ohm));
  }
  Circuit wanted = circuit.circuit();
  for (std::size_t r = 0; r < values.size(); ++r)
    wanted.resistors[r].siemens = 1.0 / values[r].ohm();
  CHECK(l2_difference(operating_voltages(FlatCircuit(built.circuit)),
                      operating_voltages(FlatCircuit(wanted))) < 1e-9);
  CHECK_THROWS_AS(soldered(circuit, {}, {}), std::invalid_argument);
}

TEST_CASE("several loads count as the mean of each, and first order is near", "[part_values]") {
  const NetworkProblem problem = array_network(9, 1e-2).problem;
  const Circuit circuit = realize(Realization::least_squares, problem);
  const Reduction reduction(circuit);
  std::vector<Load> both(2, circuit.sources);
  for (std::size_t i = 0; i < both[1].size(); ++i)  // the readings, mirrored
    both[1][i].ampere = circuit.sources[circuit.sources.size() - 1 - i].ampere;
  both[1][0].ampere *= 3.0;
  const LoadedNetwork network(reduction, both);
  const std::vector<double> first = LoadedNetwork(reduction, {&both[0], 1}).sensitivities();
  const std::vector<double> second = LoadedNetwork(reduction, {&both[1], 1}).sensitivities();
  const std::vector<double> mean = network.sensitivities();
  const std::vector<double> known = relative_sensitivities(reduction);
  for (std::size_t r = 0; r < mean.size(); ++r) {
    CHECK_THAT(mean[r], WithinRel(0.5 * (first[r] + second[r]), 1e-10) || WithinAbs(0.0, 1e-25));
    CHECK_THAT(first[r], WithinRel(known[r], 1e-8) || WithinAbs(known[r], 1e-20));
  }
  // A change of all at once, not the sum of its squares: exactly what it does, to first order.
  std::vector<ResistorChange> change;
  std::vector<double> siemens(reduction.siemens().begin(), reduction.siemens().end());
  for (std::size_t r = 0; r < siemens.size(); ++r) {
    change.push_back({r, 1e-6 * std::sin(1.0 + static_cast<double>(r))});
    siemens[r] *= 1.0 + change.back().relative;
  }
  const std::vector<std::vector<ResistorChange>> changes(1, change);
  const double predicted = std::sqrt(network.squared_errors(changes).front());
  CHECK_THAT(network.error(siemens), WithinRel(predicted, 1e-3));
  CHECK_THROWS_AS(LoadedNetwork(reduction, {}), std::invalid_argument);
}

TEST_CASE("a resistor's name says where it stands", "[part_values]") {
  CHECK(place_of("Rk3_17p").array == Array::kernel);
  CHECK(place_of("Rk3_17p").row == 3);
  CHECK(place_of("Rk3_17p").column == 17);
  CHECK(place_of("Re5").column == 5);
  CHECK(place_of("R1.Xf0_12").array == Array::inside);
  CHECK(place_of("R1.Xf0_12").column == 12);
  CHECK(same_entry("Rt3_17n") == "Rk3_17n");
  CHECK(same_entry("Rs3_4").empty());
}
