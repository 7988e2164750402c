#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "calibration/disc_transform.hpp"
#include "calibration/pad_readings.hpp"
#include "elasticity/space/displacement_amplitudes.hpp"
#include "elasticity/space/reduced_bessel.hpp"
#include "elasticity/stress_amplitudes.hpp"
#include "numeric/dual.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

using Amplitude = Dual<3>;  // by depth, thickness and nu

/// exp(-k depth) is some 1e-15 there, times the k depth of the amplitudes.
constexpr double largest_decay = 36.0;
/// A fit that has gone astray may ask for more; it is not to take the memory.
constexpr std::size_t most_panels = 400;
constexpr std::size_t points = 20;  // of a panel of radii
/// A press whose derivatives are asked for turns a wave of order 2 into one of order 3.
constexpr std::size_t orders = 4;

/// What depends on the distance from the load alone: under a normal load six functions, and with
/// Hooke's law in them four more.
enum Wave {
  stress_x,
  shear,
  trace,
  deviator,
  strain_x,
  shear_strain,
  strain_trace,
  strain_deviator,
  displacement_x,
  displacement_along
};
constexpr std::size_t waves = 10;
constexpr std::array<std::size_t, waves> order_of = {0, 1, 0, 2, 0, 1, 0, 2, 0, 1};

/// A wave times the cosine, or the sine, of its order times the angle from the y axis.
struct Term {
  Wave wave;
  bool sine = false;
  double factor = 1.0;
};

/// In the order of the quantities.
const std::array<std::vector<Term>, skin_quantities.size()> terms_of = {{
    {{stress_x}},
    {{trace}, {deviator}},
    {{trace}, {deviator, false, -1.0}},
    {{shear}},
    {{shear, true}},
    {{deviator, true}},
    {{strain_x}},
    {{strain_trace}, {strain_deviator}},
    {{strain_trace}, {strain_deviator, false, -1.0}},
    {{shear_strain}},
    {{shear_strain, true}},
    {{strain_deviator, true, 2.0}},
    {{displacement_x}},
    {{displacement_along}},
    {{displacement_along, true}},
}};

/// Every wave's amplitude times k, with the sign that i^order gives it.
std::array<Amplitude, waves> amplitudes(const Material& material, double depth, double k) {
  const Amplitude x = Amplitude::seed(depth, 0);
  const Amplitude nu = Amplitude::seed(material.poisson_ratio, 2);
  const double modulus = material.youngs_modulus;
  Stress<Amplitude> stress;
  Amplitude u_x;
  Amplitude u_along;  // both times 2 G k
  if (!material.layer || k * (material.layer->thickness - depth) > 400.0) {
    const Amplitude a = k * x;
    stress = half_plane_amplitudes(Traction::normal, a);
    u_x = (2.0 - 2.0 * nu + a) * exp(-a);
    u_along = (a - 1.0 + 2.0 * nu) * exp(-a);
  } else {
    const Amplitude h = Amplitude::seed(material.layer->thickness, 1);
    const LayerFunctionsOf<Amplitude> f(h, x, k);
    const bool bonded = material.layer->base == Base::bonded;
    stress = bonded ? bonded_amplitudes(Traction::normal, nu, f)
                    : frictionless_amplitudes(Traction::normal, f);
    const auto u = bonded ? bonded_displacements(nu, f) : frictionless_displacements(nu, f);
    const Amplitude over = bonded ? f.bonded_determinant(nu) : f.frictionless_determinant();
    u_x = u.normal_x / over;
    u_along = u.normal_along / over;
  }
  const Amplitude across = nu * (stress.x + stress.y);
  const Amplitude mean = 0.5 * (stress.y + across);
  const Amplitude half = -0.5 * (stress.y - across);
  const Amplitude compliance = (1.0 + nu) / modulus;  // 1 / 2 G
  return {k * stress.x,
          k * stress.shear,
          k * mean,
          k * half,
          k * (stress.x - 2.0 * nu * mean) / modulus,
          2.0 * k * compliance * stress.shear,
          k * ((1.0 - nu) * mean - nu * stress.x) / modulus,
          k * compliance * half,
          compliance * u_x,
          compliance * u_along};
}

/// Nodes in k, those near 0 as dense as a layer asks for: its poles are 0.7 / h away.
struct Nodes {
  Nodes(double depth, double farthest, const Material& material) {
    using Rule = boost::math::quadrature::gauss<double, points>;
    const double end = largest_decay / depth;
    const double count = std::clamp(std::ceil(end * farthest / 26.0), 5.0, double{most_panels});
    const double wide = end / count;
    const double h = material.layer ? material.layer->thickness : 0.0;
    for (double from = 0.0; from < end * (1.0 - 1e-9);) {
      const double width = from * h < 15.0 && h > 0.0 ? std::min(wide, 2.5 / h) : wide;
      for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
        for (const double sign : {-1.0, 1.0}) {
          k.push_back(from + 0.5 * width * (1.0 + sign * Rule::abscissa()[i]));
          weight.push_back(0.25 * width * Rule::weights()[i] / std::numbers::pi);
        }
      from += width;
    }
  }
  std::vector<double> k, weight;
};

