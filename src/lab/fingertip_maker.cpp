#include "lab/fingertip_maker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lab/referred_file.hpp"
#include "numeric/named.hpp"
#include "realtime/line_contacts.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/sensing/resultant.hpp"

namespace tactile_net::lab {
namespace {

// --- lines and skins ----------------------------------------------------------------------------

void take_remarks(auto& tip, const auto& remarks) {
  tip.remarks.insert(tip.remarks.end(), remarks.begin(), remarks.end());
}

/// One frame of the pad's readings: recorded, or of the scene's contacts.
///
/// @param recorded  of (file, scene, frame)
std::vector<double> readings_of(auto& tip, const FingertipScene& source,
                                const std::filesystem::path& folder, const auto& scene,
                                const auto& recorded) {
  if (source.readings) {
    if (!recorded)
      throw std::invalid_argument("the hand names a file of readings, and nothing reads it");
    require_regular(folder / *source.readings);
    return unquoted(explain_readings,
                    [&] { return recorded(folder / *source.readings, scene, source.frame); });
  }
  if (scene.contacts.empty()) throw nothing_presses(folder / source.scene);
  auto simulated = simulate(scene);
  take_remarks(tip, simulated.remarks);
  take_remarks(tip, simulated.notes);
  return std::move(simulated.readings);
}

/// What the readings mean, with all that is odd about it.
///
/// @param solve  the frame
FrameAnswer answer_of(auto& tip, const auto& solve) {
  FrameAnswer found;
  try {
    found = solve();
  } catch (const std::invalid_argument& error) {
    fail_fingertip(tip, error.what());
  } catch (const std::domain_error& error) {
    fail_fingertip(tip, error.what());
  }
  take_remarks(tip, found.remarks);
  if (!is_faultless(found.verdict)) tip.remarks.emplace_back(remark::Doubtful{found.verdict});
  return found;
}

[[noreturn]] void fail_unpressed(const auto& tip, double normal) {
  fail_fingertip(tip, "the normal force is " + brief(normal) +
                          ", and must be > 0: nothing presses on the pad");
}

void note_source(auto& tip, const FingertipScene& source) {
  tip.source = source.readings ? Fingertip::Source::readings : Fingertip::Source::simulated;
  tip.file = source.readings.value_or(source.scene);
  tip.frame = source.frame;
}

// --- lines --------------------------------------------------------------------------------------

/// Half as wide as what belongs to the taxels.
double half_width(std::size_t count, double pitch) {
  return 0.5 * static_cast<double>(count) * pitch;
}
double half_width(const SensorArray& array) {
  if (is_even(array)) return half_width(array.count, array.pitch);
  return std::max(std::abs(array.taxels.front().y), std::abs(array.taxels.back().y)) +
         0.5 * array.pitch;
}

/// A resultant whose deviations are not known.
UncertainResultant certain(const Resultant& sum, bool has_tangential) {
  UncertainResultant result;
  result.normal = {sum.normal, 0.0};
  if (has_tangential) result.tangential = Uncertain{sum.tangential, 0.0};
  if (const auto centre = sum.centre()) result.centre = Uncertain{*centre, 0.0};
  return result;
}

UncertainResultant certain(std::span<const double> normal, std::span<const double> tangential,
                           const Surface& surface) {
  return certain(resultant_of(normal, tangential, surface), !tangential.empty());
}

/// Of the contact that needs the most friction; absent: there is one.
std::optional<UncertainResultant> certain_nearest_to_slipping(std::span<const double> normal,
                                                              std::span<const double> tangential,
                                                              const Surface& surface) {
  if (tangential.empty()) return std::nullopt;
  const LineContact worst =
      nearest_to_slipping(normal.data(), tangential.data(), normal.size(), 0.0);
  if (worst.contacts < 2) return std::nullopt;
  return certain(resultant_between(worst.first, worst.last, normal, tangential, surface), true);
}

/// Takes a resultant for the fingertip's force, and of several contacts the one nearest to
/// slipping.
void press_by(Fingertip& tip, const UncertainResultant& resultant,
              const std::optional<UncertainResultant>& worst, double breadth) {
  if (!resultant.centre) fail_unpressed(tip, resultant.normal.value);
  tip.force = fingertip_force(resultant, breadth);
  if (worst) {
    tip.nearest_to_slipping = fingertip_force(*worst, breadth);
    tip.remarks.emplace_back(remark::SeveralContacts{});
  }
  if (!resultant.tangential) tip.remarks.emplace_back(remark::TangentialUnseen{});
  const double end = tip.finger.pad.half_width;
  if (std::abs(tip.force->centre) > end)
    fail_fingertip(tip, "the centre of pressure is at " + brief(tip.force->centre) +
                            ", outside the fingertip, which ends at " + brief(end));
}

/// Takes the sum of tractions whose deviations are not known.
void press_by(Fingertip& tip, std::span<const double> normal, std::span<const double> tangential,
              const Surface& surface, double breadth) {
  press_by(tip, certain(normal, tangential, surface),
           certain_nearest_to_slipping(normal, tangential, surface), breadth);
}

constexpr const char* explain_tractions = "docs/hand.md says what it should hold";

/// A line's contact, whose forces are per metre, on a pad so broad.
ContactPatch over_breadth(ContactPatch patch, double breadth) {
  UncertainWrench& wrench = patch.wrench;
  const auto widen = [&](Uncertain& force) {
    force = {breadth * force.value, breadth * force.deviation};
  };
  widen(wrench.normal);
  if (wrench.tangential_y) widen(*wrench.tangential_y);
  const std::array<double, 6> scale = {breadth, breadth, 1.0, 1.0, 1.0, 1.0};  // two are forces
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) wrench.covariance[6 * i + j] *= scale[i] * scale[j];
  return patch;
}

// --- skins --------------------------------------------------------------------------------------

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

FingertipMaker::Line::Line(const std::filesystem::path& path)
    : problem(unquoted(explain_scene, [&] { return read_scene(path); })),
      solver(make_solver(problem, Method::tikhonov)) {}

FingertipMaker::Skin::Skin(const std::filesystem::path& path) : problem(read_skin(path)) {}

void FingertipMaker::press(Fingertip& tip, const HandFinger& finger,
                           const TractionFile& source) const {
  if (!frame_of_.tractions)
    throw std::invalid_argument("the hand names a file of tractions, and FrameOf reads none");
  require_regular(folder_ / source.file);
  const TractionField f = unquoted(
      explain_tractions, [&] { return frame_of_.tractions(folder_ / source.file, source.frame); });
  tip.finger = finger.with_pad(half_width(f.normal.size(), source.pitch));
  press_by(tip, f.normal, f.tangential, {.count = f.normal.size(), .spacing = source.pitch},
           finger.breadth);
}

void FingertipMaker::press(Fingertip& tip, const HandFinger& finger, const FingertipScene& source) {
  const std::filesystem::path path = folder_ / source.scene;
  const Line& line = lines_.try_emplace(path, path).first->second;
  const SceneProblem& problem = line.problem;
  tip.finger = finger.with_pad(half_width(problem.scene().sensor));
  const std::vector<double> readings =
      readings_of(tip, source, folder_, problem.scene(), frame_of_.readings);
  const FrameAnswer found =
      answer_of(tip, [&] { return solve(problem, readings, line.solver.get()); });
  const std::span<const double> f = found.tractions;
  const Surface& surface = problem.surface();
  if (!found.bands)
    return press_by(tip, f.first(surface.count), f.subspan(surface.count), surface, finger.breadth);
  const std::array<double, 9>& covariance = found.bands->resultant.covariance;
  if (!std::all_of(covariance.begin(), covariance.end(),
                   [](double value) { return std::isfinite(value); }))
    fail_fingertip(tip, FrameOverflow().what());
  press_by(tip, found.bands->resultant, found.bands->nearest_to_slipping, finger.breadth);
  for (const ContactPatch& patch : found.bands->patches)
    tip.patches.push_back(over_breadth(patch, finger.breadth));
}

void FingertipMaker::press(SpaceFingertip& tip, const SpaceHandFinger& finger,
                           const FingertipScene& source) {
  const std::filesystem::path path = folder_ / source.scene;
  const SkinSceneProblem& problem = skins_.try_emplace(path, path).first->second.problem;
  const std::vector<double> readings =
      readings_of(tip, source, folder_, problem.scene(), skin_frame_of_);
  const FrameAnswer answer = answer_of(tip, [&] { return solve(problem, readings); });
  const UncertainWrench& wrench = answer.wrench;
  if (!wrench.centre_y || !wrench.centre_z) fail_unpressed(tip, wrench.normal.value);
  if (!wrench.tangential_y) tip.remarks.emplace_back(remark::TangentialUnseen{});
  std::optional<double> radius;
  if (finger.soft) radius = finger.torsion_radius ? *finger.torsion_radius : radius_of(tip, answer);
  tip.force = force_of(wrench, radius);
  tip.patches = answer.patches;
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

Fingertip FingertipMaker::make(const HandFinger& finger) {
  Fingertip tip{.finger = finger.with_pad(0.0)};
  if (const auto* place = std::get_if<ContactPlace>(&finger.contact)) {
    tip.place = *place;
  } else if (const auto* force = std::get_if<FingertipForce>(&finger.contact)) {
    tip.source = Fingertip::Source::resultant;
    tip.force = *force;
  } else if (const auto* tractions = std::get_if<TractionFile>(&finger.contact)) {
    tip.source = Fingertip::Source::tractions;
    tip.file = tractions->file;
    tip.frame = tractions->frame;
    press(tip, finger, *tractions);
  } else if (const auto* scene = std::get_if<FingertipScene>(&finger.contact)) {
    note_source(tip, *scene);
    press(tip, finger, *scene);
  }
  if (tip.force) tip.place = place_of(*tip.force);
  tip.pose = pose_of(tip.finger);
  check_bent(tip.finger, tip.pose, contact_point(tip.pose, tip.place.centre));
  return tip;
}

SpaceFingertip FingertipMaker::make(const SpaceHandFinger& finger) {
  check(finger.finger);
  SpaceFingertip tip{.finger = finger.finger, .pad = pad_frame(finger.finger)};
  if (const auto* place = std::get_if<SpaceContactPlace>(&finger.contact)) {
    tip.place = *place;
  } else if (const auto* force = std::get_if<SpaceFingertipForce>(&finger.contact)) {
    tip.source = Fingertip::Source::resultant;
    tip.force = *force;
  } else if (const auto* scene = std::get_if<FingertipScene>(&finger.contact)) {
    note_source(tip, *scene);
    press(tip, finger, *scene);
  }
  if (tip.force) tip.place = place_of(*tip.force);
  return tip;
}

std::string_view name(Fingertip::Source source) noexcept {
  return name_in<Enumerators<Fingertip::Source>::all>(source);
}

}  // namespace tactile_net::lab
