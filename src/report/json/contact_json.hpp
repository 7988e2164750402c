/// @file
/// The contacts of an answer, one by one, and what becomes of them, as parts of documents. Private.
#pragma once

#include <span>
#include <vector>

#include "report/json/values.hpp"
#include "tactile_net/lab/contact_tracker.hpp"

namespace tactile_net::report {

/// Of a line and of a skin.
[[nodiscard]] Json line_contacts_json(std::span<const ContactPatch> patches);
[[nodiscard]] Json skin_contacts_json(std::span<const ContactPatch> patches);

/// Of a recording's frame: each with its number, without its cells.
[[nodiscard]] Json line_contacts_json(std::span<const lab::FollowedContact> contacts);
[[nodiscard]] Json skin_contacts_json(std::span<const lab::FollowedContact> contacts);

[[nodiscard]] Json events_json(std::span<const lab::ContactEvent> events);

/// A value for each of the surface's two directions.
[[nodiscard]] Json pair_json(const std::optional<Uncertain>& a, const std::optional<Uncertain>& b);
/// Force, drag, centre and torsion of a skin's wrench.
[[nodiscard]] Json found_json(const UncertainWrench& wrench);
[[nodiscard]] Json ellipse_json(const std::optional<ContactEllipse>& ellipse);

}  // namespace tactile_net::report
