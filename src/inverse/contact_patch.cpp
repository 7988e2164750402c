#include "tactile_net/inverse/contact_patch.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "inverse/contact_sizes.hpp"
#include "realtime/line_contacts.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t wrench_values = 6;
constexpr std::size_t place_of_centre = 3;
constexpr std::size_t place_of_torsion = 5;

/// Standard deviation of a sum of a wrench's values. Correlations, unlike covariances, are numbers
/// in any unit.
double deviation_of(const UncertainWrench& wrench,
                    const std::array<double, wrench_values>& gradient) {
  const auto own = [](const std::optional<Uncertain>& one) { return one ? one->deviation : 0.0; };
  const std::array<double, wrench_values> deviations{
      wrench.normal.deviation, own(wrench.tangential_y), own(wrench.tangential_z),
      own(wrench.centre_y),    own(wrench.centre_z),     own(wrench.torsion)};
  std::array<double, wrench_values> parts{};
  double largest = 0.0;
  for (std::size_t i = 0; i < wrench_values; ++i) {
    parts[i] = gradient[i] * deviations[i];
    largest = std::max(largest, std::abs(parts[i]));
  }
  if (!(largest > 0.0)) return 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < wrench_values; ++i)
    for (std::size_t j = 0; j < wrench_values; ++j) {
      if (parts[i] == 0.0 || parts[j] == 0.0) continue;
      const double correlation =
          i == j ? 1.0 : wrench.covariance[wrench_values * i + j] / deviations[i] / deviations[j];
      if (std::isfinite(correlation))
        sum += parts[i] / largest * std::clamp(correlation, -1.0, 1.0) * (parts[j] / largest);
    }
  return largest * std::sqrt(std::max(sum, 0.0));
}

/// Size and direction of a drag.
struct Drag {
  double size, along_y, along_z;
};

Drag drag_in(const UncertainWrench& wrench) {
  const double y = wrench.tangential_y->value;
  const double z = wrench.tangential_z ? wrench.tangential_z->value : 0.0;
  const double size = std::hypot(y, z);
  return size > 0.0 ? Drag{size, y / size, z / size} : Drag{0.0, 1.0, 0.0};
}

UncertainWrench wrench_of(const UncertainResultant& resultant) {
  UncertainWrench wrench{.normal = resultant.normal,
                         .tangential_y = resultant.tangential,
                         .centre_y = resultant.centre};
  constexpr std::array<std::size_t, 3> place{0, 1, place_of_centre};
  for (std::size_t i = 0; i < place.size(); ++i)
    for (std::size_t j = 0; j < place.size(); ++j)
      wrench.covariance[wrench_values * place[i] + place[j]] = resultant.covariance[3 * i + j];
  return wrench;
}

/// Of a line's drag over its force, by the angle's: where drags to either side are possible, up to
/// the larger one.
CentralInterval friction_interval(const CentralInterval& angle) {
  const double left = std::tan(angle.low);
  const double right = std::tan(angle.high);
  const bool either = left < 0.0 && right > 0.0;
  return {.level = angle.level,
          .low = either ? 0.0 : std::min(std::abs(left), std::abs(right)),
          .high = std::max(std::abs(left), std::abs(right))};
}

/// The variance of the place where values press [m^2]; not > 0: they have none.
double variance_of_place(std::span<const double> p, std::size_t first, const Surface& surface,
                         double centre) {
  double sum = 0.0;
  double squares = 0.0;
  const double largest = *std::max_element(p.begin(), p.end());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double apart = surface.position(first + i) - centre;
    sum += p[i] / largest;
    squares += p[i] / largest * apart * apart;
  }
  return squares / sum;
}

}  // namespace

Uncertain drag_of(const UncertainWrench& wrench) {
  const Drag drag = drag_in(wrench);
  if (drag.size > 0.0) return {drag.size, deviation_of(wrench, {0.0, drag.along_y, drag.along_z})};
  return {0.0, std::max(wrench.tangential_y->deviation,
                        wrench.tangential_z ? wrench.tangential_z->deviation : 0.0)};
}

