/// @file
/// How far the resistors of a build are off their values: each by its own error, all by what their
/// reel and the temperature have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tactile_net {

/// Parts of one reel that were measured, by their errors relative to the nominal value.
struct MeasuredReel {
  double mean = 0.0;
  double spread = 0.0;    ///< standard deviation
  std::size_t parts = 0;  ///< how many, >= 2
};

/// A measured part that far from the nominal value is of another one, or in another unit.
inline constexpr double most_off_nominal = 0.1;

/// @param ohms     what was measured, in any unit
/// @param nominal  what is printed on them, in the same
/// @throw std::invalid_argument  less than two parts, one is further than `most_off_nominal`, or
///                               all are the same
[[nodiscard]] MeasuredReel measured_reel(std::span<const double> ohms, double nominal);

/// Where builds work, from where their parts have the values they are sold with.
struct Temperature {
  double kelvin = 0.0;       ///< as far at most, either way [K], > 0
  double coefficient = 0.0;  ///< of all parts of a build alike, within +- [1/K], >= 0
  double tracking = 0.0;     ///< of each part beside that, within +- [1/K], >= 0
};

/// What all resistors of a build have in common. Uniform within what is stated.
struct CommonErrors {
  std::optional<double> reel{};  ///< all are off alike, within +-reel, > 0, < 1
  std::optional<MeasuredReel> measured{};
  std::optional<Temperature> temperature{};

  [[nodiscard]] bool any() const noexcept { return reel || measured || temperature; }
};

/// @throw std::invalid_argument  a value is out of range
void check(const CommonErrors& common);

/// One resistor of a circuit.
struct ResistorError {
  enum class Kind {
    none,      ///< it has no error at all: a cell that is programmed
    within,    ///< uniform within +-tolerance
    measured,  ///< normal, with mean and spread of `CommonErrors::measured`
  };
  Kind kind = Kind::within;
  double tolerance = 0.0;
};

/// Draws that are a function of seed, build and the resistor's place alone.
class ResistorErrors {
 public:
  /// @param each    one a resistor
  /// @param common  `measured` may be absent if no resistor is
  explicit ResistorErrors(std::vector<ResistorError> each, const CommonErrors& common = {});
  /// Each uniform within its tolerance.
  explicit ResistorErrors(std::span<const double> tolerances);

  [[nodiscard]] std::size_t size() const noexcept { return each_.size(); }

  /// Makes the conductances of a build of those printed.
  void draw(std::uint64_t seed, std::uint64_t build, std::span<double> siemens) const;

  /// How far that build's temperature is from where the parts have their values [K].
  [[nodiscard]] double kelvin(std::uint64_t seed, std::uint64_t build) const noexcept;

  /// Mean squares of each resistor's own relative error.
  [[nodiscard]] std::vector<double> own_squares() const;

  /// An error that resistors share: how much of it each has, and its mean square.
  struct Shared {
    std::vector<double> shares{};
    double square = 0.0;
  };
  [[nodiscard]] std::vector<Shared> shared() const;

 private:
  std::vector<ResistorError> each_;
  CommonErrors common_;
};

}  // namespace tactile_net
