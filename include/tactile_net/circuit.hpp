/// @file
/// The problem as an analog circuit: its resistors and amplifiers, its deck for ngspice, and what
/// is proven of it before it is built.
///
///     const NetworkProblem network = network_problem(problem, 1e-2, readings);
///     const RealizationOptions options{.opamp = {.bandwidth = 10e6}};
///     const Certificate proven = certify(Realization::lattice, network, options, 1e-3);
///     const Circuit circuit = realize(Realization::lattice, network, options);
///     write_deck(std::cout, circuit, header, Answer::printed);  // for `ngspice -b`
#pragma once

#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/flat_circuit.hpp"
#include "tactile_net/network/part_values.hpp"
#include "tactile_net/network/realization.hpp"
#include "tactile_net/network/tolerance.hpp"
