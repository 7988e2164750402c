#include "realtime/contact_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "realtime/line_contacts.hpp"
#include "realtime/touching_cells.hpp"

namespace tactile_net {

void ContactFollower::follow(std::span<ContactRow> rows, const std::uint32_t* labels) noexcept {
  std::array<std::array<std::uint32_t, most>, most_contact_rows> shared{};
  for (std::size_t cell = 0; cell < cells_; ++cell)
    if (labels[cell] != none && owners_[cell] != 0) ++shared[labels[cell]][owners_[cell] - 1U];

  // The row and the track that share most belong together, then of the rest.
  std::array<std::size_t, most_contact_rows> track_of;
  track_of.fill(most);
  for (std::size_t found = 0; found < rows.size(); ++found) {
    std::uint32_t best = 0;
    std::size_t row_of = 0;
    std::size_t track = most;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      if (track_of[row] != most) continue;
      for (std::size_t k = 0; k < most; ++k)
        if (shared[row][k] > best) {
          best = shared[row][k];
          row_of = row;
          track = k;
        }
    }
    if (track == most) break;
    track_of[row_of] = track;
    for (auto& of_row : shared) of_row[track] = 0;
  }
  std::array<bool, most> seen{};
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (track_of[row] != most) seen[track_of[row]] = true;
  for (std::size_t k = 0; k < most; ++k) {
    if (tracks_[k].id == 0) continue;
    tracks_[k].unseen = seen[k] ? 0 : tracks_[k].unseen + 1;
    if (tracks_[k].unseen >= patience) tracks_[k] = {};
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::size_t& track = track_of[row];
    if (track == most) {  // a new one, in a free place or in that of the one unseen for longest
      track = 0;
      for (std::size_t k = 0; k < most; ++k) {
        if (seen[k]) continue;
        if (seen[track] || tracks_[k].id == 0 ||
            (tracks_[track].id != 0 && tracks_[k].unseen > tracks_[track].unseen))
          track = k;
        if (tracks_[track].id == 0) break;
      }
      tracks_[track] = {.id = next_};
      next_ = next_ == ~std::uint32_t{0} ? 1 : next_ + 1;
      seen[track] = true;
      for (std::size_t cell = 0; cell < cells_; ++cell)  // of who had the place before
        if (owners_[cell] == track + 1) owners_[cell] = 0;
    }
    rows[row].id = tracks_[track].id;
  }
  for (std::size_t cell = 0; cell < cells_; ++cell) {
    std::uint8_t& owner = owners_[cell];
    if (labels[cell] != none)
      owner = static_cast<std::uint8_t>(track_of[labels[cell]] + 1);
    else if (owner != 0 && (tracks_[owner - 1U].id == 0 || seen[owner - 1U]))
      owner = 0;
  }
}

namespace {

/// Rows of the strongest of some contacts, in their order. Calls `use(contact, row)`.
///
/// @param force  (contact) its normal force
void for_strongest(std::size_t count, std::size_t rows, const auto& force,
                   const auto& use) noexcept {
  rows = std::min(rows, count);
  double before = std::numeric_limits<double>::infinity();
  std::size_t last = count;
  for (std::size_t row = 0; row < rows; ++row) {
    std::size_t best = count;
    for (std::size_t i = 0; i < count; ++i) {
      const double one = force(i);
      const bool is_left = one < before || (one == before && last != count && i > last);
      if (is_left && (best == count || one > force(best))) best = i;
    }
    if (best == count) return;
    before = force(best);
    last = best;
    use(best, row);
  }
}

}  // namespace

