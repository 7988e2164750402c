/// @file
/// The array of buried sensors: where the taxels are and what they read.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/elasticity/quantity.hpp"
#include "tactile_net/sensing/site.hpp"

namespace tactile_net {

/// A place in the pad of a line array or a skin where something is read.
struct Taxel {
  std::string name{};             ///< "thumb_3"; empty: its index
  double y = 0.0;                 ///< along the surface [m]
  double z = 0.0;                 ///< along the surface [m]; of a line array 0
  double depth = 0.0;             ///< below it [m], > 0
  std::vector<Quantity> reads{};  ///< at least one, none twice; of a line array `line_quantities`
  /// Along y [m], >= 0: a line array's taxel reads the mean over it (aperture.hpp). Of a skin 0.
  double width = 0.0;
};

/// A regular array: equally spaced taxels along y, centred on y = 0, at one or several depths; or
/// an irregular one, made by `uneven_array`: taxels anywhere.
///
/// A vector of readings is channel after channel. Regular arrays have a channel for each quantity
/// in the order of `reads`, at each depth in the order of `depths`, with `count` values. Irregular
/// ones have a channel for each quantity, with a value for each taxel that reads it, along y.
struct SensorArray {
  std::size_t count = 0;          ///< taxels along y, >= 2
  double pitch = 0.0;             ///< distance of neighbours [m], > 0; the mean, if irregular
  std::vector<double> depths{};   ///< below the surface [m], each > 0, at least one, none twice
  std::vector<Quantity> reads{};  ///< at least one of `line_quantities`, none twice
  /// Width of every taxel of a regular array [m], >= 0; taxels of an irregular one have their own.
  double width = 0.0;
  /// The taxels of an irregular array, y never falling, from which all other members follow. Empty:
  /// a regular array.
  std::vector<Taxel> taxels{};
};

/// An irregular array: taxels that need not be equally far apart, nor equally deep, nor read the
/// same.
///
///     const SensorArray palm = uneven_array({{.y = -3e-3, .depth = 1.5e-3, .reads = reads}, ...});
///
/// @param taxels  two at least, no two of one name, at most one of them with the same y, depth and
///                quantity
/// @throw std::invalid_argument  as `check`
[[nodiscard]] SensorArray uneven_array(std::vector<Taxel> taxels);

/// True for a regular array: taxels equally spaced, equally deep and reading the same.
[[nodiscard]] inline bool is_even(const SensorArray& array) noexcept {
  return array.taxels.empty();
}

/// @throw std::invalid_argument  a value is out of its range or not finite, y falls, z is not 0, a
///                               quantity is none of `line_quantities`; two taxels have one name,
///                               or lie at one place and read the same
void check(const SensorArray& array);

/// Place `index` of `count` equally spaced ones, in units of their distance, with 0 at the middle.
[[nodiscard]] constexpr double centred(std::size_t index, std::size_t count) noexcept {
  return static_cast<double>(index) - 0.5 * static_cast<double>(count - 1);
}

/// y of taxel j [m]: centred(j, count) * pitch in a regular array.
[[nodiscard]] double position(const SensorArray& array, std::size_t taxel) noexcept;

/// y of every taxel [m], `count` values.
[[nodiscard]] std::vector<double> positions(const SensorArray& array);

/// Taxels along y. In a regular array those at several depths below one place count once.
[[nodiscard]] inline std::size_t taxel_count(const SensorArray& array) noexcept {
  return array.count;
}

/// Number of readings in a frame.
[[nodiscard]] std::size_t reading_count(const SensorArray& array) noexcept;

/// The channels, in the order of the readings.
[[nodiscard]] std::vector<Channel> channels(const SensorArray& array);

/// Number of channels: in a regular array quantities times depths, else quantities.
[[nodiscard]] std::size_t channel_count(const SensorArray& array) noexcept;

/// The place and the quantity of every reading, in the order of the readings.
[[nodiscard]] std::vector<Site> sites(const SensorArray& array);

/// The least depth of all taxels [m]. @pre  the array has a depth
[[nodiscard]] double least_depth(const SensorArray& array) noexcept;

/// The array of taxels 0, stride, 2 stride ...; it has the last taxel where stride divides count -
/// 1.
/// @param stride  >= 1
[[nodiscard]] SensorArray every(const SensorArray& array, std::size_t stride);

/// Name of a taxel: its own, or its index. @pre  taxel < taxel_count
[[nodiscard]] std::string taxel_name(const SensorArray& array, std::size_t taxel);

/// Names of all readings, "strain_x_0" ...: the channel's name and the taxel's.
[[nodiscard]] std::vector<std::string> reading_names(const SensorArray& array);

/// Refuses an irregular array.
/// @param asks  what needs equal distances, for the message: "dft"
/// @throw std::invalid_argument  the array is irregular
void require_even(const SensorArray& array, std::string_view asks);

}  // namespace tactile_net
