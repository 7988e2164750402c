// The taxels of a pad that a rigid-body simulator moves.
#include "tactile_net/lab/simulated_pad.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
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
#include "tactile_net/lab/rigid_contacts.hpp"

namespace tactile_net::python {
namespace {

/// The simulator's own memory, whatever its strides.
template <class Number>
using Table = nb::ndarray<const Number, nb::ndim<2>, nb::device::cpu>;
using Values = nb::ndarray<const double, nb::ndim<1>, nb::device::cpu>;
using Room = nb::ndarray<double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

template <std::size_t count>
std::array<double, count> first(const Values& values) {
  std::array<double, count> result{};
  for (std::size_t i = 0; i < count; ++i)
    result[i] = values.data()[static_cast<std::int64_t>(i) * values.stride(0)];
  return result;
}

double at(const Table<double>& table, std::size_t row, std::size_t column) {
  return table.data()[static_cast<std::int64_t>(row) * table.stride(0) +
                      static_cast<std::int64_t>(column) * table.stride(1)];
}

/// What Python warns of.
enum Note : unsigned { pulled = 1, skipped_flex = 2, short_contact = 4 };

class RigidPad {
 public:
  /// @param own        of each geom of the simulator's model whether it is the pad's
  /// @param curvature  of each geom [1/m]; 0: flat, or unknown
  RigidPad(const ScenePointer& shared, std::vector<bool> own, std::vector<double> curvature,
           double breadth, std::optional<double> edge)
      : model_(std::make_shared<const lab::PadModel>(shared->scene())),
        widths_(lab::contact_widths(shared->scene(), breadth, edge)),
        own_(std::move(own)),
        curvature_(std::move(curvature)) {
    for (const Site& site : sites(shared->scene().sensor)) depth_ = std::max(depth_, site.depth);
  }

  RigidPad(const RigidPad&) = delete;  // of a map of what cannot be copied nanobind would not know
  RigidPad& operator=(const RigidPad&) = delete;

  [[nodiscard]] double edge() const noexcept { return widths_.edge; }

  /// @param state     which of the simulator's states it is: each has a sensor of its own
  /// @param geoms     of each contact its two
  /// @param frames    of each the 3 x 3 matrix whose first row points from the first to the second
  /// @param forces    of each in that frame, on the second
  /// @param readings  where they go, from `offset` on
  /// @return          notes
  unsigned read(std::uintptr_t state, double time, const Table<std::int32_t>& geoms,
                const Table<double>& positions, const Table<double>& frames,
                const Table<double>& forces, const Values& origin, const Values& axes,
                const Room& readings, std::size_t offset) {
    const lab::PadFace face{.origin = first<3>(origin), .axes = first<9>(axes)};
    unsigned notes = 0;
    points_.clear();
    for (std::size_t i = 0; i < geoms.shape(0); ++i) {
      const std::int32_t* pair = geoms.data() + static_cast<std::int64_t>(i) * geoms.stride(0);
      const std::int32_t one = pair[0];
      const std::int32_t other = pair[geoms.stride(1)];
      const bool is_second = is_own(other);
      if (is_second == is_own(one)) continue;
      const std::int32_t object = is_second ? one : other;
      if (object < 0) {
        notes |= skipped_flex;
        continue;
      }
      add(i, is_second, object, is_second ? other : one, face, positions, frames, forces, notes);
    }
    const lab::ContactPatches found =
        lab::contact_patches(points_, model_->scene.material, widths_);
    if (found.shortest && *found.shortest < 3.0 * depth_) notes |= short_contact;
    const auto [sensor, is_new] = sensors_.try_emplace(state, model_);
    sensor->second.read(time, found.loads,
                        {readings.data() + offset, reading_count(model_->scene.sensor)});
    return notes;
  }

  /// The state is no more.
  void forget(std::uintptr_t state) { sensors_.erase(state); }

 private:
  [[nodiscard]] bool is_own(std::int32_t geom) const {
    return geom >= 0 && own_[static_cast<std::size_t>(geom)];
  }

  void add(std::size_t i, bool pad_is_second, std::int32_t object, std::int32_t own,
           const lab::PadFace& face, const Table<double>& positions, const Table<double>& frames,
           const Table<double>& forces, unsigned& notes) {
    lab::PairContact contact;
    for (std::size_t k = 0; k < 3; ++k) {
      contact.position[k] = at(positions, i, k);
      contact.force[k] = at(forces, i, k);
    }
    for (std::size_t k = 0; k < 9; ++k) contact.frame[k] = at(frames, i, k);
    auto [facing, point] = face.touched_by(contact, pad_is_second);
    if (facing < -lab::least_facing) notes |= pulled;
    if (facing < lab::least_facing) return;
    point.object = static_cast<std::size_t>(object);
    point.curvature =
        curvature_[static_cast<std::size_t>(object)] + curvature_[static_cast<std::size_t>(own)];
    points_.push_back(point);
  }

  std::shared_ptr<const lab::PadModel> model_;
  lab::ContactWidths widths_;
  std::vector<bool> own_;
  std::vector<double> curvature_;
  double depth_ = 0.0;  // the greatest
  std::map<std::uintptr_t, lab::SimulatedPad> sensors_;
  std::vector<lab::ContactPoint> points_;
};

}  // namespace

void bind_simulated_pad(nb::module_& module) {
  nb::class_<RigidPad>(module, "RigidPad")
      .def(nb::init<const ScenePointer&, std::vector<bool>, std::vector<double>, double,
                    std::optional<double>>(),
           nb::arg("scene"), nb::arg("own"), nb::arg("curvature"), nb::arg("breadth"),
           nb::arg("edge").none())
      .def_prop_ro("edge", &RigidPad::edge)
      .def("read", &RigidPad::read, nb::arg("state"), nb::arg("time"), nb::arg("geoms"),
           nb::arg("positions"), nb::arg("frames"), nb::arg("forces"), nb::arg("origin"),
           nb::arg("axes"), nb::arg("readings"), nb::arg("offset"))
      .def("forget", &RigidPad::forget, nb::arg("state"));
}

}  // namespace tactile_net::python
