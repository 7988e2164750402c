/// @file
/// What builds of a circuit do, as a data sheet says it: each figure's least, typical and largest
/// value over tolerances and temperature, from draws that nothing was chosen with.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/lab/board_certificate.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/parts_list.hpp"
#include "tactile_net/lab/scene_circuit.hpp"

namespace tactile_net::lab {

struct DatasheetFigure {
  enum class Kind { error, offset, settling, noise, supply_current };
  enum class Verdict { no_limit, passes, fails, open };

  Kind kind = Kind::error;
  std::size_t builds = 0;  ///< that were drawn
  double least = 0.0;      ///< of them; infinite where a build is unstable, as all below
  double typical = 0.0;    ///< their median
  double p95 = 0.0;        ///< 95 of 100 of them are within it
  /// Where that of all builds lies, in 95 of 100 such draws, `quantile_ranks`.
  double p95_least = 0.0, p95_most = 0.0;
  std::optional<double> limit{};  ///< that the scene states

  /// Passes if 95 of 100 of all builds are within the limit, fails if not, as sure as that.
  [[nodiscard]] Verdict verdict() const noexcept;
};

/// Why a figure is not told.
struct MissingFigure {
  enum class Reason {
    no_bandwidth,     ///< nothing takes a time that is modelled
    too_many_states,  ///< draws of poles would take hours
    no_noise,         ///< the op-amps' is not stated, or has no size
    no_part,          ///< the supply current is a part's, and the scene names none that states it
    no_offset,        ///< the op-amps have none
  };
  DatasheetFigure::Kind kind = DatasheetFigure::Kind::error;
  Reason reason = Reason::no_bandwidth;
};

struct Datasheet {
  Realization realization = Realization::lattice;
  bool ladder = false;  ///< see `has_ladder`
  std::size_t opamps = 0;
  std::string opamp_part{};  ///< empty: the scene names none
  bool ordered = false;   ///< it is of the list that is to order, else of the scene's own circuit
  bool on_board = false;  ///< with the capacitances of its board
  ToleranceOptions drawn{};  ///< what resistors and op-amps are off
  /// The temperature differs from build to build, and what offsets do then is not stated.
  bool drift_unknown = false;
  std::size_t loads = 1;  ///< the contacts' places that errors are root mean squares over
  double settling_accuracy = 1e-3;
  std::size_t unstable = 0;  ///< of the builds whose poles were computed
  std::vector<DatasheetFigure> figures{};
  std::vector<MissingFigure> missing{};

  /// Whether no limit is missed.
  [[nodiscard]] bool passes() const noexcept;
};

/// The figure that draws make. @param values  one a build, in any order, not empty
[[nodiscard]] DatasheetFigure figure_of(DatasheetFigure::Kind kind, std::vector<double> values,
                                        std::optional<double> limit = {});

/// Beyond this no poles of builds are drawn.
inline constexpr std::size_t most_datasheet_states = 400;

/// Of the circuit that a list of parts has chosen, or of the scene's own with its tolerances.
///
/// @param parts  null, or without a choice: the scene's own circuit
/// @param board  of that list, or of the scene's own circuit; null: with what the scene states of a
///               board
/// @throw std::invalid_argument  there is no load; the circuit is not of resistors and op-amps, or
///                               has programmed arrays or lines with a resistance
[[nodiscard]] Datasheet datasheet(const SceneCircuit& circuit, const PartsList* parts = nullptr,
                                  const BoardCertificate* board = nullptr);

/// A build of those that the figures over time are of, for whoever compares.
///
/// @throw std::invalid_argument  as `datasheet`
[[nodiscard]] Circuit datasheet_build(const SceneCircuit& circuit, const PartsList* parts,
                                      std::size_t build, const BoardCertificate* board = nullptr);

/// The temperature of that build, whose noise is of it [K].
///
/// @throw std::invalid_argument  as `datasheet`
[[nodiscard]] double datasheet_kelvin(const SceneCircuit& circuit, const PartsList* parts,
                                      std::size_t build);

}  // namespace tactile_net::lab
