/// @file
/// A circuit with what the copper of its board loads its nodes with: whether it still settles, and
/// the siemens at which it does.
///
///     const LaidBoard board = read_kicad_board(text, "board.kicad_pcb");
///     certify_board(simulated_circuit(scene), board).used.margin->degrees;
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/lab/parts_list.hpp"
#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/network/copper_capacitance.hpp"
#include "tactile_net/network/phase_margin.hpp"
#include "tactile_net/network/supply_drop.hpp"

namespace tactile_net::lab {

/// What designers of amplifiers ask for [degrees].
inline constexpr double usual_phase_margin = 45.0;

/// Siemens are not raised beyond where a resistor would be smaller [ohm].
inline constexpr double least_board_ohm = 100.0;

struct BoardCertificate {
  /// The board's circuit at one scale.
  struct Judged {
    double siemens = 0.0;  ///< `Scale::siemens`
    StabilityVerdict stability{};
    std::optional<double> slowest{};           ///< largest real part of a pole [1/s]
    std::optional<double> damping{};           ///< as `Dynamics::damping`
    std::optional<double> settling_seconds{};  ///< as `Dynamics::settling_seconds`
    std::optional<PhaseMargin> margin{};       ///< of a circuit that is stable
    double least_ohm = 0.0;
    /// What the op-amps cannot give at these siemens; absent: nothing, or its limit is not known.
    std::optional<CircuitRemark> overload{};
    std::optional<ScaleProposal> proposal{};  ///< as `Certificate::proposal`

    [[nodiscard]] bool stable() const noexcept { return stability.stability == Stability::stable; }
    [[nodiscard]] bool oscillates() const noexcept {
      return stability.stability == Stability::unstable;
    }
    [[nodiscard]] bool enough(double degrees) const noexcept {
      return stable() && (!margin || margin->degrees >= degrees);
    }
  };

  std::string file{};  ///< whose copper it is; empty: of the board that is written
  Realization realization = Realization::lattice;
  bool ladder = false;  ///< see `has_ladder`
  double wanted = usual_phase_margin;
  double siemens_unit = 1.0;        ///< in which the scene writes siemens [S]
  bool has_planes = false;          ///< false: capacitance is as if the board's other side were one
  double to_plane = 0.0;            ///< of the top layer's copper [mm]
  std::vector<NetCopper> copper{};  ///< of every net but the supply
  std::vector<NodeCapacitance> nodes{};    ///< of the circuit's own, in its order
  std::optional<SupplyDrop> supply{};      ///< of VEE, by its tracks
  std::optional<double> supply_current{};  ///< of an op-amp, typical of its part [A]
  /// At the scene's siemens, and at those that are used: the least that were found to bring the
  /// margin, or of those that were tried the ones with the largest; equal: nothing was changed. Of
  /// a board from a file the latter would be other resistors on the same copper.
  Judged stated{}, used{};
  /// With the capacitances, as it is soldered.
  std::shared_ptr<const NetworkCircuit> circuit{};

  [[nodiscard]] bool changed() const noexcept { return stated.siemens != used.siemens; }
  /// What is, or would be, soldered: of a board from a file its own resistors.
  [[nodiscard]] const Judged& soldered() const noexcept { return file.empty() ? used : stated; }
};

/// The scene's circuit with its board's capacitances, in place of `parasitic.node` and
/// `parasitic.input`: for decks, simulations and certificates.
///
/// @throw std::invalid_argument  the realisation is not one of resistors and op-amps, or the board
///                               is of another circuit
[[nodiscard]] SceneCircuit on_board(const SceneCircuit& circuit, const LaidBoard& board);

/// `simulated_circuit`, on its board where one is given. @throw  as both
[[nodiscard]] SceneCircuit circuit_on_board(const AnyScene& scene,
                                            const std::optional<LaidBoard>& board);

/// The scene's own circuit on that board, in place of `parasitic.node` and `parasitic.input`.
///
/// @param wanted  phase margin [degrees], > 0 and < 90
/// @throw std::invalid_argument  the margin is out of range, the realisation is not one of
///                               resistors and op-amps, or the board is of another circuit
[[nodiscard]] BoardCertificate certify_board(const SceneCircuit& circuit, const LaidBoard& board,
                                             double wanted = usual_phase_margin);

/// The same of the board that a list of parts makes: the siemens are raised and the list is made
/// anew for them, until its board has the margin, or no siemens bring it.
///
/// @param list  of the scene's circuit, with a choice, which is replaced where the siemens are
[[nodiscard]] BoardCertificate close_board(const SceneCircuit& circuit, PartsList& list,
                                           double wanted = usual_phase_margin);

}  // namespace tactile_net::lab
