#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "calibration/ball_load.hpp"
#include "calibration/contact_radii.hpp"
#include "calibration/pad_readings.hpp"
#include "elasticity/space/ball_sums.hpp"
#include "elasticity/space/layer_field.hpp"
#include "numeric/dual.hpp"
#include "numeric/eigen.hpp"
#include "skin/curved_kernel.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t ball_tables = layer_table_orders.size();
constexpr std::size_t first_dragged_table = static_cast<std::size_t>(LayerTable::tangential_x);
constexpr std::size_t degrees_at_once = 256;

/// By log depth, log thickness and nu.
using BallAmplitude = Dual<3>;
/// What is summed over the degrees.
constexpr std::size_t of_value = 0, of_depth = 1, of_thickness = 2, of_nu = 3, of_width = 4;
constexpr std::size_t ball_columns = 5;
/// A reading by log depth, log thickness, nu, log half width, and the taxel's y and z from the
/// load.
using BallReading = Dual<6>;
constexpr std::size_t seed_y = 4;

bool is_displacement(std::size_t table) {
  const auto one = static_cast<LayerTable>(table);
  return one == LayerTable::normal_displacement_x ||
         one == LayerTable::normal_displacement_radial ||
         one >= LayerTable::tangential_displacement_x;
}

/// Marks the tables that a field asks for.
struct AskedTables {
  std::array<bool, ball_tables>& asked;
  double operator()(LayerTable table) const {
    asked[static_cast<std::size_t>(table)] = true;
    return 0.0;
  }
};

struct BallModuli {
  double youngs_modulus = 0.0;
  BallReading poisson_ratio{};
};

/// A ball that taxels of one depth take their readings from, under every press.
class BallPresses {
 public:
  /// What of a pad's state counts here.
  struct Pad {
    Material material{};
    double depth = 0.0;
    bool tied = false;
    double curvature = 0.0;      ///< of the kernel
    double arc_curvature = 0.0;  ///< of the surface along which arcs run
  };
  BallPresses(const Pad& pad, const std::array<bool, ball_tables>& asked,
              std::span<const PressState> presses, double farthest, bool with_derivatives)
      : moduli_{pad.material.youngs_modulus, BallReading::seed(pad.material.poisson_ratio, 2)},
        columns_(with_derivatives ? ball_columns : 1),
        radii_(pad.depth, widest(presses), farthest, end_of(pad)) {
    const double h = pad.material.layer->thickness;
    const auto rows = static_cast<Eigen::Index>(presses.size());
    for (std::size_t t = 0; t < ball_tables; ++t)
      for (std::size_t c = 0; asked[t] && c < columns_; ++c)
        tables_[t][c] = RowMajor::Zero(rows, static_cast<Eigen::Index>(radii_.r.size()));
    for (const auto& [curvature, weight] : summed_curvatures(pad.curvature * h))
      add(pad, curvature / h, weight, asked, presses);
  }

  /// A unit load's reading at a place.
  ///
  /// @param along  the tractions asked for: the normal one alone, or all
  [[nodiscard]] std::array<BallReading, 3> readings(std::size_t press, const AxisShares& axes,
                                                    const BallPlace& place,
                                                    std::size_t tractions) const {
    std::array<BallReading, 3> sums{};
    const double r = std::hypot(place.y, place.z);
    if (r >= radii_.end()) return sums;
    Table table{*this, static_cast<Eigen::Index>(press), radii_.at(r), {}, 0.0, 0.0};
    if (columns_ > 1) {
      table.slope = radii_.slope_at(r, table.at);
      table.along_y = r > 0.0 ? place.y / r : 0.0;
      table.along_z = r > 0.0 ? place.z / r : 0.0;
    }
    const BallReading y = BallReading::seed(place.y, seed_y);
    const BallReading z = BallReading::seed(place.z, seed_y + 1);
    for (std::size_t k = 0; k < axes.count; ++k)
      for (std::size_t u = 0; u < tractions; ++u) {
        const bool turned = skin_tractions[u] == Traction::tangential_z;
        const LayerField<Table, BallReading> field{table, skin_tractions[u], turned ? z : y,
                                                   turned ? y : z};
        sums[u] = sums[u] + axes.shares[k] * read(axes.quantities[k], field, moduli_);
      }
    return sums;
  }

