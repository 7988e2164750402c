#include "scene/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <tuple>

#include "tactile_net/scene/nearest.hpp"

namespace tactile_net {

Problems::Problems(std::string file, std::string_view content) : file_(std::move(file)) {
  std::istringstream stream{std::string(content)};
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    lines_.push_back(line);
  }
}

void Problems::add(const toml::source_region& where, const std::string& message,
                   const std::string& hint) {
  const std::size_t line = where.begin.line;
  found_.push_back({.file = file_,
                    .line = line,
                    .column = where.begin.column,
                    .message = message,
                    .hint = hint,
                    .source = line >= 1 && line <= lines_.size() ? lines_[line - 1] : ""});
}

void Problems::add(const std::string& message, const std::string& hint) {
  found_.push_back({.file = file_, .message = message, .hint = hint});
}

void Problems::raise() const {
  if (found_.empty()) return;
  std::vector<Diagnostic> sorted = found_;
  const auto key = [](const Diagnostic& d) { return std::tie(d.line, d.column, d.message); };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
  sorted.erase(
      std::unique(sorted.begin(), sorted.end(),
                  [&](const Diagnostic& a, const Diagnostic& b) { return key(a) == key(b); }),
      sorted.end());
  throw InputError(std::move(sorted));
}

std::string shown(const toml::node& node) {
  constexpr std::size_t longest = 40;
  if (const auto text = node.value_exact<std::string>())
    return "'" + text->substr(0, longest) + (text->size() > longest ? "..." : "") + "'";
  if (const auto integer = node.value_exact<std::int64_t>()) return std::to_string(*integer);
  if (const auto number = node.value_exact<double>()) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, *number).ptr};
  }
  if (const auto truth = node.value_exact<bool>()) return *truth ? "true" : "false";
  if (node.is_table()) return "a table";
  if (node.is_array()) return "a list";
  return "a date";
}

