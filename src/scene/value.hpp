/// @file
/// One value of a TOML file, asked for by type. A value that does not fit is reported at its
/// position, and the answer is nothing.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/problems.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net {

/// Of one list, no more values than these are reported: the rest are likely wrong in the same way.
inline constexpr std::size_t most_misfits = 5;

/// A condition on a number and how a message says it: "must be > 0".
struct Rule {
  std::string_view text;
  bool (*holds)(double number) noexcept;
  std::string_view what_to_do{};
};

// Of numbers that are measured in these whatever [units] states.
inline constexpr Unit in_hertz{"Hz"};
inline constexpr Unit in_kelvin{"K"};
inline constexpr Unit in_seconds{"s"};
inline constexpr Unit in_volts{"V"};

inline constexpr Rule any_number{"", [](double) noexcept { return true; }};
inline constexpr Rule positive{"must be > 0", [](double x) noexcept { return x > 0.0; }};
inline constexpr Rule not_negative{"must be >= 0", [](double x) noexcept { return x >= 0.0; }};
inline constexpr Rule proper_fraction{"must be >= 0 and < 1",
                                      [](double x) noexcept { return x >= 0.0 && x < 1.0; }};

class Table;

class Value {
 public:
  /// `path` is how messages call the value: "sensor.depth". The others must outlive the object.
  Value(const toml::node& node, std::string path, Problems& problems);

  /// A finite number that keeps the rule; whole numbers are numbers, booleans are not.
  ///
  /// @param unit  of the number in the file; the answer is in SI
  [[nodiscard]] std::optional<double> number(const Rule& rule, const Unit& unit = {}) const;

  /// A whole number from `low` to `high`; 81.0 is none. `reason` is the hint when out of range.
  [[nodiscard]] std::optional<std::int64_t> integer(std::int64_t low, std::int64_t high,
                                                    std::string_view reason = {}) const;

  [[nodiscard]] std::optional<bool> boolean() const;

  [[nodiscard]] std::optional<std::string> text() const;

  /// Index of the text in `names`; `kind` is what a name stands for: "shape".
  [[nodiscard]] std::optional<std::size_t> one_of(std::string_view kind,
                                                  std::span<const std::string_view> names) const;

  /// The values of a list; `kind` is what the list holds: "numbers".
  [[nodiscard]] std::optional<std::vector<Value>> list(std::string_view kind) const;

  /// Every value of a list of numbers; at most `most_misfits` are reported.
  [[nodiscard]] std::optional<std::vector<double>> numbers(const Rule& rule,
                                                           const Unit& unit = {}) const;

  /// The value again, on one line, and the same without the quotes of a text; twice "" for tables
  /// and dates. Every number as short as it can be read back: 2.0 as 2.
  [[nodiscard]] std::pair<std::string, std::string> written() const;

  [[nodiscard]] std::optional<Table> table() const;

  /// The tables of [[name]].
  [[nodiscard]] std::optional<std::vector<Table>> tables() const;

  [[nodiscard]] bool is_text() const noexcept { return node_->is_string(); }
  [[nodiscard]] bool is_table() const noexcept { return node_->is_table(); }
  [[nodiscard]] bool is_list() const noexcept { return node_->is_array(); }

  /// "<path> <message>", at the value.
  void problem(std::string_view message, std::string hint = {}) const;

  /// As `problem`, with what the file says: "<path> <message> (got -1.5)".
  void misfit(std::string_view message, std::string hint = {}) const;

  [[nodiscard]] Place place() const noexcept;

 private:
  const toml::node* node_;
  std::string path_;
  Problems* problems_;
};

/// The number, or another where there is none or a wrong one.
[[nodiscard]] inline double number_or(const std::optional<Value>& value, const Rule& rule,
                                      double otherwise, const Unit& unit = {}) {
  return value ? value->number(rule, unit).value_or(otherwise) : otherwise;
}

[[nodiscard]] Place place_of(const toml::source_position& position) noexcept;

}  // namespace tactile_net
