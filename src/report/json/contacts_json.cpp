#include "tactile_net/report/json/contacts_json.hpp"

#include "report/json/described.hpp"
#include "tactile_net/lab/answer_fields.hpp"

namespace tactile_net::report {
namespace {

Json contacts_of(const std::vector<ContactPatch>& patches, bool skin) {
  return as_json(patches, skin ? Of::skins : Of::lines);
}

}  // namespace

std::string contacts_json(const std::vector<ContactPatch>& patches, bool skin) {
  return text_of(contacts_of(patches, skin), -1);
}

std::string contacts_json(std::span<const std::optional<std::vector<ContactPatch>>> frames,
                          bool skin) {
  lab::ContactTracker tracker;
  Json all = Json::array();
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    Json rows = Json::array();
    if (const auto& patches = frames[frame]) {
      rows = contacts_of(*patches, skin);
      const std::vector<lab::FollowedContact> followed = tracker.follow(frame, *patches);
      for (std::size_t i = 0; i < followed.size(); ++i)
        add_fields(rows[i], followed[i], skin ? Of::skins : Of::lines);
    }
    all.push_back(std::move(rows));
  }
  return text_of(all, -1);
}

}  // namespace tactile_net::report
