#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/load_plan.hpp"
#include "tactile_net/tactile_net.h"

using tactile_net::ContactEstimate;
using tactile_net::ContactEstimator;
using tactile_net::ContactRow;
using tactile_net::EstimatorPlan;
using tactile_net::FrameCounters;
using tactile_net::FrameStatus;
using tactile_net::most_contact_rows;
using tactile_net::Preparation;
using tactile_net::ReadingType;
using tactile_net::ReadingView;

struct tactile_net_estimator {
  explicit tactile_net_estimator(const EstimatorPlan& from)
      : estimator(from),
        label(from.label),
        tractions(from.tractions()),
        plan{.label = label.c_str(),
             .readings = from.readings(),
             .tractions = from.tractions(),
             .unknowns = from.unknowns,
             .is_curved = from.space.has_value(),
             .is_skin = from.cells.has_value(),
             .rows = from.cells ? from.cells->rows : from.values,
             .columns = from.cells ? from.cells->columns : 1,
             .spacing_y_m = from.cells ? from.cells->spacing_y : from.spacing,
             .spacing_z_m = from.cells ? from.cells->spacing_z : 0.0,
             .centre_y_m = from.cells ? from.cells->centre_y : from.centre,
             .centre_z_m = from.cells ? from.cells->centre_z : 0.0,
             .steps = from.cone ? from.cone->steps : 0,
             .friction_limit = from.cone
                                   ? from.cone->friction_limit.value_or(ContactEstimate::unknown)
                                   : ContactEstimate::unknown} {
    estimator.stop_at(&stop);
  }
  tactile_net_estimator(const tactile_net_estimator& other)
      : estimator(other.estimator),
        label(other.label),
        tractions(other.tractions),
        plan(other.plan),
        wanted_rows(other.wanted_rows) {
    plan.label = label.c_str();
    estimator.stop_at(&stop);
  }
  tactile_net_estimator& operator=(const tactile_net_estimator&) = delete;
  ~tactile_net_estimator() = default;

  ContactEstimator estimator;
  std::string label;
  std::vector<double> tractions;  // of callers who want none
  tactile_net_plan plan;
  std::array<ContactRow, most_contact_rows> rows{};
  std::size_t wanted_rows = 0;
  std::size_t found_rows = 0;
  std::atomic<bool> stop{false};
};
static_assert(TACTILE_NET_MOST_CONTACTS == most_contact_rows);
static_assert(std::atomic<bool>::is_always_lock_free);

