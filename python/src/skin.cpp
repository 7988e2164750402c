// A scene of a skin: what it says, what its taxels would read, and the matrices behind it.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <tuple>

#include "bound_scene.hpp"
#include "rooms.hpp"
#include "shared_scene.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net::python {
namespace {

/// y, z, depth, quantity, taxel and channel of every reading, in their order.
std::tuple<Array, Array, Array, std::vector<std::string>, std::vector<std::size_t>,
           std::vector<std::size_t>>
skin_sites_of(const SharedSkin& self) {
  std::vector<double> y;
  std::vector<double> z;
  std::vector<double> depth;
  std::vector<std::string> quantity;
  std::vector<std::size_t> taxel;
  std::vector<std::size_t> channel;
  for (const Site& site : sites(self.scene().sensor)) {
    y.push_back(site.y);
    z.push_back(site.z);
    depth.push_back(site.depth);
    quantity.emplace_back(name(site.quantity));
    taxel.push_back(site.taxel);
    channel.push_back(site.channel);
  }
  return {
      owned(std::move(y)), owned(std::move(z)), owned(std::move(depth)), quantity, taxel, channel};
}

std::vector<std::string> taxel_names(const SharedSkin& self) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < taxel_count(self.scene().sensor); ++i)
    names.push_back(taxel_name(self.scene().sensor, i));
  return names;
}

/// y of the cells' rows, z of their columns, and how far apart these are.
std::tuple<Array, Array, std::pair<double, double>> cell_places(const SharedSkin& self) {
  const SurfaceGrid cells = grid(self.scene());
  std::vector<double> y;
  std::vector<double> z;
  for (std::size_t row = 0; row < cells.rows; ++row) y.push_back(cells.y(row));
  for (std::size_t column = 0; column < cells.columns; ++column) z.push_back(cells.z(column));
  return {owned(std::move(y)), owned(std::move(z)), {cells.spacing_y, cells.spacing_z}};
}

/// Of a curved skin's cells middles, frames, areas, and what 1 Pa along each frame's axis amounts
/// to: (N, 3), (N, 3, 3), (N,), (N, 3, 3); of a flat one nothing.
std::optional<std::tuple<Array, Array, Array, Array>> surface_of(const SharedSkin& self) {
  const SkinScene& scene = self.scene();
  if (!scene.sensor.curved) return std::nullopt;
  const std::vector<SurfaceCell> cells = cells_of(scene.sensor, grid(scene));
  std::vector<double> middles;
  std::vector<double> frames;
  std::vector<double> areas;
  std::vector<double> forces;
  for (const SurfaceCell& cell : cells) {
    middles.insert(middles.end(), cell.middle.point.begin(), cell.middle.point.end());
    for (std::size_t u = 0; u < 3; ++u) {
      frames.insert(frames.end(), cell.middle.frame[u].begin(), cell.middle.frame[u].end());
      forces.insert(forces.end(), cell.force[u].begin(), cell.force[u].end());
    }
    areas.push_back(cell.area);
  }
  const std::size_t count = cells.size();
  return std::tuple{owned(std::move(middles), {count, 3}), owned(std::move(frames), {count, 3, 3}),
                    owned(std::move(areas)), owned(std::move(forces), {count, 3, 3})};
}

/// Of a curved skin where each taxel's place on the surface is, and the outward normal: (N, 3)
/// each.
std::optional<std::tuple<Array, Array>> places_of(const SharedSkin& self) {
  const SkinArray& skin = self.scene().sensor;
  if (!skin.curved) return std::nullopt;
  std::vector<double> points;
  std::vector<double> normals;
  for (const SurfacePlace& place : skin.curved->above) {
    points.insert(points.end(), place.point.begin(), place.point.end());
    for (const double x : place.frame[0]) normals.push_back(-x);
  }
  const std::size_t count = skin.curved->above.size();
  return std::tuple{owned(std::move(points), {count, 3}), owned(std::move(normals), {count, 3})};
}

std::vector<std::string> skin_words(const SharedSkin& self) {
  const SkinScene& scene = self.scene();
  std::vector<std::string> all{report::sensor_in_words(scene), report::material_in_words(scene)};
  for (std::string& contact : report::contacts_in_words(scene)) all.push_back(std::move(contact));
  all.push_back(report::grid_in_words(scene, grid(scene)));
  return all;
}

}  // namespace

void bind_skin(nb::module_& module) {
  nb::class_<SharedSkin> scene(module, "Skin");
  bind_what_scenes_share(scene);
  scene.def_prop_ro("rows", [](const SharedSkin& self) { return self.scene().sensor.rows; })
      .def_prop_ro("columns", [](const SharedSkin& self) { return self.scene().sensor.columns; })
      .def_prop_ro("unknowns", [](const SharedSkin& self) { return components(self.scene()); })
      .def_prop_ro("taxel_names", &taxel_names)
      .def("cells", &cell_places)
      .def("surface", &surface_of)
      .def("places", &places_of)
      .def("sites", &skin_sites_of)
      .def("words", &skin_words);
}

}  // namespace tactile_net::python
