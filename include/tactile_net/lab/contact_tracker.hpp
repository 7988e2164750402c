/// @file
/// Which contact of a frame is which of the frame before: numbers that stay with contacts over a
/// recording's frames, and what became of each.
///
///     lab::ContactTracker tracker;
///     for (const lab::FollowedContact& one : tracker.follow(frame, answer.patches))
///       tell(one.id, one.patch.wrench);
///     for (const lab::ContactEvent& event : tracker.events()) tell(event);
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tactile_net/inverse/contact_patch.hpp"

namespace tactile_net::lab {

struct ContactEvent {
  enum class Kind {
    appeared,  ///< a contact touches where none did
    vanished,  ///< a contact touches no more
    merged,    ///< a contact has grown together with `other`, which goes on
    split,     ///< a contact has parted from `other`, which goes on
  };
  Kind kind = Kind::appeared;
  std::size_t frame = 0;  ///< the first frame that shows it
  std::size_t id = 0;
  std::optional<std::size_t> other{};
};

/// "appeared", "vanished", ...
[[nodiscard]] std::string_view name(ContactEvent::Kind kind) noexcept;

/// A contact of a frame, with the number by which it is known.
struct FollowedContact {
  std::size_t id = 0;
  ContactPatch patch{};  ///< without its cells: these would be most of a recording's memory
};

/// Follows contacts by the cells that they share with those of the frame before: a contact keeps
/// its number where it shares more cells with its former self than any other does. A contact that
/// moves by more than its own width between two frames is a new one.
class ContactTracker {
 public:
  /// @param patience  frames without a contact after which it has vanished, >= 1
  /// @throw std::invalid_argument  patience is 0
  explicit ContactTracker(std::size_t patience = 3);

  /// Takes the contacts of the next frame that has an answer, in any order.
  /// @param frame  its number, in rising order
  /// @return each contact with its number, from 1 on: none is used twice
  std::vector<FollowedContact> follow(std::size_t frame, std::span<const ContactPatch> patches);

  /// In the order in which they were known: that a contact has vanished is known some frames later.
  [[nodiscard]] const std::vector<ContactEvent>& events() const noexcept { return events_; }

 private:
  struct Track {
    std::size_t id = 0;
    std::vector<std::size_t> cells{};  // where it was seen last
    std::size_t unseen = 0;            // frames since
    std::size_t since = 0;             // the first of these
  };

  std::size_t patience_;
  std::size_t next_ = 1;
  std::vector<Track> tracks_{};
  std::vector<ContactEvent> events_{};
};

}  // namespace tactile_net::lab
