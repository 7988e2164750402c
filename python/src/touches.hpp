/// @file
/// The contacts of MuJoCo's memory as points on a pad.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "tactile_net/lab/rigid_contacts.hpp"

namespace tactile_net::python {

namespace nb = nanobind;

/// The simulator's own memory, whatever its strides.
template <class Number>
using Table = nb::ndarray<const Number, nb::ndim<2>, nb::device::cpu>;
using Values = nb::ndarray<const double, nb::ndim<1>, nb::device::cpu>;
using Room = nb::ndarray<double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

/// Of one moment, for as long as it is looked at.
struct SimulatorContacts {
  const Table<std::int32_t>& geoms;  ///< of each contact its two
  const Table<double>& positions;
  const Table<double>& frames;  ///< 3 x 3 each, whose first row points from the first to the second
  const Table<double>& forces;  ///< in that frame, on the second
  const Values& origin;         ///< of the pad's face
  const Values& axes;
};

/// What Python warns of.
enum Note : unsigned { pulled = 1, skipped_flex = 2, short_contact = 4 };

class Touches {
 public:
  /// @param own        of each geom of the simulator's model whether it is the pad's
  /// @param curvature  of each geom [1/m]; 0: flat, or unknown
  Touches(std::vector<bool> own, std::vector<double> curvature)
      : own_(std::move(own)), curvature_(std::move(curvature)) {}

  /// @return notes
  unsigned gather(const SimulatorContacts& contacts) {
    const lab::PadFace face{.origin = first<3>(contacts.origin), .axes = first<9>(contacts.axes)};
    unsigned notes = 0;
    points_.clear();
    for (std::size_t i = 0; i < contacts.geoms.shape(0); ++i) {
      const std::int32_t one = at(contacts.geoms, i, 0);
      const std::int32_t other = at(contacts.geoms, i, 1);
      const bool is_second = is_own(other);
      if (is_second == is_own(one)) continue;
      const std::int32_t object = is_second ? one : other;
      if (object < 0) {
        notes |= skipped_flex;
        continue;
      }
      add(contacts, i, is_second, object, is_second ? other : one, face, notes);
    }
    return notes;
  }

  [[nodiscard]] const std::vector<lab::ContactPoint>& points() const noexcept { return points_; }

 private:
  template <std::size_t count>
  static std::array<double, count> first(const Values& values) {
    std::array<double, count> result{};
    for (std::size_t i = 0; i < count; ++i)
      result[i] = values.data()[static_cast<std::int64_t>(i) * values.stride(0)];
    return result;
  }

  template <class Number>
  static Number at(const Table<Number>& table, std::size_t row, std::size_t column) {
    return table.data()[static_cast<std::int64_t>(row) * table.stride(0) +
                        static_cast<std::int64_t>(column) * table.stride(1)];
  }

  [[nodiscard]] bool is_own(std::int32_t geom) const {
    return geom >= 0 && own_[static_cast<std::size_t>(geom)];
  }

  void add(const SimulatorContacts& contacts, std::size_t i, bool pad_is_second,
           std::int32_t object, std::int32_t own, const lab::PadFace& face, unsigned& notes) {
    lab::PairContact contact;
    for (std::size_t k = 0; k < 3; ++k) {
      contact.position[k] = at(contacts.positions, i, k);
      contact.force[k] = at(contacts.forces, i, k);
    }
    for (std::size_t k = 0; k < 9; ++k) contact.frame[k] = at(contacts.frames, i, k);
    auto [facing, point] = face.touched_by(contact, pad_is_second);
    if (facing < -lab::least_facing) notes |= pulled;
    if (facing < lab::least_facing) return;
    point.object = static_cast<std::size_t>(object);
    point.curvature =
        curvature_[static_cast<std::size_t>(object)] + curvature_[static_cast<std::size_t>(own)];
    points_.push_back(point);
  }

  std::vector<bool> own_;
  std::vector<double> curvature_;
  std::vector<lab::ContactPoint> points_{};
};

}  // namespace tactile_net::python
