#include "scene/hand_parts.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::hand_parts {

std::filesystem::path path_of(const Value& value, const References& references) {
  const std::string text = value.text().value_or("-");
  if (text.empty())
    value.problem("must name a file", "paths are relative to the hand's folder");
  else if (!references.allow(text))
    value.misfit("must name a file beside the hand's file or below its folder",
                 "a hand from somewhere else could have any file read; if the hand is your own: " +
                     option(Option::allow_outside));
  return text;
}

std::size_t read_frame(Table& table) {
  const auto value = table.value("frame");
  return value ? static_cast<std::size_t>(value->integer(0, INT64_MAX).value_or(0)) : 0;
}

void refuse_others(Table& table, std::string_view kind, Keys keys, std::string_view kinds) {
  const std::string why = "has no place beside " + std::string{kind};
  for (const char* key : keys) table.not_here(key, why, kinds);
}

FingertipScene read_fingertip_scene(Table& table, const Value& scene,
                                    const References& references) {
  FingertipScene tip{.scene = path_of(scene, references), .readings = {}};
  if (const auto readings = table.value("readings")) {
    tip.readings = path_of(*readings, references);
    tip.frame = read_frame(table);
  } else {
    table.not_here("frame", "has no place without readings", "add readings = \"FILE.csv\"");
  }
  return tip;
}

std::string read_name(Table& table, const std::vector<std::string>& before) {
  const auto value = table.value("name");
  if (!value) return "finger " + std::to_string(before.size() + 1);
  const std::string name = value->text().value_or("");
  if (name.empty() || name.find_first_of("\r\n") != std::string::npos)
    value->problem("must be a name on one line", "name = \"index\"");
  if (std::find(before.begin(), before.end(), name) != before.end())
    value->misfit("must not be another finger's");
  return name;
}

std::vector<double> read_for_each(const Value& value, const Rule& rule, std::size_t count,
                                  std::string_view what) {
  const std::vector<double> values = value.numbers(rule).value_or(std::vector<double>{});
  if (!values.empty() && count != 0 && values.size() != count)
    value.problem("must hold one number for each " + std::string(what) + " (" +
                  std::to_string(count) + ' ' + std::string(what) + "s, got " +
                  std::to_string(values.size()) + ')');
  return values;
}

void read_heading(Table& root, std::string& title, bool& si) {
  if (const auto value = root.value("title")) {
    title = value->text().value_or("");
    if (title.find_first_of("\r\n") != std::string::npos)
      value->problem("must be one line", "say more in comments");
  }
  constexpr std::array<std::string_view, 1> systems = {"SI"};
  if (const auto system = root.value("units"))
    si = system->one_of("system of units", systems).has_value();
}

}  // namespace tactile_net::hand_parts
