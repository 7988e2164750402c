/// @file
/// The taxels of a skin: where they are and what they read.
///
/// Frame as in elasticity/quantity.hpp: x into the skin, y and z along its surface. Rows follow one
/// another along y, columns along z; taxel (row, column) has the index row * columns + column.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

struct CurvedSkin;

/// A regular skin: a lattice of equally spaced taxels centred on y = z = 0, at one or several
/// depths; or an irregular one, made by `uneven_skin`: taxels anywhere. One row, one column and one
/// taxel are skins too.
///
/// A vector of readings is channel after channel. Regular skins have a channel for each quantity in
/// the order of `reads`, at each depth in the order of `depths`, with rows * columns values, row
/// after row. Irregular ones have a channel for each quantity, with a value for each taxel that
/// reads it, in the order of `taxels`.
struct SkinArray {
  std::size_t rows = 0;           ///< >= 1; of an irregular skin all its taxels
  std::size_t columns = 0;        ///< >= 1; of an irregular skin 1
  double pitch_y = 0.0;           ///< from row to row [m], > 0; unused with one row; of an
                                  ///< irregular skin the mean distance to the nearest taxel
  double pitch_z = 0.0;           ///< from column to column [m]; otherwise as `pitch_y`
  std::vector<double> depths{};   ///< below the surface [m], each > 0, at least one, none twice
  std::vector<Quantity> reads{};  ///< at least one, none twice
  /// The taxels of an irregular skin, from which all other members follow. Empty: a regular skin.
  std::vector<Taxel> taxels{};
  /// Of an irregular skin whose surface is curved, made by `curved_skin` (curved_skin.hpp); y and z
  /// of its taxels are places on the surface's chart. Null: the surface is flat.
  std::shared_ptr<const CurvedSkin> curved{};
};

/// An irregular skin: taxels anywhere, in any order.
///
///     const SkinArray palm = uneven_skin({{"palm_1", -3e-3, 1e-3, 2e-3, reads}, ...});
///
/// @param taxels  one at least, no two of one name, at most one with the same place, depth and
///                quantity; names are filled in where they are empty
/// @throw std::invalid_argument  as `check`
[[nodiscard]] SkinArray uneven_skin(std::vector<Taxel> taxels);

/// True for a regular skin: taxels on a lattice, equally deep and reading the same.
[[nodiscard]] inline bool is_even(const SkinArray& skin) noexcept { return skin.taxels.empty(); }

/// Refuses a curved skin.
/// @param asks  what knows flat ones alone, for the message: "an exact reading"
/// @throw std::invalid_argument  the skin is curved
void require_flat(const SkinArray& skin, std::string_view asks);

/// @throw std::invalid_argument  a place is not finite, a depth not > 0, a pitch not > 0, a width
///                               not 0; no taxel, no depth, nothing read or something twice; two
///                               taxels of one name, or at one place that read the same
void check(const SkinArray& skin);

/// Checks the skin and the material.
/// @throw std::invalid_argument  as `check(skin)`; the material is out of range, or a taxel lies
///                               below the base
void check(const SkinArray& skin, const Material& material);

/// rows * columns. In a regular skin taxels at several depths below one place count once.
[[nodiscard]] inline std::size_t taxel_count(const SkinArray& skin) noexcept {
  return skin.rows * skin.columns;
}

/// Number of readings in a frame.
[[nodiscard]] std::size_t reading_count(const SkinArray& skin) noexcept;

/// Number of channels: in a regular skin quantities times depths, else quantities.
[[nodiscard]] std::size_t channel_count(const SkinArray& skin) noexcept;

/// The channels, in the order of the readings.
[[nodiscard]] std::vector<Channel> channels(const SkinArray& skin);

/// The place and the quantity of every reading, in the order of the readings.
[[nodiscard]] std::vector<Site> sites(const SkinArray& skin);

/// The least depth of all taxels [m]. @pre  the skin has a depth
[[nodiscard]] double least_depth(const SkinArray& skin) noexcept;

/// Name of a taxel: "3_5" (row and column), or its own. @pre  taxel < taxel_count
[[nodiscard]] std::string taxel_name(const SkinArray& skin, std::size_t taxel);

/// Names of all readings, "stress_x_3_5" ...: the channel's name and the taxel's.
[[nodiscard]] std::vector<std::string> reading_names(const SkinArray& skin);

}  // namespace tactile_net
