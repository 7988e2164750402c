#include "tactile_net/inverse/thesis/dft_friction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "numeric/finite.hpp"
#include "numeric/named.hpp"
#include "tactile_net/sensing/sampled.hpp"

namespace tactile_net {
namespace {

constexpr double tolerated = 0.1;

/// Splits the misfit of the antisymmetric readings.
struct Misfit {
  /// Squared 2-norm of the part correlated between neighbours, which white noise does not produce.
  double shape = 0.0;
  double doubt = 0.0;  ///< three standard deviations of what white noise puts there by chance
  double noise = 0.0;  ///< standard deviation of the readings' noise
};

Misfit examine(std::span<const double> misfit) {
  const std::size_t half = misfit.size() / 2;  // the other half is its mirror image
  double power = 0.0;
  double steps = 0.0;
  for (std::size_t i = 0; i < half; ++i) power += 2.0 * misfit[i] * misfit[i];
  for (std::size_t i = 0; i + 1 < half; ++i) steps += std::pow(misfit[i + 1] - misfit[i], 2);
  const double count = static_cast<double>(std::max<std::size_t>(half, 1));
  return {std::max(power - steps, 0.0), 3.0 * steps / std::sqrt(count), std::sqrt(steps / count)};
}

/// `values` on a ring, blurred by a Gaussian of standard deviation `width` taxels: the DFT's
/// amplification of noise, at most exp(k depth), is gone when `width` is the depth.
std::vector<double> blurred(std::span<const double> values, double width) {
  const std::size_t n = values.size();
  std::vector<double> weights(n);
  for (std::size_t lag = 0; lag < n; ++lag)
    weights[lag] =
        std::exp(-0.5 * std::pow(static_cast<double>(std::min(lag, n - lag)) / width, 2));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<double> result(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) result[i] += weights[(i + n - j) % n] / sum * values[j];
  return result;
}

/// One contact that fills `width` taxels in the middle has its greatest traction, once blurred,
/// near the middle (a Gaussian keeps what has one hump at one hump), and 97 % of its force within
/// two standard deviations of its edges.
bool fills(std::span<const double> blurred, std::size_t width, double spread) {
  const std::size_t n = blurred.size();
  const double middle = 0.5 * (blurred[(n - 1) / 2] + blurred[n / 2]);
  if (middle < 0.5 * *std::max_element(blurred.begin(), blurred.end())) return false;
  const double edge = 0.5 * static_cast<double>(width) + 2.0 * spread;
  double outside = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    all += blurred[i];
    if (std::abs(centred(i, n)) > edge) outside += blurred[i];
  }
  return std::abs(outside) <= tolerated * all;
}

double square(std::span<const double> values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

constexpr Named<FrictionVerdict> friction_verdicts[] = {
    {FrictionVerdict::ok, "ok"},
    {FrictionVerdict::dft, "dft"},
    {FrictionVerdict::not_one_contact, "not_one_contact"},
    {FrictionVerdict::drag_in_noise, "drag_in_noise"},
    {FrictionVerdict::no_contact, "no_contact"}};

}  // namespace

std::string_view name(FrictionVerdict verdict) noexcept {
  return name_in<friction_verdicts>(verdict);
}

DftFriction::DftFriction(const SensorArray& array, const Material& material, double friction,
                         double gain_limit)
    : division_(array, material, gain_limit),
      friction_(friction),
      depth_(array.depths.front() / array.pitch),
      kernel_(sampled_kernel(channels(array).front(), Traction::tangential_y, material, array.count,
                             array.pitch)) {
  if (!std::isfinite(friction)) throw std::invalid_argument("friction must be finite");
}

/// Boxes that grow by a taxel on each side: the one whose drag explains the odd readings best.
DftFriction::Drag DftFriction::likeliest(std::span<const double> odd,
                                         std::span<const double> normal, double force) const {
  const std::size_t n = odd.size();
  Drag likeliest{.width = 0, .readings = std::vector<double>(n)};
  std::vector<double> sum(n);  // K2 * box of height 1
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t width = n % 2 == 0 ? 2 : 1; width <= n; width += 2) {
    const std::size_t first = (n - width) / 2;
    const auto add = [&](std::size_t source) {
      for (std::size_t i = 0; i < n; ++i) sum[i] += kernel_[i + n - 1 - source];
    };
    add(first);
    if (width > 1) add(n - 1 - first);
    const double height = friction_ * force / static_cast<double>(width);
    double misfit = 0.0;
    for (std::size_t i = 0; i < n; ++i) misfit += std::pow(odd[i] - height * sum[i], 2);
    // Without friction every width fits: then the one that holds nearly all of the normal force.
    if (friction_ == 0.0) {
      double inside = 0.0;
      for (std::size_t i = first; i < n - first; ++i) inside += normal[i];
      misfit = inside >= 0.99 * force ? static_cast<double>(width)
                                      : static_cast<double>(n) + force - inside;
    }
    if (misfit < least) {
      least = misfit;
      likeliest.width = width;
      for (std::size_t i = 0; i < n; ++i) likeliest.readings[i] = height * sum[i];
    }
  }
  return likeliest;
}

