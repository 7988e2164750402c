#include "scene/problems.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "scene/excerpt.hpp"

namespace tactile_net {

namespace {

constexpr std::size_t most_problems = 100;
constexpr std::size_t longest_quotation = 40;

std::string cut(std::string_view text) {
  if (text.size() <= longest_quotation) return std::string{text};
  return std::string{text.substr(0, byte_of_column(text, longest_quotation - 2))} + "...";
}

}  // namespace

Problems::Problems(std::string file, std::string_view text, const FileKind& kind)
    : file_{std::move(file)}, text_{text}, kind_{kind}, line_starts_{0} {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') line_starts_.push_back(i + 1);
}

void Problems::add(Place place, std::string message, std::string hint) {
  if (diagnostics_.size() == most_problems) {
    ++left_off_;
    return;
  }
  const Excerpt source = excerpt(line(place.line), place.column);
  diagnostics_.push_back({file_, place.line, place.column, std::move(message), std::move(hint),
                          source.text, source.column});
}

void Problems::add_unknown(Place place, std::string message, std::string hint, UnknownKey key) {
  add(place, std::move(message), std::move(hint));
  unknown_.push_back(std::move(key));
}

void Problems::note_unit(std::string_view path, std::string_view unit) {
  const bool known = !units_.empty() && units_.back().first == path && units_.back().second == unit;
  if (!known) units_.emplace_back(path, unit);  // once for all numbers of a list
}

std::string_view Problems::line(std::size_t number) const {
  if (number == 0 || number > line_starts_.size()) return {};
  const std::string_view rest = text_.substr(line_starts_[number - 1]);
  std::string_view result = rest.substr(0, rest.find('\n'));
  if (result.ends_with('\r')) result.remove_suffix(1);
  return result;
}

std::string Problems::written(Place from, Place to) const {
  if (from.line != to.line || to.column <= from.column) return {};
  std::string_view rest = line(from.line);
  rest.remove_prefix(byte_of_column(rest, from.column));
  return cut(rest.substr(0, byte_of_column(rest, to.column - from.column + 1)));
}

void Problems::throw_if_any() {
  if (none()) return;
  const auto place = [](const Diagnostic& d) { return std::tie(d.line, d.column, d.message); };
  std::stable_sort(diagnostics_.begin(), diagnostics_.end(),
                   [&](const auto& a, const auto& b) { return place(a) < place(b); });
  const auto end = std::unique(diagnostics_.begin(), diagnostics_.end(),
                               [&](const auto& a, const auto& b) { return place(a) == place(b); });
  diagnostics_.erase(end, diagnostics_.end());
  if (left_off_ > 0) {
    Diagnostic rest;
    rest.file = file_;
    rest.message = std::to_string(left_off_) + " more problems are not shown";
    diagnostics_.push_back(std::move(rest));
  }
  throw InputError{std::move(diagnostics_)};
}

std::string in_quotes(std::string_view text) { return '"' + cut(text) + '"'; }

std::string listed(const std::vector<std::string_view>& names) {
  std::string result;
  for (const std::string_view name : names)
    result += (result.empty() ? "" : ", ") + in_quotes(name);
  return result;
}

}  // namespace tactile_net
