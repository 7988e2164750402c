/// @file
/// Tables that every kind of scene has, a function each: from checked values to plain data.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/effect_values.hpp"
#include "scene/table.hpp"
#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/sensor_effects.hpp"
#include "tactile_net/scene/timing.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net {

inline constexpr std::string_view equal_taxels =
    "taxels that are equally far apart, equally deep and alike";

inline constexpr Rule below_surface{"must be > 0", [](double x) noexcept { return x > 0.0; },
                                    "sensors lie below the surface: of beads or markers at the "
                                    "surface write how deep their middles "
                                    "lie, at least half their diameter"};

inline constexpr std::int64_t most_taxels = 4096;  ///< dense matrices take 128 MiB each then

/// What later sections need to know of earlier ones beyond the scene itself.
struct Read {
  Units units{};  ///< of the numbers in the file; every number is 1 of them where it states none
  std::optional<Value> reads{};
  bool reads_complete = false;  ///< `sensor.reads` was understood as a whole
  bool depths_complete = false;
  bool timed = false;  ///< there is a table [time]
};

/// The words of an enum, in the order of its list.
template <typename Enum, std::size_t size>
[[nodiscard]] std::array<std::string_view, size> names_of(const std::array<Enum, size>& all) {
  std::array<std::string_view, size> names;
  std::transform(all.begin(), all.end(), names.begin(), [](Enum one) { return name(one); });
  return names;
}

/// `title`, at the top of the file.
[[nodiscard]] std::string read_title(Table& root);

/// The table [units]. @param force  of contacts: per unit of depth, or of points
[[nodiscard]] Units read_units(Table table, Dimension force);

/// The table [material]. @param depths  of the sensors
[[nodiscard]] Material read_material(Table table, std::span<const double> depths,
                                     const Units& units);

/// The table [time].
[[nodiscard]] Timing read_time(Table table);

/// The table [forward]. @param even  the taxels: `sampled` asks for it
[[nodiscard]] ForwardModel read_forward(Table table, bool even);

/// A depth, or several; a problem where both or what is wrong stands there.
[[nodiscard]] std::vector<double> read_depths(const std::optional<Value>& one,
                                              const std::optional<Value>& several,
                                              const Unit& length);

/// Of the file of taxels that a scene names; a problem where it lies elsewhere than the scene.
///
/// @param folder  of the scene's file
[[nodiscard]] std::optional<std::filesystem::path> read_taxel_path(
    const Value& value, const std::filesystem::path& folder);

/// A list of quantities, each once. @return  it was understood as a whole
///
/// @param all  the quantities that it may name: a line's or a skin's
[[nodiscard]] bool read_quantities(const Value& value, std::span<const Quantity> all,
                                   std::vector<Quantity>& reads);

/// A number, or the name of the rule that chooses it.
///
/// @param unit         of the number
/// @param noise_known  a rule may ask for it
void read_alpha(const Value& value, const Unit& unit, bool noise_known,
                std::optional<double>& alpha, std::optional<AlphaRule>& rule);

/// A number, or "evidence": `weight` is then absent. @return  it was understood
[[nodiscard]] bool read_tangential_weight(const Value& value, std::optional<double>& weight);

/// What is wrong with the distance of the tractions that a circuit's nodes stand for.
using SpacingCheck = std::function<void(const Value& value, double spacing)>;

/// The table [network], if there is one; the noise is known by then.
///
/// @param alpha  the unit of alpha and of the matrix P
[[nodiscard]] NetworkOptions read_network(Table& root, const Units& units, const Unit& alpha,
                                          const SpacingCheck& check_spacing);

/// The knots of a temperature that changes.
///
/// @param timed  the scene has a table [time]; a problem where it has none
[[nodiscard]] PiecewiseLinear read_trajectory(const Value& trajectory, bool timed);

/// The tables of what lies between the pad and the file: [noise], [quantization] and their like.
///
/// @param time  of the scene, whose frames a sampling window must fit between
void read_sensor_effects(Table& root, const SensorOfEffects& sensor,
                         const std::optional<Timing>& time, SensorEffects& effects);

}  // namespace tactile_net
