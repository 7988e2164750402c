#include "realtime/loop_state.hpp"

#include <algorithm>
#include <span>

#include "realtime/estimator_state.hpp"

namespace tactile_net {

void LoopState::count_refused(FrameStatus status) noexcept {
  switch (status) {
    case FrameStatus::ok:
      break;
    case FrameStatus::wrong_size:
      ++counters.wrong_size;
      break;
    case FrameStatus::not_finite:
      ++counters.not_finite;
      break;
    case FrameStatus::too_large:
      ++counters.too_large;
      break;
  }
}

void LoopState::hold(FrameStatus status, ContactEstimate& estimate) noexcept {
  const std::span<double> room = estimate.tractions;
  if (status == FrameStatus::ok) {
    held = estimate;
    held.tractions = {held_tractions.data(), room.size()};
    std::copy_n(estimate.rows.begin(), estimate.rows_found, held_rows.begin());
    // Frames of `prepare` have their tractions there.
    if (room.data() != held_tractions.data())
      std::copy(room.begin(), room.end(), held_tractions.data());
    has_held = true;
    return;
  }
  if (!has_held) return;
  ++held.age;
  if (room.size() != held.tractions.size()) return;
  const std::span<ContactRow> rows = estimate.rows;
  estimate = held;
  estimate.tractions = room;
  estimate.rows = rows;
  estimate.rows_found = std::min(held.rows_found, rows.size());
  std::copy_n(held_rows.begin(), estimate.rows_found, rows.begin());
  std::copy(held.tractions.begin(), held.tractions.end(), room.begin());
}

void ContactEstimator::set_options(const LoopOptions& options) noexcept {
  LoopState& loop = scratch_->loop;
  loop.options = options;
  loop.has_held = loop.has_held && options.hold;
}

const LoopOptions& ContactEstimator::options() const noexcept { return scratch_->loop.options; }
const FrameCounters& ContactEstimator::counters() const noexcept { return scratch_->loop.counters; }
void ContactEstimator::reset_counters() noexcept { scratch_->loop.counters = {}; }

/// Readings in doubles; none where they are not as many as the plan has.
std::span<const double> ContactEstimator::converted(const ReadingView& readings) noexcept {
  if (readings.size() != ready_->readings()) return {};
  double* const values = scratch_->loop.converted.data();
  readings.copy_to(values);
  return {values, readings.size()};
}

FrameStatus ContactEstimator::update(const ReadingView& readings, ContactEstimate& estimate,
                                     double time) noexcept {
  return update(converted(readings), estimate, time);
}

FrameStatus ContactEstimator::set_baseline(const ReadingView& readings) noexcept {
  return set_baseline(converted(readings));
}

}  // namespace tactile_net
