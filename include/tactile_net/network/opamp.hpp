/// @file
/// The operational amplifier of a circuit, in as many steps as a scene asks for.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tactile_net {

/// Across a diode of the clamp that holds an output within its rails, as it begins to conduct [V].
inline constexpr double diode_drop = 0.6;

/// What is absent is not simulated. With nothing given the amplifier is a nullor: no input current,
/// no input voltage, whatever output it takes.
struct OpAmp {
  std::optional<double> gain{};         ///< A0 at direct current, > 0; absent with a pole: 1e6
  std::optional<double> bandwidth{};    ///< gain-bandwidth product [Hz], > 0; absent: no pole
  std::optional<double> second_pole{};  ///< [Hz], > 0; needs the bandwidth
  /// Input offset voltage of every op-amp [V]: typical, or its limit where that alone is known.
  std::optional<double> offset{};
  /// No op-amp's offset is beyond it, either way [V], > 0, >= the size of `offset`.
  std::optional<double> offset_limit{};
  /// What an offset changes by a kelvin at most, either way [V/K], > 0.
  std::optional<double> offset_drift{};
  std::optional<double> rail{};  ///< the output stays within -rail ... rail [V], > 0.6
  /// From the inverting input to ground, and from both where the outputs are complementary [F], >
  /// 0.
  std::optional<double> input_capacitance{};
  std::optional<double> differential_capacitance{};  ///< between the two inputs [F], > 0
  /// From every output to ground: a load's, or a line's [F], > 0. It takes time only behind an
  /// `output_resistance`.
  std::optional<double> load_capacitance{};

  /// White noise at the input [V per square root of Hz], > 0; absent: no noise is asked for.
  std::optional<double> noise_voltage{};
  /// Up to where the 1/f part of the noise at the input exceeds the white one [Hz], > 0; needs
  /// `noise_voltage`.
  std::optional<double> noise_corner{};
  /// White noise of each input [A per square root of Hz], > 0; needs the bandwidth.
  std::optional<double> noise_current{};
  /// That every input takes in [A], of either sign: typical, or its limit where that alone is
  /// known.
  std::optional<double> bias_current{};
  std::optional<double> bias_limit{};  ///< no input's is beyond it [A], > 0, >= its size
  /// How much more the output follows the inputs' difference than what they have in common, > 0:
  /// 1e4 is 80 dB.
  std::optional<double> common_mode_rejection{};
  std::optional<double> slew{};  ///< the output's largest rate [V/s], > 0; needs the bandwidth
  /// In series with every output [ohm], > 0. Complementary outputs stay each other's opposite: a
  /// loop of their own holds their sum at 0 V.
  std::optional<double> output_resistance{};
  /// The most that an output gives off or takes in [A], > 0. Certificates compare it with what the
  /// circuit draws at rest; beside `output_resistance` a deck limits it.
  std::optional<double> output_current{};

  [[nodiscard]] bool is_nullor() const noexcept {
    return !gain && !bandwidth && !second_pole && !offset && !rail && !bias_current &&
           !common_mode_rejection && !slew && !output_resistance;
  }
  /// A0 of a model that is no nullor.
  [[nodiscard]] double dc_gain() const noexcept { return gain.value_or(1e6); }

  friend bool operator==(const OpAmp&, const OpAmp&) = default;
};

/// @throw std::invalid_argument  a value is out of range, or one that needs the bandwidth has none
void check(const OpAmp& opamp);

/// Op-amps as they are sold, figures typical of their data sheets.
struct OpAmpClass {
  std::string_view name{};
  OpAmp opamp{};
};

/// "general", "precision", "fast".
[[nodiscard]] std::span<const OpAmpClass> opamp_classes() noexcept;

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

/// Transconductance that is left in saturation, over that of the linear range: it keeps the
/// Jacobian of a simulator's Newton iteration regular.
inline constexpr double slewing_leak = 1e-3;

/// The text of the sub-circuit: only the elements that the model calls for.
///
///     d = p - n + offset + (p + n) / (2 common_mode_rejection)
///     x' = 2 pi bandwidth d - 2 pi bandwidth / gain x    first pole
///     y' = 2 pi second_pole (x - y)                      second pole
///     out = y (or x, or gain d) - output_resistance i, inv = -out
///
/// with the input capacitance from n to ground, and from p where the outputs are complementary, the
/// differential one between both and the load's from every output to ground; of complementary
/// outputs i is half the difference of what they give off. With a slew, r = 2 pi bandwidth d is
/// bent: slew tanh((1 - leak) r / slew) + leak r, whose slope at 0 is 1 and never 0
/// (`slewing_leak`).
///
/// The rail is a pair of diodes at x: it converges where a tanh fails, and x does not wind up.
///
/// @throw std::invalid_argument  as `check`
[[nodiscard]] std::string subcircuit_text(const AmplifierModel& model);

}  // namespace tactile_net
