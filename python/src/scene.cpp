// A scene: what it says, what its sensor would read, and the matrices behind it.
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <map>

#include "bound_scene.hpp"
#include "rooms.hpp"
#include "shared_scene.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/scene/scene_effects.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net::python {
namespace {

/// Of a line array or of a skin. @throw InputError
std::variant<ScenePointer, SkinPointer> parse(std::string text, std::string file) {
  AnyScene scene = parse_any_scene(text, file);
  if (auto* skin = std::get_if<SkinScene>(&scene))
    return std::make_shared<SharedSkin>(std::move(text), std::move(file),
                                        lab::SkinSceneProblem(std::move(*skin)));
  return std::make_shared<SharedScene>(std::move(text), std::move(file),
                                       lab::SceneProblem(std::get<Scene>(std::move(scene))));
}

/// y, depth, quantity, taxel and channel of every reading, in their order.
std::tuple<Array, Array, std::vector<std::string>, std::vector<std::size_t>,
           std::vector<std::size_t>>
sites_of(const SharedScene& self) {
  std::vector<double> y;
  std::vector<double> depth;
  std::vector<std::string> quantity;
  std::vector<std::size_t> taxel;
  std::vector<std::size_t> channel;
  for (const Site& site : sites(self.scene().sensor)) {
    y.push_back(site.y);
    depth.push_back(site.depth);
    quantity.emplace_back(name(site.quantity));
    taxel.push_back(site.taxel);
    channel.push_back(site.channel);
  }
  return {owned(std::move(y)), owned(std::move(depth)), quantity, taxel, channel};
}

std::vector<std::string> scene_words(const SharedScene& self) {
  const Scene& scene = self.scene();
  std::vector<std::string> all{report::sensor_in_words(scene), report::material_in_words(scene)};
  if (std::string surface = report::surface_in_words(scene); !surface.empty())
    all.push_back(std::move(surface));
  for (std::string& contact : report::contacts_in_words(scene)) all.push_back(std::move(contact));
  if (scene.time) all.push_back(report::time_in_words(scene));
  return all;
}

/// By name, what to multiply and what to divide by for the unit in SI.
std::map<std::string, std::pair<double, double>> units_by_name(Dimension dimension) {
  std::map<std::string, std::pair<double, double>> units;
  for (const Unit& unit : units_of(dimension))
    units.emplace(unit.name, std::pair(unit.multiplier, unit.divisor));
  return units;
}

std::vector<std::string> methods_of(const SharedScene& self) {
  std::vector<std::string> names;
  for (const Method method : self.scene().reconstruct.methods) names.emplace_back(name(method));
  return names;
}

}  // namespace

void bind_scene(nb::module_& module) {
  nb::class_<SharedScene> scene(module, "Scene");
  bind_what_scenes_share(scene);
  scene.def_prop_ro("count", [](const SharedScene& self) { return self.scene().sensor.count; })
      .def_prop_ro("drags", [](const SharedScene& self) { return any_friction(self.scene()); })
      .def_prop_ro("unknowns", [](const SharedScene& self) { return unknowns(self.scene()); })
      .def_prop_ro("methods", &methods_of)
      .def_prop_ro("spacing", [](const SharedScene& self) { return surface(self.scene()).spacing; })
      .def("y", [](const SharedScene& self) { return owned(positions(surface(self.scene()))); })
      .def("taxels", [](const SharedScene& self) { return owned(positions(self.scene().sensor)); })
      .def("sites", &sites_of)
      .def("words", &scene_words);
  module.def("parse", &parse, nb::arg("text"), nb::arg("file"));
  module.def("stress_units", [] { return units_by_name(Dimension::stress); });
  module.def("length_units", [] { return units_by_name(Dimension::length); });
}

}  // namespace tactile_net::python
