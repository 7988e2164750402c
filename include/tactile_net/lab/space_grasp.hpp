/// @file
/// A grasp in space: what the forces on skins mean for a hand, which torques or forces would hold
/// its load, and what of both cannot be.
///
///     const AnyHand any = read_any_hand("box.toml");
///     const lab::SpaceGraspResult grasp = lab::hold(std::get<SpaceHand>(any), frame_of);
///     if (grasp.held && grasp.failures.empty()) use(grasp.held->grasp.fingers[0].torques);
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tactile_net/grasp/space/hold_in_space.hpp"
#include "tactile_net/grasp/space/internal_forces.hpp"
#include "tactile_net/grasp/space/measured_space_grasp.hpp"
#include "tactile_net/lab/grasp.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/scene/skin_scene.hpp"
#include "tactile_net/scene/space_hand.hpp"

namespace tactile_net::lab {

/// Where recorded frames come from; may be empty where the hand names none. What it throws, `hold`
/// throws. Frames from 0.
using SkinFrameOf = std::function<std::vector<double>(const std::filesystem::path& file,
                                                      const SkinScene& scene, std::size_t frame)>;

namespace remark {
/// A hard finger has none, and this contact's is more than two deviations.
struct TorsionLeftOut {
  Uncertain torsion{};
};
}  // namespace remark

struct SpaceFingertip {
  SpaceFinger finger{};
  PadFrame pad{};
  SpaceContactPlace place{};
  std::optional<SpaceFingertipForce> force{};  ///< absent: the contact is only assumed
  /// Of several contacts that lie apart on the pad, the one by which friction is judged: the force
  /// is their sum, and may be held where each of them slips. Absent: there is one.
  std::optional<SpaceFingertipForce> nearest_to_slipping{};
  Fingertip::Source source = Fingertip::Source::assumed;
  std::filesystem::path file{};  ///< of the source, as the hand's file names it; empty: none
  std::size_t frame = 0;         ///< row of that file, from 0
  /// The corners of the pad along y and z [m], least and largest; absent: not known.
  std::optional<std::array<Vector3, 4>> corners{};
  std::vector<ContactPatch> patches{};  ///< each contact on the pad by itself, the strongest first
  std::vector<FingertipRemark> remarks{};
  std::optional<remark::TorsionLeftOut> torsion_left_out{};
};

struct MeasuredSpaceAnswer {
  MeasuredSpaceGrasp grasp{};
  std::vector<FingerMargins> margins{};
  std::optional<bool> balanced{};  ///< absent: not known
  InternalForces internal{};
};

struct HeldSpaceAnswer {
  HeldSpaceGrasp grasp{};
  std::vector<FingerMargins> margins{};
  InternalForces internal{};
};

/// Why nothing holds the load, where its motion says more than the failure's reason.
struct SpaceRefusal {
  std::optional<ObjectMotion> motion{};
  double size = 0.0;                      ///< of the grasp: the contacts' spread [m]
  std::optional<double> least_squeeze{};  ///< that would hold it
};

struct SpaceGraspResult {
  SpaceHand hand{};
  std::vector<SpaceFingertip> tips{};             ///< one for each finger
  std::optional<MeasuredSpaceAnswer> measured{};  ///< where every finger's force is known
  std::optional<HeldSpaceAnswer> held{};  ///< where there is a load or a squeeze, and two fingers
  std::optional<SpaceRefusal> refusal{};  ///< of a failure `cannot_hold`
  std::vector<GraspRemark> remarks{};
  std::vector<GraspFailure> failures{};  ///< none: the grasp stands
};

/// As `hold` of a hand of the plane. Scenes are of skins; each is read, and its problem made, once.
///
/// @throw InputError             a scene is bad, or of a line array, or nothing presses on it; what
///                               `readings` throws
/// @throw std::domain_error      nothing presses on a pad; a soft finger's radius is not known; a
///                               frame cannot be solved: the text names the finger
/// @throw std::invalid_argument  there is nothing to compute; as `tactile_net::hold`
[[nodiscard]] SpaceGraspResult hold(const SpaceHand& hand, const SkinFrameOf& readings = {},
                                    Observer& observer = silent);

}  // namespace tactile_net::lab