namespace {

static_assert(TACTILE_NET_OK == static_cast<int>(FrameStatus::ok));
static_assert(TACTILE_NET_WRONG_SIZE == static_cast<int>(FrameStatus::wrong_size));
static_assert(TACTILE_NET_NOT_FINITE == static_cast<int>(FrameStatus::not_finite));
static_assert(TACTILE_NET_TOO_LARGE == static_cast<int>(FrameStatus::too_large));

static_assert(TACTILE_NET_FLOAT64 == static_cast<int>(ReadingType::float64));
static_assert(TACTILE_NET_FLOAT32 == static_cast<int>(ReadingType::float32));
static_assert(TACTILE_NET_INT16 == static_cast<int>(ReadingType::int16));
static_assert(TACTILE_NET_UINT16 == static_cast<int>(ReadingType::uint16));
static_assert(TACTILE_NET_INT32 == static_cast<int>(ReadingType::int32));

tactile_net_status in_c(FrameStatus status) noexcept {
  return static_cast<tactile_net_status>(status);
}

/// Room for any message, without the heap, of which there may be nothing left.
std::array<char, 1024>& error_text() noexcept {
  thread_local std::array<char, 1024> text{};
  return text;
}

void set_error(std::string_view text) noexcept {
  std::array<char, 1024>& room = error_text();
  room.fill('\0');
  std::memcpy(room.data(), text.data(), std::min(text.size(), room.size() - 1));
}

/// An estimator of what `from()` gives, a plan or another one; null, and the error's text, where
/// anything throws.
tactile_net_estimator* made_of(const auto& from) noexcept {
  try {
    return std::make_unique<tactile_net_estimator>(from()).release();
  } catch (const std::bad_alloc&) {
    set_error("out of memory");
  } catch (const std::exception& error) {
    set_error(error.what());
  } catch (...) {
    set_error("an unknown error");
  }
  return nullptr;
}

void check_version(int version) {
  if (version == TACTILE_NET_INTERFACE) return;
  throw std::invalid_argument("the program was compiled for version " + std::to_string(version) +
                              " of tactile_net.h, the library has version " +
                              std::to_string(TACTILE_NET_INTERFACE) +
                              ": compile it with the header of the library that it links");
}

void check_given(const void* pointer, const char* what) {
  if (pointer == nullptr) throw std::invalid_argument(std::string(what) + " is a null pointer");
}

/// None for a null pointer: a size that no plan has.
std::span<const double> frame_of(const double* readings, std::size_t count) noexcept {
  return {readings, readings == nullptr ? 0 : count};
}

ReadingView view_of(const tactile_net_readings& readings) noexcept {
  const bool is_known = readings.type >= TACTILE_NET_FLOAT64 && readings.type <= TACTILE_NET_INT32;
  return {readings.first,
          static_cast<ReadingType>(readings.type),
          readings.first == nullptr || !is_known ? 0 : readings.count,
          {.stride = readings.stride, .scale = readings.scale == 0.0 ? 1.0 : readings.scale}};
}

tactile_net_estimate in_c(const ContactEstimate& estimate) noexcept {
  const auto& [force, moment, centre] = estimate.space;
  return {.time_s = estimate.time,
          .normal_force = estimate.normal_force,
          .force_deviation = estimate.force_deviation,
          .tangential_force = estimate.tangential_force,
          .tangential_y = estimate.tangential_y,
          .tangential_z = estimate.tangential_z,
          .centre_y_m = estimate.centre,
          .centre_z_m = estimate.centre_z,
          .torsion_n_m = estimate.torsion,
          .angle_rad = estimate.angle,
          .friction_margin = estimate.friction_margin,
          .slip_margin = estimate.slip_margin,
          .margin_centre_y_m = estimate.margin_centre,
          .margin_centre_z_m = estimate.margin_centre_z,
          .force_in_space = {force[0], force[1], force[2]},
          .moment_in_space_n_m = {moment[0], moment[1], moment[2]},
          .centre_in_space_m = {centre[0], centre[1], centre[2]},
          .residual_rms = estimate.residual_rms,
          .contacts = estimate.contacts,
          .touching = estimate.touching,
          .unfinished = estimate.unfinished,
          .unfinished_share = estimate.unfinished_share,
          .steps = estimate.steps,
          .outlier = estimate.outlier,
          .age = estimate.age,
          .contact = estimate.contact,
          .pulls = estimate.pulls,
          .implausible = estimate.implausible,
          .misfit = estimate.misfit,
          .beyond_edge = estimate.beyond_edge,
          .baseline_moved = estimate.baseline_moved,
          .saturated = estimate.saturated};
}

/// One frame of either kind of readings.
tactile_net_status update_by(tactile_net_estimator& of, const auto& readings, double time_s,
                             double* tractions, tactile_net_estimate* estimate) noexcept {
  ContactEstimate contact{
      .tractions = {tractions == nullptr ? of.tractions.data() : tractions, of.tractions.size()},
      .rows = {of.rows.data(), of.wanted_rows}};
  const FrameStatus status = of.estimator.update(readings, contact, time_s);
  const bool answered = status == FrameStatus::ok || contact.age > 0;
  if (answered) of.found_rows = contact.rows_found;
  if (answered && estimate != nullptr) *estimate = in_c(contact);
  return in_c(status);
}

}  // namespace

int tactile_net_interface(void) { return TACTILE_NET_INTERFACE; }

tactile_net_estimator* tactile_net_load(int version, const char* path) {
  return made_of([&] {
    check_version(version);
    check_given(path, "the path of the plan");
    return tactile_net::load_plan(path);
  });
}

tactile_net_estimator* tactile_net_decode(int version, const void* bytes, size_t size) {
  return made_of([&] {
    check_version(version);
    check_given(bytes, "the plan");
    return tactile_net::decode_plan({static_cast<const std::byte*>(bytes), size});
  });
}

