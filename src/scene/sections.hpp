/// @file
/// The tables of a scene, of a line or of a skin, a function each: from checked values to plain
/// data. Private.
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
#include "tactile_net/calibration/calibration_options.hpp"
#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/scene/any_scene.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/sensor_effects.hpp"
#include "tactile_net/scene/skin_scene.hpp"
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
  bool whole = false;  ///< [sensor] was: there are taxels, at known depths, with known readings
  bool timed = false;  ///< there is a table [time]
};

/// The words of an enum, in the order of its list.
template <typename Enum, std::size_t size>
[[nodiscard]] std::array<std::string_view, size> names_of(const std::array<Enum, size>& all) {
  std::array<std::string_view, size> names;
  std::transform(all.begin(), all.end(), names.begin(), [](Enum one) { return name(one); });
  return names;
}

/// Whether a file is of a skin: its [sensor] has rows or columns, or a file of taxels with a
/// column z.
[[nodiscard]] bool is_skin(const toml::table& scene, const std::filesystem::path& folder);

/// The scene of a document. What is wrong goes to the problems, and then the scene is not complete;
/// where there are some already, nothing is read.
///
/// @param path  of the file: those that it names are in its folder
[[nodiscard]] AnyScene scene_in(const toml::table& toml, const std::filesystem::path& path,
                                Problems& problems);

/// `title`, at the top of a file.
[[nodiscard]] std::string read_title(Table& root);

/// The table [units]. @param force  of contacts: per unit of depth, or of points
[[nodiscard]] Units read_units(Table table, Dimension force);

/// The table [sensor]; without taxels where it is wrong.
///
/// @param surface  the table [surface], of curved skins
/// @param folder   of the scene's file
void read_sensor(Table table, const std::optional<Value>& surface,
                 const std::filesystem::path& folder, Read& read, SensorArray& sensor);
void read_sensor(Table table, const std::optional<Value>& surface,
                 const std::filesystem::path& folder, Read& read, SkinArray& sensor);

/// The contacts. What was wrong with the sensor counts as harmless: it is not compared with.
void read_contacts(std::vector<Table> tables, const Read& read, Scene& scene);
void read_contacts(std::vector<Table> tables, const Read& read, SkinScene& scene);

/// The table [reconstruct], if there is one.
///
/// @param sensor  the table, for what its depths make
/// @param folder  of the scene's file
void read_reconstruct(std::optional<Table> table, const std::optional<Value>& sensor,
                      const Read& read, const std::filesystem::path& folder, Scene& scene);
void read_reconstruct(std::optional<Table> table, const std::optional<Value>& sensor,
                      const Read& read, const std::filesystem::path& folder, SkinScene& scene);

/// A list of two numbers, such as a place on the surface.
[[nodiscard]] std::optional<std::array<double, 2>> read_two(const Value& value, const Rule& rule,
                                                            const Unit& unit,
                                                            std::string_view example);

/// A list of quantities, each once. @return  it was understood as a whole
///
/// @param all  the quantities that it may name: a line's or a skin's
[[nodiscard]] bool read_quantities(const Value& value, std::span<const Quantity> all,
                                   std::vector<Quantity>& reads);

/// The table [calibrate]: how well what the scene states is known.
[[nodiscard]] CalibrationOptions read_calibrate(Table table, const Units& units, bool has_layer,
                                                bool is_skin);

/// What is wrong with the distance of the tractions that a circuit's nodes stand for.
using SpacingCheck = std::function<void(const Value& value, double spacing)>;

/// The table [network], if there is one; the noise is known by then.
///
/// @param alpha   the unit of alpha and of the matrix P
/// @param folder  of the scene's file
[[nodiscard]] NetworkOptions read_network(Table& root, const Units& units, const Unit& alpha,
                                          const SpacingCheck& check_spacing,
                                          const std::filesystem::path& folder);

/// The tables of what lies between the pad and the file: [noise], [quantization] and their like.
///
/// @param time  of the scene, whose frames a sampling window must fit between
void read_sensor_effects(Table& root, const SensorOfEffects& sensor,
                         const std::optional<Timing>& time, SensorEffects& effects);

}  // namespace tactile_net
