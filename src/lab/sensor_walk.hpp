/// @file
/// From frame to frame of a simulated sensor, a line or a skin, through its signal path. Private.
#pragma once

#include <utility>

#include "lab/lines_and_skins.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/scene/scene_effects.hpp"

namespace tactile_net::lab {

template <SceneKind Kind>
SensorWalk<Kind>::SensorWalk(Kind scene)
    : scene_(std::move(scene)), instants_(instants(scene_)), path_(signal_path(scene_)) {}

template <SceneKind Kind>
bool SensorWalk<Kind>::next(bool wanted) {
  for (; next_ < instants_.size(); ++next_) {
    const Instant& at = instants_[next_];
    if (!wanted && !path_.has_memory()) {
      readings_.assign(reading_count(scene_.sensor), 0.0);
    } else {
      if (pure_.empty() || any_contact_moves(scene_))
        pure_ = press(scene_.time ? contacts_at(scene_, at.time) : scene_.contacts);
      readings_ = pure_;
    }
    path_.apply(at, readings_);
    if (!at.recorded) continue;
    time_ = at.time;
    ++next_;
    return true;
  }
  return false;
}

/// Goes on to the scene's frame, which alone is wanted.
void go_to_frame(auto& recording, std::size_t wanted, Observer& observer) {
  for (std::size_t frame = 0; recording.next(frame == wanted); ++frame)
    observer.step({.kind = Step::Kind::frame, .count = frame});
}

}  // namespace tactile_net::lab