FrictionVerdict DftFriction::judge(std::span<const double> even, std::span<const double> rest,
                                   std::span<const double> normal, const Drag& drag) const {
  const std::size_t n = even.size();
  const bool one = fills(blurred(normal, depth_), friction_ == 0.0 ? n : drag.width, depth_);
  const Misfit misfit = examine(rest);
  // The model is as uncertain as the normal force, which the readings' sum gives.
  const double sum_of_readings = std::accumulate(even.begin(), even.end(), 0.0);
  const double force_doubt =
      3.0 * misfit.noise * std::sqrt(static_cast<double>(n)) / std::abs(sum_of_readings);
  const double size = square(friction_ == 0.0 ? even : std::span<const double>(drag.readings));
  const double allowed = tolerated * tolerated * size;
  const bool contradicted =
      misfit.shape > std::pow(tolerated + force_doubt, 2) * size + misfit.doubt;
  if (contradicted || (!one && force_doubt <= tolerated)) return FrictionVerdict::not_one_contact;
  if (misfit.shape + misfit.doubt > allowed || force_doubt > tolerated)
    return FrictionVerdict::drag_in_noise;
  return FrictionVerdict::ok;
}

FrictionSolution DftFriction::solve(std::span<const double> readings) {
  const std::size_t n = kernel_.size() / 2 + 1;
  if (readings.size() != n) return {.status = FrameStatus::wrong_size};
  if (!all_finite(readings)) return {.status = FrameStatus::not_finite};
  const FrictionSolution too_large{.status = FrameStatus::too_large};

  std::vector<double> even(n);
  std::vector<double> odd(n);
  for (std::size_t i = 0; i < n; ++i) {
    even[i] = 0.5 * (readings[i] + readings[n - 1 - i]);
    odd[i] = 0.5 * (readings[i] - readings[n - 1 - i]);
  }
  FrictionSolution solution{.normal = std::vector<double>(n), .tangential = std::vector<double>(n)};
  if (division_.solve(even, solution.normal) != FrameStatus::ok) return too_large;
  solution.dft = division_.verdict(even);
  const double force = std::accumulate(solution.normal.begin(), solution.normal.end(), 0.0);
  if (!(force > 0.0)) {
    if (division_.solve(readings, solution.normal) != FrameStatus::ok) return too_large;
    solution.verdict = FrictionVerdict::no_contact;
    return solution;
  }

  const Drag drag = likeliest(odd, solution.normal, force);
  const double height = friction_ * force / static_cast<double>(drag.width);
  if (!std::isfinite(height)) return too_large;  // also if the squares overflowed for every width
  std::vector<double> rest(readings.begin(), readings.end());
  for (std::size_t i = 0; i < n; ++i) {
    rest[i] -= drag.readings[i];
    odd[i] -= drag.readings[i];
  }
  solution.width = drag.width;
  solution.verdict = judge(even, odd, solution.normal, drag);
  if (solution.verdict == FrictionVerdict::ok && solution.dft != DftVerdict::ok)
    solution.verdict = FrictionVerdict::dft;

  if (division_.solve(rest, solution.normal) != FrameStatus::ok) return too_large;
  std::fill_n(solution.tangential.begin() + static_cast<std::ptrdiff_t>((n - drag.width) / 2),
              drag.width, height);
  return solution;
}

}  // namespace tactile_net
