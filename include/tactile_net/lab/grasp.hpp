/// @file
/// A hand's grasp: what its measured forces mean, which torques would hold its load, and what of
/// both cannot be.
///
///     const Hand hand = read_hand("hand.toml");
///     const lab::GraspResult grasp = lab::hold(hand, {.readings = ..., .tractions = ...});
///     if (grasp.held && grasp.failures.empty()) use(grasp.held->grasp.fingers[0].torques);
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "tactile_net/grasp/cannot_hold.hpp"
#include "tactile_net/grasp/hold.hpp"
#include "tactile_net/grasp/margins.hpp"
#include "tactile_net/grasp/measured_grasp.hpp"
#include "tactile_net/grasp/two_fingers.hpp"
#include "tactile_net/lab/fingertip.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/scene/hand.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net::lab {

/// Where the frames come from that a hand's file only names; a function may be empty where the hand
/// names no such file. What they throw, `hold` throws.
struct FrameOf {
  /// One frame of recorded readings of the scene's sensor: channels x count. Frames from 0.
  std::function<std::vector<double>(const std::filesystem::path& file, const Scene& scene,
                                    std::size_t frame)>
      readings{};
  /// One frame of tractions [Pa], `tangential` empty if the file has none. Frames from 0.
  std::function<TractionField(const std::filesystem::path& file, std::size_t frame)> tractions{};
};

/// One finger's margins; empty where the file gives no friction or no limits.
struct FingerMargins {
  std::optional<FrictionMargin> friction{};
  std::vector<TorqueMargin> torques{};
};

/// What the measured forces mean.
struct MeasuredAnswer {
  MeasuredGrasp grasp{};
  std::vector<FingerMargins> margins{};
  /// Whether the forces carry the load within their deviations; absent: not known.
  std::optional<bool> balanced{};
};

/// The torques again, by the thesis' four equations.
struct TorqueWitness {
  TwoFingerTorques torques{};
  double difference = 0.0;  ///< of the two answers' torques, over the largest
};

/// What would hold the load.
struct HeldAnswer {
  HeldGrasp grasp{};
  std::vector<FingerMargins> margins{};
  std::optional<TorqueWitness> thesis{};  ///< two fingers of two links and a grasping force
};

enum class GraspAnswer { measured, held };

/// What only just holds, or need not be there.
struct GraspRemark {
  enum class Kind {
    idle,           ///< the finger carries nothing
    near_slipping,  ///< it is less than two standard deviations from slipping
  };
  Kind kind = Kind::idle;
  GraspAnswer answer = GraspAnswer::measured;
  std::size_t finger = 0;  ///< from 0
};

/// What cannot hold.
struct GraspFailure {
  enum class Kind {
    pulls,         ///< `finger` would have to pull with `number`
    slips,         ///< its force is `number` outside the friction cone
    beyond_limit,  ///< its `joint` exceeds the torque limit by `number`
    unbalanced,    ///< the forces do not carry the load: `number` is chi squared
    cannot_hold,   ///< there are no torques, by `reason`
    disagreement,  ///< the witness's torques differ by `number` of the largest
  };
  Kind kind = Kind::pulls;
  GraspAnswer answer = GraspAnswer::measured;
  std::size_t finger = 0;  ///< from 0
  std::size_t joint = 0;   ///< from 0, at the palm
  double number = 0.0;
  NoHold reason = NoHold::undetermined;
};

struct GraspResult {
  Hand hand{};
  std::vector<Fingertip> tips{};             ///< one for each finger
  std::optional<MeasuredAnswer> measured{};  ///< where every finger's force is known
  std::optional<HeldAnswer> held{};  ///< where there is a load or a squeeze, and two fingers
  std::vector<GraspRemark> remarks{};
  std::vector<GraspFailure> failures{};  ///< none: the grasp stands
};

/// Scenes that the hand names are read from its folder, each once.
///
/// @throw InputError             a scene is bad, or nothing presses on it; what `frame_of` throws
/// @throw std::domain_error      nothing presses on a pad, or beside it: the text names the finger;
///                               torques overflow a double
/// @throw std::invalid_argument  there is nothing to compute; as `tactile_net::hold`
[[nodiscard]] GraspResult hold(const Hand& hand, const FrameOf& frame_of,
                               Observer& observer = silent);

}  // namespace tactile_net::lab
