/// @file
/// The operational amplifier of a circuit, in as many steps as a scene asks for.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tactile_net {

/// What is absent is not simulated. With nothing given the amplifier is a nullor: no input current,
/// no input voltage, whatever output it takes.
struct OpAmp {
  std::optional<double> gain{};         ///< A0 at direct current, > 0; absent with a pole: 1e6
  std::optional<double> bandwidth{};    ///< gain-bandwidth product [Hz], > 0; absent: no pole
  std::optional<double> second_pole{};  ///< [Hz], > 0; needs the bandwidth
  std::optional<double> offset{};       ///< input offset voltage of every op-amp [V]
  std::optional<double> rail{};         ///< the output stays within -rail ... rail [V], > 0.6
  /// From the inverting input to ground, and from both where the outputs are complementary [F], >
  /// 0.
  std::optional<double> input_capacitance{};

  /// White noise at the input [V per square root of Hz], > 0; absent: no noise is asked for.
  std::optional<double> noise_voltage{};

  [[nodiscard]] bool is_nullor() const noexcept {
    return !gain && !bandwidth && !second_pole && !offset && !rail;
  }
  /// A0 of a model that is no nullor.
  [[nodiscard]] double dc_gain() const noexcept { return gain.value_or(1e6); }

  friend bool operator==(const OpAmp&, const OpAmp&) = default;
};

/// @throw std::invalid_argument  a value is out of range, or a second pole has no first
void check(const OpAmp& opamp);

enum class Outputs {
  single,         ///< pins p n out
  complementary,  ///< pins p n out inv: out and inv = -out from one core, hence one pole
};

/// One kind of amplifier in a circuit: a sub-circuit of that name.
struct AmplifierModel {
  std::string name{};
  OpAmp opamp{};
  Outputs outputs = Outputs::single;
};

/// The text of the sub-circuit: only the elements that the model calls for.
///
///     x' = 2 pi bandwidth (p - n + offset) - 2 pi bandwidth / gain x    first pole
///     y' = 2 pi second_pole (x - y)                                      second pole
///     out = y (or x, or gain (p - n + offset)), inv = -out
///
/// with the input capacitance from n to ground, and from p where the outputs are complementary.
///
/// The rail is a pair of diodes at x: it converges where a tanh fails, and x does not wind up.
///
/// @throw std::invalid_argument  as `check`
[[nodiscard]] std::string subcircuit_text(const AmplifierModel& model);

}  // namespace tactile_net
