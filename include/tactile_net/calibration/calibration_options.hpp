/// @file
/// How well a scene's values are known before its sensor is calibrated: the table [calibrate].
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

namespace tactile_net {

/// What presses tell of the pad and of the array as a whole.
enum class PadParameter {
  depth,           ///< of every taxel, by one factor
  thickness,       ///< of the layer
  poisson_ratio,   ///< of the pad
  youngs_modulus,  ///< of the pad
  crosstalk,       ///< `Crosstalk::fraction`
  shift,           ///< of the array against the stage that states positions, along y [m]
  pitch,           ///< of the array
  shift_z,         ///< of a skin [m]
};
inline constexpr std::size_t pad_parameter_count = 8;

/// "depth", "thickness", as scenes and JSON spell it.
[[nodiscard]] std::string_view name(PadParameter parameter) noexcept;

/// Which gains are free one by one: every reading's, every taxel's or every channel's.
enum class GainSharing { reading, taxel, channel };

/// "reading", "taxel", "channel".
[[nodiscard]] std::string_view name(GainSharing sharing) noexcept;

/// Standard deviations of what the nominal scene states; 0: exact, infinite: nothing is known.
struct CalibrationOptions {
  double depth_sd = 0.3;           ///< relative
  double thickness_sd = 0.2;       ///< relative
  double poisson_ratio_sd = 0.03;  ///< absolute
  double youngs_modulus_sd = 0.5;  ///< relative
  double crosstalk_sd = 0.0;       ///< absolute; a free crosstalk spoils the depth
  double shift_sd = 0.0;           ///< [m]
  double shift_z_sd = 0.0;         ///< of a skin [m]; lines have none: 0
  double pitch_sd = 0.0;           ///< relative
  double gain_sd = 0.1;            ///< of each reading about its channel's mean, relative
  double mean_gain_sd = 0.2;       ///< of a channel's mean, relative
  double half_width_sd = 0.03;     ///< of a half width computed from a rod's radius, relative
  GainSharing gains = GainSharing::reading;
  bool at_base = false;  ///< the sensors lie at the layer's base: thickness is depth
  bool robust = false;   ///< outlying readings, forces and positions count less
  bool profile = false;  ///< how the misfit rises with the depth, too
  std::vector<double> starts{1.0, 0.6, 1.6};  ///< depths to start from, over the nominal one
  std::size_t most_iterations = 60;

  [[nodiscard]] double sd(PadParameter parameter) const noexcept;
  void set_sd(PadParameter parameter, double sd) noexcept;
};

/// @throw std::invalid_argument  an sd is negative or NaN, no start, a start not > 0
void check(const CalibrationOptions& options);

}  // namespace tactile_net
