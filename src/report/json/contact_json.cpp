#include "report/json/contact_json.hpp"

#include "report/json/described.hpp"
#include "tactile_net/lab/answer_fields.hpp"

namespace tactile_net::report {
namespace {

template <class Contact>
Json each_json(std::span<const Contact> contacts, Of of) {
  Json list = Json::array();
  for (const Contact& one : contacts) list.push_back(as_json(one, of));
  return list;
}

}  // namespace

Json found_json(const UncertainWrench& wrench) { return as_json(wrench, Of::skins); }

Json line_contacts_json(std::span<const lab::FollowedContact> contacts) {
  return each_json(contacts, Of::lines);
}

Json skin_contacts_json(std::span<const lab::FollowedContact> contacts) {
  return each_json(contacts, Of::skins);
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
