#include "tactile_net/lab/contact_tracker.hpp"

#include <algorithm>
#include <random>
#include <set>
#include <stdexcept>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

/// Cells from `first` to before `last` of a row.
ContactPatch stretch(std::size_t first, std::size_t last) {
  ContactPatch patch;
  for (std::size_t cell = first; cell < last; ++cell) patch.cells.push_back(cell);
  return patch;
}

std::vector<std::size_t> ids(lab::ContactTracker& tracker, std::size_t frame,
                             const std::vector<ContactPatch>& patches) {
  std::vector<std::size_t> all;
  for (const lab::FollowedContact& one : tracker.follow(frame, patches)) all.push_back(one.id);
  return all;
}

using Ids = std::vector<std::size_t>;

}  // namespace

TEST_CASE("a contact that moves by less than its width keeps its number",
          "[lab][contact_tracker]") {
  lab::ContactTracker tracker;
  for (std::size_t frame = 0; frame < 40; ++frame)
    CHECK(ids(tracker, frame, {stretch(2 * frame, 2 * frame + 5)}) == Ids{1});
  REQUIRE(tracker.events().size() == 1);
  CHECK(tracker.events().front().kind == lab::ContactEvent::Kind::appeared);
  CHECK(tracker.events().front().frame == 0);
  // Its own cells are not kept.
  CHECK(tracker.follow(40, std::vector{stretch(80, 85)}).front().patch.cells.empty());
  // A jump is another contact.
  CHECK(ids(tracker, 41, {stretch(200, 205)}) == Ids{2});
}

TEST_CASE("contacts that meet are told as merged, and those that part as split",
          "[lab][contact_tracker]") {
  using Kind = lab::ContactEvent::Kind;
  lab::ContactTracker tracker;
  CHECK(ids(tracker, 0, {stretch(0, 4), stretch(10, 20)}) == Ids{1, 2});
  CHECK(ids(tracker, 1, {stretch(3, 7), stretch(9, 19)}) == Ids{1, 2});
  CHECK(ids(tracker, 2, {stretch(5, 18)}) == Ids{2});  // of which it has more cells
  CHECK(ids(tracker, 3, {stretch(4, 9), stretch(11, 18)}) == Ids{3, 2});
  CHECK(ids(tracker, 4, {stretch(3, 8), stretch(12, 18)}) == Ids{3, 2});
  const std::vector<lab::ContactEvent>& events = tracker.events();
  REQUIRE(events.size() == 4);
  CHECK(events[2].kind == Kind::merged);
  CHECK(events[2].frame == 2);
  CHECK(events[2].id == 1);
  CHECK(events[2].other == std::size_t{2});
  CHECK(events[3].kind == Kind::split);
  CHECK(events[3].frame == 3);
  CHECK(events[3].id == 3);
  CHECK(events[3].other == std::size_t{2});
}

TEST_CASE("a contact that is lost for fewer frames than patience has not vanished",
          "[lab][contact_tracker]") {
  const std::size_t patience = GENERATE(std::size_t{1}, std::size_t{2}, std::size_t{3});
  lab::ContactTracker tracker(patience);
  std::size_t frame = 0;
  CHECK(ids(tracker, frame++, {stretch(3, 6)}) == Ids{1});
  for (std::size_t lost = 1; lost < patience; ++lost) CHECK(ids(tracker, frame++, {}).empty());
  CHECK(ids(tracker, frame++, {stretch(4, 7)}) == Ids{1});
  CHECK(tracker.events().size() == 1);
  const std::size_t gone = frame;
  for (std::size_t lost = 0; lost < patience; ++lost) CHECK(ids(tracker, frame++, {}).empty());
  REQUIRE(tracker.events().size() == 2);
  CHECK(tracker.events().back().kind == lab::ContactEvent::Kind::vanished);
  CHECK(tracker.events().back().frame == gone);
  CHECK(tracker.events().back().id == 1);
  CHECK(ids(tracker, frame, {stretch(4, 7)}) == Ids{2});
  CHECK_THROWS_AS(lab::ContactTracker(0), std::invalid_argument);
}

TEST_CASE("numbers do not depend on the order of contacts, and none is used twice",
          "[lab][contact_tracker][property]") {
  std::mt19937 random(11);
  lab::ContactTracker tracker;
  lab::ContactTracker shuffled;
  std::set<std::size_t> begun;
  for (std::size_t frame = 0; frame < 300; ++frame) {
    std::vector<ContactPatch> patches;
    for (std::size_t cell = random() % 5; cell < 60;) {
      const std::size_t last = cell + 1 + random() % 8;
      patches.push_back(stretch(cell, last));
      cell = last + 1 + random() % 6;
    }
    std::vector<ContactPatch> others = patches;
    std::shuffle(others.begin(), others.end(), random);
    const Ids own = ids(tracker, frame, patches);
    const Ids mixed = ids(shuffled, frame, others);
    for (std::size_t i = 0; i < others.size(); ++i) {
      const auto at = std::find_if(patches.begin(), patches.end(), [&](const ContactPatch& one) {
        return one.cells == others[i].cells;
      });
      CHECK(mixed[i] == own[static_cast<std::size_t>(at - patches.begin())]);
    }
    CHECK(std::set(own.begin(), own.end()).size() == own.size());
  }
  // Each number begins once and ends once at most, and what goes on has not ended.
  std::set<std::size_t> ended;
  for (const lab::ContactEvent& event : tracker.events()) {
    const bool begins = event.kind == lab::ContactEvent::Kind::appeared ||
                        event.kind == lab::ContactEvent::Kind::split;
    CHECK((begins ? begun : ended).insert(event.id).second);
    if (!begins) CHECK(begun.count(event.id) == 1);
    if (event.other) CHECK(begun.count(*event.other) == 1);
    if (event.other) CHECK(ended.count(*event.other) == 0);
  }
  CHECK(begun.size() > 10);
}