 private:
  struct Table {
    const BallPresses& of;
    Eigen::Index press;
    ContactRadii::At at;
    ContactRadii::Shares slope;
    double along_y, along_z;  // from the load

    BallReading operator()(LayerTable which) const {
      const auto& columns = of.tables_[static_cast<std::size_t>(which)];
      const auto of_press = [&](std::size_t column) {
        return columns[column].row(press).segment(at.first,
                                                  static_cast<Eigen::Index>(ContactRadii::points));
      };
      BallReading result(of_press(of_value).dot(at.share));
      if (of.columns_ == 1) return result;
      for (std::size_t i = 0; i < seed_y; ++i) result.slope[i] = of_press(1 + i).dot(at.share);
      const double by_r = of_press(of_value).dot(slope);
      result.slope[seed_y] = by_r * along_y;
      result.slope[seed_y + 1] = by_r * along_z;
      return result;
    }
  };

  static double widest(std::span<const PressState> presses) {
    double most = 0.0;
    for (const PressState& press : presses) most = std::max(most, std::exp(press.log_half_width));
    return most;
  }
  /// The antipode, or where nothing is left.
  static double end_of(const Pad& pad) {
    const double reach = ball_reach * pad.material.layer->thickness;
    const double bend = std::abs(pad.arc_curvature);
    return bend * reach > std::numbers::pi ? std::numbers::pi / bend : reach;
  }

  /// Adds what the ball of one curvature reads, times a weight.
  void add(const Pad& pad, double curvature, double weight,
           const std::array<bool, ball_tables>& asked, std::span<const PressState> presses) {
    constexpr std::size_t points = ContactRadii::points;
    const std::size_t panels = radii_.r.size() / points;
    std::vector<ArcShapes<points>> arcs;
    for (std::size_t panel = 0; panel < panels; ++panel) {
      std::array<double, points> at{};
      std::copy_n(radii_.r.begin() + static_cast<std::ptrdiff_t>(panel * points), points,
                  at.begin());
      arcs.emplace_back(at, curvature);
    }
    BallAmplitude depth(pad.depth);
    depth.slope[of_depth - 1] = pad.depth;
    BallAmplitude h = depth;
    if (!pad.tied) {
      h = BallAmplitude(pad.material.layer->thickness);
      h.slope[of_thickness - 1] = h.value;
    }
    const BallAmplitude bend = h * curvature;
    const BallAmplitude place = depth / h;
    const BallModesOf<BallAmplitude> modes(
        BallAmplitude::seed(pad.material.poisson_ratio, of_nu - 1), bend, place);
    const std::size_t degrees = modes.degrees();
    std::vector<BallLoad> loads;
    for (const PressState& press : presses)
      loads.emplace_back(press.disc, std::exp(press.log_half_width) * std::abs(curvature), degrees);

    const auto rows = static_cast<Eigen::Index>(presses.size());
    const auto radii = static_cast<Eigen::Index>(radii_.r.size());
    const auto block = static_cast<Eigen::Index>(degrees_at_once);
    std::array<Eigen::MatrixXd, ball_shape_count> shapes;
    for (Eigen::MatrixXd& values : shapes) values.resize(block, radii);
    // Of normal tractions, and of drags.
    std::array<Eigen::MatrixXd, 2> load;
    std::array<Eigen::MatrixXd, 2> load_slope;
    for (std::size_t kind = 0; kind < 2; ++kind) {
      load[kind].resize(rows, block);
      load_slope[kind].resize(rows, block);
    }
    std::array<std::array<Eigen::VectorXd, ball_columns - 1>, ball_tables> amplitudes;
    for (auto& columns : amplitudes)
      for (Eigen::VectorXd& values : columns) values.resize(block);
    std::array<std::array<Eigen::MatrixXd, ball_columns>, ball_tables> sums;
    for (std::size_t t = 0; t < ball_tables; ++t)
      for (std::size_t c = 0; asked[t] && c < columns_; ++c)
        sums[t][c] = Eigen::MatrixXd::Zero(rows, radii);

    for (std::size_t first = 0; first < degrees; first += degrees_at_once) {
      for (Eigen::Index i = 0; i < block; ++i) {
        const std::size_t degree = first + static_cast<std::size_t>(i);
        for (std::size_t panel = 0; panel < panels; ++panel) {
          std::array<std::array<double, points>, ball_shape_count> values;
          arcs[panel].take(values);
          for (std::size_t s = 0; s < ball_shape_count; ++s)
            for (std::size_t k = 0; k < points; ++k)
              shapes[s](i, static_cast<Eigen::Index>(panel * points + k)) = values[s][k];
        }
        for (Eigen::Index p = 0; p < rows; ++p) {
          const BallLoad::Share share = loads[static_cast<std::size_t>(p)].next();
          load[0](p, i) = share.normal;
          load[1](p, i) = share.drag;
          load_slope[0](p, i) = share.normal_slope;
          load_slope[1](p, i) = share.drag_slope;
        }
        const auto of_degree = ball_amplitudes(modes(degree), degree, bend, place);
        for (std::size_t t = 0; t < ball_tables; ++t) {
          if (!asked[t]) continue;
          const BallAmplitude one = is_displacement(t) ? of_degree[t] / h : of_degree[t] / (h * h);
          amplitudes[t][of_value](i) = one.value;
          for (std::size_t s = 0; s < one.slope.size(); ++s) amplitudes[t][1 + s](i) = one.slope[s];
        }
      }
      for (std::size_t t = 0; t < ball_tables; ++t) {
        if (!asked[t]) continue;
        const std::size_t kind = t < first_dragged_table ? 0 : 1;
        const Eigen::MatrixXd& shape = shapes[static_cast<std::size_t>(ball_shapes[t])];
        for (std::size_t c = 0; c < columns_; ++c)
          sums[t][c] += (c == of_width ? load_slope : load)[kind] *
                        amplitudes[t][c == of_width ? of_value : c].asDiagonal() * shape;
      }
    }
    for (std::size_t t = 0; t < ball_tables; ++t)
      for (std::size_t c = 0; asked[t] && c < columns_; ++c)
        for (Eigen::Index k = 0; k < radii; ++k) {
          const auto at = static_cast<std::size_t>(k);
          tables_[t][c].col(k) +=
              weight * arcs[at / points].factor(static_cast<LayerTable>(t), at % points) *
              sums[t][c].col(k);
        }
  }

