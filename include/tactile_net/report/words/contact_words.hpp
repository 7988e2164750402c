/// @file
/// The contacts of an answer, one by one, as text for people.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/inverse/contact_patch.hpp"
#include "tactile_net/scene/any_scene.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net::report {

/// What a contact of a scene presses with, and where.
struct TrueContact {
  double force = 0.0;         ///< [N/m], of a skin [N]
  double y = 0.0;             ///< its middle [m]
  std::optional<double> z{};  ///< of a skin [m]
};

/// Those of the scene that press; none where force and middle of one are not stated.
[[nodiscard]] std::vector<TrueContact> true_contacts(const AnyScene& scene);

/// A row a contact, the strongest first, with the numbers of `contact_fields` that are known
/// (lab/answer_fields.hpp). Where there are fewer than two the sum says it all: no row, not even a
/// header.
///
/// @param force  what forces are; absent: of a line per metre, of a skin a point's
/// @param truth  the force and the middle of the contact that is nearest stand beside those found,
///               where there are as many and each is nearest to another one
[[nodiscard]] std::vector<std::vector<std::string>> patch_cells(
    const std::optional<Units>& units, std::span<const ContactPatch> patches,
    std::optional<Dimension> force = {}, std::span<const TrueContact> truth = {});

}  // namespace tactile_net::report
