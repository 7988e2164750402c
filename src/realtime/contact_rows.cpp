#include "realtime/contact_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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

/// A contact that may become a row: of a skin a patch, of a line its values from `first` to before
/// `last`.
struct Found {
  double force = 0.0;
  std::size_t first = 0;
  std::size_t last = 0;
};

/// The strongest of those that are offered, the strongest first, as many as there are rows for.
class Strongest {
 public:
  explicit Strongest(std::size_t rows) noexcept : rows_(std::min(rows, most_contact_rows)) {}

  void offer(const Found& one) noexcept {
    if (!(one.force > 0.0)) return;
    std::size_t at = count_;
    while (at > 0 && found_[at - 1].force < one.force) --at;
    if (at == rows_) return;
    count_ = std::min(count_ + 1, rows_);
    for (std::size_t k = count_ - 1; k > at; --k) found_[k] = found_[k - 1];
    found_[at] = one;
  }
  [[nodiscard]] std::span<Found> all() noexcept { return std::span(found_).first(count_); }

 private:
  std::array<Found, most_contact_rows> found_{};
  std::size_t rows_;
  std::size_t count_ = 0;
};

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
  Strongest strongest(estimate.rows.size());
  for (std::size_t patch = 0; patch < patches; ++patch)
    if (const CellSums& sums = marks.patches[patch]; sums.lever >= 0.0)
      strongest.offer({.force = area * sums.p, .first = patch});
  const std::span<const Found> rows = strongest.all();
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const CellSums& sums = marks.patches[rows[row].first];
    ContactRow& to = estimate.rows[row];
    to = {.normal_force = rows[row].force,
          .centre = cells.centre_y + sums.y_p / sums.p,
          .centre_z = cells.centre_z + sums.z_p / sums.p};
    if (unknowns == 1) continue;
    to.tangential_y = area * sums.q_y;
    to.tangential_z = area * sums.q_z;
    to.torsion = area * torsion_of(sums);
    if (!friction) continue;
    const Margins margins = margins_of(sums, area, *friction);
    to.friction_margin = margins.friction;
    to.slip_margin = margins.slip;
  }
  estimate.rows_found = rows.size();
  std::array<double, most_contact_rows> variance{};
  std::array<double, most_contact_rows> largest{};
  for (std::size_t cell = 0; cell < count; ++cell) {
    const std::uint32_t patch = marks.marks[cell] != 0 ? labels[cell] : ContactFollower::none;
    labels[cell] = ContactFollower::none;
    for (std::uint32_t row = 0; row < rows.size() && patch != ContactFollower::none; ++row) {
      if (rows[row].first != patch) continue;
      labels[cell] = row;
      ++estimate.rows[row].cells;
      if (variances.empty()) continue;
      variance[row] += variances[cell];
      largest[row] = std::max(largest[row], variances[cell]);
    }
  }
  for (std::size_t row = 0; row < rows.size() && !variances.empty(); ++row)
    estimate.rows[row].force_deviation = deviation_of(cells, variance[row], largest[row]);
  follower.follow(estimate.rows.first(rows.size()), labels);
}

void add_line_rows(std::span<const double> tractions, std::size_t values, double spacing,
                   double centre, std::optional<double> friction, double least,
                   Aligned<std::uint32_t>& labels, ContactFollower& follower,
                   ContactEstimate& estimate) noexcept {
  const double* const p = tractions.data();
  const double* const q = tractions.size() > values ? p + values : nullptr;
  std::fill(labels.data(), labels.data() + values, ContactFollower::none);
  if (!estimate.contact) return follower.follow({}, labels.data());
  Strongest strongest(estimate.rows.size());
  const auto offer = [&](std::size_t first, std::size_t last) {
    strongest.offer({spacing * std::accumulate(p + first, p + last, 0.0), first, last});
  };
  const bool is_alone = for_each_contact(p, values, least, offer) < 2;
  if (is_alone) strongest.offer({estimate.normal_force, 0, values});
  const std::span<Found> rows = strongest.all();
  std::sort(rows.begin(), rows.end(),
            [](const Found& a, const Found& b) { return a.first < b.first; });
  const double peak = *std::max_element(p, p + values);
  for (std::uint32_t row = 0; row < rows.size(); ++row) {
    ContactRow& to = estimate.rows[row];
    to = {.normal_force = rows[row].force};
    double moment = 0.0;
    double drag = 0.0;
    for (std::size_t i = rows[row].first; i < rows[row].last; ++i) {
      moment += (static_cast<double>(i) - 0.5 * static_cast<double>(values - 1)) * p[i];
      if (q != nullptr) drag += q[i];
      if (!(p[i] > least_share * peak)) continue;
      labels[i] = row;
      ++to.cells;
    }
    if (is_alone) {  // the frame's own
      to.force_deviation = estimate.force_deviation;
      to.centre = estimate.centre;
      to.tangential_y = estimate.tangential_force;
      to.friction_margin = estimate.friction_margin;
      continue;
    }
    to.centre = centre + spacing * (spacing * moment / to.normal_force);
    if (q == nullptr) continue;
    to.tangential_y = spacing * drag;
    if (friction) to.friction_margin = *friction * to.normal_force - std::abs(to.tangential_y);
  }
  estimate.rows_found = rows.size();
  follower.follow(estimate.rows.first(rows.size()), labels.data());
}

}  // namespace tactile_net