  BallModuli moduli_;
  std::size_t columns_;
  ContactRadii radii_;
  std::array<std::array<RowMajor, ball_columns>, ball_tables> tables_{};  // presses x radii
};

/// A press' middle on the chart, and beside it, for differences.
struct LoadPlaces {
  SurfacePlace here{};
  std::array<std::array<SurfacePlace, 2>, 2> beside{};  ///< of y and z, up and down
  double step = 0.0;
};

/// @param y, z  on the chart; beyond its end its end counts
SurfacePlace place_on(const CurvedSurface& surface, double y, double z) {
  const double most = 1.99 * std::sin(0.5 * CurvedSurface::most_angle);
  const double far = std::abs(surface.curvature()) * std::hypot(y, z);
  const double share = far > most ? most / far : 1.0;
  return surface.at(share * y, share * z);
}

LoadPlaces load_places(const CurvedSurface& surface, double y, double z, double step) {
  return {.here = place_on(surface, y, z),
          .beside = {{{place_on(surface, y + step, z), place_on(surface, y - step, z)},
                      {place_on(surface, y, z + step), place_on(surface, y, z - step)}}},
          .step = step};
}

/// Where a taxel is from a load, and how that moves with the load's place.
struct SeenLoad {
  BallPlace place{};
  std::array<BallPlace, 2> slope{};  ///< by y and z of the chart
};

SeenLoad seen_from(const SurfacePlace& taxel, const LoadPlaces& load, double curvature,
                   bool with_derivatives) {
  const auto seen = [&](const SurfacePlace& from) {
    return surface_place(from.frame, taxel.frame, combined(1.0, taxel.point, -1.0, from.point),
                         curvature);
  };
  SeenLoad result{.place = seen(load.here)};
  for (std::size_t u = 0; with_derivatives && u < 2; ++u) {
    const BallPlace up = seen(load.beside[u][0]);
    const BallPlace down = seen(load.beside[u][1]);
    const double scale = 0.5 / load.step;
    result.slope[u] = {scale * (up.y - down.y), scale * (up.z - down.z),
                       scale * (up.cosine - down.cosine), scale * (up.sine - down.sine)};
  }
  return result;
}

}  // namespace