tactile_net_estimator* tactile_net_copy(const tactile_net_estimator* estimator) {
  return made_of([&]() -> const tactile_net_estimator& {
    check_given(estimator, "the estimator");
    return *estimator;
  });
}

void tactile_net_destroy(tactile_net_estimator* estimator) {
  const std::unique_ptr<tactile_net_estimator> owned(estimator);
}

const char* tactile_net_last_error(void) { return error_text().data(); }

const tactile_net_plan* tactile_net_plan_of(const tactile_net_estimator* estimator) {
  return &estimator->plan;
}

tactile_net_status tactile_net_update(tactile_net_estimator* estimator, const double* readings,
                                      size_t count, double time_s, double* tractions,
                                      tactile_net_estimate* estimate) {
  return update_by(*estimator, frame_of(readings, count), time_s, tractions, estimate);
}

tactile_net_status tactile_net_update_from(tactile_net_estimator* estimator,
                                           const tactile_net_readings* readings, double time_s,
                                           double* tractions, tactile_net_estimate* estimate) {
  return update_by(*estimator, view_of(*readings), time_s, tractions, estimate);
}

size_t tactile_net_contacts(const tactile_net_estimator* estimator, tactile_net_contact* contacts,
                            size_t room) {
  const std::size_t count = std::min(room, estimator->found_rows);
  for (std::size_t i = 0; i < count; ++i) {
    const ContactRow& row = estimator->rows[i];
    contacts[i] = {.normal_force = row.normal_force,
                   .force_deviation = row.force_deviation,
                   .tangential_y = row.tangential_y,
                   .tangential_z = row.tangential_z,
                   .centre_y_m = row.centre,
                   .centre_z_m = row.centre_z,
                   .torsion_n_m = row.torsion,
                   .friction_margin = row.friction_margin,
                   .slip_margin = row.slip_margin,
                   .cells = row.cells,
                   .id = row.id};
  }
  return count;
}

tactile_net_status tactile_net_set_baseline(tactile_net_estimator* estimator,
                                            const double* readings, size_t count) {
  return in_c(estimator->estimator.set_baseline(frame_of(readings, count)));
}

tactile_net_status tactile_net_set_baseline_from(tactile_net_estimator* estimator,
                                                 const tactile_net_readings* readings) {
  return in_c(estimator->estimator.set_baseline(view_of(*readings)));
}

bool tactile_net_set_dead(tactile_net_estimator* estimator, size_t taxel) {
  return estimator->estimator.set_dead(taxel);
}

void tactile_net_revive(tactile_net_estimator* estimator) { estimator->estimator.revive(); }

void tactile_net_set_options(tactile_net_estimator* estimator, const tactile_net_options* options) {
  estimator->estimator.set_options(
      {.flush_denormals = options->flush_denormals, .hold = options->hold});
  estimator->wanted_rows = std::min(options->contacts, most_contact_rows);
  estimator->found_rows = std::min(estimator->found_rows, estimator->wanted_rows);
}

void tactile_net_prepare(tactile_net_estimator* estimator, tactile_net_preparation* result) {
  const Preparation done = estimator->estimator.prepare();
  if (result != nullptr) *result = {.bytes = done.bytes, .locked = done.locked};
}

void tactile_net_set_work(tactile_net_estimator* estimator, size_t steps, double enough) {
  estimator->estimator.set_work({.steps = steps, .enough = enough});
}

void tactile_net_stop(tactile_net_estimator* estimator, bool stop) {
  estimator->stop.store(stop, std::memory_order_relaxed);
}

void tactile_net_get_counters(const tactile_net_estimator* estimator,
                              tactile_net_counters* counters) {
  const FrameCounters& all = estimator->estimator.counters();
  *counters = {.frames = all.frames,
               .wrong_size = all.wrong_size,
               .not_finite = all.not_finite,
               .too_large = all.too_large};
}

void tactile_net_reset_counters(tactile_net_estimator* estimator) {
  estimator->estimator.reset_counters();
}

const char* tactile_net_status_name(int status) {
  return tactile_net::name(static_cast<FrameStatus>(status))
      .data();  // of a literal: it ends with 0
}
