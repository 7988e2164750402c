/// @file
/// How well a scene's values are known before its sensor is calibrated: the table [calibrate].
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include "tactile_net/numeric/fields.hpp"

namespace tactile_net {

/// What presses tell of the pad and of the array as a whole.
enum class PadParameter {
  depth,
  thickness,
  poisson_ratio,
  youngs_modulus,
  crosstalk,
  shift,
  pitch,
  shift_z
};
inline constexpr std::size_t pad_parameter_count = 8;

template <>
struct Enumerators<PadParameter> {
  static constexpr Enumerator<PadParameter> all[] = {
      {PadParameter::depth, "depth", "The depth of every taxel, by one factor."},
      {PadParameter::thickness, "thickness", "The layer's thickness."},
      {PadParameter::poisson_ratio, "poisson_ratio", "The pad's Poisson's ratio."},
      {PadParameter::youngs_modulus, "youngs_modulus", "The pad's Young's modulus."},
      {PadParameter::crosstalk, "crosstalk", "The share that neighbouring taxels exchange."},
      {PadParameter::shift, "shift",
       "How far the array is along y from where the stage that states positions has it."},
      {PadParameter::pitch, "pitch", "The array's pitch."},
      {PadParameter::shift_z, "shift_z", "The shift along z; of a skin alone."}};
};

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
