/// @file
/// The contacts of an answer, one by one, and what becomes of them, as parts of documents. Private.
#pragma once

#include <span>
#include <vector>

#include "report/json/described.hpp"
#include "tactile_net/lab/answer_fields.hpp"
#include "tactile_net/lab/contact_tracker.hpp"

namespace tactile_net::report {

/// Of a frame of a line's and of a skin's recording: each with its number, without its cells.
[[nodiscard]] Json line_contacts_json(std::span<const lab::FollowedContact> contacts);
[[nodiscard]] Json skin_contacts_json(std::span<const lab::FollowedContact> contacts);

/// The same lists as fields of a result.
struct LineContacts {
  std::vector<ContactPatch> patches{};
};
struct SkinContacts {
  std::vector<ContactPatch> patches{};
};

template <>
struct JsonForm<LineContacts> {
  static Json json(const LineContacts& contacts) { return as_json(contacts.patches, Of::lines); }
  static Json schema() { return schema_of<std::vector<ContactPatch>>(Of::lines); }
};
template <>
struct JsonForm<SkinContacts> {
  static Json json(const SkinContacts& contacts) { return as_json(contacts.patches, Of::skins); }
  static Json schema() { return schema_of<std::vector<ContactPatch>>(Of::skins); }
};

[[nodiscard]] Json events_json(std::span<const lab::ContactEvent> events);

/// Force, drag, centre and torsion of a skin's wrench.
[[nodiscard]] Json found_json(const UncertainWrench& wrench);

}  // namespace tactile_net::report