/// Radii between which readings are interpolated: Chebyshev's points on panels as wide as the
/// depth, and wider where the load is far. The functions' singularities lie a depth beside the
/// radii of the contact: 20 points resolve them to 1e-12.
class Radii {
 public:
  Radii(double depth, double largest_contact, double farthest) {
    edges_.push_back(0.0);
    while (edges_.back() <= farthest) {
      const double from = edges_.back();
      edges_.push_back(from + std::max(depth, 0.5 * (from - largest_contact)));
      for (std::size_t i = 0; i < points; ++i)
        r.push_back(0.5 * (from + edges_.back() - (edges_.back() - from) * std::cos(angle(i))));
    }
  }
  std::vector<double> r{};

  struct At {
    Eigen::Index first = 0;  ///< of the panel's points
    Eigen::Matrix<double, points, 1> share{};
  };
  [[nodiscard]] At at(double radius) const {
    const auto above = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, radius);
    At result{.first = (above - edges_.begin() - 1) * static_cast<Eigen::Index>(points)};
    double sum = 0.0;  // the barycentric formula
    for (std::size_t i = 0; i < points; ++i) {
      const double apart = radius - r[static_cast<std::size_t>(result.first) + i];
      auto& share = result.share(static_cast<Eigen::Index>(i));
      if (apart == 0.0) {
        result.share.setZero();
        share = 1.0;
        return result;
      }
      share = (i % 2 == 0 ? 1.0 : -1.0) * std::sin(angle(i)) / apart;
      sum += share;
    }
    result.share /= sum;
    return result;
  }

 private:
  static double angle(std::size_t i) {
    return std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(points);
  }
  std::vector<double> edges_{};
};

/// What is summed over the nodes: the wave itself, its derivatives, and it times k with the order
/// one lower and one higher, which its derivatives by the place are made of.
enum Column { value, by_depth, by_thickness, by_nu, by_width, lower, upper };
constexpr std::size_t columns = 7;

/// One depth: its waves over the radii, for every press.
class DepthReadings {
 public:
  DepthReadings(const Material& material, double depth, bool tied, std::vector<bool> needed,
                std::span<const PressState> presses, double farthest, bool with_derivatives)
      : presses_(presses),
        columns_(with_derivatives ? columns : 1),
        radii_(depth, widest(presses), farthest) {
    const Nodes nodes(depth, farthest + widest(presses), material);
    const auto count = static_cast<Eigen::Index>(nodes.k.size());
    const auto rows = static_cast<Eigen::Index>(presses.size());
    const auto radii = static_cast<Eigen::Index>(radii_.r.size());
    for (Eigen::MatrixXd& values : bessel_) values.resize(count, radii);
    for (Eigen::Index m = 0; m < radii; ++m)
      for (Eigen::Index i = 0; i < count; ++i) {
        const double z =
            nodes.k[static_cast<std::size_t>(i)] * radii_.r[static_cast<std::size_t>(m)];
        const std::array<double, orders> reduced = reduced_bessel(z);
        double power = 1.0;
        for (std::size_t n = 0; n < orders; ++n, power *= z) bessel_[n](i, m) = power * reduced[n];
      }
    load_.resize(rows, count);
    Eigen::MatrixXd slope(rows, count);
    for (Eigen::Index p = 0; p < rows; ++p) {
      const PressState& press = presses[static_cast<std::size_t>(p)];
      const double a = std::exp(press.log_half_width);
      for (Eigen::Index i = 0; i < count; ++i) {
        const double z = nodes.k[static_cast<std::size_t>(i)] * a;
        const IndenterTransform phi = disc_transform(press.disc, z);
        const double scale = std::exp(press.log_force) * nodes.weight[static_cast<std::size_t>(i)];
        load_(p, i) = scale * phi.value;
        slope(p, i) = scale * phi.slope * z;
      }
    }
    std::vector<std::array<Amplitude, waves>> all;
    for (const double k : nodes.k) all.push_back(amplitudes(material, depth, k));
    const double h = material.layer ? material.layer->thickness : 0.0;
    for (std::size_t wave = 0; wave < waves; ++wave) {
      if (!needed[wave]) continue;
      const std::size_t n = order_of[wave];
      Eigen::VectorXd amplitude(count);
      const auto take = [&](Column column, const Eigen::MatrixXd& load, std::size_t order,
                            const auto& of) {
        for (Eigen::Index i = 0; i < count; ++i)
          amplitude(i) = of(all[static_cast<std::size_t>(i)][wave], static_cast<std::size_t>(i));
        tables_[wave][column] = load * amplitude.asDiagonal() * bessel_[order];
      };
      const auto plain = [](const Amplitude& one, std::size_t) { return one.value; };
      take(value, load_, n, plain);
      if (!with_derivatives) continue;
      take(by_width, slope, n, plain);
      take(by_depth, load_, n, [&](const Amplitude& one, std::size_t) {
        return depth * one.slope[0] + (tied ? h * one.slope[1] : 0.0);
      });
      take(by_thickness, load_, n,
           [&](const Amplitude& one, std::size_t) { return tied ? 0.0 : h * one.slope[1]; });
      take(by_nu, load_, n, [](const Amplitude& one, std::size_t) { return one.slope[2]; });
      const auto times_k = [&](const Amplitude& one, std::size_t i) {
        return nodes.k[i] * one.value;
      };
      take(lower, load_, n == 0 ? 1 : n - 1, times_k);  // J_-1 = -J_1
      take(upper, load_, n + 1, times_k);
    }
  }

