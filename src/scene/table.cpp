#include "scene/table.hpp"

#include <algorithm>
#include <utility>

#include "tactile_net/scene/nearest.hpp"

namespace tactile_net {

Table::Table(const toml::table& table, std::string path, Problems& problems)
    : table_{&table}, path_{std::move(path)}, problems_{&problems} {}

Place Table::place() const noexcept {
  return path_.empty() ? Place{} : place_of(table_->source().begin);
}

std::string Table::path_of(std::string_view key) const {
  return path_.empty() ? std::string{key} : path_ + '.' + std::string{key};
}

bool Table::is_known(std::string_view key) const noexcept {
  return std::find(known_.begin(), known_.end(), key) != known_.end();
}

std::optional<Value> Table::value(std::string_view key) {
  if (!is_known(key)) {
    known_.push_back(key);
    on_offer_.push_back(key);
  }
  const toml::node* node = table_->get(key);
  if (node == nullptr) return std::nullopt;
  return Value{*node, path_of(key), *problems_};
}

std::optional<Value> Table::required(std::string_view key, std::string_view hint,
                                     std::initializer_list<std::string_view> alternatives) {
  auto result = value(key);
  const bool replaced =
      std::any_of(alternatives.begin(), alternatives.end(),
                  [&](std::string_view other) { return value(other).has_value(); });
  if (!result && !replaced) {
    const std::string name = path_.empty() ? '[' + std::string{key} + ']' : path_of(key);
    missing(key, place(), name + " is missing", hint);
    missing_.back().keys.insert(missing_.back().keys.end(), alternatives);
  }
  return result;
}

void Table::missing(std::string_view key, Place where, std::string message, std::string_view hint) {
  missing_.push_back({{key}, where, std::move(message), std::string{hint}});
}

void Table::not_here(std::string_view key, std::string_view why, std::string_view hint) {
  const auto found = value(key);
  std::erase(on_offer_, key);
  if (found) found->problem(why, std::string{hint});
}

void Table::report_unknown(const toml::key& key, const toml::node& node, std::string_view near) {
  const bool is_table = path_.empty() && (node.is_table() || node.is_array_of_tables());
  const std::string meant = near.empty() ? "" : "did you mean " + std::string{near} + '?';
  std::string hint = meant;
  if (near.empty() || table_->contains(near)) {
    hint = path_.empty() ? "a " + std::string{problems_->kind().name} + " has" : path_ + " has";
    for (const std::string_view known : on_offer_)
      hint += (known == on_offer_.front() ? " " : ", ") + std::string{known};
  }
  problems_->add_unknown(
      place_of(key.source().begin),
      (is_table ? "unknown table " : "unknown key ") + in_quotes(path_of(key.str())),
      std::move(hint), {path_of(key.str()), meant});
}

void Table::finish() {
  std::vector<std::string_view> misspelt;
  for (const auto& [key, node] : *table_) {
    if (is_known(key.str())) continue;
    const std::string_view near = nearest(key.str(), known_);
    report_unknown(key, node, near);
    misspelt.push_back(near);
  }
  for (const auto& [keys, where, message, hint] : missing_) {
    const bool explained = std::find_first_of(keys.begin(), keys.end(), misspelt.begin(),
                                              misspelt.end()) != keys.end();
    if (!explained) problems_->add(where, message, hint);
  }
}

}  // namespace tactile_net
