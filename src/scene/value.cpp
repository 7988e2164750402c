#include "scene/value.hpp"

#include <cmath>
#include <utility>

#include "scene/table.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/nearest.hpp"

namespace tactile_net {

namespace {

/// TOML's basic string of one line.
std::string basic_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      (result += '\\') += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      constexpr std::string_view digits = "0123456789ABCDEF";
      const auto code = static_cast<unsigned char>(c);
      (((result += "\\u00") += digits[code >> 4U]) += digits[code & 0xFU]);
    } else {
      result += c;
    }
  }
  return result + '"';
}

/// "": a table, a date, or a list with such.
std::string written_anew(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return std::to_string(whole->get());
  if (const auto* real = node.as_floating_point()) return shortest(real->get());
  if (const auto* boolean = node.as_boolean()) return boolean->get() ? "true" : "false";
  if (const auto* string = node.as_string()) return basic_string(string->get());
  const auto* list = node.as_array();
  if (list == nullptr) return {};
  std::string result = "[";
  for (const toml::node& one : *list) {
    const std::string text = written_anew(one);
    if (text.empty()) return {};
    (result += result.size() > 1 ? ", " : "") += text;
  }
  return result + ']';
}

}  // namespace

Place place_of(const toml::source_position& position) noexcept {
  return {position.line, position.column};
}

Value::Value(const toml::node& node, std::string path, Problems& problems)
    : node_{&node}, path_{std::move(path)}, problems_{&problems} {}

Place Value::place() const noexcept { return place_of(node_->source().begin); }

void Value::problem(std::string_view message, std::string hint) const {
  problems_->add(place(), path_ + ' ' + std::string{message}, std::move(hint));
}

void Value::misfit(std::string_view message, std::string hint) const {
  std::string got;
  if (node_->is_array())
    got = "a list";
  else if (node_->is_table())
    got = "a table";
  else
    got = problems_->written(place(), place_of(node_->source().end));
  problem(std::string{message} + (got.empty() ? "" : " (got " + got + ')'), std::move(hint));
}

std::optional<double> Value::number(const Rule& rule, const Unit& unit) const {
  problems_->note_unit(path_, unit.name);
  std::optional<double> number;
  if (const auto* whole = node_->as_integer()) number = static_cast<double>(whole->get());
  if (const auto* real = node_->as_floating_point()) number = real->get();
  if (!number) {
    misfit("must be a number", is_text() ? "a number stands without quotes" : "");
    return std::nullopt;
  }
  if (!std::isfinite(*number)) {
    misfit("must be a finite number");
    return std::nullopt;
  }
  if (!rule.holds(*number)) {
    misfit(rule.text, std::string(rule.what_to_do));
    return std::nullopt;
  }
  number = unit.to_si(*number);
  if (!std::isfinite(*number) || !rule.holds(*number)) {
    misfit("is beyond what a double holds in SI" +
           (unit.name.empty() ? "" : ", and is in " + std::string{unit.name}));
    return std::nullopt;
  }
  return number;
}

std::optional<std::int64_t> Value::integer(std::int64_t low, std::int64_t high,
                                           std::string_view reason) const {
  const auto* whole = node_->as_integer();
  if (whole == nullptr) {
    misfit("must be a whole number",
           node_->is_floating_point() ? "write it without point and exponent: 81, not 81.0" : "");
    return std::nullopt;
  }
  if (whole->get() >= low && whole->get() <= high) return whole->get();
  const bool no_upper_end = high == INT64_MAX;
  misfit(no_upper_end ? "must be >= " + std::to_string(low)
                      : "must be from " + std::to_string(low) + " to " + std::to_string(high),
         std::string{reason});
  return std::nullopt;
}

std::optional<bool> Value::boolean() const {
  if (const auto* boolean = node_->as_boolean()) return boolean->get();
  misfit("must be true or false");
  return std::nullopt;
}

std::optional<std::string> Value::text() const {
  if (const auto* string = node_->as_string()) return string->get();
  misfit("must be text", "text stands in quotes");
  return std::nullopt;
}

std::optional<std::size_t> Value::one_of(std::string_view kind,
                                         std::span<const std::string_view> names) const {
  const std::vector<std::string_view> known{names.begin(), names.end()};
  if (!is_text()) {
    misfit("must be the name of a " + std::string{kind}, "one of " + listed(known));
    return std::nullopt;
  }
  const std::string& name = node_->as_string()->get();
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return i;
  const std::string_view near = nearest(name, names);
  const std::string hint =
      near.empty() ? "one of " + listed(known) : "did you mean " + in_quotes(near) + '?';
  problem("names an unknown " + std::string{kind} + ' ' + in_quotes(name), hint);
  return std::nullopt;
}

std::optional<std::vector<Value>> Value::list(std::string_view kind) const {
  const auto* array = node_->as_array();
  if (array == nullptr) {
    misfit("must be a list of " + std::string{kind},
           node_->is_table() ? "" : "a list stands in brackets, even one of a single value");
    return std::nullopt;
  }
  std::vector<Value> values;
  values.reserve(array->size());
  for (const toml::node& node : *array) values.emplace_back(node, path_, *problems_);
  return values;
}

std::optional<std::vector<double>> Value::numbers(const Rule& rule, const Unit& unit) const {
  const auto values = list("numbers");
  if (!values) return std::nullopt;
  std::vector<double> numbers;
  numbers.reserve(values->size());
  std::size_t misfits = 0;
  for (const Value& value : *values) {
    if (const auto number = value.number(rule, unit))
      numbers.push_back(*number);
    else if (++misfits == most_misfits)
      return std::nullopt;
  }
  if (misfits > 0) return std::nullopt;
  return numbers;
}

std::pair<std::string, std::string> Value::written() const {
  std::string toml = written_anew(*node_);
  std::string plain = is_text() ? node_->as_string()->get() : toml;
  return {std::move(toml), std::move(plain)};
}

std::optional<Table> Value::table() const {
  if (const auto* table = node_->as_table()) return Table{*table, path_, *problems_};
  if (node_->is_array_of_tables())
    problem("must stand once", "write [" + path_ + "] with single brackets");
  else
    misfit("must be a table", "write [" + path_ + "] and its keys on the lines below");
  return std::nullopt;
}

std::optional<std::vector<Table>> Value::tables() const {
  const auto* array = node_->as_array();
  const std::string header = "[[" + path_ + "]]";
  if (array == nullptr) {
    misfit("must be a list of tables", "write " + header + " with double brackets, once for each");
    return std::nullopt;
  }
  std::vector<Table> tables;
  bool complete = true;
  for (const toml::node& node : *array) {
    if (const auto* table = node.as_table()) {
      tables.emplace_back(*table, path_, *problems_);
      continue;
    }
    Value{node, path_, *problems_}.misfit("must be a list of tables", "write " + header);
    complete = false;
  }
  if (!complete) return std::nullopt;
  return tables;
}

}  // namespace tactile_net
