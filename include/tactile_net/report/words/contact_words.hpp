/// @file
/// The contacts of an answer, one by one, as text for people.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/inverse/contact_patch.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net::report {

/// A row a contact, the strongest first, with the numbers of `contact_fields` that are known
/// (lab/answer_fields.hpp). Where there are fewer than two the sum says it all: no row, not even a
/// header.
///
/// @param force  what forces are; absent: of a line per metre, of a skin a point's
[[nodiscard]] std::vector<std::vector<std::string>> patch_cells(
    const std::optional<Units>& units, std::span<const ContactPatch> patches,
    std::optional<Dimension> force = {});

}  // namespace tactile_net::report
