#include "tactile_net/realtime/contact_estimator.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "realtime/kernels.hpp"

namespace tactile_net {
namespace {

/// Largest sum of magnitudes in a row: how far entries can grow.
double row_sum_norm(const Factor& factor) {
  double largest = 0.0;
  for (std::size_t i = 0; i < factor.rows; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < factor.columns; ++j)
      sum += std::abs(factor.values[i * factor.columns + j]);
    largest = std::max(largest, sum);
  }
  return largest;
}

/// A bound on every number that a product makes of entries <= 1, itself >= 1.
double growth(const ProductPlan& plan) {
  double most = 1.0;
  const std::size_t per_class = is_low_rank(plan.structure) ? 2 : 1;
  for (std::size_t i = 0; i < plan.factors.size(); i += per_class) {
    double size = 2.0;  // sums of two entries
    for (std::size_t k = 0; k < per_class; ++k) {
      size *= row_sum_norm(plan.factors[i + k]);
      most = std::max({most, size, size * plan.scale});
    }
  }
  return 2.0 * most;  // sums of two classes
}

/// For what was checked before. A dead reading that is filled in may be larger than any live one.
constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

}  // namespace

struct ContactEstimator::Ready {
  Ready(const EstimatorPlan& plan, InstructionSet chosen)
      : label(plan.label),
        count(plan.count),
        channels(plan.channels),
        unknowns(plan.unknowns),
        pitch(plan.pitch),
        friction(plan.friction_coefficient),
        ranges(plan.ranges),
        weights(plan.weights),
        noise_rms(plan.noise_rms),
        outlier_limit(plan.outlier_limit),
        set(std::min(chosen, widest_instruction_set())),
        loops(kernels(set)) {
    if (plan.reconstruction.precision == Precision::float64)
      product64.emplace(plan.reconstruction, loops.most_lines);
    else
      product32.emplace(plan.reconstruction, loops.most_lines);
    double most = growth(plan.reconstruction) * static_cast<double>(plan.tractions()) *
                  static_cast<double>(plan.count) * std::max(1.0, plan.pitch * plan.pitch);
    if (plan.prediction) {
      prediction.emplace(*plan.prediction, loops.most_lines);
      shares.resize(plan.readings());
      for (std::size_t i = 0; i < shares.size(); ++i) {
        shares[i] = 1.0 / (1.0 - plan.leverages[i]);
        degrees += weights[i] > 0.0 ? 1.0 - plan.leverages[i] : 0.0;
      }
      const double weight = *std::max_element(weights.begin(), weights.end());
      const double residual =
          2.0 * growth(*plan.prediction) * std::max(1.0, weight);  // its square must not overflow
      const double share = *std::max_element(shares.begin(), shares.end());
      most = std::max(most, residual);
      square_limit = std::sqrt(std::numeric_limits<double>::max() / share /
                               static_cast<double>(plan.readings())) /
                     residual;
    }
    limit = std::min(square_limit, std::numeric_limits<double>::max() / most);
  }

  [[nodiscard]] std::size_t readings() const noexcept { return channels * count; }

  std::string label;
  std::size_t count, channels, unknowns;
  double pitch;
  std::optional<double> friction;
  std::vector<ReadingRange> ranges;
  std::vector<double> weights;
  double noise_rms, outlier_limit;
  InstructionSet set;
  const Kernels& loops;
  std::optional<ReadyProduct<double>> product64;
  std::optional<ReadyProduct<float>> product32;
  std::optional<ReadyProduct<double>> prediction;
  std::vector<double> shares;  // 1 / (1 - h_i)
  double degrees = 0.0;        // of freedom that the tractions leave to the residual
  double square_limit = std::numeric_limits<double>::max();
  double limit = 0.0;  // of |g - baseline|
};

