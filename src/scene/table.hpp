/// @file
/// One TOML table as the reader sees it: typed values, positions, and which keys were asked for.
/// Private.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net {

/// Collects the problems of one file.
class Problems {
 public:
  Problems(std::string file, std::string_view content);

  void add(const toml::source_region& where, const std::string& message,
           const std::string& hint = {});
  /// About the file as a whole.
  void add(const std::string& message, const std::string& hint = {});

  /// @throw InputError  if there are any: in the file's order, each once
  void raise() const;

 private:
  std::string file_;
  std::vector<std::string> lines_;
  std::vector<Diagnostic> found_;
};

/// What a number must satisfy; the text completes "KEY must ...".
struct Rule {
  const char* text;
  bool (*holds)(double);
};
inline constexpr Rule positive{"be > 0", [](double x) { return x > 0.0; }};
inline constexpr Rule not_negative{"be >= 0", [](double x) { return x >= 0.0; }};
inline constexpr Rule finite{"be finite", [](double) { return true; }};

/// Every getter reports what is wrong and returns nothing then, so that all problems of a file are
/// found in one pass.
class Table {
 public:
  Table(const toml::table& table, std::string path, Problems& problems)
      : table_(table), path_(std::move(path)), problems_(problems) {}

  [[nodiscard]] bool has(std::string_view key);
  [[nodiscard]] std::optional<double> number(std::string_view key, const Rule& rule);
  [[nodiscard]] std::optional<std::int64_t> integer(std::string_view key, std::int64_t least,
                                                    std::int64_t most);
  [[nodiscard]] std::optional<std::string> string(std::string_view key);
  [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view key, const Rule& rule);
  [[nodiscard]] std::optional<std::vector<std::int64_t>> integers(std::string_view key,
                                                                  std::int64_t least,
                                                                  std::int64_t most);
  [[nodiscard]] std::optional<std::vector<std::string>> strings(std::string_view key);
  [[nodiscard]] const toml::table* table(std::string_view key);
  [[nodiscard]] const toml::node* node(std::string_view key);

  /// One of the known words; says which is nearest otherwise.
  [[nodiscard]] std::optional<std::size_t> choice(std::string_view key,
                                                  const std::vector<std::string>& known);

  /// Reports a key that is required and absent (false then).
  bool require(std::string_view key, const std::string& what);
  /// Reports a key of the format that this version cannot simulate, if it is there.
  void not_yet(std::string_view key, const std::string& hint);
  /// Reports a key that does not apply here, if it is there.
  void refuse(std::string_view key, const std::string& why);
  /// Reports a problem at a key's value, or at the table if the key is absent.
  void problem(std::string_view key, const std::string& message, const std::string& hint = {});
  /// Reports every key that nothing above asked for.
  void finish();

 private:
  [[nodiscard]] std::string full(std::string_view key) const;
  [[nodiscard]] std::optional<double> checked(const toml::node& value, const std::string& key,
                                              const Rule& rule);
  template <class Type, class Get>
  [[nodiscard]] std::optional<std::vector<Type>> list(std::string_view key, const char* what,
                                                      Get get);

  const toml::table& table_;
  std::string path_;
  Problems& problems_;
  std::set<std::string, std::less<>> asked_;
};

/// A value as the file spells it, for messages: "'abc'", "-1.5", "true", "a table".
[[nodiscard]] std::string shown(const toml::node& node);

}  // namespace tactile_net
