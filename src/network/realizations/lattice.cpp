/// @file
/// Least squares without residual amplifiers. Row i of K is a pair of passive nodes u+, u-: array A
/// (conductances a_i |k_ij|, k = K/scale) leads from +-f_j to them, array B (b_i |k_ij|) from them
/// to both inputs s+_j, s-_j of the amplifier that drives +-f_j; signs by crossing the pair. A
/// reading is a pair of currents -+a_i g_i/scale.
///
/// With a_i = c b_i, a row's total D_i = (1 + c) b_i sum |k_ij|, so that b_i in proportion to
/// sum |k_ij| gives every residual u_i = a_i (k f - g/scale)_i / D_i the same weight
/// w = b_i a_i / D_i. As a pair of voltages a reading comes through resistors of a_i l, l the
/// largest sum |k_ij|, which D_i has besides: b_i is then in proportion to sum |k_ij| + c/(1 + c)
/// l. The stabiliser's conductances are w R / scale^2 from +-f_j to s+-_i, and the fixed point is
/// (K'K + R) f = K'g. The answer is free of K's unit: scale is the largest 2-norm of a column of K,
/// b_i at most siemens * scale^2. The outputs are the amplifiers'.
#include <algorithm>

#include "network/realizations/nodes.hpp"
#include "network/realizations/traits.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

/// a_i / b_i: more of it costs resistors' range, less costs the loop's speed.
constexpr double array_ratio = 4.0;

/// Two nodes of opposite voltage, or the two inputs of an amplifier.
struct Pair {
  Node plus = 0;
  Node minus = 0;
};

/// A conductance of either sign between two pairs: two resistors, crossed where it is negative.
void add_crossed(Circuit& circuit, const std::string& name, const Pair& from, const Pair& to,
                 double siemens) {
  if (siemens == 0.0) return;
  const Pair end = siemens > 0.0 ? to : Pair{to.minus, to.plus};
  const double size = siemens > 0.0 ? siemens : -siemens;
  circuit.resistors.push_back({name + 'p', from.plus, end.plus, size});
  circuit.resistors.push_back({name + 'n', from.minus, end.minus, size});
}

Circuit lattice_circuit(const NetworkProblem& problem, const RealizationOptions& options) {
  check(options);
  const Eigen::MatrixXd k = as_eigen(problem.kernel);
  const double scale = k.colwise().norm().maxCoeff();
  if (!(scale > 0.0)) throw std::invalid_argument("K must not be zero");
  const Eigen::VectorXd row_sums = k.rowwise().lpNorm<1>() / scale;
  const double largest = row_sums.maxCoeff();
  const double siemens = options.scale.siemens * scale * scale;  // per unit of k
  const double input = options.inputs == Inputs::voltage ? largest : 0.0;
  const double share = array_ratio / (1.0 + array_ratio);
  const double whole = largest + share * input;

  Circuit circuit;
  circuit.divider = options.divider;
  const std::string model = add_models(circuit, Realization::lattice, options);
  std::vector<Pair> f;
  std::vector<Pair> inputs;
  for (std::size_t j = 0; j < problem.kernel.columns; ++j) {
    const std::string index = std::to_string(j);
    inputs.push_back({add_node(circuit, "p" + index), add_node(circuit, "s" + index)});
    f.push_back({add_node(circuit, "n" + index), add_node(circuit, "r" + index)});
    add_driver(circuit, inputs[j].plus, {inputs[j].minus, f[j].plus, f[j].minus}, model,
               options.inverters);
    circuit.outputs.push_back(f[j].plus);
  }
  for (std::size_t i = 0; i < problem.kernel.rows; ++i) {
    const double row_sum = row_sums(static_cast<Eigen::Index>(i));
    if (row_sum == 0.0) continue;  // a dead taxel has no residual
    const std::string row = std::to_string(i);
    const Pair u{add_node(circuit, "u" + row), add_node(circuit, "v" + row)};
    const double b = siemens * ((row_sum + share * input) / whole);
    for (std::size_t j = 0; j < problem.kernel.columns; ++j) {
      const std::string pair = row + "_" + std::to_string(j);
      const double conductance = b * (problem.kernel(i, j) / scale);
      add_crossed(circuit, "Rk" + pair, f[j], u, array_ratio * conductance);
      add_crossed(circuit, "Rt" + pair, u, inputs[j], -conductance);
    }
    const double ampere = array_ratio * b * options.scale.volts * (problem.readings[i] / scale);
    add_reading(circuit, row + 'p', u.plus, 0.0 - ampere, array_ratio * b * input);
    add_reading(circuit, row + 'n', u.minus, ampere, array_ratio * b * input);
    if (options.node_capacitance) {
      circuit.capacitors.push_back({"C" + row + 'p', u.plus, 0, *options.node_capacitance});
      circuit.capacitors.push_back({"C" + row + 'n', u.minus, 0, *options.node_capacitance});
    }
  }
  const double weight = share * options.scale.siemens / whole;
  for (std::size_t i = 0; i < problem.kernel.columns; ++i)
    for (std::size_t j = 0; j < problem.kernel.columns; ++j)
      add_crossed(circuit, "Rs" + std::to_string(i) + "_" + std::to_string(j), f[j], inputs[i],
                  -weight * problem.stabiliser(i, j));
  return circuit;
}

constexpr TheoremCondition lattice_conditions[] = {
    TheoremCondition::definite, TheoremCondition::one_lag,
    TheoremCondition::second_pole_beyond_twice_bandwidth, TheoremCondition::no_resistor_capacitance,
    TheoremCondition::no_output_resistance};
constexpr TheoremCondition lattice_conditions_with_inverters[] = {
    TheoremCondition::complementary_outputs, TheoremCondition::definite};
constexpr TheoremCondition lattice_conditions_of_slewing[] = {
    TheoremCondition::complementary_outputs, TheoremCondition::definite,
    TheoremCondition::no_input_capacitance,  TheoremCondition::no_second_pole,
    TheoremCondition::no_node_capacitance,   TheoremCondition::no_resistor_capacitance,
    TheoremCondition::no_output_resistance,  TheoremCondition::slew_holds_outputs};

constexpr std::string_view statement =
    "Op-amps of equal bandwidth with complementary outputs: stable for any capacitance at their "
    "inputs with second poles of twice the bandwidth or more, for any second pole without such "
    "capacitance, or with one pole for any capacitance at the residuals' nodes.";

}  // namespace

constexpr RealizationTraits lattice_traits{
    .realization = Realization::lattice,
    .uses_opamps = true,
    .drives_nodes = true,
    .takes_readings = true,
    .passive_residuals = true,
    .theorem = {"T7", statement, lattice_conditions},
    .theorem_with_inverters = {"T7", statement, lattice_conditions_with_inverters},
    .theorem_of_slewing = {"T8",
                           "Op-amps of one slew, one bandwidth and one gain, with complementary "
                           "outputs, of which none takes more than two thirds of the slew to be "
                           "held at rest: the circuit comes to its answer from everywhere, however "
                           "far it slews.",
                           lattice_conditions_of_slewing},
    .bandwidth_ratio = [](const RealizationOptions&) { return 0.5; },
    .build = lattice_circuit};

}  // namespace tactile_net
