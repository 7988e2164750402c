/// @file
/// The tables of a scene, one function each: from checked values to plain data.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "scene/table.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net {

inline constexpr std::int64_t most_taxels = 4096;  ///< dense matrices take 128 MiB each then

/// Fills the scene from the whole file; what is wrong goes to the problems that `root` was made
/// with, and then the scene is not complete.
///
/// @param folder  of the scene's file: of the files that it names
void read_sections(Table& root, const std::filesystem::path& folder, Scene& scene);

/// The knots of a temperature that changes.
///
/// @param timed  the scene has a table [time]; a problem where it has none
[[nodiscard]] PiecewiseLinear read_trajectory(const Value& trajectory, bool timed);

/// What later sections need to know of earlier ones beyond the scene itself.
struct Read {
  Units units{};  ///< of the numbers in the file; every number is 1 of them where it states none
  std::optional<Value> reads{};
  bool reads_complete = false;  ///< `sensor.reads` was understood as a whole
  bool depths_complete = false;
  bool timed = false;  ///< there is a table [time]
};

/// The table [sensor].
///
/// @param folder  of the scene's file
[[nodiscard]] SensorArray read_sensor(Table table, const std::filesystem::path& folder, Read& read);

/// The table [units].
[[nodiscard]] Units read_units(Table table);

/// The unit of a quantity's readings.
[[nodiscard]] Unit reading_unit(const Units& units, Quantity quantity) noexcept;

/// The unit of a number that is of every quantity's readings at once; a problem at `value` if they
/// differ.
[[nodiscard]] Unit reading_unit(const Units& units, const SensorArray& array, const Value& value);

/// The unit of alpha and of the matrix P: that of weighted readings over tractions, squared.
[[nodiscard]] Unit alpha_unit(const Units& units, const Scene& scene) noexcept;

/// The contacts; the sensor has count 0 or pitch 0 where that was wrong, and is then not compared
/// with.
void read_contacts(std::vector<Table> tables, const Read& read, Scene& scene);

/// The table [calibration], if there is one, and the units of readings.
void read_calibration(const std::optional<Table>& table, const std::filesystem::path& folder,
                      const Read& read, Scene& scene);

/// The table [network]; the noise is known by then.
[[nodiscard]] NetworkOptions read_network(Table table, const Units& units, const Scene& scene);

/// The tables of what lies between the pad and the file: [noise], [quantization] and their like.
void read_sensor_effects(Table& root, const Read& read, Scene& scene);

[[nodiscard]] inline std::optional<Table> table_of(const std::optional<Value>& value) {
  return value ? value->table() : std::nullopt;
}

/// The words of an enum, in the order of its list.
template <typename Enum, std::size_t size>
[[nodiscard]] std::array<std::string_view, size> names_of(const std::array<Enum, size>& all) {
  std::array<std::string_view, size> names;
  std::transform(all.begin(), all.end(), names.begin(), [](Enum one) { return name(one); });
  return names;
}

}  // namespace tactile_net
