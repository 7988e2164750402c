#include "skin/part_quadrature.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>
#include <utility>

namespace tactile_net {
namespace {

using std::numbers::pi;

constexpr std::size_t first_angles = 8;
constexpr std::size_t most_levels = 16;                    // 8 * 2^15 angles
constexpr std::size_t most_points = std::size_t{1} << 26;  // for one taxel and part
constexpr int most_halvings = 24;
constexpr double ring_share = 1.0 / 32.0;   // of the tolerance, for the rings of a panel
constexpr double panel_share = 1.0 / 32.0;  // and for the panel

/// A point of the way from the middle to the rim: s, and the weight of its ring's mean in the
/// integral, per dt.
struct Ring {
  double s;
  double weight;
};

Ring ring_at(DiscProfile profile, double t) noexcept {
  switch (profile) {
    case DiscProfile::sphere:
      return {std::sin(t), 3.0 * std::cos(t) * std::cos(t) * std::sin(t)};
    case DiscProfile::punch:
      return {std::sin(t), std::sin(t)};
    case DiscProfile::cone: {
      const double s = 1.0 / std::cosh(t);
      return {s, 2.0 * t * s * s * std::tanh(t)};
    }
  }
  return {};
}

/// The t of s in [0, 1]; a cone's rings end where all that is left is below rounding.
constexpr double cone_end = 21.0;
double t_at(DiscProfile profile, double s) noexcept {
  if (profile != DiscProfile::cone) return std::asin(std::min(s, 1.0));
  return s < 1e-9 ? cone_end : std::min(cone_end, std::acosh(1.0 / std::min(s, 1.0)));
}

/// Borders of panels that shrink towards the ring s below the taxel, down to `finest`.
std::vector<double> borders(DiscProfile profile, double s, double finest) {
  std::vector<double> t = {t_at(profile, 0.0), t_at(profile, 1.0)};
  const auto add = [&](double at) {
    if (at > 0.0 && at < 1.0) t.push_back(t_at(profile, at));
  };
  add(s);
  for (double distance = finest; distance < 1.0 + s; distance *= 4.0) {
    add(s - distance);
    add(s + distance);
  }
  if (profile == DiscProfile::cone)
    for (const double middle : {1.5, 4.0, 9.0}) t.push_back(middle);
  std::sort(t.begin(), t.end());
  t.erase(std::unique(t.begin(), t.end()), t.end());
  return t;
}

}  // namespace

struct PartQuadrature::Taxel {
  const LoadPart& part;
  double y, z;  // from the middle [m]
  double s;     // of the ring below
  std::span<const Quantity> quantities;
  std::span<const double> tolerances;

  /// Whether every difference is at most a share of its tolerance.
  [[nodiscard]] bool agree(const Values& a, const Values& b, double share) const noexcept {
    for (std::size_t q = 0; q < quantities.size(); ++q)
      if (!(std::abs(a[q] - b[q]) <= share * tolerances[q])) return false;
    return true;
  }
};

PartQuadrature::PartQuadrature(PointLoads kernel, double length)
    : kernel_(std::move(kernel)), length_(length) {}

void PartQuadrature::add_ring_points(const Taxel& taxel, double s, std::size_t level, Values& sum) {
  while (angles_.size() <= level) {
    // 8 angles, then those half way between all before.
    const std::size_t own = first_angles << (angles_.empty() ? 0 : angles_.size() - 1);
    const double offset = angles_.empty() ? 0.0 : 0.5;
    std::vector<SurfaceVector> points(own);
    for (std::size_t i = 0; i < own; ++i) {
      const double angle = 2.0 * pi * (static_cast<double>(i) + offset) / static_cast<double>(own);
      points[i] = {std::cos(angle), std::sin(angle)};
    }
    angles_.push_back(std::move(points));
  }
  const LoadPart& part = taxel.part;
  const bool twists = part.torsion != 0.0;
  const std::vector<SurfaceVector>& own = angles_[level];
  const std::size_t count = own.size();
  points_ += count;
  for (auto* buffer : {&y_, &z_, &values_}) buffer->resize(count);
  if (twists) twist_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [y, z] = part.from_middle(s * own[i].y, s * own[i].z);
    y_[i] = taxel.y - y;
    z_[i] = taxel.z - z;
    if (twists) twist_[i] = part.twist(s * own[i].y, s * own[i].z);
  }
  for (std::size_t q = 0; q < taxel.quantities.size(); ++q)
    for (const Traction component : skin_tractions) {
      const double force = part.force[static_cast<std::size_t>(component)];
      const bool is_normal = component == Traction::normal;
      if (force == 0.0 && (!twists || is_normal)) continue;
      kernel_(taxel.quantities[q], component, y_, z_, values_);
      double own_sum = 0.0;
      if (twists)
        for (std::size_t i = 0; i < count; ++i)
          own_sum += values_[i] * (component == Traction::tangential_y ? twist_[i].y : twist_[i].z);
      else
        for (const double value : values_) own_sum += value;
      sum[q] += twists ? own_sum : own_sum * force;
    }
}

