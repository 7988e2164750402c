#include "scene/common_sections.hpp"

#include <algorithm>
#include <string>

#include "scene/references.hpp"
#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {
namespace {

constexpr std::int64_t most_frames = 1'000'000;
constexpr std::size_t most_depths = 64;
constexpr Rule poisson_range{"must be from 0 to 0.5",
                             [](double nu) noexcept { return nu >= 0.0 && nu <= 0.5; }};

Layer read_layer(Table table, std::span<const double> depths, const Unit& length) {
  constexpr std::array bases = {Base::bonded, Base::frictionless};
  Layer layer;
  if (const auto thickness =
          table.required("thickness", "from the surface to the rigid base: thickness = 3.0")) {
    if (const auto h = thickness->number(positive, length)) {
      layer.thickness = *h;
      if (std::any_of(depths.begin(), depths.end(), [=](double depth) { return depth > *h; }))
        thickness->misfit("must be at least the sensors' depth",
                          "sensors lie in the layer, at its base at most");
    }
  }
  if (const auto base = table.required(
          "base", "what holds the layer's lower face: base = \"bonded\", or \"frictionless\""))
    if (const auto index = base->one_of("base", names_of(bases))) layer.base = bases[*index];
  table.finish();
  return layer;
}

}  // namespace

std::string read_title(Table& root) {
  const auto title = root.value("title");
  if (!title) return {};
  const std::string text = title->text().value_or("");
  if (text.find_first_of("\r\n") != std::string::npos)
    title->problem("must be one line", "say more in comments");
  return text;
}

Material read_material(Table table, std::span<const double> depths, const Units& units) {
  Material material;
  if (const auto modulus = table.required(
          "youngs_modulus", "the pad's stiffness, in the unit of stress: youngs_modulus = 1.0"))
    material.youngs_modulus =
        modulus->number(positive, units.modulus).value_or(material.youngs_modulus);
  if (const auto ratio = table.required(
          "poisson_ratio", "from 0 to 0.5, which is incompressible: poisson_ratio = 0.45"))
    material.poisson_ratio = ratio->number(poisson_range).value_or(material.poisson_ratio);
  if (const auto layer = table_of(table.value("layer")))
    material.layer = read_layer(*layer, depths, units.length);
  table.finish();
  return material;
}

bool read_quantities(const Value& value, std::span<const Quantity> all,
                     std::vector<Quantity>& reads) {
  const auto list = value.list("quantities, such as " + in_quotes(name(all.front())));
  if (!list) return false;
  if (list->empty()) value.problem("must name at least one quantity", "reads = [\"stress_x\"]");
  bool complete = !list->empty();
  std::vector<std::string_view> names;
  for (const Quantity quantity : all) names.push_back(name(quantity));
  for (const Value& item : *list) {
    const auto index = item.one_of("quantity", names);
    complete = complete && index;
    if (!index) continue;
    if (std::find(reads.begin(), reads.end(), all[*index]) == reads.end())
      reads.push_back(all[*index]);
    else
      item.problem("names " + in_quotes(names[*index]) + " twice", "remove one");
  }
  return complete;
}

Timing read_time(Table table) {
  Timing timing;
  if (const auto rate = table.required("rate", "frames per second: rate = 100.0"))
    timing.rate = rate->number(positive, in_hertz).value_or(timing.rate);
  const auto duration = table.required(
      "duration", "seconds from the first frame to the last: duration = 1.0", {"frames"});
  const auto frames = table.value("frames");
  if (frames && duration) {
    frames->problem("and time.duration exclude each other", "keep one of the two");
  } else if (frames) {
    timing.frames = static_cast<std::size_t>(frames->integer(1, most_frames).value_or(1));
  } else if (duration) {
    const double last =
        duration->number(not_negative, in_seconds).value_or(0.0) * timing.rate + 1e-9;
    if (last < static_cast<double>(most_frames))
      timing.frames = static_cast<std::size_t>(last) + 1;
    else
      duration->misfit("makes more than 1000000 frames at this rate", "a lower rate");
  }
  table.finish();
  return timing;
}

ForwardModel read_forward(Table table, bool even) {
  constexpr std::array models = {ForwardModel::exact, ForwardModel::sampled};
  auto result = ForwardModel::exact;
  if (const auto model = table.value("model"))
    if (const auto index = model->one_of("model", names_of(models))) {
      result = models[*index];
      if (result == ForwardModel::sampled && !even)
        model->problem("sums over " + std::string(equal_taxels), "model = \"exact\"");
    }
  table.finish();
  return result;
}

std::vector<double> read_depths(const std::optional<Value>& one,
                                const std::optional<Value>& several, const Unit& length) {
  std::vector<double> result;
  if (one && several) {
    several->problem("and sensor.depth exclude each other", "keep one of the two");
  } else if (one) {
    if (const auto depth = one->number(below_surface, length)) result = {*depth};
  } else if (several) {
    const auto items = several->list("numbers");
    const auto depths = several->numbers(below_surface, length);
    if (!items || !depths) return {};
    if (depths->size() > most_depths) {
      several->problem("must hold at most 64 depths (got " + std::to_string(depths->size()) + ')');
      return {};
    }
    if (depths->empty()) several->problem("must hold at least one depth", "depths = [1.0, 1.5]");
    for (std::size_t i = 0; i < depths->size(); ++i) {
      const double depth = (*depths)[i];
      if (std::find(result.begin(), result.end(), depth) == result.end())
        result.push_back(depth);
      else
        (*items)[i].misfit("names a depth twice", "remove one");
    }
  }
  return result;
}

std::optional<std::filesystem::path> read_taxel_path(const Value& value,
                                                     const std::filesystem::path& folder) {
  const References references{folder.empty() ? "." : folder};
  const std::string file = value.text().value_or("");
  if (file.empty()) {
    if (value.is_text()) value.problem("must name a file", "taxels = \"palm.csv\"");
    return std::nullopt;
  }
  if (!references.allow(file)) {
    value.misfit("must name a file beside the scene's or below its folder",
                 "a scene from somewhere else could have any file read");
    return std::nullopt;
  }
  return references.folder / file;
}

void read_alpha(const Value& value, const Unit& unit, bool noise_known,
                std::optional<double>& alpha, std::optional<AlphaRule>& rule) {
  if (!value.is_text()) {
    alpha = value.number(positive, unit);
    return;
  }
  const auto index = value.one_of("rule", names_of(alpha_rules));
  if (!index) return;
  rule = alpha_rules[*index];
  if (needs_noise(*rule) && !noise_known)
    value.misfit("needs to know the noise",
                 "under [noise], rms = 1e-4, or one for each quantity; or alpha = \"rgcv\"");
}

bool read_tangential_weight(const Value& value, std::optional<double>& weight) {
  constexpr std::string_view ways[] = {"evidence"};
  const bool estimated = value.is_text();
  weight = estimated ? std::nullopt : value.number(positive);
  return estimated ? value.one_of("way to estimate a weight", ways).has_value()
                   : weight.has_value();
}

}  // namespace tactile_net
