/// @file
/// What can be said of a scene's circuit before it is built.
#pragma once

#include <optional>

#include "tactile_net/lab/board_certificate.hpp"
#include "tactile_net/lab/circuit_refinement.hpp"
#include "tactile_net/lab/contact_motion.hpp"
#include "tactile_net/lab/datasheet.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/parts_list.hpp"
#include "tactile_net/lab/recommendation.hpp"
#include "tactile_net/lab/relaxation.hpp"

namespace tactile_net::lab {

struct Certification {
  SceneCircuit circuit;
  std::optional<ContactMotion> motion{};       ///< of contacts, for a circuit that settles
  std::optional<ToleranceResult> tolerance{};  ///< where the scene gives one, for a linear circuit
  std::optional<CircuitRefinement> refinement{};  ///< where the scene asks for it
  Recommendation recommendation{};
  std::optional<PartsList> parts{};  ///< where an accuracy is asked for
  /// Of the board that is given, or of that which the list of parts makes.
  std::optional<BoardCertificate> board{};
  std::optional<Datasheet> datasheet{};  ///< where one is asked for
  bool oscillating_board = false;        ///< as `CertificationOptions`

  /// Stability is of the linear circuit: where devices' curves leave no answer of it, why.
  std::optional<Disagreement> curves{};

  /// Whether a board is to be written: of a choice that does not oscillate on it.
  [[nodiscard]] bool writes_board() const noexcept {
    return parts && parts->choice &&
           (oscillating_board || !board || !board->soldered().oscillates());
  }

  [[nodiscard]] const AnyScene& scene() const noexcept { return circuit.scene(); }
  [[nodiscard]] const Certificate& certificate() const { return circuit.certificate(); }
};

/// For the scene's simulated readings; without a simulator of circuits, and without solving for the
/// tractions.
///
struct CertificationOptions {
  std::optional<double> accuracy{};  ///< of a list of parts, `parts_list`; absent: none is made
  const LaidBoard* board = nullptr;  ///< of the scene's own circuit; null: none is given
  double phase_margin = usual_phase_margin;  ///< wanted on the board [degrees]
  bool oscillating_board = false;            ///< a board that oscillates is written all the same
  bool datasheet = false;  ///< one is made, of the list's circuit where there is one
};

/// @throw std::invalid_argument, std::domain_error  the scene's options make no circuit, or as
///                                                  `parts_list`, `certify_board` and `datasheet`
[[nodiscard]] Certification certify(const AnyScene& scene, Observer& observer = silent,
                                    const CertificationOptions& wanted = {});

}  // namespace tactile_net::lab