void PartQuadrature::ring(const Taxel& taxel, double s, double share, Values& mean) {
  const LoadPart& part = taxel.part;
  // Angles no further apart than the kernel is wide, so that none of it can be missed.
  const double nearest = std::hypot(length_, std::min(part.a, part.b) * std::abs(s - taxel.s));
  const double wanted = 1.0 + s * std::max(part.a, part.b) / nearest;
  Values sum{};
  std::size_t level = 0;
  auto count = static_cast<double>(first_angles);
  add_ring_points(taxel, s, 0, sum);
  const auto refine = [&] {
    add_ring_points(taxel, s, ++level, sum);
    count *= 2.0;
  };
  while (count < static_cast<double>(first_angles) * wanted && level + 2 < most_levels) refine();
  const auto means = [&] {
    Values result{};
    for (std::size_t q = 0; q < taxel.quantities.size(); ++q) result[q] = sum[q] / count;
    return result;
  };
  mean = means();
  for (Values before;;) {
    before = mean;
    refine();
    mean = means();
    if (taxel.agree(before, mean, share)) return;
    if (level + 1 == most_levels || points_ > most_points) {
      converged_ = false;
      return;
    }
  }
}

void PartQuadrature::panel(const Taxel& taxel, double from, double to, int halvings, Values& sum) {
  using Kronrod = boost::math::quadrature::gauss_kronrod<double, 21>;
  using Gauss = boost::math::quadrature::gauss<double, 10>;
  const double centre = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  Values fine{};
  Values coarse{};
  for (std::size_t i = 0; i < Kronrod::abscissa().size() && converged_; ++i)
    for (const double sign : {-1.0, 1.0}) {
      if (i == 0 && sign > 0.0) continue;  // the middle
      const auto [s, weight] =
          ring_at(taxel.part.profile, centre + sign * half * Kronrod::abscissa()[i]);
      Values mean;
      ring(taxel, s, ring_share / (weight * (to - from)), mean);
      for (std::size_t q = 0; q < taxel.quantities.size(); ++q) {
        fine[q] += half * weight * mean[q] * Kronrod::weights()[i];
        if (i % 2 == 1) coarse[q] += half * weight * mean[q] * Gauss::weights()[i / 2];
      }
    }
  if (!converged_) return;
  if (taxel.agree(fine, coarse, panel_share)) {
    for (std::size_t q = 0; q < taxel.quantities.size(); ++q) sum[q] += fine[q];
    return;
  }
  if (halvings == 0) {
    converged_ = false;
    return;
  }
  panel(taxel, from, centre, halvings - 1, sum);
  panel(taxel, centre, to, halvings - 1, sum);
}

bool PartQuadrature::add(const LoadPart& part, double y, double z, std::span<const Quantity> wanted,
                         std::span<const double> tolerances, std::span<double> readings) {
  const auto [u, v] = part.inside(y, z);
  const Taxel taxel{part, y - part.y, z - part.z, std::hypot(u, v), wanted, tolerances};
  points_ = 0;
  converged_ = true;
  Values sum{};
  const double outside = std::min(part.a, part.b) * std::max(0.0, taxel.s - 1.0);
  const double finest = std::hypot(length_, outside) / std::max(part.a, part.b);
  const std::vector<double> t = borders(part.profile, std::min(taxel.s, 1.0), finest);
  for (std::size_t i = 0; i + 1 < t.size() && converged_; ++i)
    panel(taxel, t[i], t[i + 1], most_halvings, sum);
  if (converged_)
    for (std::size_t q = 0; q < wanted.size(); ++q) readings[q] += sum[q];
  return converged_;
}

}  // namespace tactile_net
