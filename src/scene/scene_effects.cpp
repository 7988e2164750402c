#include "tactile_net/scene/scene_effects.hpp"

#include <algorithm>
#include <array>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/unit_text.hpp"

namespace tactile_net {
namespace {

constexpr double draw = 20.0;  // what a random number costs

template <auto member>
bool present(const Scene& scene) {
  return (scene.*member).has_value();
}

template <auto member>
std::unique_ptr<SensorEffect> make(const Scene& scene) {
  return make_effect(*(scene.*member), scene.sensor);
}

template <int thousandths>
double operations(const Scene&) {
  return thousandths / 1000.0;
}

/// An effect whose data is an optional member of the scene.
template <auto member>
constexpr SceneEffect stage(std::string_view name, std::string (*words)(const Scene&),
                            double (*cost)(const Scene&)) {
  return {name, present<member>, make<member>, words, cost};
}

std::string taxels(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " taxel" : " taxels");
}

/// With its unit, if the scene has units.
std::string in_unit(const Scene& scene, Dimension dimension, double number) {
  return scene.units ? with_unit(number, si_unit(dimension)) : brief(number);
}

std::string seconds(const Scene& scene, double number) {
  return scene.units ? duration(number) : brief(number);
}

/// "1e-4" or "strain_x 1e-4, stress_x 20".
std::string each(const Scene& scene, const PerQuantity<double>& values) {
  if (values.empty()) return "0";
  const auto number = [&](const auto& one) {
    const bool is_strain = traits(one.first).kind == QuantityKind::strain;
    return in_unit(scene, is_strain ? Dimension::none : Dimension::stress, one.second);
  };
  const auto differs = [&](const auto& one) {
    return one.second != values.begin()->second || number(one) != number(*values.begin());
  };
  if (std::none_of(values.begin(), values.end(), differs)) return number(*values.begin());
  std::string text;
  for (const auto& one : values)
    text += (text.empty() ? "" : ", ") + std::string(name(one.first)) + ' ' + number(one);
  return text;
}

double strain_share(const Scene& scene) {
  const auto strains =
      std::count_if(scene.sensor.reads.begin(), scene.sensor.reads.end(), is_strain);
  return static_cast<double>(strains) / static_cast<double>(scene.sensor.reads.size());
}

// The order of the signal path: what loads the pad, the pad itself, the taxels and the wires
// between them, the amplifiers, the converter, and what is broken for good.
const std::array table = {
    SceneEffect{"friction", any_friction, nullptr,
                [](const Scene&) -> std::string {
                  return "contacts drag the surface: a second field of tractions";
                },
                [](const Scene& scene) { return 2.0 * static_cast<double>(scene.sensor.count); },
                "one field of tractions, no tangential kernel"},
    SceneEffect{
        "layer", [](const Scene& scene) { return scene.material.layer.has_value(); }, nullptr,
        [](const Scene& scene) {
          return "pad " + in_unit(scene, Dimension::length, scene.material.layer->thickness) +
                 " thick on a " + std::string(name(scene.material.layer->base)) +
                 " base: its kernels are integrals";
        },
        operations<0>, "half plane: kernels are closed formulas"},
    stage<&Scene::viscoelasticity>(
        "viscoelasticity",
        [](const Scene& scene) {
          const std::size_t terms = scene.viscoelasticity->terms.size();
          return strain_share(scene) == 0.0
                     ? std::string("stresses under given loads do not relax: no stage")
                     : "strains creep, " + std::to_string(terms) + " Prony terms";
        },
        [](const Scene& scene) {
          return strain_share(scene) * 7.0 *
                 static_cast<double>(scene.viscoelasticity->terms.size());
        }),
    stage<&Scene::hysteresis>(
        "hysteresis",
        [](const Scene& scene) {
          return std::to_string(scene.hysteresis->weights.size()) + " play operators";
        },
        [](const Scene& scene) {
          return 7.0 * static_cast<double>(scene.hysteresis->weights.size());
        }),
    stage<&Scene::crosstalk>(
        "crosstalk",
        [](const Scene& scene) {
          return "fraction " + brief(scene.crosstalk->fraction) + " to each neighbour";
        },
        operations<4000>),
    stage<&Scene::gain_error>(
        "gain_error",
        [](const Scene& scene) {
          return scene.gain_error->values.empty()
                     ? "drawn once, rms " + brief(scene.gain_error->rms)
                     : std::string("as listed");
        },
        operations<1000>),
    stage<&Scene::offset_error>(
        "offset_error",
        [](const Scene& scene) {
          return scene.offset_error->values.empty()
                     ? "drawn once, rms " + each(scene, scene.offset_error->rms)
                     : std::string("as listed");
        },
        operations<1000>),
    stage<&Scene::temperature>(
        "temperature",
        [](const Scene& scene) {
          return "gain " + brief(scene.temperature->gain) + " and offset " +
                 each(scene, scene.temperature->offset) + " per kelvin";
        },
        operations<4000>),
    stage<&Scene::low_pass>(
        "low_pass",
        [](const Scene& scene) {
          return "time constant " + seconds(scene, scene.low_pass->time_constant);
        },
        operations<5000>),
    stage<&Scene::sampling>(
        "sampling",
        [](const Scene& scene) { return "mean over " + seconds(scene, scene.sampling->aperture); },
        operations<5000>),
    stage<&Scene::noise>(
        "noise", [](const Scene& scene) { return "rms " + each(scene, scene.noise->rms); },
        [](const Scene&) { return draw + 2.0; }),
    stage<&Scene::taxel_noise>(
        "taxel_noise", [](const Scene&) { return std::string("an rms for each taxel"); },
        [](const Scene&) { return draw + 2.0; }),
    stage<&Scene::saturation>(
        "saturation", [](const Scene&) { return std::string("readings end at their range"); },
        operations<2000>),
    stage<&Scene::quantization>(
        "quantization",
        [](const Scene& scene) { return std::to_string(scene.quantization->bits) + " bits"; },
        operations<9000>),
    stage<&Scene::stuck_taxels>(
        "stuck_taxels",
        [](const Scene& scene) { return taxels(scene.stuck_taxels->indices.size()); },
        operations<0>),
    SceneEffect{
        "dead_taxels", [](const Scene& scene) { return !scene.dead_taxels.empty(); },
        [](const Scene& scene) { return make_effect(DeadTaxels{scene.dead_taxels}, scene.sensor); },
        [](const Scene& scene) { return taxels(scene.dead_taxels.size()) + " at zero"; },
        operations<0>},
};

}  // namespace

std::span<const SceneEffect> scene_effects() { return table; }

}  // namespace tactile_net