/// What one thread writes.
struct ContactEstimator::Scratch {
  explicit Scratch(const Ready& ready)
      : baseline(ready.readings()),
        zero(ready.readings()),
        x(ready.readings()),
        predicted(ready.prediction ? ready.readings() : 0),
        spread(ready.prediction ? ready.readings() : 0),
        weights(ready.readings()),
        product64(std::max(ready.product64 ? ready.product64->scratch_size() : 0,
                           ready.prediction ? ready.prediction->scratch_size() : 0)),
        product32(ready.product32 ? ready.product32->scratch_size() : 0),
        degrees(ready.degrees) {
    std::copy(ready.weights.begin(), ready.weights.end(), weights.data());
    for (const double weight : ready.weights)
      if (weight > 0.0) ++live;
    for (std::size_t i = 0; i < ready.readings(); ++i)
      if (ready.weights[i] == 0.0) unread.push_back(i);
    unread.reserve(ready.readings());
    if (ready.prediction) {
      const std::size_t most = most_dead_taxels * ready.channels;
      dead.reserve(most);
      dead_rows = Aligned<double>(most * padded<double>(ready.readings()));
      cholesky = Aligned<double>(most * most);
      filled = Aligned<double>(most);
    }
  }

  Aligned<double> baseline, zero, x, predicted, spread, weights;  // weights: 0 for what is dead
  Aligned<double> product64;
  Aligned<float> product32;
  std::vector<std::size_t> unread;  // readings that count for nothing, whatever they say
  std::size_t live = 0;             // readings with a weight
  double degrees;

  // Dead at run time: x_D = (I - H_DD)^-1 H_DL x_L, in weighted readings, by Cholesky.
  std::vector<std::size_t> dead;  // indices of readings
  Aligned<double> dead_rows;      // w_d H_dj / w_j ... as it acts on x
  Aligned<double> cholesky;       // lower, row-major, stride most
  Aligned<double> filled;
};

ContactEstimator::ContactEstimator(const EstimatorPlan& plan, InstructionSet set) {
  check(plan);
  ready_ = std::make_shared<const Ready>(plan, set);
  scratch_ = std::make_unique<Scratch>(*ready_);
}

ContactEstimator::ContactEstimator(const ContactEstimator& other)
    : ready_(other.ready_), scratch_(std::make_unique<Scratch>(*ready_)) {
  (void)set_baseline({other.scratch_->baseline.data(), readings()});
  for (const std::size_t reading : other.scratch_->dead) set_dead(reading % ready_->count);
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
  return ready_->unknowns * ready_->count;
}
std::string_view ContactEstimator::label() const noexcept { return ready_->label; }
InstructionSet ContactEstimator::instruction_set() const noexcept { return ready_->set; }

FrameStatus ContactEstimator::update(std::span<const double> readings, ContactEstimate& estimate,
                                     double time) noexcept {
  const Ready& ready = *ready_;
  Scratch& scratch = *scratch_;
  const Kernels& loops = ready.loops;
  const std::size_t n = ready.readings();
  const std::size_t count = ready.count;
  if (readings.size() != n || estimate.tractions.size() != tractions())
    return FrameStatus::wrong_size;

  double* const x = scratch.x.data();
  auto limit = std::bit_cast<std::uint64_t>(ready.limit);
  const auto refused = [&] {
    for (std::size_t i = 0; i < n; ++i)
      if (scratch.weights[i] > 0.0 && !std::isfinite(readings[i])) return FrameStatus::not_finite;
    return FrameStatus::too_large;
  };
  Difference input{readings.data(), scratch.baseline.data()};
  if (ready.prediction || ready.product32 || !scratch.unread.empty()) {
    if (loops.subtract(input.a, input.b, x, n) > limit && scratch.unread.empty()) return refused();
    if (!scratch.unread.empty()) {
      for (const std::size_t i : scratch.unread) x[i] = 0.0;
      if (loops.largest(x, n) > limit) return refused();
      input = {x, scratch.zero.data()};
    }
    limit = unlimited;
  }

  bool saturated = false;
  for (std::size_t c = 0; c < ready.ranges.size(); ++c)
    for (std::size_t i = c * count; i < (c + 1) * count; ++i)
      saturated |= scratch.weights[i] > 0.0 &&
                   !(readings[i] > ready.ranges[c].lowest && readings[i] < ready.ranges[c].highest);

  if (!scratch.dead.empty()) fill_dead();

  double* const f = estimate.tractions.data();
  std::array<Moments, 2> each;
  const std::span<Moments> moments(each.data(), ready.unknowns);
  if (ready.product64) {
    if (!loops.multiply64(*ready.product64, input, f, scratch.product64.data(), 1.0, moments,
                          limit))
      return refused();
  } else {
    // The power of two below the largest |x|; of its bits, the exponent.
    const std::uint64_t exponent = loops.largest(x, n) & 0x7ff0'0000'0000'0000U;
    const auto magnitude = std::bit_cast<double>(std::clamp(
        exponent, std::bit_cast<std::uint64_t>(0x1p-1021), std::bit_cast<std::uint64_t>(0x1p1021)));
    (void)loops.multiply32(*ready.product32, input, f, scratch.product32.data(), magnitude, moments,
                           unlimited);
  }

  const Moments& normal = each[0];
  estimate.time = time;
  estimate.normal_force = ready.pitch * normal.sum;
  estimate.tangential_force = ContactEstimate::unknown;
  estimate.centre = ContactEstimate::unknown;
  estimate.angle = ContactEstimate::unknown;
  estimate.friction_margin = ContactEstimate::unknown;
  estimate.residual_rms = ContactEstimate::unknown;
  estimate.contact = estimate.normal_force > 0.0;
  estimate.saturated = saturated;
  estimate.outlier = -1;
  if (estimate.contact) estimate.centre = ready.pitch * (normal.first / normal.sum);
  if (ready.unknowns == 2) {
    estimate.tangential_force = ready.pitch * each[1].sum;
    if (estimate.contact)
      estimate.angle = std::atan2(estimate.tangential_force, estimate.normal_force);
    if (ready.friction)
      estimate.friction_margin =
          *ready.friction * estimate.normal_force - std::abs(estimate.tangential_force);
  }
  if (ready.prediction) judge(estimate);
  return FrameStatus::ok;
}

