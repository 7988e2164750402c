/// @file
/// The circuit of a small skin: from its problem to what the network room realises, certifies and
/// writes as a deck.
///
///     const lab::SkinSceneProblem problem(skin);
///     const lab::FrameAnswer answer = lab::solve(problem, readings);
///     const NetworkCircuit circuit(Realization::least_squares,
///         std::make_shared<const NetworkProblem>(
///             lab::skin_network_problem(problem.problem(), answer.alpha.value, readings)), {});
///     certify(circuit).stability;                        // network/certificate.hpp
///
/// Of a whole scene: `SceneCircuit` (scene_circuit.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "tactile_net/network/realization.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net::lab {

/// `network_problem` of a skin: node i stands for traction i, the normal ones of all cells, then
/// tangential_y, then tangential_z, and is named after it: "p_3_5" of row 3 and column 5, from 0,
/// "qy_3_5" and "qz_3_5". Constraints are not among it: circuits are linear.
///
/// @throw std::invalid_argument  alpha is not > 0 and finite, or readings have the wrong size
[[nodiscard]] NetworkProblem skin_network_problem(const LinearProblem& problem, double alpha,
                                                  std::span<const double> readings);

/// Branches of P, at most, of realisations that have one for each pair of nodes: with more a deck
/// takes a simulator minutes. An 8 x 8 skin with cells at its taxels has 18336.
inline constexpr std::size_t most_branches = 20000;
/// Nodes and residuals together, of the one that has two arrays and no P.
inline constexpr std::size_t most_amplifiers = 1024;

/// Why a skin of so many tractions and readings is too large for a realisation: how many parts it
/// would have, how many there may be, and what takes fewer. Absent: it is small enough.
[[nodiscard]] std::optional<std::string> too_large(Realization realization, std::size_t tractions,
                                                   std::size_t readings);

}  // namespace tactile_net::lab
