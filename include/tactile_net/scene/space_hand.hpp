/// @file
/// A hand in space and its grasp as plain data: what such a HAND file says (format: docs/hand.md).
///
///     const AnyHand any = read_any_hand("scenes/hands/box.toml");
///     if (const auto* hand = std::get_if<SpaceHand>(&any))
///       const lab::SpaceGraspResult grasp = lab::hold(*hand);
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tactile_net/grasp/space/hold_in_space.hpp"
#include "tactile_net/grasp/space/space_action.hpp"
#include "tactile_net/grasp/space/space_contact.hpp"
#include "tactile_net/grasp/space/space_finger.hpp"
#include "tactile_net/scene/hand.hpp"

namespace tactile_net {

/// Where a finger's contact in space is known from. `SpaceContactPlace`: it is only assumed.
using SpaceContactSource = std::variant<SpaceContactPlace, SpaceFingertipForce, FingertipScene>;

struct SpaceHandFinger {
  SpaceFinger finger{};
  bool soft = false;                       ///< it bears torsion
  std::optional<double> torsion_radius{};  ///< of a soft one [m]; absent: by the skin's own field
  std::optional<double> friction{};        ///< mu, > 0
  std::vector<double> torque_limits{};     ///< one per joint, > 0, or none
  SpaceContactSource contact{};
};

/// A hand whose fingertips are skins.
struct SpaceHand {
  std::string file{};
  std::filesystem::path folder{};
  std::string title{};
  bool si = false;
  std::vector<SpaceHandFinger> fingers{};
  std::optional<SpaceLoad> load{};
  std::optional<double> squeeze{};
  std::optional<double> friction_used{};
  Least least = Least::torques;
};

/// A hand of the plane or one in space, whose first finger has a `normal`.
using AnyHand = std::variant<Hand, SpaceHand>;

/// As `read_hand`, of either kind. @throw InputError  as that
[[nodiscard]] AnyHand read_any_hand(const std::filesystem::path& path,
                                    const HandOptions& options = {});
[[nodiscard]] AnyHand parse_any_hand(std::string_view toml, const std::string& file,
                                     const HandOptions& options = {});

}  // namespace tactile_net
