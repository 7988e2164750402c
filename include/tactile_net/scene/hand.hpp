/// @file
/// A hand and its grasp as plain data: what a HAND file says (format: docs/hand.md).
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tactile_net/grasp/finger.hpp"
#include "tactile_net/grasp/finger_action.hpp"
#include "tactile_net/grasp/fingertip_force.hpp"
#include "tactile_net/grasp/hold.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net {

/// Tractions from a CSV file as `tactile-net solve` writes them.
struct TractionFile {
  std::filesystem::path file{};
  double pitch = 0.0;     ///< [m]
  std::size_t frame = 0;  ///< row, from 0
};

/// A fingertip that is a scene of its own: recorded readings, or the scene's contacts.
struct FingertipScene {
  std::filesystem::path scene{};
  std::optional<std::filesystem::path> readings{};
  std::size_t frame = 0;  ///< row of the readings, from 0
};

/// Where a finger's contact is known from. `ContactPlace`: it is not measured, only assumed.
using ContactSource = std::variant<ContactPlace, FingertipForce, TractionFile, FingertipScene>;

struct HandFinger {
  Finger finger{};                      ///< all but its pad's half width: see `with_pad`
  std::optional<double> half_width{};   ///< of the pad [m], > 0; absent: as wide as the array
  double breadth = 1.0;                 ///< of the pad out of plane [m]; 1: forces per unit length
  std::optional<double> friction{};     ///< mu, > 0
  std::vector<double> torque_limits{};  ///< one per joint, > 0, or none
  ContactSource contact{};

  /// The finger with its pad, which is as wide as the fingertip's array where the file gives no
  /// width of its own.
  ///
  /// @param array_half_width  [m], > 0; not used where the contact's place is in the hand's file
  [[nodiscard]] Finger with_pad(double array_half_width) const {
    Finger whole = finger;
    whole.pad.half_width = half_width.value_or(array_half_width);
    return whole;
  }
};

struct Hand {
  std::string file{};              ///< name of the file, without its folder
  std::filesystem::path folder{};  ///< what its paths are relative to
  std::string title{};
  bool si = false;  ///< its numbers are in m, N and N m: words and pages have units
  std::vector<HandFinger> fingers{};
  std::optional<ExternalLoad> load{};
  HoldOptions squeeze{};  ///< without `friction`
  /// Share of every finger's friction that holding may use, > 0 and <= 1; absent: forces are found
  /// without regard to friction.
  std::optional<double> friction_used{};
};

struct HandOptions {
  /// Whether the hand may name files elsewhere than beside its own and below. Not for a stranger's:
  /// what is in a file shows in what is computed from it.
  bool allow_outside = false;
};

/// @throw InputError  every problem of the file at once, as `read_scene`; fingers that are
///                    straight, where their contacts' places are in the file; files elsewhere,
///                    links followed; a hand in space
[[nodiscard]] Hand read_hand(const std::filesystem::path& path, const HandOptions& options = {});

/// As `read_hand`, from text already in memory; `file` is the name in messages.
[[nodiscard]] Hand parse_hand(std::string_view toml, const std::string& file,
                              const HandOptions& options = {});

}  // namespace tactile_net
