/// @file
/// One table of a TOML file that remembers which keys were asked for: what is left over is unknown.
#pragma once

#include <toml++/toml.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/problems.hpp"
#include "scene/value.hpp"

namespace tactile_net {

class Table {
 public:
  /// `path` is how messages call the table, empty for the whole file. The others must outlive the
  /// object.
  Table(const toml::table& table, std::string path, Problems& problems);

  /// The value of a key that may be absent.
  [[nodiscard]] std::optional<Value> value(std::string_view key);

  /// The value of a key that must be there, or one of `alternatives` instead of it.
  ///
  /// @param hint  what the key says, with an example
  [[nodiscard]] std::optional<Value> required(
      std::string_view key, std::string_view hint,
      std::initializer_list<std::string_view> alternatives = {});

  /// A key of the format that has no place here: a problem if it is there.
  void not_here(std::string_view key, std::string_view why, std::string_view hint);

  /// Reports the keys that nobody asked for and those that are missing; a missing key whose
  /// misspelling was reported is not reported again. To be called once, after every key was asked
  /// for.
  void finish();

  /// Where the table begins.
  [[nodiscard]] Place place() const noexcept;

 private:
  struct Missing {
    std::vector<std::string_view> keys;  // any of them would do
    Place where;
    std::string message;
    std::string hint;
  };

  /// Says that a key is missing for which the value at `where` asks.
  void missing(std::string_view key, Place where, std::string message, std::string_view hint);
  [[nodiscard]] std::string path_of(std::string_view key) const;
  [[nodiscard]] bool is_known(std::string_view key) const noexcept;
  void report_unknown(const toml::key& key, const toml::node& node, std::string_view near);

  const toml::table* table_;
  std::string path_;
  Problems* problems_;
  std::vector<std::string_view> known_;
  std::vector<std::string_view> on_offer_;  // the known keys that have a use here
  std::vector<Missing> missing_;
};

[[nodiscard]] inline std::optional<Table> table_of(const std::optional<Value>& value) {
  return value ? value->table() : std::nullopt;
}

}  // namespace tactile_net
