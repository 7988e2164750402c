/// @file
/// One contact of several: what the tractions of a patch amount to, each value with its deviation.
/// Of lines and of skins alike: forces are N/m and N, extents m and m^2.
///
///     for (const ContactPatch& patch : patches_of(surface, tractions, covariance, rms, whole))
///       use(patch.wrench.normal, patch.wrench.centre_y, patch.friction);
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/uncertainty.hpp"

namespace tactile_net {

/// What tractions on a curved skin amount to in the sensor's own axes.
struct SpaceWrench {
  std::array<Uncertain, 3> force{};   ///< that acts on the skin [N]
  std::array<Uncertain, 3> moment{};  ///< of it, about the point that the scene names [N m]
  /// The centre of pressure: the mean of the places that press, which lies below a convex surface
  /// [m]. Absent if nothing presses.
  std::optional<std::array<Uncertain, 3>> centre{};
  std::optional<std::array<double, 3>> above{};  ///< the place of the surface above it [m]
};

/// The wrench of tractions, each value with its deviation. Of a line it has force, drag along y and
/// centre y, per metre across the line.
struct UncertainWrench {
  Uncertain normal{};                       ///< F_x [N]
  std::optional<Uncertain> tangential_y{};  ///< F_y [N]; absent with one component
  std::optional<Uncertain> tangential_z{};  ///< F_z [N]; absent with one component
  std::optional<Uncertain> centre_y{};      ///< centre of pressure [m]; absent if F_x <= 0
  std::optional<Uncertain> centre_z{};      ///< centre of pressure [m]; absent if F_x <= 0
  /// Moment about x through the centre of pressure, from y towards z [N m].
  std::optional<Uncertain> torsion{};
  /// Covariance of the six values in their order, 6 x 6 row-major; zero where one is absent.
  std::array<double, 36> covariance{};
  /// Of a curved skin, whose other values are those of its chart: F_x sums what presses along each
  /// place's own normal, and centres are places of the chart.
  std::optional<SpaceWrench> space{};
};

/// The size of a drag, to first order. @pre  there is one
[[nodiscard]] Uncertain drag_of(const UncertainWrench& wrench);

/// The ellipse that has the second moments of one contact's pressure, which the solver has blurred
/// by about a depth.
struct ContactEllipse {
  Uncertain radius{};         ///< [m], the longer one
  Uncertain second_radius{};  ///< [m]
  Uncertain angle{};          ///< of `radius`, from the y axis towards z [rad], in (-pi/2, pi/2]
};

/// A patch that touches.
struct ContactPatch {
  /// Of the surface, in rising order, at least one. Of a line those that press with more than a
  /// tenth of the highest pressure, while its sums hold all values nearer to it than to another
  /// contact.
  std::vector<std::size_t> cells{};
  UncertainWrench wrench{};
  /// |drag| / F_x: the least friction that holds it. Absent with one component, or if F_x <= 0.
  std::optional<Uncertain> friction{};
  /// 1 - sqrt((|drag| / (mu F_x))^2 + (torsion / (mu lever))^2): < 0 beyond what friction holds.
  /// Absent without a limit mu.
  std::optional<Uncertain> slip_margin{};
  double lever = 0.0;  ///< sum p r A [N m]: the torsion at which all of it turns, over mu
  /// (sum p)^2 A / sum p^2: the area, of a line the length, over which the same force would press
  /// with the same sum of squares if it were even. Absent if F_x <= 0.
  std::optional<Uncertain> extent{};
  std::optional<ContactEllipse> ellipse{};  ///< of skins, by Hertz' law
};

struct PatchOptions {
  std::optional<double> friction_limit{};  ///< mu, > 0; absent: there are no margins
  /// The variance of place that smoothing may have added to the pressure, along each axis [m^2].
  /// Sizes then lie between what they would be if it had added all of that, and none.
  double smoothed_variance = 0.0;
  /// The tractions are the mean of what readings leave possible, where these tell a size no
  /// smoother than the load is: sizes are then theirs, and the deviations hold what smoothing may
  /// have added.
  bool is_mean = false;
  ResultantBetween between{};  ///< of each of several contacts; null: `resultant_between`
};

/// Gives a patch the friction and the margin that its wrench and lever have. All deviations are by
/// first order; the lever's own is of second order beside the torsion's.
/// @throw std::invalid_argument  the limit is not > 0
void judge_slip(ContactPatch& patch, std::optional<double> limit);

/// Gives a judged patch the interval of its friction, and the margin that of what friction leaves,
/// where no torsion takes of it.
void add_friction_interval(ContactPatch& patch, const CentralInterval& friction,
                           std::optional<double> limit);

/// The contacts on a line, the strongest first: stretches above a tenth of the highest pressure,
/// each with all that lies nearer to it than to another one, so that their sums are the whole's.
/// A stretch counts if its force is above a tenth of the strongest one's and above six deviations
/// of the whole's. None where the whole presses with less than three of its deviations.
///
/// @param tractions  all normal values, then all tangential ones [Pa]
/// @param noise_rms  of one weighted reading
/// @param whole      resultant of all tractions
[[nodiscard]] std::vector<ContactPatch> patches_of(const Surface& surface,
                                                   std::span<const double> tractions,
                                                   const Covariance& covariance, double noise_rms,
                                                   const UncertainResultant& whole,
                                                   const PatchOptions& options = {});

/// The patch with the least margin, or without margins the one that needs the most friction, of
/// those with more than a tenth of the strongest one's force. Null: none drags.
[[nodiscard]] const ContactPatch* nearest_to_slipping(std::span<const ContactPatch> patches);

}  // namespace tactile_net
