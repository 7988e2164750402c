/// @file
/// Residual amplifiers e_i = -rho (K f - g)_i and main amplifiers that hold K'e = rho R f: the
/// fixed point is K'K f + R f = K'g. Takes the readings themselves.
///
/// Conductances are siemens * scale^2 * K/scale, scale = the largest 2-norm of a column of K, and
/// rho * siemens * R: the answer is free of K's unit. The outputs are the main amplifiers'.
#include <algorithm>
#include <cmath>

#include "network/realizations/nodes.hpp"
#include "network/realizations/traits.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

Circuit build(const NetworkProblem& problem, const RealizationOptions& options) {
  check(options);
  const Matrix& k = problem.kernel;
  const double scale = as_eigen(k).colwise().norm().maxCoeff();
  if (!(scale > 0.0)) throw std::invalid_argument("K must not be zero");
  const double siemens = options.scale.siemens * scale * scale;  // per unit of K / scale
  const double rho = options.residual_gain;

  Circuit circuit;
  circuit.divider = options.divider;
  const std::string main = add_models(circuit, Realization::least_squares, options);
  const std::string others = circuit.amplifiers.front().name;
  std::vector<Signed> f;
  std::vector<Signed> e;
  for (std::size_t j = 0; j < k.columns; ++j) {
    const std::string index = std::to_string(j);
    f.push_back(
        add_amplifier(circuit, "s" + index, "n" + index, "r" + index, main, options.inverters));
    circuit.outputs.push_back(f[j].plus);
  }
  for (std::size_t i = 0; i < k.rows; ++i) {
    const auto row = k.row(i);
    if (std::all_of(row.begin(), row.end(), [](double value) { return value == 0.0; })) {
      e.push_back({});  // a dead taxel has no residual
      continue;
    }
    const std::string index = std::to_string(i);
    e.push_back(
        add_amplifier(circuit, "t" + index, "e" + index, "q" + index, others, options.inverters));
  }

  for (std::size_t i = 0; i < k.rows; ++i) {
    if (e[i].summing == 0) continue;
    const std::string row = std::to_string(i);
    for (std::size_t j = 0; j < k.columns; ++j) {
      const std::string pair = row + "_" + std::to_string(j);
      const double conductance = siemens * (k(i, j) / scale);
      add_signed(circuit, "Rk" + pair, f[j], e[i].summing, conductance);
      add_signed(circuit, "Rt" + pair, e[i], f[j].summing, -conductance);
    }
    circuit.resistors.push_back({"Re" + row, e[i].plus, e[i].summing, siemens / rho});
    circuit.sources.push_back(
        {"I" + row, e[i].summing,
         0.0 - siemens * options.scale.volts * (problem.readings[i] / scale)});
  }
  for (std::size_t i = 0; i < k.columns; ++i)
    for (std::size_t j = 0; j < k.columns; ++j)
      add_signed(circuit, "Rs" + std::to_string(i) + "_" + std::to_string(j), f[j], f[i].summing,
                 rho * options.scale.siemens * problem.stabiliser(i, j));
  return circuit;
}

constexpr TheoremCondition needs[] = {TheoremCondition::definite,
                                      TheoremCondition::lag_within_bound,
                                      TheoremCondition::no_output_resistance};
constexpr TheoremCondition needs_with_inverters[] = {
    TheoremCondition::main_slow_enough, TheoremCondition::definite,
    TheoremCondition::no_input_capacitance, TheoremCondition::no_second_pole,
    TheoremCondition::no_output_resistance};

}  // namespace

constexpr RealizationTraits least_squares_traits{
    .realization = Realization::least_squares,
    .name = "least_squares",
    .uses_opamps = true,
    .drives_nodes = true,
    .takes_readings = true,
    .theorem =
        {"T6",
         "Complementary outputs: stable for every gain rho and any bandwidths, and for a lag of "
         "summing nodes and second poles within its bound.",
         needs},
    .theorem_with_inverters =
        {"T4",
         "Main op-amps slow enough: stable. How slow is not proven; 0.2/rho of "
         "the others' bandwidth is a rule of thumb.",
         needs_with_inverters},
    .bandwidth_ratio =
        [](const RealizationOptions& options) { return 0.2 / options.residual_gain; },
    .build = build};

}  // namespace tactile_net
