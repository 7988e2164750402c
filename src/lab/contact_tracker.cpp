#include "tactile_net/lab/contact_tracker.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "numeric/named.hpp"

namespace tactile_net::lab {
namespace {

constexpr Named<ContactEvent::Kind> contact_event_kinds[] = {
    {ContactEvent::Kind::appeared, "appeared"},
    {ContactEvent::Kind::vanished, "vanished"},
    {ContactEvent::Kind::merged, "merged"},
    {ContactEvent::Kind::split, "split"}};

/// A track and a patch that have cells in common.
struct SharedCells {
  std::size_t count, track, patch;
};

}  // namespace

std::string_view name(ContactEvent::Kind kind) noexcept {
  return name_in<contact_event_kinds>(kind);
}

ContactTracker::ContactTracker(std::size_t patience) : patience_(patience) {
  if (patience == 0)
    throw std::invalid_argument(
        "patience must be 1 or more: the frames without a contact after which it has vanished");
}

std::vector<FollowedContact> ContactTracker::follow(std::size_t frame,
                                                    std::span<const ContactPatch> patches) {
  // By their first cells patches have an order of their own.
  std::vector<std::size_t> order(patches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return patches[a].cells < patches[b].cells; });

  std::vector<std::pair<std::size_t, std::size_t>> owners;  // a cell, and a track that was there
  for (std::size_t track = 0; track < tracks_.size(); ++track)
    for (const std::size_t cell : tracks_[track].cells) owners.emplace_back(cell, track);
  std::sort(owners.begin(), owners.end());
  std::vector<SharedCells> shared;
  for (std::size_t place = 0; place < order.size(); ++place) {
    std::map<std::size_t, std::size_t> counts;  // by track
    for (const std::size_t cell : patches[order[place]].cells)
      for (auto at =
               std::lower_bound(owners.begin(), owners.end(), std::pair(cell, std::size_t{0}));
           at != owners.end() && at->first == cell; ++at)
        ++counts[at->second];
    for (const auto& [track, count] : counts) shared.push_back({count, track, place});
  }
  // Tracks are in the order of their numbers.
  std::sort(shared.begin(), shared.end(), [](const SharedCells& a, const SharedCells& b) {
    return std::tuple(b.count, a.track, a.patch) < std::tuple(a.count, b.track, b.patch);
  });

  std::vector<std::optional<std::size_t>> track_of(patches.size());
  std::vector<std::optional<std::size_t>> patch_of(tracks_.size());
  for (const SharedCells& one : shared) {
    if (track_of[one.patch] || patch_of[one.track]) continue;
    track_of[one.patch] = one.track;
    patch_of[one.track] = one.patch;
  }
  // What is left shares its cells with one that has found its own, or with none.
  std::vector<std::optional<std::size_t>> parent(patches.size());     // a track
  std::vector<std::optional<std::size_t>> swallowed(tracks_.size());  // by a track
  for (const SharedCells& one : shared) {
    if (!track_of[one.patch] && !parent[one.patch]) parent[one.patch] = one.track;
    if (!patch_of[one.track] && !swallowed[one.track]) swallowed[one.track] = track_of[one.patch];
  }

  std::vector<Track> tracks;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Track& track = tracks_[i];
    if (patch_of[i]) {
      track.unseen = 0;
      track.cells = patches[order[*patch_of[i]]].cells;
    } else if (swallowed[i]) {
      events_.push_back({ContactEvent::Kind::merged, frame, track.id, tracks_[*swallowed[i]].id});
      continue;
    } else {
      if (track.unseen++ == 0) track.since = frame;
      if (track.unseen >= patience_) {
        events_.push_back({ContactEvent::Kind::vanished, track.since, track.id, std::nullopt});
        continue;
      }
    }
    tracks.push_back(track);
  }
  std::vector<FollowedContact> followed(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    followed[i].patch = patches[i];
    followed[i].patch.cells = {};
  }
  for (std::size_t place = 0; place < order.size(); ++place) {
    std::size_t& id = followed[order[place]].id;
    if (track_of[place]) {
      id = tracks_[*track_of[place]].id;
      continue;
    }
    id = next_++;
    events_.push_back(
        parent[place]
            ? ContactEvent{ContactEvent::Kind::split, frame, id, tracks_[*parent[place]].id}
            : ContactEvent{ContactEvent::Kind::appeared, frame, id, std::nullopt});
    tracks.push_back({.id = id, .cells = patches[order[place]].cells});
  }
  tracks_ = std::move(tracks);
  return followed;
}

}  // namespace tactile_net::lab
