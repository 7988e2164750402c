#include "report/json/contact_json.hpp"

#include <string>

namespace tactile_net::report {
namespace {

Json line_contact_json(const ContactPatch& patch) {
  return {{"normal", uncertain_json(patch.wrench.normal)},
          {"tangential", uncertain_or_null(patch.wrench.tangential_y)},
          {"centre", uncertain_or_null(patch.wrench.centre_y)},
          {"friction", uncertain_or_null(patch.friction)},
          {"slip_margin", uncertain_or_null(patch.slip_margin)},
          {"length", uncertain_or_null(patch.extent)}};
}

Json skin_contact_json(const ContactPatch& patch) {
  Json json = found_json(patch.wrench);
  json["friction"] = uncertain_or_null(patch.friction);
  json["slip_margin"] = uncertain_or_null(patch.slip_margin);
  json["area"] = uncertain_or_null(patch.extent);
  json["ellipse"] = ellipse_json(patch.ellipse);
  return json;
}

Json with_cells(std::span<const ContactPatch> patches, Json (*contact)(const ContactPatch&)) {
  Json list = Json::array();
  for (const ContactPatch& patch : patches) {
    list.push_back({{"cells", patch.cells}});
    list.back().update(contact(patch));
  }
  return list;
}

Json with_ids(std::span<const lab::FollowedContact> contacts,
              Json (*contact)(const ContactPatch&)) {
  Json list = Json::array();
  for (const lab::FollowedContact& one : contacts) {
    list.push_back({{"id", one.id}});
    list.back().update(contact(one.patch));
  }
  return list;
}

}  // namespace

Json pair_json(const std::optional<Uncertain>& a, const std::optional<Uncertain>& b) {
  return a && b ? Json{uncertain_json(*a), uncertain_json(*b)} : Json(nullptr);
}

Json found_json(const UncertainWrench& wrench) {
  return {{"normal", uncertain_json(wrench.normal)},
          {"tangential_y", uncertain_or_null(wrench.tangential_y)},
          {"tangential_z", uncertain_or_null(wrench.tangential_z)},
          {"centre", pair_json(wrench.centre_y, wrench.centre_z)},
          {"torsion", uncertain_or_null(wrench.torsion)}};
}

Json ellipse_json(const std::optional<ContactEllipse>& ellipse) {
  if (!ellipse) return nullptr;
  return {{"radius", uncertain_json(ellipse->radius)},
          {"second_radius", uncertain_json(ellipse->second_radius)},
          {"angle", uncertain_json(ellipse->angle)}};
}

Json line_contacts_json(std::span<const ContactPatch> patches) {
  return with_cells(patches, line_contact_json);
}

Json skin_contacts_json(std::span<const ContactPatch> patches) {
  return with_cells(patches, skin_contact_json);
}

Json line_contacts_json(std::span<const lab::FollowedContact> contacts) {
  return with_ids(contacts, line_contact_json);
}

Json skin_contacts_json(std::span<const lab::FollowedContact> contacts) {
  return with_ids(contacts, skin_contact_json);
}

Json events_json(std::span<const lab::ContactEvent> events) {
  Json list = Json::array();
  for (const lab::ContactEvent& event : events)
    list.push_back({{"frame", event.frame},
                    {"event", name(event.kind)},
                    {"id", event.id},
                    {"other", event.other ? Json(*event.other) : Json(nullptr)}});
  return list;
}

}  // namespace tactile_net::report