void add_skin_rows(const PlanCells& cells, std::size_t unknowns, const double* f,
                   std::optional<double> friction, std::span<const double> variances,
                   CellMarks& marks, ContactFollower& follower,
                   ContactEstimate& estimate) noexcept {
  const std::size_t count = cells.rows * cells.columns;
  std::uint32_t* const labels = marks.queue.data();
  const std::size_t patches =
      label_patches({cells.rows, cells.columns, 0, 0}, marks.marks.data(), labels);
  add_patches(cells, unknowns, f, patches, marks);
  const double area = cells.area();
  // Of each patch its row, of each cell in place of its patch.
  std::array<std::uint32_t, most_contact_rows> patch_of{};
  std::size_t found = 0;
  for_strongest(
      patches, std::min(estimate.rows.size(), most_contact_rows),
      [&](std::size_t patch) {
        const CellSums& sums = marks.patches[patch];
        return sums.lever >= 0.0 ? sums.p : 0.0;
      },
      [&](std::size_t patch, std::size_t row) {
        const CellSums& sums = marks.patches[patch];
        if (!(sums.lever >= 0.0)) return;
        patch_of[row] = static_cast<std::uint32_t>(patch);
        found = row + 1;
        ContactRow& to = estimate.rows[row];
        to = {.normal_force = area * sums.p,
              .centre = cells.centre_y + sums.y_p / sums.p,
              .centre_z = cells.centre_z + sums.z_p / sums.p};
        if (unknowns == 1) return;
        to.tangential_y = area * sums.q_y;
        to.tangential_z = area * sums.q_z;
        to.torsion = area * torsion_of(sums);
        if (!friction) return;
        const double hold = *friction * to.normal_force;
        const double drag = std::hypot(to.tangential_y, to.tangential_z);
        to.friction_margin = hold - drag;
        if (!(hold > 0.0)) return;
        const double turn = *friction * area * sums.lever;
        to.slip_margin = 1.0 - std::hypot(drag / hold, turn > 0.0 ? to.torsion / turn : 0.0);
      });
  estimate.rows_found = found;
  std::array<double, most_contact_rows> variance{};
  std::array<double, most_contact_rows> largest{};
  for (std::size_t cell = 0; cell < count; ++cell) {
    const std::uint32_t patch = marks.marks[cell] != 0 ? labels[cell] : ContactFollower::none;
    labels[cell] = ContactFollower::none;
    for (std::uint32_t row = 0; row < found && patch != ContactFollower::none; ++row) {
      if (patch_of[row] != patch) continue;
      labels[cell] = row;
      ++estimate.rows[row].cells;
      if (variances.empty()) continue;
      variance[row] += variances[cell];
      largest[row] = std::max(largest[row], variances[cell]);
    }
  }
  const auto window =
      static_cast<double>((2 * cells.window_rows + 1) * (2 * cells.window_columns + 1));
  for (std::size_t row = 0; row < found && !variances.empty(); ++row)
    estimate.rows[row].force_deviation = std::sqrt(std::max(variance[row], window * largest[row]));
  follower.follow(estimate.rows.first(found), labels);
}

void add_line_rows(std::span<const double> tractions, std::size_t values, double spacing,
                   double centre, std::optional<double> friction, double least,
                   Aligned<std::uint32_t>& labels, ContactFollower& follower,
                   ContactEstimate& estimate) noexcept {
  const double* const p = tractions.data();
  const double* const q = tractions.size() > values ? p + values : nullptr;
  const std::size_t rows = std::min(estimate.rows.size(), most_contact_rows);
  std::fill(labels.data(), labels.data() + values, ContactFollower::none);
  estimate.rows_found = 0;
  if (!estimate.contact) return follower.follow({}, labels.data());
  std::size_t found = 0;
  std::array<std::size_t, most_contact_rows> first{};
  std::array<std::size_t, most_contact_rows> last{};
  const auto take = [&](std::size_t from, std::size_t to) {
    ContactRow row;
    double sum = 0.0;
    double moment = 0.0;
    double drag = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      sum += p[i];
      moment += (static_cast<double>(i) - 0.5 * static_cast<double>(values - 1)) * p[i];
      if (q != nullptr) drag += q[i];
    }
    if (!(sum > 0.0)) return;
    row.normal_force = spacing * sum;
    row.centre = centre + spacing * (moment / sum);
    if (q != nullptr) row.tangential_y = spacing * drag;
    if (q != nullptr && friction)
      row.friction_margin = *friction * row.normal_force - std::abs(row.tangential_y);
    std::size_t place = found;
    if (found == rows) {  // the weakest goes
      place = 0;
      for (std::size_t k = 1; k < rows; ++k)
        if (estimate.rows[k].normal_force < estimate.rows[place].normal_force) place = k;
      if (!(row.normal_force > estimate.rows[place].normal_force)) return;
      for (std::size_t k = place; k + 1 < rows; ++k) {
        estimate.rows[k] = estimate.rows[k + 1];
        first[k] = first[k + 1];
        last[k] = last[k + 1];
      }
      place = rows - 1;
    } else {
      ++found;
    }
    estimate.rows[place] = row;
    first[place] = from;
    last[place] = to;
  };
  if (for_each_contact(p, values, least, take) < 2) {
    found = 0;
    take(0, values);
    if (found == 1) {
      ContactRow& only = estimate.rows[0];
      only.normal_force = estimate.normal_force;
      only.force_deviation = estimate.force_deviation;
      only.centre = estimate.centre;
      if (q != nullptr) only.tangential_y = estimate.tangential_force;
      if (q != nullptr && friction) only.friction_margin = estimate.friction_margin;
    }
  }
  const double peak = *std::max_element(p, p + values);
  for (std::uint32_t row = 0; row < found; ++row)
    for (std::size_t i = first[row]; i < last[row]; ++i)
      if (p[i] > least_share * peak) {
        labels[i] = row;
        ++estimate.rows[row].cells;
      }
  estimate.rows_found = found;
  follower.follow(estimate.rows.first(found), labels.data());
}

}  // namespace tactile_net
