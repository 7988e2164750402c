#include "tactile_net/drawing/html.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::drawing {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Where the decimal number ends that begins at `at`: digits, a point and digits.
std::size_t end_of_decimal(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  if (at + 1 < text.size() && text[at] == '.' && is_digit(text[at + 1]))
    for (++at; at < text.size() && is_digit(text[at]);) ++at;
  return at;
}

/// "1.09" and 3: "1090".
std::string shifted(std::string_view decimal, std::size_t power) {
  const std::size_t point = std::min(decimal.find('.'), decimal.size());
  std::string digits(decimal.substr(0, point));
  if (point < decimal.size()) digits += decimal.substr(point + 1);
  if (digits.size() <= point + power) return digits.append(point + power - digits.size(), '0');
  return digits.insert(point + power, 1, '.');
}

/// A number at `at`, written for people, and how much of the text it was; nothing: none begins
/// there, or it is fine as it is.
std::pair<std::string, std::size_t> rewritten(std::string_view text, std::size_t at) {
  const bool inside = at > 0 && (is_digit(text[at - 1]) || text[at - 1] == '.');
  if (inside || !is_digit(text[at])) return {};
  const std::size_t end = end_of_decimal(text, at);
  if (end + 3 >= text.size() || text[end] != 'e' || (text[end + 1] != '+' && text[end + 1] != '-'))
    return {};
  int power = 0;
  const auto [stop, error] =
      std::from_chars(text.data() + end + 2, text.data() + text.size(), power);
  if (error != std::errc{}) return {};
  const std::string_view decimal = text.substr(at, end - at);
  const auto length = static_cast<std::size_t>(stop - text.data()) - at;
  if (text[end + 1] == '+' && power < 6)
    return {shifted(decimal, static_cast<std::size_t>(power)), length};
  return {std::string(decimal) + (text[end + 1] == '-' ? "e-" : "e") + std::to_string(power),
          length};
}

/// "0.549 +- 0.0857" at `at`, rounded by the deviation, and how much of the text it was.
std::pair<std::string, std::size_t> rounded(std::string_view text, std::size_t at) {
  const bool inside = at > 0 && (is_digit(text[at - 1]) || text[at - 1] == '.');
  if (inside || !(is_digit(text[at]) || text[at] == '-')) return {};
  const char* const end = text.data() + text.size();
  double value = 0.0;
  const auto [first, error] = number_from_chars(text.data() + at, end, value);
  constexpr std::string_view between = " +- ";
  const auto middle = static_cast<std::size_t>(first - text.data());
  if (error != std::errc{} || !text.substr(middle).starts_with(between)) return {};
  double deviation = 0.0;
  const auto [last, wrong] =
      number_from_chars(text.data() + middle + between.size(), end, deviation);
  if (wrong != std::errc{}) return {};
  const auto end_of_both = static_cast<std::size_t>(last - text.data());
  const std::string_view given = text.substr(at, middle - at);
  std::string both = plus_minus(value, deviation);
  const auto decimals = [](std::string_view number) {
    const std::string_view whole = number.substr(0, number.find(' '));
    return whole.find('.') == std::string_view::npos ? 0 : whole.size() - whole.find('.');
  };
  // Digits that the text does not have are not made up.
  if (given.find('e') == std::string_view::npos && decimals(both) > decimals(given))
    both = std::string(given) + " ± " + brief(deviation);
  return {std::move(both), end_of_both - at};
}

constexpr std::array<std::pair<std::string_view, std::string_view>, 5> signs = {
    {{" us", " µs"}, {" deg", "°"}, {"+-", "±"}, {"<=", "≤"}, {">=", "≥"}}};

/// A unit behind a number alone: "5 us", not "let us".
bool stands(std::string_view sign, std::string_view text, std::size_t at) {
  if (!text.substr(at).starts_with(sign)) return false;
  const std::size_t end = at + sign.size();
  const bool letter = end < text.size() && ((text[end] >= 'a' && text[end] <= 'z') ||
                                            (text[end] >= 'A' && text[end] <= 'Z'));
  return sign.front() != ' ' || (at > 0 && is_digit(text[at - 1]) && !letter);
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : printable_lines(text)) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string typeset(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    std::pair<std::string, std::size_t> next = rounded(text, at);
    if (next.second == 0) next = rewritten(text, at);
    for (const auto& [sign, written] : signs)
      if (next.second == 0 && stands(sign, text, at))
        next = std::pair(std::string(written), sign.size());
    if (next.second == 0) next = std::pair(std::string(1, text[at]), std::size_t{1});
    out += next.first;
    at += next.second;
  }
  return out;
}

std::string words_html(std::string_view text) { return escaped(typeset(text)); }

std::string enclosed(std::string_view tag, std::string_view html, std::string_view type) {
  std::string out = "<" + std::string(tag);
  if (!type.empty()) out += " class=\"" + std::string(type) + "\"";
  return out + ">" + std::string(html) + "</" + std::string(tag) + ">\n";
}

std::string element(std::string_view tag, std::string_view words, std::string_view type) {
  return enclosed(tag, words_html(words), type);
}

std::string data_html(std::string_view json) {
  std::string out(data_element);
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out + "</script>\n";
}

std::string html_list(const std::vector<std::string>& items) {
  std::string out = "<ul>\n";
  for (const std::string& item : items) out += element("li", item);
  return out + "</ul>\n";
}

std::string html_table(const std::vector<std::vector<std::string>>& rows, const CellHtml& cell) {
  std::string out = "<div class=\"wide\"><table>\n<thead><tr>";
  for (const std::string& title : rows.front()) out += element("th", title);
  out += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 1; i < rows.size(); ++i) {
    out += "<tr>";
    for (std::size_t k = 0; k < rows[i].size(); ++k)
      out += "<td data-label=\"" + words_html(rows.front()[k]) + "\">" +
             (cell ? cell(k, rows[i][k]) : words_html(rows[i][k])) + "</td>";
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string html_page(std::string_view title, std::string_view body, std::string_view style) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width\">\n" +
         std::string(written_by) + " " + std::string(version()) + "\">\n" +
         enclosed("title", escaped(title)) + "<style>" + std::string(style) +
         "</style></head>\n<body>\n" + std::string(body) +
         element("footer", "Written by tactile-net " + std::string(version()) +
                               ". Numbers without a unit are in the input's units.") +
         "</body>\n</html>\n";
}

}  // namespace tactile_net::drawing
