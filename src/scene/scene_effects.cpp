#include "tactile_net/scene/scene_effects.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/unit_text.hpp"

namespace tactile_net {
namespace {

constexpr double draw = 20.0;  // what a random number costs

template <auto member>
bool present(const SensedScene& scene) {
  return (scene.effects->*member).has_value();
}

template <auto member>
std::unique_ptr<SensorEffect> make(const SensorEffects& effects, const SignalLayout& sensor) {
  return effects.*member ? make_effect(*(effects.*member), sensor) : nullptr;
}

template <int thousandths>
double operations(const SensedScene&) {
  return thousandths / 1000.0;
}

/// An effect whose data is an optional member of the scene.
template <auto member>
constexpr SceneEffect stage(std::string_view name, std::string (*words)(const SensedScene&),
                            double (*cost)(const SensedScene&)) {
  return {name, present<member>, make<member>, words, cost};
}

std::string taxels(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " taxel" : " taxels");
}

/// With its unit, if the scene has units.
std::string in_unit(const SensedScene& scene, Dimension dimension, double number) {
  return *scene.units ? with_unit(number, si_unit(dimension)) : brief(number);
}

std::string seconds(const SensedScene& scene, double number) {
  return *scene.units ? duration(number) : brief(number);
}

/// "1e-4" or "strain_x 1e-4, stress_x 20".
std::string each(const SensedScene& scene, const PerQuantity<double>& values) {
  if (values.empty()) return "0";
  const auto number = [&](const auto& one) {
    return in_unit(scene, dimension_of(traits(one.first).kind), one.second);
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

/// Of the quantities read, how many of a whole creep.
double creeping_share(const SensedScene& scene) {
  const auto creeping = std::count_if(scene.reads.begin(), scene.reads.end(), creeps);
  return static_cast<double>(creeping) / static_cast<double>(scene.reads.size());
}

// The order of the signal path: what loads the pad, the pad itself, the taxels and the wires
// between them, the amplifiers, the converter, and what is broken for good.
const std::array effects_in_order = {
    SceneEffect{"friction", [](const SensedScene& scene) { return scene.drags; }, nullptr,
                [](const SensedScene&) -> std::string {
                  return "contacts drag the surface: a second field of tractions";
                },
                [](const SensedScene& scene) { return 2.0 * static_cast<double>(scene.taxels); },
                "one field of tractions, no tangential kernel"},
    SceneEffect{"layer", [](const SensedScene& scene) { return scene.material->layer.has_value(); },
                nullptr,
                [](const SensedScene& scene) {
                  return "pad " +
                         in_unit(scene, Dimension::length, scene.material->layer->thickness) +
                         " thick on a " + std::string(name(scene.material->layer->base)) +
                         " base: its kernels are integrals";
                },
                operations<0>, "half plane: kernels are closed formulas"},
    stage<&SensorEffects::viscoelasticity>(
        "viscoelasticity",
        [](const SensedScene& scene) {
          const std::size_t terms = scene.effects->viscoelasticity->terms.size();
          return creeping_share(scene) == 0.0
                     ? std::string("stresses under given loads do not relax: no stage")
                     : "strains creep, " + std::to_string(terms) + " Prony terms";
        },
        [](const SensedScene& scene) {
          return creeping_share(scene) * 7.0 *
                 static_cast<double>(scene.effects->viscoelasticity->terms.size());
        }),
    stage<&SensorEffects::hysteresis>(
        "hysteresis",
        [](const SensedScene& scene) {
          return std::to_string(scene.effects->hysteresis->weights.size()) + " play operators";
        },
        [](const SensedScene& scene) {
          return 7.0 * static_cast<double>(scene.effects->hysteresis->weights.size());
        }),
    stage<&SensorEffects::crosstalk>(
        "crosstalk",
        [](const SensedScene& scene) {
          return "fraction " + brief(scene.effects->crosstalk->fraction) + " to each neighbour";
        },
        operations<4000>),
    stage<&SensorEffects::gain_error>(
        "gain_error",
        [](const SensedScene& scene) {
          return scene.effects->gain_error->values.empty()
                     ? "drawn once, rms " + brief(scene.effects->gain_error->rms)
                     : std::string("as listed");
        },
        operations<1000>),
    stage<&SensorEffects::offset_error>(
        "offset_error",
        [](const SensedScene& scene) {
          return scene.effects->offset_error->values.empty()
                     ? "drawn once, rms " + each(scene, scene.effects->offset_error->rms)
                     : std::string("as listed");
        },
        operations<1000>),
    stage<&SensorEffects::temperature>(
        "temperature",
        [](const SensedScene& scene) {
          return "gain " + brief(scene.effects->temperature->gain) + " and offset " +
                 each(scene, scene.effects->temperature->offset) + " per kelvin";
        },
        operations<4000>),
    stage<&SensorEffects::low_pass>(
        "low_pass",
        [](const SensedScene& scene) {
          return "time constant " + seconds(scene, scene.effects->low_pass->time_constant);
        },
        operations<5000>),
    stage<&SensorEffects::sampling>(
        "sampling",
        [](const SensedScene& scene) {
          return "mean over " + seconds(scene, scene.effects->sampling->aperture);
        },
        operations<5000>),
    stage<&SensorEffects::noise>(
        "noise",
        [](const SensedScene& scene) { return "rms " + each(scene, scene.effects->noise->rms); },
        [](const SensedScene&) { return draw + 2.0; }),
    stage<&SensorEffects::taxel_noise>(
        "taxel_noise", [](const SensedScene&) { return std::string("an rms for each taxel"); },
        [](const SensedScene&) { return draw + 2.0; }),
    stage<&SensorEffects::saturation>(
        "saturation", [](const SensedScene&) { return std::string("readings end at their range"); },
        operations<2000>),
    stage<&SensorEffects::quantization>(
        "quantization",
        [](const SensedScene& scene) {
          return std::to_string(scene.effects->quantization->bits) + " bits";
        },
        operations<9000>),
    stage<&SensorEffects::stuck_taxels>(
        "stuck_taxels",
        [](const SensedScene& scene) {
          return taxels(scene.effects->stuck_taxels->indices.size());
        },
        operations<0>),
    SceneEffect{
        "dead_taxels", [](const SensedScene& scene) { return !scene.effects->dead_taxels.empty(); },
        [](const SensorEffects& effects, const SignalLayout& sensor) {
          return effects.dead_taxels.empty() ? nullptr
                                             : make_effect(DeadTaxels{effects.dead_taxels}, sensor);
        },
        [](const SensedScene& scene) {
          return taxels(scene.effects->dead_taxels.size()) + " at zero";
        },
        operations<0>},
};

}  // namespace

std::span<const SceneEffect> scene_effects() { return effects_in_order; }

}  // namespace tactile_net
