#include "tactile_net/scene/scene_template.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "scene/document.hpp"
#include "scene/sections.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"

namespace tactile_net {
namespace {

/// A setting has no place in the scene, or none that it can be written into.
class NoPlace : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The element of a list that a step of a path names.
std::size_t place_in(const toml::array& list, std::string_view step, std::string_view key) {
  const auto index = whole_number(step);
  if (!index || *index >= list.size())
    throw NoPlace(std::string(key) + ": the scene's list has " + std::to_string(list.size()) +
                  ", counted from 0");
  return *index;
}

/// What a step of a path leads to; a table that is missing is made.
toml::node& within(toml::node& place, std::string_view step, std::string_view key) {
  if (toml::array* list = place.as_array()) return (*list)[place_in(*list, step, key)];
  toml::table* table = place.as_table();
  if (table == nullptr)
    throw NoPlace(std::string(key) + ": what stands before " + in_quotes(step) + " is not a table");
  if (toml::node* found = table->get(step)) return *found;
  return table->insert_or_assign(step, toml::table{}).first->second;
}

void set(toml::table& scene, const Setting& setting) {
  const std::vector<std::string_view> way = split(setting.key, '.');
  toml::node* place = &scene;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) place = &within(*place, way[i], setting.key);
  const toml::table holder = toml::parse("v = " + std::string(setting.value));
  const toml::node& value = *holder.get("v");
  if (toml::array* list = place->as_array()) {
    const std::size_t at = place_in(*list, way.back(), setting.key);
    (void)list->replace(list->cbegin() + static_cast<std::ptrdiff_t>(at), value);
  } else if (toml::table* table = place->as_table()) {
    table->insert_or_assign(way.back(), value);
  } else {
    throw NoPlace(std::string(setting.key) + ": what stands before " + in_quotes(way.back()) +
                  " is not a table");
  }
}

bool is_si(std::string_view unit) {
  constexpr std::array dimensions{Dimension::length, Dimension::stress, Dimension::force,
                                  Dimension::point_force};
  return std::any_of(dimensions.begin(), dimensions.end(),
                     [unit](Dimension one) { return si_unit(one) == unit; });
}

/// The unit of the numbers at and below a path; "" where they have several.
std::string unit_at(const Problems& problems, std::string_view path, bool stated) {
  std::optional<std::string_view> found;
  for (const auto& [at, unit] : problems.units()) {
    if (at != path && !(at.starts_with(path) && at[path.size()] == '.')) continue;
    if (found && *found != unit) return {};
    found = unit;
  }
  return found && (stated || !is_si(*found)) ? std::string(*found) : std::string();
}

/// A path as messages have it: lists of tables are called by their name alone.
std::string without_indices(std::string_view key) {
  std::vector<std::string> names;
  for (const std::string_view step : split(key, '.'))
    if (!whole_number(step)) names.emplace_back(step);
  return join(names, ".");
}

AnyScene scene_of(const SceneTemplate& base, std::span<const Setting> settings,
                  Problems& problems) {
  const std::string file = base.file().string();
  const std::string_view text = without_byte_order_mark(base.text());
  toml::table toml = parse_document(text, file, problems);
  for (const Setting& setting : settings) {
    try {
      set(toml, setting);
    } catch (const NoPlace& error) {
      problems.add({}, error.what());
    } catch (const toml::parse_error&) {
      problems.add({}, std::string(setting.key) + ": " + in_quotes(setting.value) + " is not TOML");
    }
  }
  return scene_in(toml, base.file(), problems);
}

}  // namespace

SceneTemplate::SceneTemplate(std::string text, std::filesystem::path file)
    : text_(std::move(text)), file_(std::move(file)) {
  const std::string_view content = without_byte_order_mark(text_);
  Problems problems{file_.string(), content};
  (void)parse_document(content, file_.string(), problems);
}

AnyScene SceneTemplate::with(std::span<const Setting> settings) const {
  Problems problems{file_.string(), without_byte_order_mark(text_)};
  AnyScene scene = scene_of(*this, settings, problems);
  problems.throw_if_any();
  return scene;
}

SceneTemplate::NumberUnits SceneTemplate::units(std::span<const Setting> settings) const {
  Problems problems{file_.string(), without_byte_order_mark(text_)};
  const AnyScene scene = scene_of(*this, settings, problems);
  NumberUnits units;
  const bool stated = std::visit([](const auto& one) { return one.units.has_value(); }, scene);
  if (stated)
    units.force = si_unit(std::holds_alternative<SkinScene>(scene) ? Dimension::point_force
                                                                   : Dimension::force);
  for (const Setting& setting : settings)
    units.settings.push_back(unit_at(problems, without_indices(setting.key), stated));
  return units;
}

std::vector<std::string> SceneTemplate::files() const {
  const toml::table toml = toml::parse(without_byte_order_mark(text_));
  std::vector<std::string> names;
  for (const std::string_view key : file_keys)
    if (const auto name = toml.at_path(key).value<std::string>()) names.push_back(*name);
  return names;
}

std::optional<SceneTemplate::Objection> SceneTemplate::objection(
    std::string_view key, std::span<const Setting> settings) const {
  toml::table toml = toml::parse(without_byte_order_mark(text_));
  for (const Setting& setting : settings) {
    if (setting.key != key) continue;
    try {
      set(toml, setting);
    } catch (const NoPlace& error) {
      return Objection{error.what(), "contacts are counted from 0: contact.0.force"};
    }
  }
  Problems problems{file_.string(), without_byte_order_mark(text_)};
  (void)scene_of(*this, settings, problems);
  const std::string name = without_indices(key);
  for (const UnknownKey& unknown : problems.unknown_keys())
    if (name == unknown.path || name.starts_with(unknown.path + '.'))
      return Objection{in_quotes(unknown.path) + " is not a key of a scene", unknown.meant};
  return std::nullopt;
}

void SceneTemplate::check_keys(std::span<const Setting> settings) const {
  Problems problems{file_.string(), without_byte_order_mark(text_)};
  (void)scene_of(*this, settings, problems);
  if (!problems.unknown_keys().empty()) problems.throw_if_any();
}

}  // namespace tactile_net
