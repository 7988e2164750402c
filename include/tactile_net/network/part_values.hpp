/// @file
/// Resistors that are sold, in place of those that are wanted: one of a series, or two.
///
///     const PartValue pair = nearest_pair(Series::e96, 12345.0);
///     pair.ohm();                        // within 2e-4 of it
///     pair.joint;                        // in series or parallel
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/network/amplifier_package.hpp"
#include "tactile_net/network/flat_circuit.hpp"
#include "tactile_net/network/reduction.hpp"
#include "tactile_net/network/tolerance.hpp"

namespace tactile_net {

/// What is soldered in a resistor's place.
struct PartValue {
  enum class Joint { single, series, parallel };
  Joint joint = Joint::single;
  double first = 0.0;   ///< [ohm], > 0
  double second = 0.0;  ///< [ohm]; 0: there is none

  [[nodiscard]] double ohm() const noexcept;
};

/// Whether resistors of this value are found in every shop: 1 ohm to 10 megohm.
[[nodiscard]] constexpr bool is_common(double ohm) noexcept { return ohm >= 1.0 && ohm <= 1e7; }

/// One part. @throw std::invalid_argument  as `nearest_in`
[[nodiscard]] PartValue nearest_part(Series series, double ohm);

/// One part or two, in series or in parallel, whichever comes nearest: of E96 within 2e-4,
/// below 100 ohm and above 100 kilo-ohm 3e-4. Both are common where one of this value would be.
/// @throw std::invalid_argument  as `nearest_in`
[[nodiscard]] PartValue nearest_pair(Series series, double ohm);

/// Chooses what is soldered in place of every resistor.
///
/// Entries of K' become what those of K became, times their ratio: an error that both share only
/// changes the model.
class PartChoice {
 public:
  /// @throw std::invalid_argument  a resistor is negative
  PartChoice(const Reduction& reduction, Series series);

  /// Resistors that are chosen together: one, or an entry of K with that of K'. In the order of
  /// their first.
  [[nodiscard]] std::span<const std::vector<std::size_t>> groups() const noexcept {
    return groups_;
  }

  /// @param pairs  of every group, whether its resistors may be two parts each
  /// @return       as `Reduction::resistors()`
  [[nodiscard]] std::vector<PartValue> values(const std::vector<bool>& pairs) const;

 private:
  Series series_;
  std::vector<double> ohm_;
  std::vector<std::vector<std::size_t>> groups_;
};

/// Their conductances [S].
[[nodiscard]] std::vector<double> siemens_of(std::span<const PartValue> values);

/// A resistor as it is ordered.
struct SoldPart {
  double ohm = 0.0;
  double tolerance = 0.0;  ///< relative
};

/// A circuit as it is soldered.
struct SolderedCircuit {
  Circuit circuit{};
  std::vector<SoldPart> parts{};  ///< of its resistors
  /// Of each of its resistors the other one of its pair; itself where it stands alone.
  std::vector<std::size_t> partner{};
  /// What its amplifiers are bought in, all of them; absent: the usual SO-8 of their kind.
  std::optional<AmplifierPackage> amplifiers{};
};

/// Without sub-circuits; two parts that stand for R1 are called R1a and R1b, and meet at node mR1
/// if they are in series.
///
/// @param values      as `FlatCircuit::circuit`'s resistors
/// @param tolerances  as many: what each is bought within
/// @throw std::invalid_argument  the numbers of resistors differ
[[nodiscard]] SolderedCircuit soldered(const FlatCircuit& circuit,
                                       std::span<const PartValue> values,
                                       std::span<const double> tolerances);

}  // namespace tactile_net
