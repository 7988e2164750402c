#include "tactile_net/sweep/study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "sweep/draws.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/sha256.hpp"
#include "tactile_net/scene/bounded_text.hpp"

namespace tactile_net::sweep {
namespace {

/// The value at a share of the way from one end to the other. Twelve digits: the last ones of a
/// logarithm are not the same on every machine, and a seed follows from every one.
AxisValue value_at(const AxisRange& range, double share) {
  double value = range.scale == AxisScale::log ? range.from * std::pow(range.to / range.from, share)
                                               : range.from + share * (range.to - range.from);
  if (range.whole) value = std::round(value);
  const std::string text = brief(value, 12);
  return {text, text};
}

std::vector<AxisValue> values_in(const AxisRange& range) {
  std::vector<AxisValue> values;
  for (std::size_t k = 0; k < range.count; ++k) {
    const double share =
        k == 0 ? 0.0 : static_cast<double>(k) / static_cast<double>(range.count - 1);
    const AxisValue value = value_at(range, share);
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  return values;
}

std::vector<Axis> axes_of(const StudyFile& file) {
  std::vector<std::string> drawn;
  for (const StudyAxis& axis : file.axes)
    if (axis.drawn()) drawn.push_back(axis.key);
  const auto columns = draws(file.draw, file.seed, drawn, file.draws);

  std::vector<Axis> axes;
  auto column = columns.begin();
  for (const StudyAxis& from : file.axes) {
    Axis axis{.key = from.key, .drawn = from.drawn()};
    if (const auto* range = std::get_if<AxisRange>(&from.values); range == nullptr)
      axis.values = std::get<std::vector<AxisValue>>(from.values);
    else if (axis.drawn)
      for (const double share : *column++) axis.values.push_back(value_at(*range, share));
    else
      axis.values = values_in(*range);
    axes.push_back(std::move(axis));
  }
  if (file.repeats > 1) {
    Axis repeat{.key = std::string(repeat_key)};
    for (std::size_t i = 1; i <= file.repeats; ++i)
      repeat.values.push_back({std::to_string(i), std::to_string(i)});
    axes.push_back(std::move(repeat));
  }
  return axes;
}

/// What a file beside the scene holds. One that cannot be read is every point's own failure.
std::string file_hash(const SceneTemplate& scene, const std::string& name) {
  try {
    return sha256_text(input_text(scene.file().parent_path() / name));
  } catch (const InputError&) {
    return "none";
  }
}

std::string hash_of(const StudyFile& file, const std::vector<Axis>& axes) {
  std::string text =
      "study\n" + sha256_text(file.scene.text()) + '\n' + std::to_string(file.seed) + '\n';
  for (const Axis& axis : axes) {
    text += axis.key + (axis.drawn ? " drawn\n" : "\n");
    for (const AxisValue& value : axis.values) text += ' ' + value.toml + '\n';
  }
  if (file.keep != kept_by_default()) {
    text += "keep";
    for (const Kept kept : file.keep) (text += ' ') += name(kept);
    text += '\n';
  }
  std::vector<std::string> files = file.scene.files();
  for (const Axis& axis : axes)
    if (std::find(file_keys.begin(), file_keys.end(), axis.key) != file_keys.end())
      for (const AxisValue& value : axis.values) files.push_back(value.plain);
  for (const std::string& name : files)
    text += "file " + name + ' ' + file_hash(file.scene, name) + '\n';
  return sha256_text(text);
}

/// @param point  of the study: a unit is the same at all of them, unless it is an axis itself
SweepUnits units_of(const StudyFile& file, const std::vector<Axis>& axes, const Point& point) {
  std::vector<Setting> settings;
  for (std::size_t i = 0; i < file.axes.size(); ++i)
    settings.push_back({axes[i].key, point.values[i].toml});
  auto found = file.scene.units(settings);
  found.settings.resize(axes.size());  // a repeat has none
  const bool vary = std::any_of(axes.begin(), axes.end(),
                                [](const Axis& axis) { return axis.key.starts_with("units."); });
  if (vary) std::fill(found.settings.begin(), found.settings.end(), "");
  return {std::move(found.settings), std::move(found.force)};
}

/// A seed of the scene, and the key that sets it.
struct Seed {
  std::string_view key;
  std::uint64_t* (*in)(Scene& scene);
};

template <auto member>
std::uint64_t* seed_of(Scene& scene) {
  return scene.*member ? &(scene.*member)->seed : nullptr;
}

constexpr std::array seeds = {
    Seed{"noise.seed", seed_of<&Scene::noise>},
    Seed{"taxel_noise.seed", seed_of<&Scene::taxel_noise>},
    Seed{"gain_error.seed", seed_of<&Scene::gain_error>},
    Seed{"offset_error.seed", seed_of<&Scene::offset_error>},
    Seed{"network.tolerance.seed",
         [](Scene& scene) {
           auto& tolerance = scene.network.tolerance;
           return tolerance ? &tolerance->seed : nullptr;
         }},
};

}  // namespace

Study::Study(StudyFile file) : file_(std::move(file)), axes_(axes_of(file_)) {
  for (const Axis& axis : axes_)
    if (!axis.drawn) points_ *= axis.values.size();
  points_ *= std::max<std::size_t>(1, file_.draws);
  units_ = units_of(file_, axes_, point(0));
  hash_ = hash_of(file_, axes_);
}

Point Study::point(std::size_t index) const {
  Point point{.index = index, .values = std::vector<AxisValue>(axes_.size())};
  std::size_t rest = index;
  const auto take = [&](std::size_t axis) {
    const std::size_t count = axes_[axis].values.size();
    point.values[axis] = axes_[axis].values[rest % count];
    rest /= count;
  };
  const std::size_t named = file_.axes.size();
  if (axes_.size() > named) take(named);  // the repeats
  if (file_.draws > 0) {
    for (std::size_t i = 0; i < named; ++i)
      if (axes_[i].drawn) point.values[i] = axes_[i].values[rest % file_.draws];
    rest /= file_.draws;
  }
  for (std::size_t i = named; i-- > 0;)
    if (!axes_[i].drawn) take(i);

  std::vector<std::string> lines;
  for (std::size_t i = 0; i < axes_.size(); ++i)
    lines.push_back(axes_[i].key + " = " + point.values[i].toml + '\n');
  std::sort(lines.begin(), lines.end());
  std::string text = "seed\n" + std::to_string(file_.seed) + '\n';
  for (const std::string& line : lines) text += line;
  point.seed = number_of(text);
  return point;
}

AnyScene Study::scene(const Point& point) const {
  std::vector<Setting> settings;
  for (std::size_t i = 0; i < file_.axes.size(); ++i)
    settings.push_back({axes_[i].key, point.values[i].toml});
  AnyScene scene = file_.scene.with(settings);
  const auto set_seed = [&](std::string_view key, std::uint64_t* seed) {
    const bool is_axis = std::any_of(axes_.begin(), axes_.end(),
                                     [key](const Axis& axis) { return axis.key == key; });
    if (seed != nullptr && !is_axis) *seed = point.seed;
  };
  if (auto* skin = std::get_if<SkinScene>(&scene)) {
    set_seed("noise.seed", skin->noise ? &skin->noise->seed : nullptr);
  } else {
    for (const auto& [key, in] : seeds) set_seed(key, in(std::get<Scene>(scene)));
  }
  return scene;
}

}  // namespace tactile_net::sweep
