/// @file
/// Op-amps that are sold, with the figures of their data sheets.
///
///     for (const OpAmpPart& part : opamp_parts()) part.name;  // "ADA4940-1", ...
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/network/amplifier_package.hpp"
#include "tactile_net/network/opamp.hpp"

namespace tactile_net {

struct OpAmpPart {
  std::string name{};     ///< by which it is ordered: "THS4551"
  std::string maker{};    ///< "Texas Instruments"
  std::string sheet{};    ///< the data sheet's title, number and date
  std::string package{};  ///< "SO-8"
  /// Complementary of a fully differential amplifier.
  Outputs outputs = Outputs::single;
  /// As a deck has it: of a fully differential amplifier gain, bandwidth and slew are of one
  /// output, half of those of the outputs' difference, which are the data sheet's. A second pole is
  /// that which makes the phase margin. What the table does not have is absent.
  OpAmp opamp{};
  std::optional<double> least_supply{}, most_supply{};  ///< between its supply pins [V]
  std::optional<double> headroom{};        ///< of an output to either supply [V]; absent: not known
  std::optional<double> supply_current{};  ///< [A]

  /// What one costs, by a class: "under 1 dollar", "1 to 3 dollars" or "over 3 dollars" of a
  /// hundred, as distributors typically ask. A scene's own price is what counts.
  std::string price{};

  AmplifierPins pins{};
  std::string pins_at{};  ///< where the data sheet says it

  /// As a board takes it.
  [[nodiscard]] AmplifierPackage packaged() const { return {name, package, pins}; }

  /// A figure as the data sheet has it, and where it stands there.
  struct Figure {
    std::string name{};  ///< the table's: "gain_bandwidth"
    std::vector<double> values{};
    std::string at{};  ///< "page 1, Features"
  };
  std::vector<Figure> figures{};
};

/// As boards take it; absent: no part is named.
[[nodiscard]] std::optional<AmplifierPackage> package_of(const OpAmpPart* part);

/// Those of circuits/parts, in the order of their names.
[[nodiscard]] std::span<const OpAmpPart> opamp_parts();

/// What an op-amp lacks of the figures that its loops' stability depends on, in words; empty:
/// nothing.
[[nodiscard]] std::vector<std::string_view> figures_not_known(const OpAmp& opamp);

/// What a second pole at the other side of the crossover leaves of 180 degrees at a gain of 1.
///
/// @param gain_bandwidth  [Hz]
/// @param phase_margin    [degrees], > 0 and < 90
/// @return                the second pole [Hz]
[[nodiscard]] double second_pole_of(double gain_bandwidth, double phase_margin) noexcept;

}  // namespace tactile_net