void judge_slip(ContactPatch& patch, std::optional<double> limit) {
  if (limit && !(*limit > 0.0)) throw std::invalid_argument("friction limit must be > 0");
  patch.friction.reset();
  patch.slip_margin.reset();
  const UncertainWrench& wrench = patch.wrench;
  const double force = wrench.normal.value;
  if (!wrench.tangential_y || !(force > 0.0)) return;
  const Drag drag = drag_in(wrench);
  const double ratio = drag.size / force;
  std::array<double, wrench_values> gradient{-ratio / force, drag.along_y / force,
                                             drag.along_z / force};
  patch.friction = {ratio, deviation_of(wrench, gradient)};
  if (!limit) return;
  const double slide = ratio / *limit;
  const double most = *limit * patch.lever;
  const double twist = wrench.torsion && most > 0.0 ? wrench.torsion->value / most : 0.0;
  const double used = std::hypot(slide, twist);
  for (double& one : gradient) one *= used > 0.0 ? -slide / used / *limit : 0.0;
  if (twist != 0.0) gradient[place_of_torsion] = -twist / used / most;
  patch.slip_margin = {1.0 - used, deviation_of(wrench, gradient)};
}

void add_friction_interval(ContactPatch& patch, const CentralInterval& friction,
                           std::optional<double> limit) {
  if (patch.friction) patch.friction->interval = friction;
  const bool twists = patch.wrench.torsion && patch.wrench.torsion->value != 0.0;
  if (patch.slip_margin && limit && !twists)
    patch.slip_margin->interval = CentralInterval{.level = friction.level,
                                                  .low = 1.0 - friction.high / *limit,
                                                  .high = 1.0 - friction.low / *limit};
}

std::vector<ContactPatch> patches_of(const Surface& surface, std::span<const double> tractions,
                                     const Covariance& covariance, double noise_rms,
                                     const UncertainResultant& whole, const PatchOptions& options) {
  const std::size_t n = surface.count;
  std::vector<ContactPatch> patches;
  if (!(whole.normal.value > deviations_that_press * whole.normal.deviation)) return patches;
  const double* const p = tractions.data();
  const double limit = least_share * *std::max_element(p, p + n);
  const auto add = [&](std::size_t first, std::size_t last, const UncertainResultant& resultant) {
    ContactPatch patch;
    for (std::size_t i = first; i < last; ++i)
      if (p[i] > limit) patch.cells.push_back(i);
    patch.wrench = wrench_of(resultant);
    judge_slip(patch, options.friction_limit);
    if (resultant.angle && resultant.angle->interval)
      add_friction_interval(patch, friction_interval(*resultant.angle->interval),
                            options.friction_limit);
    const std::span<const double> own = tractions.subspan(first, last - first);
    if (const auto extent = extent_of(own, surface.spacing); extent && resultant.centre) {
      std::vector<double> gradient(tractions.size());
      std::copy(extent->gradient.begin(), extent->gradient.end(),
                gradient.begin() + static_cast<std::ptrdiff_t>(first));
      const Uncertain length{extent->value, covariance.deviation(gradient) * noise_rms};
      const double variance = variance_of_place(own, first, surface, resultant.centre->value);
      patch.extent =
          down_to(length, length.value * share_without(variance, options.smoothed_variance),
                  options.is_mean);
    }
    patches.push_back(std::move(patch));
  };
  const ResultantBetween between =
      options.between ? options.between : [&](std::size_t first, std::size_t last) {
        return resultant_between(first, last, surface, tractions, covariance, noise_rms);
      };
  // It throws nothing: what may is called behind it.
  std::vector<std::pair<std::size_t, std::size_t>> stretches;
  stretches.reserve(n);
  for_each_contact(
      p, n, deviations_of_part * whole.normal.deviation / surface.spacing,
      [&](std::size_t first, std::size_t last) { stretches.emplace_back(first, last); });
  if (stretches.size() < 2) stretches.assign(1, {0, n});
  for (const auto& [first, last] : stretches)
    add(first, last, stretches.size() == 1 ? whole : between(first, last));
  std::stable_sort(patches.begin(), patches.end(), [](const auto& a, const auto& b) {
    return a.wrench.normal.value > b.wrench.normal.value;
  });
  return patches;
}

const ContactPatch* nearest_to_slipping(std::span<const ContactPatch> patches) {
  double strongest = 0.0;
  for (const ContactPatch& patch : patches)
    strongest = std::max(strongest, patch.wrench.normal.value);
  const auto is_nearer = [](const ContactPatch& a, const ContactPatch& b) {
    return a.slip_margin && b.slip_margin ? a.slip_margin->value < b.slip_margin->value
                                          : a.friction->value > b.friction->value;
  };
  const ContactPatch* nearest = nullptr;
  for (const ContactPatch& patch : patches)
    if (patch.friction && patch.wrench.normal.value > least_share * strongest &&
        (nearest == nullptr || is_nearer(patch, *nearest)))
      nearest = &patch;
  return nearest;
}

}  // namespace tactile_net
