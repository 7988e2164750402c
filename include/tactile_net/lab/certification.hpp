/// @file
/// What can be said of a scene's circuit before it is built.
#pragma once

#include <optional>

#include "tactile_net/lab/contact_motion.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/parts_list.hpp"
#include "tactile_net/lab/recommendation.hpp"
#include "tactile_net/lab/relaxation.hpp"

namespace tactile_net::lab {

struct Certification {
  SceneCircuit circuit;
  std::optional<ContactMotion> motion{};       ///< of contacts, for a circuit that settles
  std::optional<ToleranceResult> tolerance{};  ///< where the scene gives one, for a linear circuit
  Recommendation recommendation{};
  std::optional<PartsList> parts{};  ///< where an accuracy is asked for

  /// Stability is of the linear circuit: where devices' curves leave no answer of it, why.
  std::optional<Disagreement> curves{};

  [[nodiscard]] const AnyScene& scene() const noexcept { return circuit.scene(); }
  [[nodiscard]] const Certificate& certificate() const { return circuit.certificate(); }
};

/// For the scene's simulated readings; without a simulator of circuits, and without solving for the
/// tractions.
///
/// @param accuracy  of a list of parts, `parts_list`; absent: none is made
/// @throw std::invalid_argument, std::domain_error  the scene's options make no circuit, or as
///                                                  `parts_list`
[[nodiscard]] Certification certify(const AnyScene& scene, Observer& observer = silent,
                                    std::optional<double> accuracy = {});

}  // namespace tactile_net::lab
