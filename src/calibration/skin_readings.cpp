#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "calibration/contact_radii.hpp"
#include "calibration/indenter_transform.hpp"
#include "calibration/pad_readings.hpp"
#include "calibration/skin_waves.hpp"
#include "calibration/wave_nodes.hpp"
#include "elasticity/space/reduced_bessel.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

constexpr double most_skin_panels = 400.0;
/// A press whose derivatives are asked for turns a wave of order 3 into one of order 4.
constexpr std::size_t orders = most_skin_wave_order + 2;

/// What is summed over the nodes: the wave itself, its derivatives, and it times k with the order
/// one lower and one higher, which its derivatives by the place are made of.
enum Column { value, by_depth, by_thickness, by_nu, by_width, lower, upper };
constexpr std::size_t columns = 7;

/// The waves that readings at one depth are made of.
struct Needed {
  bool drags = false;
  std::array<bool, skin_wave_count> waves{};

  void add(Quantity quantity) {
    const auto mark = [&](Quantity of, Traction traction) {
      for (const SkinTerm& term : skin_terms(of, traction))
        waves[static_cast<std::size_t>(term.wave)] = true;
    };
    mark(quantity, Traction::normal);
    if (!drags) return;
    mark(quantity, Traction::tangential_y);
    mark(exchanged(quantity), Traction::tangential_y);
  }
};

/// One depth: its waves over the radii, for every press.
class DepthReadings {
 public:
  DepthReadings(const Material& material, double depth, bool tied, const Needed& needed,
                std::span<const PressState> presses, double farthest, bool with_derivatives)
      : presses_(presses),
        drags_(needed.drags),
        columns_(with_derivatives ? columns : 1),
        radii_(depth, widest(presses), farthest) {
    const WaveNodes nodes(depth, farthest + widest(presses), material, most_skin_panels);
    const auto count = static_cast<Eigen::Index>(nodes.k.size());
    const auto rows = static_cast<Eigen::Index>(presses.size());
    const auto radii = static_cast<Eigen::Index>(radii_.r.size());
    for (Eigen::MatrixXd& values : bessel_) values.resize(count, radii);
    for (Eigen::Index m = 0; m < radii; ++m)
      for (Eigen::Index i = 0; i < count; ++i) {
        const double z =
            nodes.k[static_cast<std::size_t>(i)] * radii_.r[static_cast<std::size_t>(m)];
        const std::array<double, orders - 1> reduced = reduced_bessel(z);
        double power = 1.0;
        for (std::size_t n = 0; n + 1 < orders; ++n, power *= z)
          bessel_[n](i, m) = power * reduced[n];
        // It cancels near 0, and leaves an error that is small beside 1.
        bessel_[orders - 1](i, m) = z > 0.0 ? 6.0 / z * bessel_[3](i, m) - bessel_[2](i, m) : 0.0;
      }
    load_.resize(rows, count);
    Eigen::MatrixXd slope(rows, count);
    for (Eigen::Index p = 0; p < rows; ++p) {
      const PressState& press = presses[static_cast<std::size_t>(p)];
      const double a = std::exp(press.log_half_width);
      for (Eigen::Index i = 0; i < count; ++i) {
        const double z = nodes.k[static_cast<std::size_t>(i)] * a;
        const IndenterTransform phi = indenter_transform(press.disc, z);
        const double scale =
            0.5 * std::exp(press.log_force) * nodes.weight[static_cast<std::size_t>(i)];
        load_(p, i) = scale * phi.value;
        slope(p, i) = scale * phi.slope * z;
      }
    }
    std::vector<std::array<SkinAmplitude, skin_wave_count>> all;
    for (const double k : nodes.k) all.push_back(skin_amplitudes(material, depth, k, drags_));
    const double h = material.layer ? material.layer->thickness : 0.0;
    for (std::size_t wave = 0; wave < skin_wave_count; ++wave) {
      if (!needed.waves[wave]) continue;
      const std::size_t n = skin_wave_order[wave];
      Eigen::VectorXd amplitude(count);
      const auto take = [&](Column column, const Eigen::MatrixXd& load, std::size_t order,
                            const auto& of) {
        for (Eigen::Index i = 0; i < count; ++i)
          amplitude(i) = of(all[static_cast<std::size_t>(i)][wave], static_cast<std::size_t>(i));
        tables_[wave][column] = load * amplitude.asDiagonal() * bessel_[order];
      };
      const auto plain = [](const SkinAmplitude& one, std::size_t) { return one.value; };
      take(value, load_, n, plain);
      if (!with_derivatives) continue;
      take(by_width, slope, n, plain);
      take(by_depth, load_, n, [&](const SkinAmplitude& one, std::size_t) {
        return depth * one.slope[0] + (tied ? h * one.slope[1] : 0.0);
      });
      take(by_thickness, load_, n,
           [&](const SkinAmplitude& one, std::size_t) { return tied ? 0.0 : h * one.slope[1]; });
      take(by_nu, load_, n, [](const SkinAmplitude& one, std::size_t) { return one.slope[2]; });
      const auto times_k = [&](const SkinAmplitude& one, std::size_t i) {
        return nodes.k[i] * one.value;
      };
      take(lower, load_, n == 0 ? 1 : n - 1, times_k);  // J_-1 = -J_1
      take(upper, load_, n + 1, times_k);
    }
  }

