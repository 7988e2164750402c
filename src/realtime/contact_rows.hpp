/// @file
/// Fills in a frame's rows of contacts, and follows them from frame to frame. Private.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "realtime/aligned.hpp"
#include "realtime/skin_resultant.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/contact_row.hpp"

namespace tactile_net {

/// The contacts of the frames before, and where each was seen last. No allocation but at first.
class ContactFollower {
 public:
  explicit ContactFollower(std::size_t cells) : owners_(cells), cells_(cells) {}

  /// Gives each row its number.
  /// @param labels  of each cell the row that it belongs to; `none`: it belongs to none
  void follow(std::span<ContactRow> rows, const std::uint32_t* labels) noexcept;

  static constexpr std::uint32_t none = ~std::uint32_t{0};

  /// Calls `use` with each array.
  void for_each_array(auto& use) const noexcept { use(owners_); }

 private:
  static constexpr std::size_t patience = 3;  // frames unseen after which it is gone
  static constexpr std::size_t most = 2 * most_contact_rows;
  struct Track {
    std::uint32_t id = 0;  // 0: the place is free
    std::uint32_t unseen = 0;
  };

  Aligned<std::uint8_t> owners_;  // of each cell its track, from 1 on; 0: none
  std::size_t cells_;
  std::array<Track, most> tracks_{};
  std::uint32_t next_ = 1;
};

/// The patches of a skin's marked cells, strongest first.
/// @param marks   as `add_skin_resultant` left them
/// @param labels  room for one a cell
void add_skin_rows(const PlanCells& cells, std::size_t unknowns, const double* f,
                   std::optional<double> friction, std::span<const double> variances,
                   CellMarks& marks, ContactFollower& follower, ContactEstimate& estimate) noexcept;

/// The contacts on a line, from left to right where there are more than rows the strongest of them.
/// @param least  as `for_each_contact` takes it
void add_line_rows(std::span<const double> tractions, std::size_t values, double spacing,
                   double centre, std::optional<double> friction, double least,
                   Aligned<std::uint32_t>& labels, ContactFollower& follower,
                   ContactEstimate& estimate) noexcept;

}  // namespace tactile_net
