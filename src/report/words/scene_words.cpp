#include "tactile_net/report/words/scene_words.hpp"

#include <algorithm>
#include <limits>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::report {
namespace {

std::string_view shape_name(Shape shape) {
  switch (shape) {
    case Shape::cylinder:
      return "cylinder";
    case Shape::punch:
      return "punch";
    case Shape::wedge:
      return "wedge";
  }
  return "";
}

std::string contact_in_words(const RigidContact& contact, const Scene& scene) {
  const auto length = [&](double number) { return in_unit(scene, Dimension::length, number); };
  std::string text(shape_name(contact.shape));
  text += " at " + length(contact.center) + ", half width " + length(contact.half_width) +
          ", force " + in_unit(scene, Dimension::force, contact.force);
  if (contact.edge > 0.0) text += ", edge " + length(contact.edge);
  if (contact.friction != 0.0) text += ", friction " + brief(contact.friction);
  return text;
}

std::string contact_in_words(const SampledTractions& contact, const Scene&) {
  return "sampled tractions at the " + std::to_string(contact.normal.size()) + " taxels" +
         (contact.tangential.empty() ? "" : ", normal and tangential");
}

std::string moment_in_words(const auto& scene) {
  const Timing& timing = *scene.time;
  const bool last = scene.frame + 1 == timing.frames;
  return std::string(last ? "the last" : "one") + " of " + std::to_string(timing.frames) +
         " frames: frame " + std::to_string(scene.frame) +
         " at t = " + brief(timing.time(scene.frame)) + (scene.units ? " s" : "");
}

/// Nothing for points.
std::string widths_in_words(const Scene& scene) {
  double least = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (const Site& site : sites(scene.sensor)) {
    least = std::min(least, site.width);
    largest = std::max(largest, site.width);
  }
  if (largest == 0.0) return {};
  const auto length = [&](double value) { return in_unit(scene, Dimension::length, value); };
  const std::string from = least == largest ? "" : least == 0.0 ? "up to " : length(least) + " to ";
  return ", " + from + length(largest) + " wide";
}

}  // namespace

std::string sensor_in_words(const Scene& scene) {
  std::vector<std::string> reads;
  const SensorArray& sensor = scene.sensor;
  for (const Quantity quantity : sensor.reads) reads.emplace_back(name(quantity));
  const auto length = [&](double value) { return in_unit(scene, Dimension::length, value); };
  return std::to_string(sensor.count) + " taxels, " +
         (is_even(sensor) ? "pitch " + length(sensor.pitch)
                          : "from y = " + length(position(sensor, 0)) + " to " +
                                length(position(sensor, sensor.count - 1))) +
         ", reading " + join(reads, ", ") + " at depth " + depths_in_words(scene) +
         widths_in_words(scene);
}

std::string depths_in_words(const Scene& scene, const std::optional<Channel>& channel) {
  const auto length = [&](double value) { return in_unit(scene, Dimension::length, value); };
  if (is_even(scene.sensor)) {
    if (channel) return length(channel->depth);
    std::vector<std::string> depths;
    for (const double depth : scene.sensor.depths) depths.push_back(length(depth));
    return join(depths, " and ");
  }
  double least = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (const Site& site : sites(scene.sensor)) {
    if (channel && site.quantity != channel->quantity) continue;
    least = std::min(least, site.depth);
    largest = std::max(largest, site.depth);
  }
  return least == largest ? length(least) : length(least) + " to " + length(largest);
}

std::string truth_in_words(const Scene& scene) {
  return scene.reconstruct.surface.basis == SurfaceBasis::taxels ? "the truth at the taxels"
                                                                 : "the truth on the surface";
}

std::string surface_in_words(const Scene& scene) {
  if (scene.reconstruct.surface.basis == SurfaceBasis::taxels) return {};
  const Surface grid = surface(scene);
  const double beyond = static_cast<double>(grid.margin + 1) * grid.spacing;
  return "tractions at " + std::to_string(grid.count) + " places " +
         in_unit(scene, Dimension::length, grid.spacing) + " apart, to " +
         in_unit(scene, Dimension::length, beyond) + " beyond the last taxels";
}

std::string time_in_words(const Scene& scene) { return moment_in_words(scene); }
std::string time_in_words(const SkinScene& scene) { return moment_in_words(scene); }

std::string material_in_words(const Scene& scene) {
  std::string body = "half plane";
  if (const auto& layer = scene.material.layer)
    body = "layer " + in_unit(scene, Dimension::length, layer->thickness) + " thick on a " +
           std::string(name(layer->base)) + " base";
  return body + ", E = " + in_unit(scene, Dimension::stress, scene.material.youngs_modulus) +
         ", nu = " + shortest(scene.material.poisson_ratio);
}

std::vector<std::string> contacts_in_words(const Scene& scene) {
  std::vector<std::string> texts;
  for (const Contact& contact : scene.contacts)
    texts.push_back(
        std::visit([&](const auto& shape) { return contact_in_words(shape, scene); }, contact));
  return texts;
}

std::string effects_in_words(const Scene& scene, bool simulated) {
  std::vector<std::string> names;
  for (const auto& [effect, present] : effects(scene))
    if (present == simulated) names.emplace_back(effect);
  return names.empty() ? "none" : join(names, ", ");
}

std::string in_words(const CutOffNote& note) {
  return std::string(note.effect) + ": " + std::to_string(note.cut_off) + " of " +
         std::to_string(note.readings) + " readings are cut off at the range's ends";
}

}  // namespace tactile_net::report
