/// @file
/// What a user should know of an answer before trusting it: a type and its numbers each. The
/// sentences are `report::in_words`.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/identifiability.hpp"
#include "tactile_net/inverse/thesis/dft_tikhonov.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net::lab {

namespace remark {

// dft.
struct NoiseAmplified {
  double gain = 1.0;  ///< errors of the readings reach the traction multiplied by up to this
};
struct SignChanges {
  std::size_t frequencies = 0;  ///< where the kernel's DFT changes sign
};
struct DeadTaxelsRead {};  ///< dft takes a dead taxel's zero for a reading
struct CutOff {};          ///< the readings have not died away at the array's ends
struct LowerBound {};      ///< the border of what taxels see is pressed as hard as the middle
struct NotOneContact {};   ///< what contact_friction takes for granted does not hold
struct DragInNoise {};     ///< the tangential traction is assumed more than it is measured
struct NullMode {
  DftNullMode mode{};  ///< set to zero
};

// Iterations.
struct NotConverged {
  std::size_t steps = 0;
  double estimate = 0.0;  ///< of the distance from the minimiser, over the tractions' 2-norm
};
struct IterationLimit {
  std::size_t iterations = 0;
};

// The answer beside the readings.
struct NoBands {};  ///< the array is too large for a covariance
struct Unexplained {
  double share = 0.0;  ///< of the readings' 2-norm that the answer leaves
};
struct Rounding {
  double bound = 0.0;  ///< how far it may have moved the answer, over its 2-norm
};
struct EstimatedWeight {
  double value = 1.0;  ///< of the tangential traction
};
struct ChannelOffset {
  std::string channel{};
  double value = 0.0;  ///< as the channel's readings
  Dimension dimension = Dimension::none;
};
struct OffsetsFound {
  std::vector<ChannelOffset> channels{};
  std::optional<Units> units{};  ///< the scene's: remarks are told where the scene is not at hand
};
struct ModelError {
  double times = 0.0;  ///< the noise stated
  bool held = false;   ///< by the bands, as if it were noise
};
struct FlatKernel {
  double share = 0.0;  ///< of the force, that a flat layer's formula is off on this curved skin
};
struct MixtureLeftOut {};  ///< one alpha answers: all windows would take long
struct Clipped {
  std::vector<std::size_t> taxels{};  ///< that read the end of their range, rising
  std::vector<std::string> names{};   ///< theirs, as many
  bool range_known = false;           ///< the scene states it
  bool left_out = false;              ///< the answer is that of the others
};
struct DataDoubted {
  DataVerdict data{};      ///< not consistent
  std::string taxel{};     ///< the name of its taxel; empty: it has none
  OffsetsFound offsets{};  ///< its offsets; none: it has none
};
struct Hidden {
  ModeSpace modes{};  ///< that no reading shows
};
struct ConstraintsIgnored {};  ///< they bind the method tikhonov alone

// The circuit.
struct VoltagesUnresolved {
  double condition = 1.0;  ///< of P, at most
  double limit = 0.0;      ///< what rounding alone may change the voltages by, relative
};

}  // namespace remark

using Remark =
    std::variant<remark::NoiseAmplified, remark::SignChanges, remark::DeadTaxelsRead,
                 remark::CutOff, remark::LowerBound, remark::NotOneContact, remark::DragInNoise,
                 remark::NullMode, remark::NotConverged, remark::IterationLimit, remark::NoBands,
                 remark::Unexplained, remark::Rounding, remark::EstimatedWeight,
                 remark::OffsetsFound, remark::ModelError, remark::FlatKernel, remark::Clipped,
                 remark::DataDoubted, remark::Hidden, remark::ConstraintsIgnored,
                 remark::VoltagesUnresolved, remark::MixtureLeftOut>;

using Remarks = std::vector<Remark>;

}  // namespace tactile_net::lab
