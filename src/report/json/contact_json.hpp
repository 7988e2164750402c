/// @file
/// Private. The contacts of an answer, one by one, as a list of a line's or of a skin's fields.
#pragma once

#include <vector>

#include "report/json/described.hpp"
#include "tactile_net/lab/answer_fields.hpp"

namespace tactile_net::report {

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

}  // namespace tactile_net::report