  void add(std::size_t p, double y, double z, SkinQuantity quantity, std::size_t reading,
           PressReadings& out) const {
    const double from_y = y - presses_[p].center;
    const double from_z = z - presses_[p].center_z;
    const double r = std::hypot(from_y, from_z);
    const Radii::At at = radii_.at(r);
    const double turn_cosine = r > 0.0 ? from_y / r : 1.0;
    const double turn_sine = r > 0.0 ? from_z / r : 0.0;
    std::array<double, orders> cosine{1.0};
    std::array<double, orders> sine{};
    for (std::size_t n = 1; n < orders; ++n) {
      cosine[n] = cosine[n - 1] * turn_cosine - sine[n - 1] * turn_sine;
      sine[n] = sine[n - 1] * turn_cosine + cosine[n - 1] * turn_sine;
    }
    for (const Term& term : terms_of[static_cast<std::size_t>(quantity)]) {
      const std::size_t n = order_of[term.wave];
      std::array<double, columns> sum{};
      for (std::size_t column = 0; column < columns_; ++column)
        sum[column] = term.factor * tables_[term.wave][column]
                                        .row(static_cast<Eigen::Index>(p))
                                        .segment(at.first, static_cast<Eigen::Index>(points))
                                        .dot(at.share);
      const double angle = term.sine ? sine[n] : cosine[n];
      out.value(p, reading) += sum[value] * angle;
      if (columns_ == 1) continue;
      out.by_log_half_width(p, reading) += sum[by_width] * angle;
      for (const auto& [parameter, column] : {std::pair{PadParameter::depth, by_depth},
                                              std::pair{PadParameter::thickness, by_thickness},
                                              std::pair{PadParameter::poisson_ratio, by_nu}})
        out.by_pad[static_cast<std::size_t>(parameter)](p, reading) += sum[column] * angle;
      // d/dy and d/dz of J_n(k r) exp(i n theta), from J_n-1 and J_n+1.
      const double low = n == 0 ? -sum[lower] : sum[lower];
      const double low_cosine = n == 0 ? cosine[1] : cosine[n - 1];
      const double low_sine = n == 0 ? -sine[1] : sine[n - 1];
      const double along_y = term.sine ? low * low_sine - sum[upper] * sine[n + 1]
                                       : low * low_cosine - sum[upper] * cosine[n + 1];
      const double along_z = term.sine ? low * low_cosine + sum[upper] * cosine[n + 1]
                                       : -low * low_sine - sum[upper] * sine[n + 1];
      out.by_center(p, reading) -= 0.5 * along_y;
      out.by_center_z(p, reading) -= 0.5 * along_z;
    }
  }

 private:
  static double widest(std::span<const PressState> presses) {
    double most = 0.0;
    for (const PressState& press : presses) most = std::max(most, std::exp(press.log_half_width));
    return most;
  }

  std::span<const PressState> presses_;
  std::size_t columns_;
  Radii radii_;
  std::array<Eigen::MatrixXd, orders> bessel_{};               // nodes x radii
  Eigen::MatrixXd load_{};                                     // presses x nodes
  std::array<std::array<RowMajor, columns>, waves> tables_{};  // presses x radii
};

}  // namespace

void add_skin_readings(const PadTaxels& taxels, std::span<const PressState> presses,
                       bool with_derivatives, PressReadings& out) {
  std::map<double, std::vector<std::size_t>> depths;
  for (std::size_t j = 0; j < taxels.sites.size(); ++j) depths[taxels.sites[j].depth].push_back(j);
  Material material = taxels.material;
  for (const auto& [nominal, readings] : depths) {
    const double depth = nominal * taxels.depth_factor;
    if (material.layer && taxels.tied_to_base) material.layer->thickness = depth;
    std::vector<bool> needed(waves);
    double farthest = depth;
    for (const std::size_t j : readings) {
      for (const Term& term : terms_of[static_cast<std::size_t>(taxels.sites[j].quantity)])
        needed[term.wave] = true;
      for (const PressState& press : presses)
        farthest = std::max(farthest,
                            std::hypot(taxels.y[j] - press.center, taxels.z[j] - press.center_z));
    }
    const DepthReadings at(material, depth, taxels.tied_to_base, needed, presses, farthest,
                           with_derivatives);
    for (std::size_t p = 0; p < presses.size(); ++p)
      for (const std::size_t j : readings)
        at.add(p, taxels.y[j], taxels.z[j], taxels.sites[j].quantity, j, out);
  }
}

}  // namespace tactile_net
