/// @file
/// Amplifier i drives node i; its summing node s_i takes |P_ij| from node j, or from its inverse
/// where P_ij < 0, and gives off the current b_i. As a voltage b_i comes through a resistor as
/// large as the largest row's together, so that none is above the largest of the answer's.
#include "network/realizations/nodes.hpp"
#include "network/realizations/traits.hpp"

namespace tactile_net {
namespace {

Circuit crossbar_circuit(const NetworkProblem& problem, const RealizationOptions& options) {
  const Matrix& matrix = problem.matrix;
  const std::vector<double>& right_side = problem.right_side;
  const std::size_t n = matrix.rows;
  if (n == 0 || matrix.columns != n || matrix.values.size() != n * n || right_side.size() != n)
    throw std::invalid_argument("a crossbar needs a square matrix and one current per row");
  if (!all_finite(matrix.values) || !all_finite(right_side))
    throw std::invalid_argument("the matrix and the currents must be finite");
  check(options);

  Circuit circuit;
  circuit.divider = options.divider;
  const std::string main = add_models(circuit, Realization::crossbar, options);
  std::vector<Signed> nodes;
  for (std::size_t i = 0; i < n; ++i) {
    const std::string index = std::to_string(i);
    nodes.push_back(
        add_amplifier(circuit, "s" + index, "n" + index, "r" + index, main, options.inverters));
    circuit.outputs.push_back(nodes[i].plus);
  }
  const double siemens = options.scale.siemens;
  const double input = options.inputs == Inputs::voltage ? siemens * largest_row_sum(matrix) : 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::string row = std::to_string(i);
    for (std::size_t j = 0; j < n; ++j)
      add_signed(circuit, "R" + row + "_" + std::to_string(j), nodes[j], nodes[i].summing,
                 siemens * matrix(i, j));
    add_reading(circuit, row, nodes[i].summing, 0.0 - siemens * options.scale.volts * right_side[i],
                input);
  }
  return circuit;
}

constexpr TheoremCondition crossbar_conditions[] = {
    TheoremCondition::definite, TheoremCondition::second_pole_beyond_bandwidth,
    TheoremCondition::no_resistor_capacitance, TheoremCondition::no_output_resistance};
constexpr TheoremCondition crossbar_conditions_with_inverters[] = {
    TheoremCondition::definite,
    TheoremCondition::no_inverter_input_capacitance,
    TheoremCondition::no_second_pole,
    TheoremCondition::main_at_most_half_of_inverters,
    TheoremCondition::no_resistor_capacitance,
    TheoremCondition::no_output_resistance};
constexpr TheoremCondition crossbar_conditions_of_slewing[] = {
    TheoremCondition::complementary_outputs,   TheoremCondition::definite,
    TheoremCondition::no_input_capacitance,    TheoremCondition::no_second_pole,
    TheoremCondition::no_resistor_capacitance, TheoremCondition::no_output_resistance};

}  // namespace

constexpr RealizationTraits crossbar_traits{
    .realization = Realization::crossbar,
    .uses_opamps = true,
    .drives_nodes = true,
    .theorem =
        {"T5",
         "Complementary outputs: stable if P is positive definite (at infinite gain only then), "
         "for any bandwidths, and either any second poles or any capacitance at the summing nodes; "
         "for both where the second poles are not below the bandwidths.",
         crossbar_conditions, true},
    .theorem_with_inverters = {"T3",
                               "Main op-amps of at most half the inverters' bandwidth, and of no "
                               "more gain: stable if P is positive definite, for any capacitance "
                               "at the summing nodes.",
                               crossbar_conditions_with_inverters},
    .theorem_of_slewing =
        {"T8",
         "Op-amps of any slew, with complementary outputs: the circuit comes to its answer from "
         "everywhere, however far it slews.",
         crossbar_conditions_of_slewing},
    .bandwidth_ratio = [](const RealizationOptions&) { return 0.5; },
    .build = crossbar_circuit};

}  // namespace tactile_net