/// The residual, and whether one reading stands out of it: by its externally studentised residual
/// (Cook and Weisberg 1982, 2.2), whose noise is that of the other readings.
void ContactEstimator::judge(ContactEstimate& estimate) noexcept {
  const Ready& ready = *ready_;
  Scratch& scratch = *scratch_;
  const std::size_t n = ready.readings();
  (void)ready.loops.multiply64(*ready.prediction, {scratch.x.data(), scratch.zero.data()},
                               scratch.predicted.data(), scratch.product64.data(), 1.0, {},
                               unlimited);
  const Misfit misfit =
      ready.loops.misfit(scratch.x.data(), scratch.predicted.data(), scratch.weights.data(),
                         ready.shares.data(), scratch.spread.data(), n);
  estimate.residual_rms =
      scratch.live > 0 ? std::sqrt(misfit.sum_of_squares / static_cast<double>(scratch.live)) : 0.0;
  const double degrees = scratch.degrees - 1.0;
  if (!(degrees > 0.0)) return;
  const double largest = std::bit_cast<double>(misfit.largest);
  const double others =
      std::max((misfit.sum_of_squares - largest) / degrees, ready.noise_rms * ready.noise_rms);
  if (!(largest > ready.outlier_limit * ready.outlier_limit * others)) return;
  const double* const spread = scratch.spread.data();
  estimate.outlier = std::find(spread, spread + n, largest) - spread;
}

void ContactEstimator::fill_dead() noexcept {
  const Ready& ready = *ready_;
  Scratch& scratch = *scratch_;
  const std::size_t size = scratch.dead.size();
  const std::size_t stride = most_dead_taxels * ready.channels;
  const std::size_t row = padded<double>(ready.readings());
  double* const u = scratch.filled.data();
  for (std::size_t i = 0; i < size; ++i) {
    u[i] = ready.loops.dot(scratch.dead_rows.data() + i * row, scratch.x.data(), ready.readings());
    for (std::size_t k = 0; k < i; ++k) u[i] -= scratch.cholesky[i * stride + k] * u[k];
    u[i] /= scratch.cholesky[i * stride + i];
  }
  for (std::size_t i = size; i-- > 0;) {
    for (std::size_t k = i + 1; k < size; ++k) u[i] -= scratch.cholesky[k * stride + i] * u[k];
    u[i] /= scratch.cholesky[i * stride + i];
  }
  for (std::size_t i = 0; i < size; ++i)
    scratch.x[scratch.dead[i]] = u[i] / ready.weights[scratch.dead[i]];
}

