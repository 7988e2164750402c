/// @file
/// Networks of sensor arrays that several tests share.
#pragma once

#include <utility>
#include <vector>

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/network/flat_circuit.hpp"
#include "tactile_net/network/realization.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net {

/// An array under a cylinder, dragged if two unknowns are solved, and its direct solution.
struct ArrayNetwork {
  NetworkProblem problem;
  std::vector<double> direct;
};

inline ArrayNetwork array_network(std::size_t count, double alpha, std::size_t unknowns = 1,
                                  const std::optional<Layer>& layer = {}) {
  using enum Quantity;
  const SensorArray array{count,
                          count > 30 ? 0.25 : 0.5,
                          {1.5},
                          unknowns == 2 ? std::vector{stress_x, shear_xy} : std::vector{strain_x}};
  const Material pad{1.0, 0.45, layer};
  RigidContact contact{.half_width = 2.0};
  if (unknowns == 2) contact.friction = 0.4;
  const std::vector<double> g =
      sampled_readings(array, pad, sample(std::vector<Contact>{contact}, array));
  const LinearProblem inverse =
      make_problem(array, pad, {.unknowns = unknowns, .smoothing_length = 1.0});
  return {network_problem(inverse, alpha, g), tikhonov_solve(inverse, alpha, g)};
}

/// '+' and '-' of every converter's op-amps exchanged.
inline Circuit swapped(const Circuit& circuit) {
  Circuit flat = FlatCircuit(circuit).circuit();
  for (Instance& x : flat.instances)
    if (x.name.find(".Xr") == std::string::npos) std::swap(x.pins[0], x.pins[1]);
  return flat;
}

/// 1 kilo-ohm and 1 nF from one node to ground, driven by 2 mA: 2 V after some microseconds.
inline Circuit resistor_and_capacitor() {
  Circuit circuit;
  const Node a = add_node(circuit, "n0");
  circuit.outputs = {a};
  circuit.resistors = {{"R0", a, 0, 1e-3}};
  circuit.capacitors = {{"C0", a, 0, 1e-9}};
  circuit.sources = {{"I0", a, 2e-3}};
  return circuit;
}

}  // namespace tactile_net
