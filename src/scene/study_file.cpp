#include "tactile_net/scene/study_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "numeric/named.hpp"
#include "scene/document.hpp"
#include "scene/references.hpp"
#include "scene/sections.hpp"
#include "scene/table.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/scene/bounded_text.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net {
namespace {

constexpr Named<AxisScale> scales[] = {{AxisScale::linear, "linear"}, {AxisScale::log, "log"}};
constexpr Named<DrawKind> draw_kinds[] = {{DrawKind::random, "random"}, {DrawKind::sobol, "sobol"}};

constexpr FileKind study_file{
    "study", "the smallest study is scene = \"pad.toml\" and one [[axis]] with key and values"};
constexpr auto count_limit = static_cast<std::int64_t>(most_points);

std::vector<std::string> named_by_default() {
  std::vector<std::string> names;
  for (const Kept kept : kept_by_default()) names.emplace_back(name(kept));
  return names;
}

/// An axis, and where it stands.
struct ReadAxis {
  StudyAxis axis{};
  std::optional<Value> key{};  ///< absent: missing, or wrong
};

AxisRange read_range(Table& table, const Value& from) {
  AxisRange range;
  range.from = from.number(any_number).value_or(0.0);
  const auto to = table.required("to", "the other end of the range: to = 2.0");
  range.to = to ? to->number(any_number).value_or(range.from) : range.from;
  if (const auto count = table.value("count"))
    range.count = static_cast<std::size_t>(count->integer(1, count_limit).value_or(1));
  if (const auto scale = table.value("scale"))
    if (const auto index =
            scale->one_of("scale", names_of(std::array{AxisScale::linear, AxisScale::log})))
      range.scale = static_cast<AxisScale>(*index);
  if (const auto whole = table.value("whole")) range.whole = whole->boolean().value_or(false);
  if (range.scale == AxisScale::log && !(range.from > 0.0 && range.to > 0.0))
    from.problem("and axis.to must be > 0 on a logarithmic scale", "scale = \"linear\"");
  if (!std::isfinite(range.to - range.from)) from.problem("and axis.to are too far apart");
  return range;
}

std::vector<AxisValue> read_values(const Value& value) {
  std::vector<AxisValue> values;
  const auto list = value.list("values");
  if (!list) return values;
  if (list->empty())
    value.problem("must hold at least one value", "an axis without values makes no point");
  for (const Value& one : *list) {
    auto [toml, plain] = one.written();
    if (toml.empty()) {
      one.misfit("must hold numbers, text, true or false, or lists of them");
      return {};
    }
    AxisValue read{std::move(toml), std::move(plain)};
    if (std::find(values.begin(), values.end(), read) != values.end())
      one.problem("holds " + in_quotes(read.plain) + " twice", "remove one");
    values.push_back(std::move(read));
  }
  return values;
}

ReadAxis read_axis(Table table, std::span<const ReadAxis> before) {
  ReadAxis read;
  if (const auto key = table.required("key", "which of the scene's: key = \"sensor.depth\"")) {
    read.axis.key = key->text().value_or("");
    const auto is_same = [&](const ReadAxis& other) { return other.axis.key == read.axis.key; };
    if (key->is_text() &&
        (read.axis.key.empty() || read.axis.key.front() == '.' || read.axis.key.back() == '.' ||
         read.axis.key.find("..") != std::string::npos))
      key->problem("must be a dotted path", "key = \"sensor.depth\"");
    else if (std::any_of(before.begin(), before.end(), is_same))
      key->problem("names " + in_quotes(read.axis.key) + " twice", "join the two axes");
    else if (key->is_text())
      read.key = key;
  }
  const auto from = table.value("from");
  if (from) {
    read.axis.values = read_range(table, *from);
    table.not_here("values", "has no place beside axis.from", "keep one of the two");
  } else {
    for (const std::string_view key : {"to", "count", "scale", "whole"})
      table.not_here(key, "has no place without axis.from", "from = 1.0 begins a range");
    if (const auto values =
            table.required("values", "values = [1.0, 2.0], or from, to and count", {"from"}))
      read.axis.values = read_values(*values);
  }
  table.finish();
  return read;
}

void read_draw(Table table, StudyFile& study) {
  if (const auto kind = table.required("kind", "kind = \"sobol\", or \"random\""))
    if (const auto index =
            kind->one_of("kind of draw", names_of(std::array{DrawKind::random, DrawKind::sobol})))
      study.draw = static_cast<DrawKind>(*index);
  if (const auto count = table.required("count", "how many: count = 64"))
    study.draws = static_cast<std::size_t>(count->integer(1, count_limit).value_or(1));
  table.finish();
}

/// In the order of columns, whatever the file's.
std::vector<Kept> read_keep(const Value& value) {
  const auto list = value.list("names");
  if (!list) return {};
  if (list->empty())
    value.problem("must name something",
                  "without keep, rows have " + join(named_by_default(), ", "));
  std::vector<Kept> keep;
  const std::vector<std::string_view> names = kept_names();
  for (const Value& one : *list) {
    const auto index = one.one_of("column", names);
    if (!index) continue;
    const auto kept = static_cast<Kept>(*index);
    if (std::find(keep.begin(), keep.end(), kept) != keep.end())
      one.problem("names " + in_quotes(names[*index]) + " twice", "remove one");
    keep.push_back(kept);
  }
  std::sort(keep.begin(), keep.end());
  return keep;
}

std::size_t size_of(const StudyAxis& axis) {
  if (const auto* range = std::get_if<AxisRange>(&axis.values)) return range->count;
  return std::get<std::vector<AxisValue>>(axis.values).size();
}

/// Reports more points than there may be.
void check_size(const StudyFile& study, Problems& problems) {
  double points = static_cast<double>(study.repeats) *
                  static_cast<double>(std::max<std::size_t>(1, study.draws));
  for (const StudyAxis& axis : study.axes)
    if (!axis.drawn()) points *= static_cast<double>(size_of(axis));
  if (points > static_cast<double>(most_points))
    problems.add({},
                 "makes " + brief(points, 12) + " points, more than " + std::to_string(most_points),
                 "fewer values on an axis; or draw points: [draw] kind = \"sobol\", count = 1000, "
                 "and axes of from and to without count");
}

std::string first_value(const StudyAxis& axis) {
  if (const auto* range = std::get_if<AxisRange>(&axis.values)) return shortest(range->from);
  const auto& values = std::get<std::vector<AxisValue>>(axis.values);
  return values.empty() ? "" : values.front().toml;
}

/// Reports axes that are no key of a scene.
/// @throw InputError  the scene has such keys itself
void check_keys(const SceneTemplate& scene, std::span<const ReadAxis> axes, Problems& problems) {
  std::vector<std::string> values;
  for (const ReadAxis& one : axes) values.push_back(first_value(one.axis));
  std::vector<Setting> settings;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (axes[i].key && !values[i].empty()) settings.push_back({axes[i].axis.key, values[i]});
  for (const ReadAxis& one : axes)
    if (one.key)
      if (const auto objection = scene.objection(one.axis.key, settings))
        one.key->problem("names what the scene does not have: " + objection->message,
                         objection->hint);
  problems.throw_if_any();
  scene.check_keys(settings);
}

std::optional<SceneTemplate> read_base(const Value& value, const std::filesystem::path& folder,
                                       const StudyOptions& options) {
  const auto name = value.text();
  if (!name) return std::nullopt;
  if (name->empty()) {
    value.problem("must name a file", "paths are relative to the study's folder");
  } else if (!References{folder, options.allow_outside}.allow(*name)) {
    value.misfit(
        "must name a file beside the study's file or below its folder",
        "a study from somewhere else could have any file read; if the study is your own: " +
            option(Option::allow_outside));
  } else {
    const std::filesystem::path path = folder / *name;
    return SceneTemplate(input_text(path), path.lexically_normal());
  }
  return std::nullopt;
}

}  // namespace

