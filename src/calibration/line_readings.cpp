#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "calibration/indenter_transform.hpp"
#include "calibration/pad_readings.hpp"
#include "calibration/wave_nodes.hpp"
#include "elasticity/stress_amplitudes.hpp"
#include "numeric/dual.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

using Amplitude = Dual<3>;  // by depth, thickness and nu

/// Presses that are gone through at once: what is kept of them stays in the cache.
constexpr std::size_t presses_at_once = 32;

/// Enough for presses and arrays that reach 2900 depths.
constexpr double most_line_panels = 4000.0;

/// The pad's transform of one component's load, for one quantity.
Amplitude amplitude(Quantity quantity, Traction component, const Material& material, double depth,
                    double k) {
  const Amplitude x = Amplitude::seed(depth, 0);
  const Amplitude nu = Amplitude::seed(material.poisson_ratio, 2);
  if (!material.layer || k * (material.layer->thickness - depth) > 400.0)
    return read(quantity, half_plane_amplitudes(component, k * x), nu, material.youngs_modulus);
  const Amplitude h = Amplitude::seed(material.layer->thickness, 1);
  const LayerFunctionsOf<Amplitude> f(h, x, k);
  return read(quantity,
              material.layer->base == Base::bonded ? bonded_amplitudes(component, nu, f)
                                                   : frictionless_amplitudes(component, f),
              nu, material.youngs_modulus);
}

/// Sites that share a transform: one quantity at one depth.
struct Group {
  Quantity quantity = Quantity::stress_x;
  double depth = 0.0;
  std::vector<std::size_t> sites{};
};

std::vector<Group> groups_of(std::span<const Site> sites) {
  std::map<std::pair<Quantity, double>, std::vector<std::size_t>> alike;
  for (std::size_t i = 0; i < sites.size(); ++i)
    alike[{sites[i].quantity, sites[i].depth}].push_back(i);
  std::vector<Group> groups;
  for (auto& [key, indices] : alike) groups.push_back({key.first, key.second, std::move(indices)});
  return groups;
}

/// The factors of cos(k y) and sin(k y), presses x nodes.
struct PressWaves {
  RowMajor cosine, sine;
  void resize(std::size_t presses, std::size_t nodes) {
    cosine.resize(static_cast<Eigen::Index>(presses), static_cast<Eigen::Index>(nodes));
    sine.resizeLike(cosine);
  }
};

/// What one group adds to the readings of a presses_at_once of presses.
class GroupReadings {
 public:
  GroupReadings(const Group& group, const Material& material, double depth, double farthest,
                std::span<const double> places)
      : group_(group), nodes_(depth, farthest, material, most_line_panels), places_(places) {
    const std::size_t n = nodes_.k.size();
    normal_.resize(n);
    tangential_.resize(n);
    cosine_.resize(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(group.sites.size()));
    sine_.resizeLike(cosine_);
    for (std::size_t i = 0; i < n; ++i) {
      const double k = nodes_.k[i];
      normal_[i] = amplitude(group.quantity, Traction::normal, material, depth, k);
      tangential_[i] = amplitude(group.quantity, Traction::tangential_y, material, depth, k);
      for (std::size_t j = 0; j < group.sites.size(); ++j) {
        const double angle = k * places[group.sites[j]];
        cosine_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = std::cos(angle);
        sine_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = std::sin(angle);
      }
    }
  }

