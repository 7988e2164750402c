/// @file
/// Resistors, negative ones included: the definition, for checking. One per branch, and one to
/// ground per node whose row sum is not zero: R<i>_<j>, Rg<i>.
#include "network/realizations/nodes.hpp"
#include "network/realizations/traits.hpp"

namespace tactile_net {
namespace {

Circuit ideal_circuit(const NetworkProblem& problem, const RealizationOptions& options) {
  const ConductanceNetwork network = conductances(problem.matrix);
  Circuit circuit = driven_nodes(network, problem.right_side, options);
  each_conductance(network, circuit, options.scale.siemens,
                   [&](const std::string& name, Node from, Node to, double siemens) {
                     circuit.resistors.push_back({"R" + name, from, to, siemens});
                   });
  return circuit;
}

constexpr TheoremCondition ideal_conditions[] = {TheoremCondition::definite};

}  // namespace

constexpr RealizationTraits ideal_traits{
    .realization = Realization::ideal,
    .rounding = 1e-11,  // amplifiers make a simulator eliminate more
    .theorem = {"T0",
                "With capacitance at its nodes the network settles if and only if P is positive "
                "definite.",
                ideal_conditions},
    .build = ideal_circuit};

}  // namespace tactile_net
