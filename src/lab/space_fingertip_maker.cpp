#include "lab/space_fingertip_maker.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "lab/referred_file.hpp"
#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::lab {
namespace {

SkinScene read_skin(const std::filesystem::path& path) {
  AnyScene any = unquoted(explain_scene, [&] { return read_any_scene(path); });
  if (auto* skin = std::get_if<SkinScene>(&any)) return std::move(*skin);
  throw InputError({{.file = path.string(),
                     .message = "is of a line array, and the pad of a finger in space is a skin",
                     .hint = "give its [sensor] rows and columns, or the hand's fingers links"}});
}

/// Torsion that the field bears without drag, over mu times the force.
double radius_of(const SpaceFingertip& tip, const FrameAnswer& answer) {
  if (!answer.friction || !(answer.friction->lever_of_all > 0.0))
    fail_fingertip(tip,
                   "its skin does not tell how much torsion it can carry: give torsion_radius");
  return answer.friction->lever_of_all / answer.wrench.normal.value;
}

SpaceFingertipForce force_of(const UncertainWrench& wrench, std::optional<double> radius) {
  SpaceFingertipForce force{.normal = wrench.normal.value,
                            .tangential_y = wrench.tangential_y.value_or(Uncertain{}).value,
                            .tangential_z = wrench.tangential_z.value_or(Uncertain{}).value,
                            .torsion = radius ? wrench.torsion.value_or(Uncertain{}).value : 0.0,
                            .place = {wrench.centre_y->value, wrench.centre_z->value, {}, radius},
                            .covariance = wrench.covariance};
  for (std::size_t i = 0; !radius && i < 6; ++i)
    force.covariance[30 + i] = force.covariance[6 * i + 5] = 0.0;
  return force;
}

}  // namespace

const SkinSceneProblem& SpaceFingertipMaker::ready(const std::filesystem::path& scene) {
  const std::filesystem::path path = folder_ / scene;
  const auto found = scenes_.find(path);
  return found != scenes_.end()
             ? found->second
             : scenes_.emplace(path, SkinSceneProblem(read_skin(path))).first->second;
}

std::vector<double> SpaceFingertipMaker::readings_of(SpaceFingertip& tip,
                                                     const FingertipScene& source,
                                                     const SkinScene& scene) const {
  if (source.readings) {
    if (!readings_)
      throw std::invalid_argument("the hand names a file of readings, and nothing reads it");
    require_regular(folder_ / *source.readings);
    return unquoted(explain_readings,
                    [&] { return readings_(folder_ / *source.readings, scene, source.frame); });
  }
  if (scene.contacts.empty()) throw nothing_presses(folder_ / source.scene);
  SkinFrame simulated = simulate(scene);
  tip.remarks.insert(tip.remarks.end(), simulated.remarks.begin(), simulated.remarks.end());
  return std::move(simulated.readings);
}

void SpaceFingertipMaker::press(SpaceFingertip& tip, const SpaceHandFinger& finger,
                                const FingertipScene& source) {
  const SkinSceneProblem& problem = ready(source.scene);
  FrameAnswer answer;
  const std::vector<double> readings = readings_of(tip, source, problem.scene());
  try {
    answer = solve(problem, readings);
  } catch (const std::invalid_argument& error) {
    fail_fingertip(tip, error.what());
  } catch (const std::domain_error& error) {
    fail_fingertip(tip, error.what());
  }
  tip.remarks.insert(tip.remarks.end(), answer.remarks.begin(), answer.remarks.end());
  if (!is_faultless(answer.verdict)) tip.remarks.emplace_back(remark::Doubtful{answer.verdict});
  const UncertainWrench& wrench = answer.wrench;
  if (!wrench.centre_y || !wrench.centre_z)
    fail_fingertip(tip, "the normal force is " + brief(wrench.normal.value) +
                            ", and must be > 0: nothing presses on the pad");
  if (!wrench.tangential_y) tip.remarks.emplace_back(remark::TangentialUnseen{});
  std::optional<double> radius;
  if (finger.soft) radius = finger.torsion_radius ? *finger.torsion_radius : radius_of(tip, answer);
  tip.force = force_of(wrench, radius);
  if (answer.friction && answer.friction->wrench) {
    const UncertainWrench& worst = *answer.friction->wrench;
    std::optional<double> of_worst = finger.torsion_radius;
    if (!of_worst) of_worst = answer.friction->lever / worst.normal.value;
    tip.nearest_to_slipping = force_of(worst, finger.soft ? of_worst : std::nullopt);
    tip.remarks.emplace_back(remark::SeveralContacts{});
  }
  if (!radius && wrench.torsion &&
      std::abs(wrench.torsion->value) > 2.0 * wrench.torsion->deviation)
    tip.torsion_left_out = remark::TorsionLeftOut{*wrench.torsion};

  const SurfaceGrid& grid = problem.grid();
  const double half_y = 0.5 * grid.spacing_y;
  const double half_z = 0.5 * grid.spacing_z;
  const double y[] = {grid.y(0) - half_y, grid.y(grid.rows - 1) + half_y};
  const double z[] = {grid.z(0) - half_z, grid.z(grid.columns - 1) + half_z};
  tip.corners = {contact_point(tip.pad, y[0], z[0]), contact_point(tip.pad, y[1], z[0]),
                 contact_point(tip.pad, y[1], z[1]), contact_point(tip.pad, y[0], z[1])};
}

SpaceFingertip SpaceFingertipMaker::make(const SpaceHandFinger& finger) {
  check(finger.finger);
  SpaceFingertip tip{.finger = finger.finger, .pad = pad_frame(finger.finger)};
  if (const auto* place = std::get_if<SpaceContactPlace>(&finger.contact)) {
    tip.place = *place;
  } else if (const auto* force = std::get_if<SpaceFingertipForce>(&finger.contact)) {
    tip.source = Fingertip::Source::resultant;
    tip.force = *force;
  } else if (const auto* scene = std::get_if<FingertipScene>(&finger.contact)) {
    tip.source = scene->readings ? Fingertip::Source::readings : Fingertip::Source::simulated;
    tip.file = scene->readings.value_or(scene->scene);
    tip.frame = scene->frame;
    press(tip, finger, *scene);
  }
  if (tip.force) tip.place = place_of(*tip.force);
  return tip;
}

}  // namespace tactile_net::lab