  /// @param depth_factor, thickness_factor  of the derivatives by the logarithms
  void add(std::span<const PressState> presses, std::size_t first, bool with_derivatives,
           double depth_factor, double thickness_factor, bool tied, PressReadings& out) {
    const std::size_t n = nodes_.k.size();
    std::vector<double> phi(presses.size() * n);
    std::vector<double> slope(with_derivatives ? phi.size() : 0);
    PressWaves turn;  // cos(k c), sin(k c)
    turn.resize(presses.size(), n);
    for (std::size_t p = 0; p < presses.size(); ++p) {
      const double a = std::exp(presses[p].log_half_width);
      const double force = std::exp(presses[p].log_force);
      for (std::size_t i = 0; i < n; ++i) {
        const double k = nodes_.k[i];
        const IndenterTransform load = indenter_transform(presses[p].shape, k * a);
        const double scale = force * nodes_.weight[i];
        phi[p * n + i] = scale * load.value;
        if (with_derivatives) slope[p * n + i] = scale * load.slope * k * a;
        const auto row = static_cast<Eigen::Index>(p);
        const auto column = static_cast<Eigen::Index>(i);
        turn.cosine(row, column) = std::cos(k * presses[p].center);
        turn.sine(row, column) = std::sin(k * presses[p].center);
      }
    }
    const auto sum = [&](std::span<const double> load, auto normal, auto tangential, auto times_k,
                         Matrix& to) {
      waves_.resize(presses.size(), n);
      const bool odd = is_odd(group_.quantity, Traction::normal);
      for (std::size_t p = 0; p < presses.size(); ++p)
        for (std::size_t i = 0; i < n; ++i) {
          const double direct = normal(i);
          const double dragged = tangential(i, presses[p].friction);
          const double even = load[p * n + i] * (odd ? dragged : direct);
          const double sine = load[p * n + i] * (odd ? direct : dragged);
          const auto row = static_cast<Eigen::Index>(p);
          const auto column = static_cast<Eigen::Index>(i);
          const double c = turn.cosine(row, column);
          const double s = turn.sine(row, column);
          const double in_phase = even * c - sine * s;
          const double quarter = even * s + sine * c;
          waves_.cosine(row, column) = times_k ? -nodes_.k[i] * quarter : in_phase;
          waves_.sine(row, column) = times_k ? nodes_.k[i] * in_phase : quarter;
        }
      const RowMajor readings = waves_.cosine * cosine_ + waves_.sine * sine_;
      for (std::size_t p = 0; p < presses.size(); ++p)
        for (std::size_t j = 0; j < group_.sites.size(); ++j)
          to(first + p, group_.sites[j]) +=
              readings(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(j));
    };
    const auto value = [&](std::size_t i) { return normal_[i].value; };
    const auto dragged = [&](std::size_t i, double mu) {
      return mu == 0.0 ? 0.0 : mu * tangential_[i].value;
    };
    sum(phi, value, dragged, false, out.value);
    if (!with_derivatives) return;
    sum(phi, value, dragged, true, out.by_center);
    sum(slope, value, dragged, false, out.by_log_half_width);
    sum(
        phi, [](std::size_t) { return 0.0; },
        [&](std::size_t i, double) { return tangential_[i].value; }, false, out.by_friction);
    const std::array<double, 3> factor{depth_factor, thickness_factor, 1.0};
    for (const std::size_t seed : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
      const auto by = [&](const Amplitude& amplitude) {
        if (seed == 0 && tied)
          return depth_factor * amplitude.slope[0] + thickness_factor * amplitude.slope[1];
        return factor[seed] * amplitude.slope[seed];
      };
      if (seed == 1 && (tied || thickness_factor == 0.0)) continue;
      sum(
          phi, [&](std::size_t i) { return by(normal_[i]); },
          [&](std::size_t i, double mu) { return mu == 0.0 ? 0.0 : mu * by(tangential_[i]); },
          false, out.by_pad[seed]);
    }
  }

 private:
  const Group& group_;
  WaveNodes nodes_;
  std::span<const double> places_;
  std::vector<Amplitude> normal_{}, tangential_{};
  RowMajor cosine_{}, sine_{};
  PressWaves waves_{};
};

}  // namespace

void add_line_readings(const PadTaxels& taxels, std::span<const PressState> presses,
                       bool with_derivatives, PressReadings& out) {
  const auto [first, last] = std::minmax_element(taxels.y.begin(), taxels.y.end());
  Material material = taxels.material;
  for (const Group& group : groups_of(taxels.sites)) {
    const double depth = group.depth * taxels.depth_factor;
    if (material.layer && taxels.tied_to_base) material.layer->thickness = depth;
    for (std::size_t start = 0; start < presses.size(); start += presses_at_once) {
      const auto part = presses.subspan(start, std::min(presses_at_once, presses.size() - start));
      double farthest = depth;
      for (const PressState& press : part)
        farthest = std::max(
            farthest, std::exp(press.log_half_width) + std::max(std::abs(press.center - *first),
                                                                std::abs(press.center - *last)));
      GroupReadings(group, material, depth, farthest, taxels.y)
          .add(part, start, with_derivatives, depth,
               material.layer ? material.layer->thickness : 0.0, taxels.tied_to_base, out);
    }
  }
}

}  // namespace tactile_net
