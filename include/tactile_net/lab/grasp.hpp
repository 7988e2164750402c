/// @file
/// A hand's grasp: what its measured forces mean, which torques would hold its load, and what of
/// both cannot be.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tactile_net/grasp/hold.hpp"
#include "tactile_net/grasp/margins.hpp"
#include "tactile_net/grasp/measured_grasp.hpp"
#include "tactile_net/grasp/two_fingers.hpp"
#include "tactile_net/lab/fingertip.hpp"

namespace tactile_net::lab {

/// One finger's margins; empty where the file gives no friction or no limits.
struct FingerMargins {
  std::optional<FrictionMargin> friction{};
  std::vector<TorqueMargin> torques{};
};

struct GraspStudy {
  Hand hand{};
  std::vector<Fingertip> tips{};
  std::vector<FingerPose> poses{};

  std::optional<MeasuredGrasp> measured{};  ///< where every finger's force is known
  std::vector<FingerMargins> measured_margins{};
  /// Whether the measured forces carry the load within their deviations; absent: not known.
  std::optional<bool> balanced{};

  std::optional<HeldGrasp> held{};  ///< where there is a load or a squeeze, and two fingers
  std::vector<FingerMargins> held_margins{};
  std::optional<TwoFingerTorques>
      thesis{};                    ///< 6.23: two fingers of two links and a grasping force
  double thesis_difference = 0.0;  ///< of the two torques, over the largest

  std::vector<std::string> warnings{};
  std::vector<std::string> failures{};  ///< what cannot hold; none: the grasp stands
};

/// @throw InputError, std::domain_error, std::invalid_argument  as `make_fingertip`, `hold`
[[nodiscard]] GraspStudy study_grasp(const Hand& hand);

}  // namespace tactile_net::lab