std::string Table::full(std::string_view key) const {
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

const toml::node* Table::node(std::string_view key) {
  asked_.emplace(key);
  return table_.get(key);
}

bool Table::has(std::string_view key) { return node(key) != nullptr; }

std::optional<double> Table::checked(const toml::node& value, const std::string& key,
                                     const Rule& rule) {
  const auto integer = value.value_exact<std::int64_t>();
  const auto real = value.value_exact<double>();
  if (!integer && !real) {
    problems_.add(value.source(), key + " must be a number (got " + shown(value) + ")");
    return std::nullopt;
  }
  const double number = integer ? static_cast<double>(*integer) : *real;
  if (!std::isfinite(number)) {
    problems_.add(value.source(), key + " must be finite (got " + shown(value) + ")");
    return std::nullopt;
  }
  if (!rule.holds(number)) {
    problems_.add(value.source(), key + " must " + rule.text + " (got " + shown(value) + ")");
    return std::nullopt;
  }
  return number;
}

std::optional<double> Table::number(std::string_view key, const Rule& rule) {
  const toml::node* const value = node(key);
  return value == nullptr ? std::nullopt : checked(*value, full(key), rule);
}

std::optional<std::int64_t> Table::integer(std::string_view key, std::int64_t least,
                                           std::int64_t most) {
  const toml::node* const value = node(key);
  if (value == nullptr) return std::nullopt;
  const auto integer = value->value_exact<std::int64_t>();
  if (!integer) {
    problems_.add(value->source(), full(key) + " must be an integer (got " + shown(*value) + ")");
  } else if (*integer < least || *integer > most) {
    problems_.add(value->source(), full(key) + " must be from " + std::to_string(least) + " to " +
                                       std::to_string(most) + " (got " + shown(*value) + ")");
    return std::nullopt;
  }
  return integer;
}

std::optional<std::string> Table::string(std::string_view key) {
  const toml::node* const value = node(key);
  if (value == nullptr) return std::nullopt;
  auto text = value->value_exact<std::string>();
  if (!text)
    problems_.add(value->source(),
                  full(key) + " must be a text in quotes (got " + shown(*value) + ")");
  return text;
}

template <class Type, class Get>
std::optional<std::vector<Type>> Table::list(std::string_view key, const char* what, Get get) {
  const toml::node* const value = node(key);
  if (value == nullptr) return std::nullopt;
  const toml::array* const array = value->as_array();
  if (array == nullptr) {
    problems_.add(value->source(),
                  full(key) + " must be a list of " + what + " in [ ] (got " + shown(*value) + ")");
    return std::nullopt;
  }
  std::vector<Type> all;
  for (std::size_t i = 0; i < array->size(); ++i) {
    const toml::node& item = *array->get(i);
    const std::optional<Type> got = get(item, full(key) + "[" + std::to_string(i) + "]");
    if (!got) return std::nullopt;
    all.push_back(*got);
  }
  return all;
}

std::optional<std::vector<double>> Table::numbers(std::string_view key, const Rule& rule) {
  return list<double>(key, "numbers", [&](const toml::node& item, const std::string& place) {
    return checked(item, place, rule);
  });
}

std::optional<std::vector<std::int64_t>> Table::integers(std::string_view key, std::int64_t least,
                                                         std::int64_t most) {
  return list<std::int64_t>(
      key, "integers",
      [&](const toml::node& item, const std::string& place) -> std::optional<std::int64_t> {
        const auto value = item.value_exact<std::int64_t>();
        if (value && *value >= least && *value <= most) return value;
        problems_.add(item.source(), place + " must be an integer from " + std::to_string(least) +
                                         " to " + std::to_string(most) + " (got " + shown(item) +
                                         ")");
        return std::nullopt;
      });
}

std::optional<std::vector<std::string>> Table::strings(std::string_view key) {
  return list<std::string>(
      key, "texts",
      [&](const toml::node& item, const std::string& place) -> std::optional<std::string> {
        auto value = item.value_exact<std::string>();
        if (!value)
          problems_.add(item.source(),
                        place + " must be a text in quotes (got " + shown(item) + ")");
        return value;
      });
}

const toml::table* Table::table(std::string_view key) {
  const toml::node* const value = node(key);
  if (value == nullptr) return nullptr;
  if (!value->is_table())
    problems_.add(value->source(),
                  full(key) + " must be a table, [" + full(key) + "] (got " + shown(*value) + ")");
  return value->as_table();
}

std::optional<std::size_t> Table::choice(std::string_view key,
                                         const std::vector<std::string>& known) {
  const std::optional<std::string> text = string(key);
  if (!text) return std::nullopt;
  const auto found = std::find(known.begin(), known.end(), *text);
  if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
  std::string all;
  for (const std::string& word : known) all += (all.empty() ? "" : ", ") + word;
  const std::string_view near = nearest(*text, known);
  problem(key, full(key) + " must be one of " + all + " (got '" + *text + "')",
          near.empty() ? "" : "did you mean '" + std::string(near) + "'?");
  return std::nullopt;
}

bool Table::require(std::string_view key, const std::string& what) {
  if (has(key)) return true;
  problem(key, full(key) + " is missing: " + what);
  return false;
}

void Table::not_yet(std::string_view key, const std::string& hint) {
  if (has(key)) problem(key, full(key) + " is not simulated by this version yet", hint);
}

void Table::refuse(std::string_view key, const std::string& why) {
  if (has(key)) problem(key, full(key) + " " + why, "remove the line");
}

void Table::problem(std::string_view key, const std::string& message, const std::string& hint) {
  const toml::node* const value = table_.get(key);
  const toml::source_region& where = value == nullptr ? table_.source() : value->source();
  if (where.begin.line == 0)  // the file's own table
    problems_.add(message, hint);
  else
    problems_.add(where, message, hint);
}

void Table::finish() {
  const std::vector<std::string> known(asked_.begin(), asked_.end());
  for (const auto& [key, value] : table_) {
    const std::string_view word = key.str();
    if (asked_.count(word) > 0) continue;
    const std::string_view near = nearest(word, known);
    std::string all;
    for (const std::string& name : known) all += (all.empty() ? "" : ", ") + name;
    problems_.add(
        key.source(), "unknown key '" + full(word) + "'",
        near.empty() ? "known here: " + all : "did you mean '" + std::string(near) + "'?");
  }
}

}  // namespace tactile_net
