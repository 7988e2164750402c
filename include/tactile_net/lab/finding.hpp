/// @file
/// What is suspicious about a recording, beside its scene: a type and its numbers each. The
/// sentences, and what to do, are `report::in_words` and `report::advice`.
#pragma once

#include <cstddef>
#include <string_view>
#include <variant>
#include <vector>

#include "tactile_net/lab/frame_runs.hpp"

namespace tactile_net::lab {

namespace finding {

// The frames as they come.
struct NoFrames {};
struct TimeBackwards {
  std::size_t count = 0;      ///< how often
  std::size_t first = 0;      ///< the first frame whose time is before that of the frame before
  std::size_t rollovers = 0;  ///< of them as a counter of 32 bits has them that begins anew
};
struct TimeRepeats {
  std::size_t count = 0;
  std::size_t first = 0;  ///< the first frame with the time of the frame before
};
struct FramesRepeat {
  FrameRuns frames{};  ///< equal to the frame before in every reading
};
struct ValuesMissing {
  std::size_t values = 0;
  FrameRuns frames{};
  std::vector<std::size_t> taxels{};  ///< that miss values in more than half of the frames
};

struct CodesForMissing {
  struct Code {
    double number = 0.0;     ///< as the file has it
    std::size_t fields = 0;  ///< that hold it
    std::size_t frames = 0;  ///< that hold nothing else
  };
  std::vector<Code> codes{};  ///< rising
};

struct SignsLost {
  std::vector<std::size_t> channels{};  ///< whose numbers below zero are there as `codes` more
  double codes = 0.0;                   ///< 2^8 or 2^16
  std::size_t jumps = 0;                ///< from one end of them to the other
};

// Frames divided each by a number of its own.
struct FramesNormalised {
  double number = 0.0;     ///< as the file has it: the largest of a channel's readings
  std::size_t frames = 0;  ///< in which it is
};

struct SlowChannels {
  std::vector<std::size_t> channels{};  ///< that are renewed in some frames only, at a rate
  std::vector<double> every{};          ///< of each: frames from one renewal to the next
  std::vector<std::size_t> last{};      ///< of each: the frame that renewed it last
  bool all = false;                     ///< all channels are
};

// Single taxels, rising numbers.
struct DeadTaxels {
  std::vector<std::size_t> taxels{};  ///< always zero, or feel nothing where both neighbours do
};
struct StuckTaxels {
  std::vector<std::size_t> taxels{};  ///< that hold one value though the others are noisy
  std::size_t worst = 0;              ///< the one that holds longest
  std::size_t first = 0;              ///< from this frame on
  std::size_t frames = 0;             ///< for so many
};
struct NoisyTaxels {
  std::vector<std::size_t> taxels{};
  std::size_t worst = 0;
  double times = 0.0;  ///< the worst one's noise over that of its channel
};
struct SingleFrameSpikes {
  std::vector<std::size_t> taxels{};  ///< that jump for one frame, alone, as under no load
  std::size_t worst = 0;
  std::size_t frame = 0;   ///< of the worst one's largest jump
  std::size_t frames = 0;  ///< with a jump, at least
  double times = 0.0;      ///< the largest jump over the noise of its channel
};
struct EqualReadings {
  std::vector<std::vector<std::size_t>> groups{};  ///< readings that are equal in every frame
  std::vector<std::size_t> taxels{};               ///< of all of them
  std::size_t frames = 0;
};
struct SaturatedTaxels {
  std::vector<std::size_t> taxels{};  ///< whose largest or least values are many equal ones
  double limit = 0.0;                 ///< that value, of the first of them
  std::size_t frames = 0;             ///< how many of its frames lie there
};

struct WornTaxels {
  std::vector<std::size_t> taxels{};  ///< that read far less than loads on the others let them
  std::size_t worst = 0;
  double share = 0.0;  ///< what the worst one reads, of that
};

struct TaxelsLeftOut {
  std::vector<std::size_t> taxels{};  ///< that the recording shows to be dead, stuck or worn
};

// What the sensor reads when nothing happens.
struct Baseline {
  std::vector<double> values{};  ///< of every reading, channels x count; 0 for dead taxels
  std::size_t frames = 0;        ///< quiet ones, whose median it is
  double largest = 0.0;          ///< |value|
  double times = 0.0;            ///< rms of the values over that of the noise
  bool loaded = false;           ///< much of it looks like a contact: it is no unloaded frame
};
struct ZeroUnderLoad {
  double force = 0.0;     ///< of the frame that pulls most [N/m], of a skin [N]: < 0
  std::size_t first = 0;  ///< frames that pull alike,
  std::size_t last = 0;   ///< which are the least loaded ones
};
struct Drift {
  double largest = 0.0;  ///< |change| of a reading between two quiet stretches
  double times = 0.0;    ///< rms of the change over that of the noise
  std::size_t from = 0;  ///< a frame of the one stretch
  std::size_t to = 0;    ///< a frame of the other
  bool loaded = false;   ///< contacts last all the time
};

// The noise, where the scene does not state it and the answer waits for it.
struct NoiseTaken {
  std::vector<double> of_channel{};  ///< rms that still frames show, taken for it
};

// Noise and scale, where the scene states the noise.
struct NoiseDiffers {
  std::size_t channel = 0;
  double estimated = 0.0;
  double stated = 0.0;
};
struct NoiseColoured {
  double correlation = 0.0;  ///< of a reading's noise with that of the frame before
};
struct ResidualDiffers {
  double times = 0.0;  ///< the residual over the noise stated, median of the frames solved
};
struct ScaleBy1000 {
  double times = 0.0;  ///< noise or residual over the noise stated: about 1000 or 1/1000
};

// The calibration.
struct GainsChanged {
  std::vector<std::size_t> readings{};  ///< channel after channel, rising
  std::vector<double> changes{};        ///< of each of them: -0.03 reads 3 % less than calibrated
  std::vector<double> sds{};            ///< of the changes
};

// The sign.
struct WholePadPulled {
  std::size_t pulled = 0;  ///< frames whose tractions nearly all pull
  std::size_t loaded = 0;  ///< frames that were solved and hold more than noise
};

// The order of the taxels, or what comes to the same, the signs and names of their channels.
struct OrderMirrored {
  bool along_y = false;    ///< the readings are those of taxels numbered against y
  bool along_z = false;    ///< or against z
  bool exchanged = false;  ///< after rows were taken for columns
  std::size_t frames = 0;  ///< that are likelier so
  std::size_t of = 0;      ///< that were asked
};

struct OrderSerpentine {
  bool columns = false;    ///< every second column is read backwards; false: every second row
  std::size_t first = 0;   ///< of those that are: 0 or 1
  std::size_t frames = 0;  ///< that are likelier so
  std::size_t of = 0;      ///< that were asked
};

// Readings and stiffness.
struct StrainTooLarge {
  double strain = 0.0;  ///< the largest that readings show, > 1
};
struct TractionExceedsModulus {
  double times = 0.0;  ///< the largest traction over Young's modulus, > 3
};
struct DeformationTiny {
  double times = 0.0;  ///< the same, far below what touch is
};

// The scene alone.
struct MixedUnits {
  double modulus = 0.0;  ///< E, as the scene has it [Pa]
  double length = 0.0;   ///< of the array [m]
};
struct DepthBeyondArray {
  double depth = 0.0;   ///< the largest
  double length = 0.0;  ///< of the array
};
struct PitchCoarse {
  double pitch = 0.0;
  double depth = 0.0;  ///< the least
};

}  // namespace finding

using Finding = std::variant<
    finding::NoFrames, finding::TimeBackwards, finding::TimeRepeats, finding::FramesRepeat,
    finding::ValuesMissing, finding::CodesForMissing, finding::SignsLost, finding::FramesNormalised,
    finding::SlowChannels, finding::DeadTaxels, finding::StuckTaxels, finding::NoisyTaxels,
    finding::SingleFrameSpikes, finding::EqualReadings, finding::SaturatedTaxels,
    finding::WornTaxels, finding::TaxelsLeftOut, finding::Baseline, finding::ZeroUnderLoad,
    finding::Drift, finding::NoiseTaken, finding::NoiseDiffers, finding::NoiseColoured,
    finding::ResidualDiffers, finding::ScaleBy1000, finding::GainsChanged, finding::WholePadPulled,
    finding::OrderMirrored, finding::OrderSerpentine, finding::StrainTooLarge,
    finding::TractionExceedsModulus, finding::DeformationTiny, finding::MixedUnits,
    finding::DepthBeyondArray, finding::PitchCoarse>;
using Findings = std::vector<Finding>;

/// The spelling in JSON: "dead_taxels".
[[nodiscard]] std::string_view name(const Finding& finding) noexcept;

}  // namespace tactile_net::lab
