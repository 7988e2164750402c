#include "network/s_expression.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t deepest_list = 64;  // KiCad's own are some ten deep

bool is_blank(char one) { return one == ' ' || one == '\t' || one == '\n' || one == '\r'; }

/// Behind the closing quote of the text that begins at `at`; npos: it has none.
std::size_t end_of_text(std::string_view text, std::size_t at) {
  for (std::size_t k = at + 1; k < text.size(); ++k) {
    if (text[k] == '\\')
      ++k;
    else if (text[k] == '"')
      return k + 1;
  }
  return std::string_view::npos;
}

}  // namespace

std::string quoted_text(std::string_view text) {
  std::string result = "\"";
  for (const char one : text) {
    if (one == '"' || one == '\\') result += '\\';
    result += one;
  }
  return result + '"';
}

SExpression::SExpression(std::string_view text, std::string file) : file_(std::move(file)) {
  std::vector<std::size_t> open;
  std::vector<std::size_t> last;  // part of each open list
  std::size_t line = 1;
  const auto add = [&](Node node) {
    const std::size_t at = nodes_.size();
    node.line = line;
    if (!open.empty())
      (last.back() == none ? nodes_[open.back()].first : nodes_[last.back()].next) = at;
    if (!open.empty()) last.back() = at;
    nodes_.push_back(node);
    return at;
  };
  for (std::size_t k = 0; k < text.size();) {
    const char one = text[k];
    if (one == '\n') ++line;
    if (is_blank(one)) {
      ++k;
      continue;
    }
    if (open.empty() && !nodes_.empty()) refuse(line, "text behind the end of the file's list");
    if (one == '(') {
      if (open.size() == deepest_list)
        refuse(line, "lists nested more than " + std::to_string(deepest_list) +
                         " deep, as no file of KiCad has them");
      open.push_back(add({.list = true}));
      last.push_back(none);
      ++k;
      continue;
    }
    if (open.empty()) refuse(line, "a file of KiCad begins with '('");
    if (one == ')') {
      open.pop_back();
      last.pop_back();
      ++k;
      continue;
    }
    std::size_t end = k;
    if (one == '"') {
      end = end_of_text(text, k);
      if (end == std::string_view::npos) refuse(line, "a text without a closing quote");
    } else {
      while (end < text.size() && !is_blank(text[end]) && text[end] != '(' && text[end] != ')')
        ++end;
    }
    const std::string_view word = text.substr(k, end - k);
    add({.text = word});
    line += static_cast<std::size_t>(std::count(word.begin(), word.end(), '\n'));
    k = end;
  }
  if (nodes_.empty()) refuse(1, "the file is empty");
  if (!open.empty())
    refuse(line, "the file ends inside of the list that begins in line " +
                     std::to_string(nodes_[open.back()].line) + ": it is cut short");
}

void SExpression::refuse(std::size_t line, const std::string& message) const {
  throw std::invalid_argument(file_ + ':' + std::to_string(line) + ": " + message);
}

void SExpression::Item::refuse(const std::string& message) const {
  of_->refuse(node().line, message);
}

std::string_view SExpression::Item::head() const {
  if (!is_list() || node().first == none) return {};
  const Node& first = of_->nodes_[node().first];
  return first.list ? std::string_view() : first.text;
}

std::optional<SExpression::Item> SExpression::Item::find_part(std::size_t k) const {
  std::size_t at = node().first;
  for (std::size_t skipped = 0; at != none && skipped <= k; ++skipped) at = of_->nodes_[at].next;
  if (at == none) return std::nullopt;
  return Item(*of_, at);
}

SExpression::Item SExpression::Item::part(std::size_t k) const {
  const auto found = find_part(k);
  if (!found) refuse("(" + std::string(head()) + " ...) ends too early");
  return *found;
}

std::optional<SExpression::Item> SExpression::Item::find(std::string_view name) const {
  for (std::size_t at = node().first; at != none; at = of_->nodes_[at].next) {
    const Item item(*of_, at);
    if (item.is_list() && item.head() == name) return item;
  }
  return std::nullopt;
}

SExpression::Item SExpression::Item::get(std::string_view name) const {
  const auto found = find(name);
  if (!found) refuse("(" + std::string(head()) + " ...) has no (" + std::string(name) + " ...)");
  return *found;
}

std::string SExpression::Item::text() const {
  if (is_list()) refuse("a word is expected, not a list");
  std::string_view raw = node().text;
  if (raw.empty() || raw.front() != '"') return std::string(raw);
  raw = raw.substr(1, raw.size() - 2);
  std::string plain;
  for (std::size_t k = 0; k < raw.size(); ++k) {
    if (raw[k] == '\\' && k + 1 < raw.size()) ++k;
    plain += raw[k];
  }
  return plain;
}

double SExpression::Item::number() const {
  double value = 0.0;
  const std::string word = text();
  if (!read_number(word, value) || !std::isfinite(value))
    refuse("a number is expected, not '" + word.substr(0, 40) + "'");
  return value;
}

std::size_t SExpression::Item::index(std::size_t limit) const {
  const std::string word = text();
  const auto value = whole_number(word);
  if (!value || *value >= limit)
    refuse("a whole number below " + std::to_string(limit) + " is expected, not '" +
           word.substr(0, 40) + "'");
  return *value;
}

}  // namespace tactile_net
