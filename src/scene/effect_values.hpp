/// @file
/// What the tables of effects have in common: values of quantities and of taxels, of a line or of a
/// skin. Private.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/table.hpp"
#include "tactile_net/scene/units.hpp"
#include "tactile_net/sensing/effects/effect.hpp"
#include "tactile_net/sensing/effects/saturation.hpp"
#include "tactile_net/skin/array.hpp"

namespace tactile_net {

/// A sensor as these tables are compared with it.
struct SensorOfEffects {
  Units units{};
  std::vector<Quantity> on_offer{};  ///< quantities that a table may name
  std::vector<Quantity> reads{};
  bool reads_complete = false;  ///< `reads` was understood as a whole
  std::size_t taxels = 0;       ///< 0: not known
  std::size_t most_neighbours = 2;
  bool timed = false;               ///< there is a table [time]
  const SkinArray* skin = nullptr;  ///< of a skin: its taxels have names, rows and columns
};

using Numbers = std::vector<double>;
using Indices = std::optional<std::vector<std::size_t>>;  // absent: all taxels

class EffectValues {
 public:
  /// Keeps a reference.
  explicit EffectValues(const SensorOfEffects& sensor) : sensor_(sensor) {}

  /// A table that names every quantity that is read and no other; `one` reads each value, given the
  /// unit of that quantity's readings.
  template <typename T>
  PerQuantity<T> of_each(Table table, auto one) const {
    PerQuantity<T> result;
    for (const Quantity quantity : sensor_.on_offer) {
      const bool is_read =
          std::find(sensor_.reads.begin(), sensor_.reads.end(), quantity) != sensor_.reads.end();
      const auto value = is_read && sensor_.reads_complete
                             ? table.required(name(quantity),
                                              "the table names every quantity that "
                                              "sensor.reads does")
                             : table.value(name(quantity));
      if (!value) continue;
      if (!is_read && sensor_.reads_complete)
        value->problem("is of a quantity that sensor.reads does not name", "remove it");
      else if (auto got = one(*value, unit_of(quantity)))
        result[quantity] = std::move(*got);
    }
    table.finish();
    return result;
  }

  /// One value for every quantity, or a table of one for each.
  template <typename T>
  PerQuantity<T> per_quantity(const Value& value, auto one) const {
    if (value.is_table()) return of_each<T>(*value.table(), one);
    PerQuantity<T> result;
    for (const Quantity quantity : sensor_.reads)
      if (auto got = one(value, unit_of(quantity))) result[quantity] = std::move(*got);
    if (sensor_.reads.empty()) (void)one(value, Unit{});  // what is wrong with it is said anyway
    return result;
  }

  [[nodiscard]] PerQuantity<double> numbers_per_quantity(const Value& value,
                                                         const Rule& rule) const;
  [[nodiscard]] PerQuantity<Range> ranges_per_quantity(const Value& value) const;

  /// A problem at a number that stands for several quantities whose units differ.
  void require_one_unit(const Value& value) const;

  [[nodiscard]] static std::uint64_t seed(Table& table);

  /// Taxels by their numbers; of a skin also by their names, or by row and column.
  [[nodiscard]] std::vector<std::size_t> taxels(const Value& indices) const;
  [[nodiscard]] Indices optional_indices(Table& table) const;

  /// A list of one value per taxel, or per index where there are some; `indices` are complete.
  [[nodiscard]] std::optional<Numbers> taxel_values(const Value& value, const Rule& rule,
                                                    const Indices& indices,
                                                    const Unit& unit = {}) const;

  /// As `taxel_values`, spread over all taxels: 0 where no index is.
  [[nodiscard]] std::optional<Numbers> spread(const Value& value, const Rule& rule,
                                              const Indices& indices, const Unit& unit = {}) const;

 private:
  [[nodiscard]] Unit unit_of(Quantity quantity) const noexcept {
    return tactile_net::unit_of(sensor_.units, traits(quantity).kind);
  }
  [[nodiscard]] std::optional<std::size_t> taxel(const Value& item) const;

  const SensorOfEffects& sensor_;
};

}  // namespace tactile_net