bool ContactEstimator::set_dead(std::size_t taxel) noexcept {
  const Ready& ready = *ready_;
  Scratch& scratch = *scratch_;
  const std::size_t n = ready.readings();
  if (!ready.prediction || taxel >= ready.count) return false;
  const std::size_t before = scratch.dead.size();
  const std::size_t stride = most_dead_taxels * ready.channels;
  const std::size_t row_size = padded<double>(n);
  for (std::size_t c = 0; c < ready.channels; ++c) {
    const std::size_t d = c * ready.count + taxel;
    if (scratch.weights[d] == 0.0) continue;  // left out already
    const std::size_t i = scratch.dead.size();
    bool predicted = i < stride;
    if (predicted) {
      // Row d of W H W^-1, which is symmetric, from column d of H.
      std::fill_n(scratch.x.data(), n, 0.0);
      scratch.x[d] = 1.0;
      double* const row = scratch.dead_rows.data() + i * row_size;
      (void)ready.loops.multiply64(*ready.prediction, {scratch.x.data(), scratch.zero.data()}, row,
                                   scratch.product64.data(), 1.0, {}, unlimited);
      const double w = ready.weights[d];
      double* const factor = scratch.cholesky.data() + i * stride;
      for (std::size_t k = 0; k < i; ++k) {
        const std::size_t e = scratch.dead[k];
        factor[k] = -ready.weights[e] * row[e] / w;
      }
      double pivot = 1.0 - row[d];
      for (std::size_t k = 0; k < i; ++k) {
        for (std::size_t m = 0; m < k; ++m)
          factor[k] -= factor[m] * scratch.cholesky[k * stride + m];
        factor[k] /= scratch.cholesky[k * stride + k];
        pivot -= factor[k] * factor[k];
      }
      // u_d = sum_j w_d H_dj x_j = sum_j w_j^2 H_jd x_j / w_d; fill_dead sums while dead x are 0.
      for (std::size_t j = 0; j < n; ++j) row[j] *= ready.weights[j] * (ready.weights[j] / w);
      predicted = pivot > least_pivot;
      factor[i] = std::sqrt(pivot);
    }
    if (!predicted) {  // as before: rows already written beyond `before` mean nothing
      while (scratch.dead.size() > before) {
        const std::size_t undone = scratch.dead.back();
        scratch.weights[undone] = ready.weights[undone];
        scratch.unread.pop_back();
        scratch.degrees += 1.0;
        ++scratch.live;
        scratch.dead.pop_back();
      }
      return false;
    }
    scratch.dead.push_back(d);
    scratch.unread.push_back(d);
    scratch.weights[d] = 0.0;
    scratch.degrees -= 1.0;
    --scratch.live;
  }
  return true;
}

void ContactEstimator::revive() noexcept {
  const Ready& ready = *ready_;
  Scratch& scratch = *scratch_;
  for (const std::size_t d : scratch.dead) {
    scratch.weights[d] = ready.weights[d];
    scratch.degrees += 1.0;
    ++scratch.live;
  }
  scratch.unread.resize(scratch.unread.size() - scratch.dead.size());
  scratch.dead.clear();
}

FrameStatus ContactEstimator::set_baseline(std::span<const double> readings) noexcept {
  if (readings.size() != ready_->readings()) return FrameStatus::wrong_size;
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (ready_->weights[i] > 0.0 && !std::isfinite(readings[i])) return FrameStatus::not_finite;
  std::copy(readings.begin(), readings.end(), scratch_->baseline.data());
  return FrameStatus::ok;
}

FrameStatus ContactEstimator::update_batch(std::span<const double> readings,
                                           std::span<ContactEstimate> estimates) noexcept {
  const std::size_t n = ready_->readings();
  if (readings.size() != n * estimates.size()) return FrameStatus::wrong_size;
  for (const ContactEstimate& estimate : estimates)
    if (estimate.tractions.size() != tractions()) return FrameStatus::wrong_size;
  FrameStatus first = FrameStatus::ok;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const FrameStatus status = update(readings.subspan(i * n, n), estimates[i], estimates[i].time);
    if (first == FrameStatus::ok) first = status;
  }
  return first;
}

}  // namespace tactile_net