  void add(std::size_t p, double y, double z, Quantity quantity, std::size_t reading,
           PressReadings& out) const {
    const double from_y = y - presses_[p].center;
    const double from_z = z - presses_[p].center_z;
    const double r = std::hypot(from_y, from_z);
    const ContactRadii::At at = radii_.at(r);
    const Turn turn(r > 0.0 ? from_y / r : 1.0, r > 0.0 ? from_z / r : 0.0);
    Field field = sum(skin_terms(quantity, Traction::normal), at, p, turn);
    if (drags_) {
      const Field along_y = sum(skin_terms(quantity, Traction::tangential_y), at, p, turn);
      const Field along_z = sum(skin_terms(exchanged(quantity), Traction::tangential_y), at, p,
                                Turn(turn.sine[1], turn.cosine[1]))
                                .mirrored();
      field.add(presses_[p].friction, along_y);
      field.add(presses_[p].friction_z, along_z);
      if (columns_ > 1) {
        out.by_friction(p, reading) += along_y.sums[value];
        out.by_friction_z(p, reading) += along_z.sums[value];
      }
    }
    out.value(p, reading) += field.sums[value];
    if (columns_ == 1) return;
    out.by_log_half_width(p, reading) += field.sums[by_width];
    for (const auto& [parameter, column] : {std::pair{PadParameter::depth, by_depth},
                                            std::pair{PadParameter::thickness, by_thickness},
                                            std::pair{PadParameter::poisson_ratio, by_nu}})
      out.by_pad[static_cast<std::size_t>(parameter)](p, reading) += field.sums[column];
    out.by_center(p, reading) -= field.along_y;
    out.by_center_z(p, reading) -= field.along_z;
  }

 private:
  /// Cosines and sines of multiples of an angle.
  struct Turn {
    Turn(double one_cosine, double one_sine) {
      for (std::size_t n = 1; n < orders; ++n) {
        cosine[n] = cosine[n - 1] * one_cosine - sine[n - 1] * one_sine;
        sine[n] = sine[n - 1] * one_cosine + cosine[n - 1] * one_sine;
      }
    }
    std::array<double, orders> cosine{1.0};
    std::array<double, orders> sine{};
  };

  /// A reading of one component of the load, and its derivatives.
  struct Field {
    std::array<double, columns> sums{};  // all but the last two
    double along_y = 0.0, along_z = 0.0;

    void add(double factor, const Field& other) {
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += factor * other.sums[i];
      along_y += factor * other.along_y;
      along_z += factor * other.along_z;
    }
    [[nodiscard]] Field mirrored() const { return {sums, along_z, along_y}; }
  };

  [[nodiscard]] Field sum(const std::vector<SkinTerm>& terms, const ContactRadii::At& at,
                          std::size_t p, const Turn& turn) const {
    Field field;
    for (const SkinTerm& term : terms) {
      const auto wave = static_cast<std::size_t>(term.wave);
      const std::size_t n = skin_wave_order[wave];
      std::array<double, columns> sums{};
      for (std::size_t column = 0; column < columns_; ++column)
        sums[column] =
            term.factor * tables_[wave][column]
                              .row(static_cast<Eigen::Index>(p))
                              .segment(at.first, static_cast<Eigen::Index>(ContactRadii::points))
                              .dot(at.share);
      const double angle = term.sine ? turn.sine[n] : turn.cosine[n];
      for (const Column column : {value, by_depth, by_thickness, by_nu, by_width})
        field.sums[column] += sums[column] * angle;
      if (columns_ == 1) continue;
      // d/dy and d/dz of J_n(k r) exp(i n theta), from J_n-1 and J_n+1.
      const double low = n == 0 ? -sums[lower] : sums[lower];
      const double high = sums[upper];
      const double low_cosine = n == 0 ? turn.cosine[1] : turn.cosine[n - 1];
      const double low_sine = n == 0 ? -turn.sine[1] : turn.sine[n - 1];
      field.along_y += 0.5 * (term.sine ? low * low_sine - high * turn.sine[n + 1]
                                        : low * low_cosine - high * turn.cosine[n + 1]);
      field.along_z += 0.5 * (term.sine ? low * low_cosine + high * turn.cosine[n + 1]
                                        : -low * low_sine - high * turn.sine[n + 1]);
    }
    return field;
  }

  static double widest(std::span<const PressState> presses) {
    double most = 0.0;
    for (const PressState& press : presses) most = std::max(most, std::exp(press.log_half_width));
    return most;
  }

  std::span<const PressState> presses_;
  bool drags_;
  std::size_t columns_;
  ContactRadii radii_;
  std::array<Eigen::MatrixXd, orders> bessel_{};                         // nodes x radii
  Eigen::MatrixXd load_{};                                               // presses x nodes
  std::array<std::array<RowMajor, columns>, skin_wave_count> tables_{};  // presses x radii
};

}  // namespace

void add_skin_readings(const PadTaxels& taxels, std::span<const PressState> presses,
                       bool with_derivatives, PressReadings& out) {
  std::map<double, std::vector<std::size_t>> depths;
  for (std::size_t j = 0; j < taxels.sites.size(); ++j) depths[taxels.sites[j].depth].push_back(j);
  const bool drags = (with_derivatives && taxels.by_friction) ||
                     std::any_of(presses.begin(), presses.end(), [](const PressState& press) {
                       return press.friction != 0.0 || press.friction_z != 0.0;
                     });
  Material material = taxels.material;
  for (const auto& [nominal, readings] : depths) {
    const double depth = nominal * taxels.depth_factor;
    if (material.layer && taxels.tied_to_base) material.layer->thickness = depth;
    Needed needed{.drags = drags};
    double farthest = depth;
    for (const std::size_t j : readings) {
      needed.add(taxels.sites[j].quantity);
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
