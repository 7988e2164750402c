/// @file
/// What a circuit solves: P f = b of one frame, of a line or of a skin. `SceneCircuit` asks it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/network/realization.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::lab {

/// Not thread-safe.
class CircuitSource {
 public:
  virtual ~CircuitSource() = default;

  /// With the surface that the nodes stand for, and of a skin with what its options leave out.
  [[nodiscard]] virtual const AnyScene& scene() const noexcept = 0;

  /// Of the tractions that the nodes stand for.
  /// @throw std::invalid_argument  alpha is not > 0 and finite
  [[nodiscard]] virtual NetworkProblem problem(double alpha) const = 0;

  /// f of the direct solve of P f = b [Pa], by a method that does not form P.
  [[nodiscard]] virtual std::vector<double> direct(double alpha) const = 0;

  /// How the problem's readings, weighted as they are, change per metre that the scene's contacts
  /// move along y, without noise; empty: there are none.
  [[nodiscard]] virtual std::vector<double> readings_per_length() const = 0;

  /// Why a realisation is none of it; absent: it is one.
  [[nodiscard]] virtual std::optional<std::string> refusal(Realization realization) const = 0;
};

/// Of a line: nodes as far apart as the scene has them.
[[nodiscard]] std::shared_ptr<const CircuitSource> circuit_source(const SceneFrame& frame);

/// Of a skin.
///
/// @throw std::invalid_argument  the scene has constraints, which no linear circuit holds
[[nodiscard]] std::shared_ptr<const CircuitSource> circuit_source(const SkinSceneProblem& problem,
                                                                  std::vector<double> readings);

}  // namespace tactile_net::lab