std::string_view name(AxisScale scale) noexcept { return name_in<scales>(scale); }

std::string_view name(DrawKind kind) noexcept { return name_in<draw_kinds>(kind); }

StudyFile read_study(const std::filesystem::path& path, const StudyOptions& options) {
  const std::string content = input_text(path);
  const std::string_view text = without_byte_order_mark(content);
  Problems problems{path.string(), text, study_file};
  const toml::table toml = parse_document(text, path.string(), problems);
  Table root{toml, "", problems};

  std::optional<SceneTemplate> scene;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (const auto value = root.required("scene", "the scene to begin with: scene = \"pad.toml\""))
    scene = read_base(*value, folder, options);
  StudyFile study{.file = path.filename().string(),
                  .scene = scene ? *std::move(scene) : SceneTemplate("title = \"\"", "none")};
  const bool has_scene = study.scene.file() != "none";
  study.title = read_title(root);
  if (const auto seed = root.value("seed"))
    study.seed = static_cast<std::uint64_t>(seed->integer(0, INT64_MAX).value_or(1));
  if (const auto repeats = root.value("repeats"))
    study.repeats = static_cast<std::size_t>(repeats->integer(1, count_limit).value_or(1));
  if (const auto keep = root.value("keep")) study.keep = read_keep(*keep);
  if (const auto draw = table_of(root.value("draw"))) read_draw(*draw, study);

  std::vector<ReadAxis> axes;
  if (const auto value = root.required("axis", "one [[axis]] for each key, with its values"))
    if (auto tables = value->tables()) {
      if (tables->empty()) value->problem("must name at least one axis", "[[axis]]");
      for (Table& table : *tables) axes.push_back(read_axis(std::move(table), axes));
      for (const ReadAxis& one : axes) study.axes.push_back(one.axis);
      const bool draws = std::any_of(study.axes.begin(), study.axes.end(),
                                     [](const StudyAxis& axis) { return axis.drawn(); });
      if (draws && study.draws == 0)
        value->problem("has a range without count, but nothing says how many values are drawn",
                       "count = 5; or a table [draw] with kind = \"sobol\" and count = 64");
      if (!draws && study.draws > 0)
        value->problem("has nothing to draw for [draw]", "a range without count is drawn");
    }
  root.finish();
  check_size(study, problems);
  if (has_scene && problems.none()) check_keys(study.scene, axes, problems);
  problems.throw_if_any();
  return study;
}

}  // namespace tactile_net
