/// @file
/// The contacts of frame after frame as JSON, for those who want them without their recording.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/inverse/contact_patch.hpp"

namespace tactile_net::report {

/// A list a frame, an object a contact, with the keys of `patches` in the documents of `run` and
/// `solve`: the cells that it touches, and, of a recording, the number that it keeps.
///
/// @param frames  absent: without an answer, which says nothing of what became of the contacts
/// @param skin    whether they are a skin's
[[nodiscard]] std::string contacts_json(
    std::span<const std::optional<std::vector<ContactPatch>>> frames, bool skin);
/// Of one frame: a list of its contacts.
[[nodiscard]] std::string contacts_json(const std::vector<ContactPatch>& patches, bool skin);

}  // namespace tactile_net::report
