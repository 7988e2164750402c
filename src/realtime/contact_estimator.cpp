#include "tactile_net/realtime/contact_estimator.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "realtime/border_pressure.hpp"
#include "realtime/denormals.hpp"
#include "realtime/estimator_state.hpp"
#include "realtime/finite.hpp"
#include "realtime/line_contacts.hpp"
#include "realtime/touching_cells.hpp"

namespace tactile_net {
namespace {

std::unique_ptr<Convolution> made(const ConvolutionMaker& make, const ProductPlan& plan) {
  if (plan.structure != Structure::fft) return nullptr;
  std::unique_ptr<Convolution> convolution = make ? make(plan) : nullptr;
  if (!convolution)
    throw std::invalid_argument(
        "a plan of structure fft needs a convolution: pass fft_convolutions() of "
        "tactile_net::spectral, or plan without allow_fft");
  return convolution;
}

std::unique_ptr<Convolution> cloned(const std::unique_ptr<Convolution>& convolution) {
  return convolution ? convolution->clone() : nullptr;
}

/// Sum and first moment of f, about its middle. Of all of a line only for plans with a convolution,
/// which changes f after the product; without one the product returns them.
Moments moments_of(std::span<const double> f) noexcept {
  Moments moments;
  const double centre = 0.5 * static_cast<double>(f.size() - 1);
  for (std::size_t i = 0; i < f.size(); ++i) {
    moments.sum += f[i];
    moments.first += (static_cast<double>(i) - centre) * f[i];
  }
  return moments;
}

}  // namespace

ContactEstimator::ContactEstimator(const EstimatorPlan& plan, InstructionSet set)
    : ContactEstimator(plan, nullptr, set) {}

ContactEstimator::ContactEstimator(const EstimatorPlan& plan, const ConvolutionMaker& make,
                                   InstructionSet set) {
  check(plan);
  ready_ = std::make_shared<const Ready>(plan, set);
  scratch_ = std::make_unique<Scratch>(*ready_);
  scratch_->convolution = made(make, plan.reconstruction);
  if (plan.prediction) scratch_->prediction_convolution = made(make, *plan.prediction);
  std::copy(plan.baseline.begin(), plan.baseline.end(), scratch_->baseline.data());
}

ContactEstimator::ContactEstimator(const ContactEstimator& other)
    : ready_(other.ready_), scratch_(std::make_unique<Scratch>(*ready_)) {
  scratch_->convolution = cloned(other.scratch_->convolution);
  scratch_->prediction_convolution = cloned(other.scratch_->prediction_convolution);
  std::copy_n(other.scratch_->baseline.data(), readings(), scratch_->baseline.data());
  scratch_->work = other.scratch_->work;
  scratch_->loop.options = other.options();
  for (const std::size_t reading : other.scratch_->dead) set_dead(ready_->taxels[reading]);
}

ContactEstimator& ContactEstimator::operator=(const ContactEstimator& other) {
  if (this != &other) *this = ContactEstimator(other);
  return *this;
}

ContactEstimator::ContactEstimator(ContactEstimator&&) noexcept = default;
ContactEstimator& ContactEstimator::operator=(ContactEstimator&&) noexcept = default;
ContactEstimator::~ContactEstimator() = default;

std::size_t ContactEstimator::readings() const noexcept { return ready_->readings(); }
std::size_t ContactEstimator::tractions() const noexcept {
  return ready_->unknowns * ready_->values;
}
std::string_view ContactEstimator::label() const noexcept { return ready_->label; }
InstructionSet ContactEstimator::instruction_set() const noexcept { return ready_->set; }

void ContactEstimator::set_work(ConeWork work) noexcept {
  if (!ready_->cone) return;
  work.steps = std::min(work.steps > 0 ? work.steps : ready_->cone->steps, ConePlan::most_steps);
  if (!std::isgreater(work.enough, 0.0)) work.enough = 0.0;
  scratch_->work = work;
}
void ContactEstimator::stop_at(const std::atomic<bool>* flag) noexcept { scratch_->stop = flag; }
std::span<const double> ContactEstimator::free_tractions() const noexcept {
  return scratch_->cone ? scratch_->cone->free() : std::span<const double>{};
}

/// Brings the tractions inside the plan's constraints.
/// @param moments  of each traction of a line, anew; none of a skin
void ContactEstimator::constrain(ContactEstimate& estimate, std::span<Moments> moments) noexcept {
  const Ready& ready = *ready_;
  Scratch& scratch = *scratch_;
  struct Asked {
    const std::atomic<bool>* stop;
    double enough;  // of the distance
  } asked{scratch.stop, scratch.work.enough * ready.noise_rms};
  const bool each = asked.enough > 0.0;
  const auto look = [](void* context, std::size_t, double distance) {
    const auto* const of = static_cast<const Asked*>(context);
    return (of->stop != nullptr && of->stop->load(std::memory_order_relaxed)) ||
           distance <= of->enough;
  };
  if (!each) asked.enough = -1.0;
  const ConeScratch::Done done =
      scratch.cone->bind(*ready.cone, estimate.tractions, scratch.work.steps, each,
                         each || asked.stop != nullptr ? +look : nullptr, &asked);
  scratch.done = done;
  for (std::size_t u = 0; u < moments.size(); ++u)
    moments[u] = moments_of(estimate.tractions.subspan(u * ready.values, ready.values));
}

/// Of a line's tractions inside constraints, moments of the values that touch. Where none does they
/// are 0, or if the whole presses those of the linear frame.
std::span<const Moments> ContactEstimator::sum_touching(ContactEstimate& estimate,
                                                        bool presses) noexcept {
  const Ready& ready = *ready_;
  std::array<Moments, 2>& sums = scratch_->touching;
  const PlanCells& cells = *ready.line_cells;
  CellMarks& marks = scratch_->marks;
  estimate.touching = mark_cells(cells, estimate.tractions.data(), marks).cells;
  const double centre = 0.5 * static_cast<double>(ready.values - 1);
  for (std::size_t u = 0; u < ready.unknowns; ++u) {
    sums[u] = {};
    if (estimate.touching == 0 && presses)
      sums[u] = moments_of(scratch_->cone->free().subspan(u * ready.values, ready.values));
    if (estimate.touching == 0) continue;
    const double* const f = estimate.tractions.data() + u * ready.values;
    for (std::size_t i = 0; i < ready.values; ++i) {
      if (marks.marks[i] == 0) continue;
      sums[u].sum += f[i];
      sums[u].first += (static_cast<double>(i) - centre) * f[i];
    }
  }
  return sums;
}

/// @param moments  of each traction of a line; none of a skin
[[gnu::always_inline]] inline void ContactEstimator::add_resultant(
    ContactEstimate& estimate, std::span<const Moments> moments) noexcept {
  const Ready& ready = *ready_;
  estimate.force_deviation = ready.force_deviation;
  estimate.tangential_force = ContactEstimate::unknown;
  estimate.tangential_y = ContactEstimate::unknown;
  estimate.tangential_z = ContactEstimate::unknown;
  estimate.centre = ContactEstimate::unknown;
  estimate.centre_z = ContactEstimate::unknown;
  estimate.torsion = ContactEstimate::unknown;
  estimate.angle = ContactEstimate::unknown;
  estimate.friction_margin = ContactEstimate::unknown;
  estimate.slip_margin = ContactEstimate::unknown;
  estimate.margin_centre = ContactEstimate::unknown;
  estimate.margin_centre_z = ContactEstimate::unknown;
  estimate.space = {};
  estimate.contacts = 0;
  estimate.residual_rms = ContactEstimate::unknown;
  estimate.touching = 0;
  estimate.misfit = false;
  estimate.beyond_edge = false;
  estimate.baseline_moved = false;
  estimate.outlier = -1;
  estimate.unfinished = ContactEstimate::unknown;
  estimate.unfinished_share = ContactEstimate::unknown;
  estimate.steps = 0;
  estimate.rows_found = 0;
  estimate.age = 0;
  if (ready.cone) {
    estimate.steps = scratch_->done.steps;
    if (ready.noise_rms > 0.0) estimate.unfinished = scratch_->done.distance / ready.noise_rms;
  }
  if (ready.cells)
    return add_skin_resultant(*ready.cells, ready.space ? &*ready.space : nullptr, ready.unknowns,
                              estimate.tractions.data(),
                              ready.cone ? scratch_->cone->free().data() : nullptr, ready.friction,
                              ready.window_variances, ready.certain_force, ready.highest_force,
                              ready.lowest_force, scratch_->marks, estimate);
  // Of the linear frame: noise can only push inside constraints.
  double all = ready.spacing * moments[0].sum;
  if (ready.cone) {
    all = ready.spacing * moments_of(scratch_->cone->free().first(ready.values)).sum;
    if (ready.line_cells && !ready.line_cells->deviations.empty())
      moments = sum_touching(estimate, all > ready.certain_force);
  }
  const Moments& normal = moments[0];
  estimate.normal_force = ready.spacing * normal.sum;
  estimate.contact = estimate.normal_force > 0.0;
  estimate.pulls = all < ready.lowest_force;
  estimate.implausible = std::abs(all) > ready.highest_force;
  if (estimate.contact)
    estimate.centre = ready.centre + ready.spacing * (normal.first / normal.sum);
  if (ready.unknowns != 2) return;
  estimate.tangential_force = ready.spacing * moments[1].sum;
  if (estimate.contact)
    estimate.angle = std::atan2(estimate.tangential_force, estimate.normal_force);
  if (!ready.friction) return;
  estimate.friction_margin =
      *ready.friction * estimate.normal_force - std::abs(estimate.tangential_force);
  if (!estimate.contact) return;
  estimate.contacts = 1;
  estimate.margin_centre = estimate.centre;
  if (ready.loops.stretches(estimate.tractions.data(), ready.values, least_share) > 1)
    add_worst_margin(estimate);
}

/// The contacts one by one.
void ContactEstimator::add_rows(ContactEstimate& estimate) noexcept {
  const Ready& ready = *ready_;
  Scratch& scratch = *scratch_;
  if (!ready.cells)
    return add_line_rows(estimate.tractions, ready.values, ready.spacing, ready.centre,
                         ready.friction, ready.certain_force / ready.spacing, scratch.labels,
                         scratch.follower, estimate);
  if (estimate.touching > 0)
    return add_skin_rows(*ready.cells, ready.unknowns, estimate.tractions.data(), ready.friction,
                         ready.window_variances, scratch.marks, scratch.follower, estimate);
  // All cells together, or nothing.
  std::uint32_t* const labels = scratch.marks.queue.data();
  std::fill_n(labels, ready.values, estimate.contact ? 0 : ContactFollower::none);
  if (estimate.contact) {
    estimate.rows[0] = {.cells = ready.values,
                        .normal_force = estimate.normal_force,
                        .force_deviation = estimate.force_deviation,
                        .tangential_y = estimate.tangential_y,
                        .tangential_z = estimate.tangential_z,
                        .centre = estimate.centre,
                        .centre_z = estimate.centre_z,
                        .torsion = estimate.torsion,
                        .friction_margin = estimate.friction_margin,
                        .slip_margin = estimate.slip_margin};
    estimate.rows_found = 1;
  }
  scratch.follower.follow(estimate.rows.first(estimate.rows_found), labels);
}

/// Where several contacts lie apart, the margin of the one that needs the most friction.
void ContactEstimator::add_worst_margin(ContactEstimate& estimate) const noexcept {
  const Ready& ready = *ready_;
  const double* const p = estimate.tractions.data();
  const double* const q = p + ready.values;
  const LineContact worst =
      nearest_to_slipping(p, q, ready.values, ready.certain_force / ready.spacing);
  estimate.contacts = worst.contacts;
  if (worst.contacts < 2) return;
  const std::size_t size = worst.last - worst.first;
  const Moments normal = moments_of({p + worst.first, size});
  const double drag = std::abs(moments_of({q + worst.first, size}).sum);
  estimate.friction_margin = ready.spacing * (*ready.friction * normal.sum - drag);
  const double middle =
      0.5 * (static_cast<double>(worst.first + worst.last) - static_cast<double>(ready.values));
  estimate.margin_centre = ready.centre + ready.spacing * (middle + normal.first / normal.sum);
}

/// A frame that a product may take.
struct ContactEstimator::Input {
  double* x;                        // room for what the baseline leaves of it
  Difference difference{};          // of which the product is taken
  std::uint64_t limit = unlimited;  // that the product must hold it to
  bool saturated = false;
};

FrameStatus ContactEstimator::refused(std::span<const double> readings) const noexcept {
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (scratch_->weights[i] > 0.0 && !std::isfinite(readings[i])) return FrameStatus::not_finite;
  return FrameStatus::too_large;
}

/// @param stored  the product, or what follows it, needs x; else it may subtract by itself
[[gnu::always_inline]] inline FrameStatus ContactEstimator::make_input(
    std::span<const double> readings, bool stored, Input& input) noexcept {
  const Ready& ready = *ready_;
  Scratch& scratch = *scratch_;
  const Kernels& loops = ready.loops;
  const std::size_t n = ready.readings();
  double* const x = input.x;
  input.limit = std::bit_cast<std::uint64_t>(ready.limit);
  input.difference = {readings.data(), scratch.baseline.data()};
  if (stored || !scratch.unread.empty()) {
    if (loops.subtract(input.difference.a, input.difference.b, x, n) > input.limit &&
        scratch.unread.empty())
      return refused(readings);
    if (!scratch.unread.empty()) {
      for (const std::size_t i : scratch.unread) x[i] = 0.0;
      if (loops.largest(x, n) > input.limit) return refused(readings);
      input.difference = {x, scratch.zero.data()};
    }
    input.limit = unlimited;
  }

  input.saturated =
      ready.ranges && loops.outside(readings.data(), scratch.weights.data(), *ready.ranges, n);

  if (!scratch.dead.empty()) {
    fill_dead(x);  // with what may itself be too large
    if (loops.largest(x, n) > std::bit_cast<std::uint64_t>(ready.limit))
      return FrameStatus::too_large;
  }
  if (ready.fill_rows > 0) fill_planned(x);
  return FrameStatus::ok;
}

FrameStatus ContactEstimator::admit(std::span<const double> readings, double* x,
                                    bool& saturated) noexcept {
  Input input;
  input.x = x;
  const FrameStatus status = make_input(readings, true, input);
  saturated = input.saturated;
  return status;
}

FrameStatus ContactEstimator::update(std::span<const double> readings, ContactEstimate& estimate,
                                     double time) noexcept {
  LoopState& loop = scratch_->loop;
  const FlushedDenormals flushed(loop.options.flush_denormals);
  const FrameStatus status = update_frame(readings, estimate, time);
  loop.close(status, estimate);
  return status;
}

/// A frame by itself.
FrameStatus ContactEstimator::update_frame(std::span<const double> readings,
                                           ContactEstimate& estimate, double time) noexcept {
  const Ready& ready = *ready_;
  Scratch& scratch = *scratch_;
  const Kernels& loops = ready.loops;
  const std::size_t n = ready.readings();
  if (readings.size() != n || estimate.tractions.size() != tractions())
    return FrameStatus::wrong_size;

  double* const x = scratch.x.data();
  Input input{.x = x};
  const bool stored = ready.prediction || ready.product32 || scratch.convolution;
  if (const FrameStatus status = make_input(readings, stored, input); status != FrameStatus::ok)
    return status;

  double* const f = estimate.tractions.data();
  std::array<Moments, 2> each;
  const std::span<Moments> moments(each.data(), ready.blocks());
  if (ready.product64) {
    if (!loops.multiply64(*ready.product64, input.difference, f, scratch.product64.data(), 1.0,
                          moments, input.limit))
      return refused(readings);
    if (scratch.convolution) {
      scratch.convolution->add(x, f);
      for (std::size_t u = 0; u < ready.unknowns; ++u)
        moments[u] = moments_of({f + u * ready.values, ready.values});
    }
  } else {
    (void)loops.multiply32(*ready.product32, input.difference, f, scratch.product32.data(),
                           magnitude_of(loops, x, n), moments, unlimited);
  }

  estimate.time = time;
  estimate.saturated = input.saturated;
  if (ready.cone) constrain(estimate, moments);
  add_resultant(estimate, moments);
  if (!estimate.rows.empty()) add_rows(estimate);
  if (ready.prediction) {
    predict(x, scratch.predicted.data());
    judge(estimate, x, scratch.predicted.data());
  }
  return FrameStatus::ok;
}

void ContactEstimator::finish(ContactEstimate& estimate, std::span<Moments> moments,
                              const double* x, const double* explained) noexcept {
  if (ready_->cone) constrain(estimate, moments);
  add_resultant(estimate, moments);
  if (!estimate.rows.empty()) add_rows(estimate);
  if (explained != nullptr) judge(estimate, x, explained);
}

/// What the tractions explain of x.
void ContactEstimator::predict(const double* x, double* explained) noexcept {
  Scratch& scratch = *scratch_;
  (void)ready_->loops.multiply64(*ready_->prediction, {x, scratch.zero.data()}, explained,
                                 scratch.product64.data(), 1.0, {}, unlimited);
  if (scratch.prediction_convolution) scratch.prediction_convolution->add(x, explained);
}

/// The residual, and whether one reading stands out of it. Tikhonov's f is the most likely one if
/// W g is normal with covariance s^2 A^-1; then r_i^2 / A_ii is what the minimum of its functional,
/// (W g)'A(W g) = (W g)'r, falls by when reading i is left out, and never more than that minimum.
/// Studentised by what is left, which holds the regularisation's own misfit as well as noise: the
/// squares of r alone would call the foot of every noise-free contact an outlier.
void ContactEstimator::judge(ContactEstimate& estimate, const double* x,
                             const double* explained) noexcept {
  const Ready& ready = *ready_;
  Scratch& scratch = *scratch_;
  const std::size_t n = ready.readings();
  const Misfit misfit = ready.loops.misfit(x, explained, scratch.weights.data(),
                                           scratch.shares.data(), scratch.spread.data(), n);
  if (estimate.contact && estimate.normal_force > ready.certain_force && !ready.border.empty())
    estimate.beyond_edge = presses_at_border(estimate.tractions.first(ready.values), ready.border);
  estimate.baseline_moved = is_baseline_moved(x, misfit.size);
  estimate.residual_rms = std::sqrt(misfit.sum_of_squares / static_cast<double>(scratch.live));
  if (ready.cone && !ready.cone->unknown_offsets) {
    // (W g)' W K f0 = f0'P f0.
    const double energy = misfit.size - misfit.objective;
    if (energy > 0.0) estimate.unfinished_share = scratch.done.distance / std::sqrt(energy);
  }
  if (ready.residual_limit > 0.0) {
    // (W g)'(I - H)(W g) = |W r|^2 + alpha |L f|^2.
    const double smoothed = std::max(misfit.objective - misfit.sum_of_squares, 0.0);
    const double noise = ready.residual_limit * std::sqrt(static_cast<double>(scratch.live));
    estimate.misfit = std::sqrt(misfit.sum_of_squares) >
                      noise + std::sqrt(smoothed) + ready.accuracy * std::sqrt(misfit.size);
  }
  const double degrees = scratch.degrees - 1.0;
  if (!(degrees > 0.0)) return;
  // The prediction errs by at most e in the 2-norm: sum and shares are taken at their worst.
  const double size = std::sqrt(misfit.size);
  const double error = ready.accuracy * size;
  const auto largest = std::bit_cast<double>(misfit.largest);
  const double others = std::max((misfit.objective + error * size - largest) / degrees,
                                 ready.noise_rms * ready.noise_rms) +
                        error * error / least_pivot;
  if (!(largest > ready.outlier_limit * ready.outlier_limit * others)) return;
  const double* const spread = scratch.spread.data();
  estimate.outlier = std::find(spread, spread + n, largest) - spread;
}

/// Whether a constant is more than noise, and nearly all that a channel reads: a contact, unless it
/// is wider than the patch, presses on some taxels more than on others.
bool ContactEstimator::is_baseline_moved(const double* x, double all_squares) const noexcept {
  constexpr double nearly_all = 0.95;  // of a channel's sum of squares
  const Ready& ready = *ready_;
  const Scratch& scratch = *scratch_;
  const double least = ready.outlier_limit * ready.noise_rms;
  std::size_t first = 0;
  for (std::size_t channel = 0; channel < ready.channel_ends.size(); ++channel) {
    const std::size_t end = ready.channel_ends[channel];
    const double size = scratch.constants[channel];
    const double sum =
        ready.loops.dot(scratch.squared_weights.data() + first, x + first, end - first);
    if (size > 0.0 && std::abs(sum) > least * size) {
      const double most = sum * sum / (nearly_all * size * size);  // of a constant's squares
      double squares = ready.channel_ends.size() == 1 ? all_squares : 0.0;
      if (ready.channel_ends.size() > 1)
        for (std::size_t i = first; i < end && squares < most; ++i)
          squares += scratch.squared_weights[i] * x[i] * x[i];
      if (squares < most) return true;
    }
    first = end;
  }
  return false;
}

/// The readings that the plan itself leaves out, from what the others read.
void ContactEstimator::fill_planned(double* x) noexcept {
  const Ready& ready = *ready_;
  Scratch& scratch = *scratch_;
  const std::size_t n = ready.readings();
  for (std::size_t i = 0; i < ready.fill_rows; ++i)
    scratch.fill[i] = ready.loops.dot(ready.fill.data() + i * n, x, n);
  for (std::size_t i = 0; i < ready.fill_rows; ++i) x[scratch.unread[i]] = scratch.fill[i];
}

void ContactEstimator::fill_dead(double* x) noexcept {
  const Ready& ready = *ready_;
  Scratch& scratch = *scratch_;
  const std::size_t size = scratch.dead.size();
  const std::size_t stride = ready.most_dead;
  const std::size_t row = padded<double>(ready.readings());
  double* const u = scratch.filled.data();
  for (std::size_t i = size; i-- > 0;) {
    u[i] = -ready.loops.dot(scratch.dead_rows.data() + i * row, x, ready.readings());
    for (std::size_t k = i + 1; k < size; ++k) u[i] -= scratch.cholesky[k * stride + i] * u[k];
    u[i] /= scratch.cholesky[i * stride + i];
  }
  for (std::size_t i = 0; i < size; ++i) x[scratch.dead[i]] = u[i] / ready.weights[scratch.dead[i]];
}

/// The next rows of V and C, for a reading; false if the others do not predict it.
bool ContactEstimator::eliminate(std::size_t reading) noexcept {
  const Ready& ready = *ready_;
  Scratch& scratch = *scratch_;
  const std::size_t n = ready.readings();
  const std::size_t stride = ready.most_dead;
  const std::size_t row_size = padded<double>(n);
  const std::size_t i = scratch.dead.size();
  if (i == stride) return false;
  double* const row = scratch.dead_rows.data() + i * row_size;
  double* const factor = scratch.cholesky.data() + i * stride;
  const double w = ready.weights[reading];

  // Column `reading` of W^-1 H W, then that row of A, which is symmetric, times the weights.
  std::fill_n(scratch.x.data(), n, 0.0);
  scratch.x[reading] = 1.0;
  fill_planned(scratch.x.data());
  predict(scratch.x.data(), row);
  double pivot = 1.0 - row[reading];
  for (std::size_t j = 0; j < n; ++j) row[j] *= -ready.weights[j] * (ready.weights[j] / w);
  for (std::size_t k = 0; k < i; ++k) {
    const double* const before = scratch.dead_rows.data() + k * row_size;
    factor[k] = before[reading] / w;
    pivot -= factor[k] * factor[k];
    for (std::size_t j = 0; j < n; ++j) row[j] -= factor[k] * before[j];
  }
  if (!(pivot > least_pivot)) return false;
  factor[i] = std::sqrt(pivot);
  for (std::size_t j = 0; j < n; ++j) row[j] /= factor[i];
  return true;
}

bool ContactEstimator::set_dead(std::size_t taxel) noexcept {
  const Ready& ready = *ready_;
  Scratch& scratch = *scratch_;
  const std::size_t n = ready.readings();
  if (!ready.prediction || taxel >= ready.count) return false;
  const std::size_t before = scratch.dead.size();
  for (std::size_t d = 0; d < n; ++d) {
    if (ready.taxels[d] != taxel || !(scratch.weights[d] > 0.0)) continue;  // left out already
    const bool last = scratch.live == scratch.dead.size() - before + 1;
    if (last || !eliminate(d)) {
      scratch.dead.resize(before);  // rows beyond mean nothing
      return false;
    }
    scratch.dead.push_back(d);
  }
  for (std::size_t i = before; i < scratch.dead.size(); ++i) {
    const std::size_t d = scratch.dead[i];
    const double* const row = scratch.dead_rows.data() + i * padded<double>(n);
    for (std::size_t j = 0; j < n; ++j)
      if (ready.weights[j] > 0.0) {
        const double v = row[j] / ready.weights[j];
        scratch.remaining[j] -= v * v;
      }
    scratch.unread.push_back(d);
    scratch.weights[d] = 0.0;
  }
  scratch.share_out(ready);
  return true;
}

void ContactEstimator::revive() noexcept {
  Scratch& scratch = *scratch_;
  scratch.unread.resize(scratch.unread.size() - scratch.dead.size());
  scratch.dead.clear();
  scratch.revive(*ready_);
}

FrameStatus ContactEstimator::set_baseline(std::span<const double> readings) noexcept {
  if (readings.size() != ready_->readings()) return FrameStatus::wrong_size;
  FrameStatus status = FrameStatus::ok;
  for (std::size_t i = 0; i < readings.size() && status != FrameStatus::not_finite; ++i) {
    if (!(scratch_->weights[i] > 0.0) || is_baseline(readings[i])) continue;
    status = std::isfinite(readings[i]) ? FrameStatus::too_large : FrameStatus::not_finite;
  }
  if (status != FrameStatus::ok) return status;
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (is_baseline(readings[i])) scratch_->baseline[i] = readings[i];
  return status;
}

}  // namespace tactile_net
