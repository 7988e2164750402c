/// @file
/// Contacts as Python's ContactPatch names their values.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/lab/contact_tracker.hpp"

namespace tactile_net::python {

namespace nb = nanobind;

using ContactRow = nb::typed<nb::dict, nb::str, nb::any>;

/// A value and its deviation; None: not known.
[[nodiscard]] inline nb::object pair_of(const std::optional<Uncertain>& number) {
  return number ? nb::cast(nb::make_tuple(number->value, number->deviation)) : nb::none();
}

[[nodiscard]] inline ContactRow contact_row(const ContactPatch& patch,
                                            std::optional<std::size_t> id = {}) {
  const UncertainWrench& wrench = patch.wrench;
  ContactRow row;
  row["id"] = id ? nb::cast(*id) : nb::none();
  row["cells"] = nb::tuple(nb::cast(patch.cells));
  row["normal_force"] = pair_of(wrench.normal);
  row["tangential_y_force"] = pair_of(wrench.tangential_y);
  row["tangential_z_force"] = pair_of(wrench.tangential_z);
  row["centre_y"] = pair_of(wrench.centre_y);
  row["centre_z"] = pair_of(wrench.centre_z);
  row["torsion"] = pair_of(wrench.torsion);
  row["friction"] = pair_of(patch.friction);
  row["slip_margin"] = pair_of(patch.slip_margin);
  row["extent"] = pair_of(patch.extent);
  const auto& ellipse = patch.ellipse;
  row["radius"] = ellipse ? pair_of(ellipse->radius) : nb::none();
  row["second_radius"] = ellipse ? pair_of(ellipse->second_radius) : nb::none();
  row["angle"] = ellipse ? pair_of(ellipse->angle) : nb::none();
  return row;
}

[[nodiscard]] inline std::vector<ContactRow> contact_rows(std::span<const ContactPatch> patches) {
  std::vector<ContactRow> rows;
  for (const ContactPatch& patch : patches) rows.push_back(contact_row(patch));
  return rows;
}

/// Of frame after frame, numbered; a frame without an answer has none.
[[nodiscard]] inline std::vector<std::vector<ContactRow>> followed_rows(
    std::span<const std::vector<ContactPatch>> frames, const std::vector<bool>& answered) {
  lab::ContactTracker tracker;
  std::vector<std::vector<ContactRow>> rows(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!answered[i]) continue;
    const std::vector<lab::FollowedContact> followed = tracker.follow(i, frames[i]);
    for (std::size_t k = 0; k < followed.size(); ++k)
      rows[i].push_back(contact_row(frames[i][k], followed[k].id));
  }
  return rows;
}

}  // namespace tactile_net::python