void add_curved_readings(const PadTaxels& taxels, std::span<const PressState> presses,
                         bool with_derivatives, PressReadings& out) {
  const CurvedSkin& curved = *taxels.curved;
  const bool drags = (with_derivatives && taxels.by_friction) ||
                     std::any_of(presses.begin(), presses.end(), [](const PressState& press) {
                       return press.friction != 0.0 || press.friction_z != 0.0;
                     });
  const std::size_t tractions = drags ? skin_tractions.size() : 1;
  std::map<std::array<double, 3>, std::vector<std::size_t>> groups;
  double shallowest = taxels.sites.front().depth;
  const KernelCurvatures curvatures(curved, taxels.nominal_thickness);
  for (std::size_t j = 0; j < taxels.sites.size(); ++j) {
    const Site& site = taxels.sites[j];
    shallowest = std::min(shallowest, site.depth);
    const double own = curved.above[site.taxel].mean_curvature;
    const double taken = curvatures.taken(own);
    groups[{taken, taken == 0.0 ? own : taken, site.depth}].push_back(j);
  }
  std::vector<LoadPlaces> loads;
  for (const PressState& press : presses)
    loads.push_back(load_places(curved.surface, press.center - taxels.shift_y,
                                press.center_z - taxels.shift_z, 1e-3 * shallowest));

  for (const auto& [key, readings] : groups) {
    BallPresses::Pad pad{.material = taxels.material,
                         .depth = key[2] * taxels.depth_factor,
                         .tied = taxels.tied_to_base,
                         .curvature = key[0],
                         .arc_curvature = key[1]};
    if (pad.tied) pad.material.layer->thickness = pad.depth;
    std::array<bool, ball_tables> asked{};
    std::vector<AxisShares> axes;
    std::vector<SeenLoad> seen;  // of each reading and press
    double farthest = pad.depth;
    for (const std::size_t j : readings) {
      const SurfacePlace& above = curved.above[taxels.sites[j].taxel];
      axes.push_back(axis_shares(taxels.sites[j].quantity, above.frame, curved.axes));
      for (std::size_t k = 0; k < axes.back().count; ++k)
        for (std::size_t u = 0; u < tractions; ++u)
          read(axes.back().quantities[k],
               LayerField<AskedTables>{AskedTables{asked}, skin_tractions[u], 1.0, 1.0},
               taxels.material);
      for (const LoadPlaces& load : loads) {
        seen.push_back(seen_from(above, load, pad.arc_curvature, with_derivatives));
        farthest = std::max(farthest, std::hypot(seen.back().place.y, seen.back().place.z));
      }
    }
    const BallPresses ball(pad, asked, presses, farthest, with_derivatives);
    for (std::size_t i = 0; i < readings.size(); ++i)
      for (std::size_t p = 0; p < presses.size(); ++p) {
        const std::size_t j = readings[i];
        const PressState& press = presses[p];
        const auto& [place, slope] = seen[i * presses.size() + p];
        const auto& [normal, y, z] = ball.readings(p, axes[i], place, tractions);
        const double force = std::exp(press.log_force);
        const auto drag = [&y = y, &z = z](double cosine, double sine) {
          return std::pair{cosine * y + sine * z, cosine * z - sine * y};
        };
        const auto& [along_y, along_z] = drag(place.cosine, place.sine);
        const BallReading all =
            force * (normal + press.friction * along_y + press.friction_z * along_z);
        out.value(p, j) += all.value;
        if (!with_derivatives) continue;
        for (const auto& [parameter, column] : {std::pair{PadParameter::depth, of_depth},
                                                std::pair{PadParameter::thickness, of_thickness},
                                                std::pair{PadParameter::poisson_ratio, of_nu}})
          out.by_pad[static_cast<std::size_t>(parameter)](p, j) += all.slope[column - 1];
        out.by_log_half_width(p, j) += all.slope[of_width - 1];
        if (drags) {
          out.by_friction(p, j) += force * along_y.value;
          out.by_friction_z(p, j) += force * along_z.value;
        }
        for (const auto& [u, column] :
             {std::pair{0, &out.by_center}, std::pair{1, &out.by_center_z}}) {
          const BallPlace& move = slope[static_cast<std::size_t>(u)];
          const auto& [turned_y, turned_z] = drag(move.cosine, move.sine);
          (*column)(p, j) +=
              all.slope[seed_y] * move.y + all.slope[seed_y + 1] * move.z +
              force * (press.friction * turned_y.value + press.friction_z * turned_z.value);
        }
      }
  }
}

}  // namespace tactile_net
