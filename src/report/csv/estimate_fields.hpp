/// @file
/// Private. What a controller says of a frame, as columns of numbers.
#pragma once

#include <array>
#include <cmath>

#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net {

namespace report {

/// A vector of a curved skin's estimate; none of a flat one.
inline IfAny<std::array<double, 3>> in_space(const ContactEstimate& estimate,
                                             std::array<double, 3> SpaceEstimate::*which) {
  const std::array<double, 3>& vector = estimate.space.*which;
  if (std::isnan(vector[0])) return {};
  return {vector};
}

}  // namespace report

template <>
struct Fields<ContactEstimate> {
  using E = ContactEstimate;
  static constexpr auto all = std::tuple{
      field("normal_force", &E::normal_force, Measure::load, "The normal force.", Of::lines),
      field("normal", &E::normal_force, Measure::load, "The normal force.", Of::skins),
      field("normal_force_deviation", &E::force_deviation, Measure::load,
            "Its standard deviation by noise.", Of::lines),
      field("normal_deviation", &E::force_deviation, Measure::load,
            "Its standard deviation by noise.", Of::skins),
      field("tangential_force", &E::tangential_force, Measure::load, "The tangential force.",
            Of::lines),
      field("tangential_y", &E::tangential_y, Measure::load, "The tangential force along y.",
            Of::skins),
      field("tangential_z", &E::tangential_z, Measure::load, "The tangential force along z.",
            Of::skins),
      field("centre", &E::centre, Measure::length, "The centre of pressure.", Of::lines),
      field("centre_y", &E::centre, Measure::length, "The centre of pressure along y.", Of::skins),
      field("centre_z", &E::centre_z, Measure::length, "The centre of pressure along z.",
            Of::skins),
      field("torsion", &E::torsion, Measure::moment,
            "The moment about x through the centre of pressure, from y towards z.", Of::skins),
      field("angle", &E::angle, Measure::angle, "The angle between the force and the normal."),
      field("friction_margin", &E::friction_margin, Measure::load,
            "How much more tangential force friction holds; below 0 the contact slips."),
      field("slip_margin", &E::slip_margin,
            "What share of friction's limit force and torsion leave; below 0 the contact slips or "
            "turns.",
            Of::skins),
      field("margin_centre", &E::margin_centre, Measure::length,
            "The centre of the contact that has the margins.", Of::lines),
      field("margin_centre_y", &E::margin_centre, Measure::length,
            "The centre along y of the contact that has the margins.", Of::skins),
      field("margin_centre_z", &E::margin_centre_z, Measure::length,
            "The centre along z of the contact that has the margins.", Of::skins),
      field(
          "force", [](const E& e) { return report::in_space(e, &SpaceEstimate::force); },
          Measure::load, "The force that acts on the skin, along x, y and z of the sensor.",
          Of::skins),
      field(
          "moment", [](const E& e) { return report::in_space(e, &SpaceEstimate::moment); },
          Measure::moment, "Its moment about `moment_about`.", Of::skins),
      field(
          "centre_in_space", [](const E& e) { return report::in_space(e, &SpaceEstimate::centre); },
          Measure::length,
          "The mean of the places that press, in the sensor's axes: it lies below a convex "
          "surface.",
          Of::skins),
      field("contacts", &E::contacts, "How many contacts lie apart; margins are the worst one's."),
      field("residual_rms", &E::residual_rms,
            "What the tractions leave of the weighted readings, root mean square."),
      field("touching", &E::touching,
            "How many cells the forces are sums over; 0: all, or inside constraints none."),
      field("unfinished", &E::unfinished,
            "How many of its own standard deviations any force may be off since steps towards the "
            "constraints ended; only of plans with constraints that know the noise."),
      field("unfinished_share", &E::unfinished_share,
            "The same as a share of the linear frame; only of plans with constraints."),
      field("steps", &E::steps, "Steps towards the constraints; 0: the plan has none."),
      field("outlier", &E::outlier,
            "The index of the reading that the others explain least; -1: none stands out."),
      field("contact", &E::contact, "1 where something touches, else 0; as in all that follow."),
      field("pulls", &E::pulls, "The force pulls, which no contact does."),
      field("implausible", &E::implausible, "The traction would strain the pad by more than 1."),
      field("misfit", &E::misfit, "The residual is more than noise explains."),
      field("beyond_edge", &E::beyond_edge,
            "The contact may go on beyond the array: the force is a lower bound."),
      field("baseline_moved", &E::baseline_moved,
            "A constant is nearly all that a channel reads: the baseline may have moved."),
      field("saturated", &E::saturated, "A reading lies at the end of its channel's range.")};
};

}  // namespace tactile_net
