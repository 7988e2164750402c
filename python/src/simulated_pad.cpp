// The taxels of a pad that a rigid-body simulator moves: a line's and a skin's.
#include "tactile_net/lab/simulated_pad.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "rooms.hpp"
#include "shared_scene.hpp"
#include "tactile_net/lab/simulated_skin_pad.hpp"
#include "tactile_net/lab/skin_contacts.hpp"
#include "touches.hpp"

namespace tactile_net::python {
namespace {

/// A sensor for each of the simulator's states.
template <class Sensor, class Model>
class Sensors {
 public:
  explicit Sensors(std::shared_ptr<const Model> model) : model_(std::move(model)) {}
  Sensors(const Sensors&) = delete;  // of a map of what cannot be copied nanobind would not know
  Sensors& operator=(const Sensors&) = delete;

  [[nodiscard]] const Model& model() const noexcept { return *model_; }
  [[nodiscard]] Sensor& of(std::uintptr_t state) {
    return sensors_.try_emplace(state, model_).first->second;
  }
  void forget(std::uintptr_t state) { sensors_.erase(state); }

 private:
  std::shared_ptr<const Model> model_;
  std::map<std::uintptr_t, Sensor> sensors_{};
};

class RigidPad {
 public:
  RigidPad(const ScenePointer& shared, std::vector<bool> own, std::vector<double> curvature,
           double breadth, std::optional<double> edge)
      : sensors_(std::make_shared<const lab::PadModel>(shared->scene())),
        widths_(lab::contact_widths(shared->scene(), breadth, edge)),
        touches_(std::move(own), std::move(curvature)) {
    for (const Site& site : sites(shared->scene().sensor)) depth_ = std::max(depth_, site.depth);
  }

  [[nodiscard]] double edge() const noexcept { return widths_.edge; }

  unsigned read(std::uintptr_t state, double time, const SimulatorContacts& contacts,
                const Room& readings, std::size_t offset) {
    unsigned notes = touches_.gather(contacts);
    const Scene& scene = sensors_.model().scene;
    const lab::ContactPatches found =
        lab::contact_patches(touches_.points(), scene.material, widths_);
    if (found.shortest && *found.shortest < 3.0 * depth_) notes |= short_contact;
    sensors_.of(state).read(time, found.loads,
                            {readings.data() + offset, reading_count(scene.sensor)});
    return notes;
  }

  void forget(std::uintptr_t state) { sensors_.forget(state); }

 private:
  Sensors<lab::SimulatedPad, lab::PadModel> sensors_;
  lab::ContactWidths widths_;
  Touches touches_;
  double depth_ = 0.0;  // the greatest
};

class RigidSkinPad {
 public:
  RigidSkinPad(const SkinPointer& shared, std::vector<bool> own, std::vector<double> curvature,
               std::optional<double> edge)
      : sensors_(std::make_shared<const lab::SkinPadModel>(shared->scene())),
        edge_(edge.value_or(0.5 * least_depth(shared->scene().sensor))),
        touches_(std::move(own), std::move(curvature)),
        recorded_(reading_count(shared->scene().sensor)) {
    (void)lab::skin_patches({}, shared->scene().material, edge_,
                            sensors_.model().grid());  // judges
  }

  [[nodiscard]] double edge() const noexcept { return edge_; }

  /// Readings of even skins go where (rows, columns, channels) has them.
  unsigned read(std::uintptr_t state, double time, const SimulatorContacts& contacts,
                const Room& readings, std::size_t offset) {
    const unsigned notes = touches_.gather(contacts);
    const SkinScene& scene = sensors_.model().scene();
    sensors_.of(state).read(
        time, lab::skin_patches(touches_.points(), scene.material, edge_, sensors_.model().grid()),
        recorded_);
    double* to = readings.data() + offset;
    if (!is_even(scene.sensor)) {
      std::copy(recorded_.begin(), recorded_.end(), to);
      return notes;
    }
    const std::size_t taxels = taxel_count(scene.sensor);
    const std::size_t all = recorded_.size() / taxels;
    for (std::size_t i = 0; i < recorded_.size(); ++i)
      to[i % taxels * all + i / taxels] = recorded_[i];
    return notes;
  }

  void forget(std::uintptr_t state) { sensors_.forget(state); }

 private:
  Sensors<lab::SimulatedSkinPad, lab::SkinPadModel> sensors_;
  double edge_;
  Touches touches_;
  std::vector<double> recorded_;  // channel after channel
};

template <class Pad>
unsigned read_taxels(Pad& self, std::uintptr_t state, double time, const Table<std::int32_t>& geoms,
                     const Table<double>& positions, const Table<double>& frames,
                     const Table<double>& forces, const Values& origin, const Values& axes,
                     const Room& readings, std::size_t offset) {
  return self.read(state, time, {geoms, positions, frames, forces, origin, axes}, readings, offset);
}

template <class Pad>
void bind_reading(nb::class_<Pad>& pad) {
  pad.def_prop_ro("edge", &Pad::edge)
      .def("read", &read_taxels<Pad>, nb::arg("state"), nb::arg("time"), nb::arg("geoms"),
           nb::arg("positions"), nb::arg("frames"), nb::arg("forces"), nb::arg("origin"),
           nb::arg("axes"), nb::arg("readings"), nb::arg("offset"))
      .def("forget", &Pad::forget, nb::arg("state"));
}

}  // namespace

void bind_simulated_pad(nb::module_& module) {
  nb::class_<RigidPad> line(module, "RigidPad");
  line.def(nb::init<const ScenePointer&, std::vector<bool>, std::vector<double>, double,
                    std::optional<double>>(),
           nb::arg("scene"), nb::arg("own"), nb::arg("curvature"), nb::arg("breadth"),
           nb::arg("edge").none());
  bind_reading(line);
  nb::class_<RigidSkinPad> skin(module, "RigidSkinPad");
  skin.def(
      nb::init<const SkinPointer&, std::vector<bool>, std::vector<double>, std::optional<double>>(),
      nb::arg("scene"), nb::arg("own"), nb::arg("curvature"), nb::arg("edge").none());
  bind_reading(skin);
}

}  // namespace tactile_net::python
