#include "scene/effect_values.hpp"

#include <cmath>

#include "scene/sections.hpp"

namespace tactile_net {
namespace {

std::optional<Range> range(const Value& value, const Unit& unit) {
  const auto ends = value.numbers(any_number, unit);
  if (!ends) return std::nullopt;
  if (ends->size() != 2)
    value.problem("must be two numbers, the lowest and the highest reading", "range = [-1.0, 1.0]");
  else if (!((*ends)[0] < (*ends)[1]))
    value.problem("must begin with the lower of its two numbers", "range = [-1.0, 1.0]");
  else if (!std::isfinite((*ends)[1] - (*ends)[0]))
    value.problem("is wider than a double can hold");
  else
    return Range{(*ends)[0], (*ends)[1]};
  return std::nullopt;
}

/// Of an even skin, by row and column from 0.
std::optional<std::size_t> taxel_at(const SkinArray& skin, const Value& item) {
  const auto both = item.list("a taxel's row and column").value_or(std::vector<Value>{});
  if (!is_even(skin)) {
    item.problem("is a row and a column, and these taxels have none", "taxels by their names");
    return std::nullopt;
  }
  if (both.size() != 2) {
    item.problem("must be two numbers, a row and a column", "[0, 3]");
    return std::nullopt;
  }
  const auto last = [](std::size_t count) { return static_cast<std::int64_t>(count) - 1; };
  const auto row = both[0].integer(0, last(skin.rows), "rows are numbered from 0");
  const auto column = both[1].integer(0, last(skin.columns), "columns are numbered from 0");
  if (!row || !column) return std::nullopt;
  return static_cast<std::size_t>(*row) * skin.columns + static_cast<std::size_t>(*column);
}

}  // namespace

PerQuantity<double> EffectValues::numbers_per_quantity(const Value& value, const Rule& rule) const {
  return per_quantity<double>(
      value, [&](const Value& one, const Unit& unit) { return one.number(rule, unit); });
}

PerQuantity<Range> EffectValues::ranges_per_quantity(const Value& value) const {
  return per_quantity<Range>(value,
                             [&](const Value& one, const Unit& unit) { return range(one, unit); });
}

std::uint64_t EffectValues::seed(Table& table) {
  const auto seed = table.value("seed");
  return seed ? static_cast<std::uint64_t>(seed->integer(0, INT64_MAX).value_or(1)) : 1;
}

std::optional<std::size_t> EffectValues::taxel(const Value& item) const {
  if (sensor_.skin != nullptr && item.is_text()) {
    const std::string text = item.text().value_or("");
    for (std::size_t i = 0; i < sensor_.taxels; ++i)
      if (taxel_name(*sensor_.skin, i) == text) return i;
    item.misfit("names no taxel", is_even(*sensor_.skin) ? "row and column, as in the columns of "
                                                           "recordings: \"3_5\""
                                                         : "as the file of taxels names them");
    return std::nullopt;
  }
  if (sensor_.skin != nullptr && item.is_list()) return taxel_at(*sensor_.skin, item);
  const std::int64_t last =
      sensor_.taxels > 0 ? static_cast<std::int64_t>(sensor_.taxels) - 1 : most_taxels - 1;
  const auto index = item.integer(
      0, last,
      sensor_.skin == nullptr ? "taxels are numbered from 0"
      : is_even(*sensor_.skin)
          ? "taxels are numbered from 0, row after row: row * columns + column; or [row, column]"
          : "taxels are numbered from 0, as they stand in their file; or their names");
  return index ? std::optional(static_cast<std::size_t>(*index)) : std::nullopt;
}

std::vector<std::size_t> EffectValues::taxels(const Value& indices) const {
  std::vector<std::size_t> result;
  std::size_t misfits = 0;
  for (const Value& item : indices.list("taxel numbers").value_or(std::vector<Value>{})) {
    if (misfits == most_misfits) break;
    const auto index = taxel(item);
    if (!index) {
      ++misfits;
    } else if (std::find(result.begin(), result.end(), *index) != result.end()) {
      ++misfits;
      item.misfit("names a taxel twice", "remove one");
    } else {
      result.push_back(*index);
    }
  }
  return result;
}

Indices EffectValues::optional_indices(Table& table) const {
  const auto value = table.value("indices");
  return value ? std::optional(taxels(*value)) : std::nullopt;
}

std::optional<Numbers> EffectValues::taxel_values(const Value& value, const Rule& rule,
                                                  const Indices& indices, const Unit& unit) const {
  auto numbers = value.numbers(rule, unit);
  if (!numbers) return std::nullopt;
  const std::size_t expected = indices ? indices->size() : sensor_.taxels;
  if (expected > 0 && numbers->size() != expected) {
    value.problem("must have one value per " + std::string(indices ? "index" : "taxel") + ": " +
                  std::to_string(expected) + " (got " + std::to_string(numbers->size()) + ')');
    return std::nullopt;
  }
  return numbers;
}

std::optional<Numbers> EffectValues::spread(const Value& value, const Rule& rule,
                                            const Indices& indices, const Unit& unit) const {
  auto numbers = taxel_values(value, rule, indices, unit);
  if (!numbers || !indices) return numbers;
  Numbers all(sensor_.taxels);
  for (std::size_t i = 0; i < indices->size() && i < numbers->size(); ++i)
    if ((*indices)[i] < all.size()) all[(*indices)[i]] = (*numbers)[i];
  return all;
}

void EffectValues::require_one_unit(const Value& value) const {
  const auto& reads = sensor_.reads;
  const auto differs = [&](Quantity quantity) {
    const Unit one = unit_of(quantity);
    const Unit first = unit_of(reads.front());
    return one.to_si(1.0) != first.to_si(1.0);
  };
  if (value.is_table() || std::none_of(reads.begin(), reads.end(), differs)) return;
  if (sensor_.skin == nullptr)
    value.problem("is of strains and of stresses, which differ in their units here",
                  "under [units], stress = \"Pa\", or one for each quantity");
  else
    value.problem("is of quantities that differ in their units here",
                  "one for each: range = { stress_x = [-50, 50], displacement_y = [-1, 1] }");
}

}  // namespace tactile_net
