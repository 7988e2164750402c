/// @file
/// What is suspicious about a recording, beside its scene: a type each, with its name in JSON
/// (`kind`), what was seen (`text`), and its numbers. The sentences for one recording, and what to
/// do, are `report::in_words` and `report::advice`.
#pragma once

#include <cstddef>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "tactile_net/lab/frame_runs.hpp"
#include "tactile_net/numeric/fields.hpp"

namespace tactile_net::lab {

namespace finding {

// The frames as they come.

struct NoFrames {
  static constexpr std::string_view kind = "no_frames";
  static constexpr std::string_view text = "The recording holds no frame.";
  static constexpr std::tuple<> described{};
};

struct TimeBackwards {
  std::size_t count = 0;
  std::size_t first = 0;
  std::size_t rollovers = 0;

  static constexpr std::string_view kind = "time_backwards";
  static constexpr std::string_view text = "A frame's time is before that of the frame before it.";
  static constexpr auto described =
      std::tuple{field("count", &TimeBackwards::count, "How often."),
                 field("first", &TimeBackwards::first, "The first such frame."),
                 field("rollovers", &TimeBackwards::rollovers,
                       "How often that looks like a counter of 32 bits that begins anew.")};
};

struct TimeRepeats {
  std::size_t count = 0;
  std::size_t first = 0;

  static constexpr std::string_view kind = "time_repeats";
  static constexpr std::string_view text = "A frame has the time of the frame before it.";
  static constexpr auto described =
      std::tuple{field("count", &TimeRepeats::count, "How often."),
                 field("first", &TimeRepeats::first, "The first such frame.")};
};

struct FramesRepeat {
  FrameRuns frames{};

  static constexpr std::string_view kind = "frames_repeat";
  static constexpr std::string_view text =
      "Frames equal the frame before them in every reading: rows stand twice.";
  static constexpr auto described =
      std::tuple{field("frames", &FramesRepeat::frames, "The copies.")};
};

struct ValuesMissing {
  std::size_t values = 0;
  FrameRuns frames{};
  std::vector<std::size_t> taxels{};

  static constexpr std::string_view kind = "values_missing";
  static constexpr std::string_view text = "Fields are empty or hold no number.";
  static constexpr auto described = std::tuple{
      field("values", &ValuesMissing::values, "How many fields."),
      field("frames", &ValuesMissing::frames, "The frames that miss a value."),
      field("taxels", &ValuesMissing::taxels, "Taxels that miss more than half of their frames.")};
};

struct CodesForMissing {
  struct Code {
    double number = 0.0;
    std::size_t fields = 0;
    std::size_t frames = 0;

    static constexpr auto described =
        std::tuple{field("number", &Code::number, "The code, as the file has it."),
                   field("fields", &Code::fields, "Fields that hold it."),
                   field("frames", &Code::frames, "Frames that hold nothing else.")};
  };
  std::vector<Code> codes{};

  static constexpr std::string_view kind = "codes_for_missing";
  static constexpr std::string_view text =
      "Whole numbers, such as 65535 or -1, come again far from all others while nothing happens "
      "beside them: they stand for missing values. Nothing else is judged then.";
  static constexpr auto described =
      std::tuple{field("codes", &CodesForMissing::codes, "Each code, in rising order.")};
};

struct SignsLost {
  std::vector<std::size_t> channels{};
  double codes = 0.0;
  std::size_t jumps = 0;

  static constexpr std::string_view kind = "signs_lost";
  static constexpr std::string_view text =
      "Whole numbers jump from near 0 to near 255 (or 65535), and none lies between: those below "
      "zero lost their sign. Nothing else is judged then.";
  static constexpr auto described = std::tuple{
      field("channels", &SignsLost::channels, "The channels that have such numbers."),
      field("codes", &SignsLost::codes, "By how much those numbers are too large: 256 or 65536."),
      field("jumps", &SignsLost::jumps, "How often a reading jumps from one end to the other.")};
};

struct FramesNormalised {
  double number = 0.0;
  std::size_t frames = 0;

  static constexpr std::string_view kind = "frames_normalised";
  static constexpr std::string_view text =
      "The largest number of every frame is the same one, now one taxel's and now another's: each "
      "frame was divided by its own largest reading. Nothing else is judged then.";
  static constexpr auto described =
      std::tuple{field("number", &FramesNormalised::number, "That number, as the file has it."),
                 field("frames", &FramesNormalised::frames, "Frames whose largest number it is.")};
};

struct SlowChannels {
  std::vector<std::size_t> channels{};
  std::vector<double> every{};
  std::vector<std::size_t> last{};
  bool all = false;

  static constexpr std::string_view kind = "slow_channels";
  static constexpr std::string_view text =
      "All readings of a channel are new in some frames only, and repeat between: the channel is "
      "read at a rate of its own.";
  static constexpr auto described = std::tuple{
      field("channels", &SlowChannels::channels, "The channels that repeat."),
      field("every", &SlowChannels::every,
            "Frames from new readings of each channel to the next, on average."),
      field("last", &SlowChannels::last, "The last frame in which each channel is new."),
      field("all", &SlowChannels::all, "Whether every channel does: whole rows are copies.")};
};

// Single taxels, by their numbers in rising order.

struct DeadTaxels {
  std::vector<std::size_t> taxels{};

  static constexpr std::string_view kind = "dead_taxels";
  static constexpr std::string_view text =
      "Taxels read zero in every frame, or feel nothing while all neighbours feel a load.";
  static constexpr auto described =
      std::tuple{field("taxels", &DeadTaxels::taxels, "The dead taxels.")};
};

struct StuckTaxels {
  std::vector<std::size_t> taxels{};
  std::size_t worst = 0;
  std::size_t first = 0;
  std::size_t frames = 0;

  static constexpr std::string_view kind = "stuck_taxels";
  static constexpr std::string_view text =
      "Taxels hold one value for longer than chance allows, though the others change.";
  static constexpr auto described =
      std::tuple{field("taxels", &StuckTaxels::taxels, "The stuck taxels."),
                 field("worst", &StuckTaxels::worst, "The taxel that holds its value longest."),
                 field("first", &StuckTaxels::first, "The frame from which it holds the value."),
                 field("frames", &StuckTaxels::frames, "For how many frames.")};
};

struct NoisyTaxels {
  std::vector<std::size_t> taxels{};
  std::size_t worst = 0;
  double times = 0.0;

  static constexpr std::string_view kind = "noisy_taxels";
  static constexpr std::string_view text =
      "Taxels have more than 4 times the noise of their channel.";
  static constexpr auto described =
      std::tuple{field("taxels", &NoisyTaxels::taxels, "The noisy taxels."),
                 field("worst", &NoisyTaxels::worst, "The noisiest taxel."),
                 field("times", &NoisyTaxels::times, "Its noise over that of its channel.")};
};

struct SingleFrameSpikes {
  std::vector<std::size_t> taxels{};
  std::size_t worst = 0;
  std::size_t frame = 0;
  std::size_t frames = 0;
  double times = 0.0;

  static constexpr std::string_view kind = "single_frame_spikes";
  static constexpr std::string_view text =
      "A taxel jumps for one frame and comes back, and its neighbours do not: no load does that.";
  static constexpr auto described = std::tuple{
      field("taxels", &SingleFrameSpikes::taxels, "The taxels that jump."),
      field("worst", &SingleFrameSpikes::worst, "The taxel with the largest jump."),
      field("frame", &SingleFrameSpikes::frame, "The frame of that jump."),
      field("frames", &SingleFrameSpikes::frames, "Frames with a jump, at least."),
      field("times", &SingleFrameSpikes::times, "The largest jump over the channel's noise.")};
};

struct EqualReadings {
  std::vector<std::vector<std::size_t>> groups{};
  std::vector<std::size_t> taxels{};
  std::size_t frames = 0;

  static constexpr std::string_view kind = "equal_readings";
  static constexpr std::string_view text =
      "Readings are equal in every frame, noise included: two inputs on one wire, or a column "
      "twice.";
  static constexpr auto described =
      std::tuple{field("groups", &EqualReadings::groups,
                       "Readings, counted channel after channel, that are equal to each other."),
                 field("taxels", &EqualReadings::taxels, "The taxels of all these readings."),
                 field("frames", &EqualReadings::frames, "In how many frames they are equal.")};
};

struct SaturatedTaxels {
  std::vector<std::size_t> taxels{};
  double limit = 0.0;
  std::size_t frames = 0;

  static constexpr std::string_view kind = "saturated_taxels";
  static constexpr std::string_view text =
      "The largest or least values of taxels are many equal ones: the range ends there.";
  static constexpr auto described = std::tuple{
      field("taxels", &SaturatedTaxels::taxels, "The taxels that are cut off."),
      field("limit", &SaturatedTaxels::limit, Measure::reading, "The value of the first of them."),
      field("frames", &SaturatedTaxels::frames, "Frames in which that taxel has this value.")};
};

struct WornTaxels {
  std::vector<std::size_t> taxels{};
  std::size_t worst = 0;
  double share = 0.0;

  static constexpr std::string_view kind = "worn_taxels";
  static constexpr std::string_view text =
      "Taxels read far less than any contact that explains the other taxels makes them read.";
  static constexpr auto described =
      std::tuple{field("taxels", &WornTaxels::taxels, "The taxels that read too little."),
                 field("worst", &WornTaxels::worst, "The taxel that reads the least share."),
                 field("share", &WornTaxels::share, "What it reads over what it should read.")};
};

struct TaxelsLeftOut {
  std::vector<std::size_t> taxels{};

  static constexpr std::string_view kind = "taxels_left_out";
  static constexpr std::string_view text =
      "Taxels were left out, as if the scene had called them dead: the recording shows that they "
      "are broken.";
  static constexpr auto described =
      std::tuple{field("taxels", &TaxelsLeftOut::taxels,
                       "The taxels that the recording shows to be dead, stuck or worn.")};
};

// What the sensor reads when nothing happens.

struct Baseline {
  std::vector<double> values{};
  std::size_t frames = 0;
  double largest = 0.0;
  double times = 0.0;
  bool loaded = false;

  static constexpr std::string_view kind = "baseline";
  static constexpr std::string_view text =
      "The readings at rest are not zero, and no load explains them.";
  static constexpr auto described = std::tuple{
      field("values", &Baseline::values, Measure::reading,
            "The median of each reading at rest, channel after channel; 0 of dead taxels."),
      field("frames", &Baseline::frames, "How many quiet frames it is the median of."),
      field("largest", &Baseline::largest, Measure::reading, "The largest of the values' sizes."),
      field("times", &Baseline::times, "The values' rms over that of the noise."),
      field("loaded", &Baseline::loaded, "Whether a contact seems to be in these frames too.")};
};

struct ZeroUnderLoad {
  double force = 0.0;
  std::size_t first = 0;
  std::size_t last = 0;

  static constexpr std::string_view kind = "zero_under_load";
  static constexpr std::string_view text =
      "The pad is pulled as a contact would press it: the zero was taken while something touched.";
  static constexpr auto described = std::tuple{
      field("force", &ZeroUnderLoad::force, Measure::load,
            "The force of the frame that pulls most, below zero."),
      field("first", &ZeroUnderLoad::first, "The first of the frames that are loaded least."),
      field("last", &ZeroUnderLoad::last,
            "The last of these frames; their mean is a better zero.")};
};

struct Drift {
  double largest = 0.0;
  double times = 0.0;
  std::size_t from = 0;
  std::size_t to = 0;
  bool loaded = false;

  static constexpr std::string_view kind = "drift";
  static constexpr std::string_view text =
      "The readings at rest change by more than twice the noise, and no load explains the change.";
  static constexpr auto described =
      std::tuple{field("largest", &Drift::largest, Measure::reading,
                       "The largest change of a reading between two quiet stretches."),
                 field("times", &Drift::times, "The change's rms over that of the noise."),
                 field("from", &Drift::from, "A frame of the one stretch."),
                 field("to", &Drift::to, "A frame of the other stretch."),
                 field("loaded", &Drift::loaded, "Whether contacts last all the time.")};
};

// The noise, where the scene does not state it and the answer waits for it.

struct NoiseTaken {
  std::vector<double> of_channel{};

  static constexpr std::string_view kind = "noise_taken";
  static constexpr std::string_view text =
      "The scene states no noise: the noise of still frames was taken for it.";
  static constexpr auto described =
      std::tuple{field("of_channel", &NoiseTaken::of_channel, Measure::reading,
                       "The rms that still frames show, of each channel.")};
};

// Noise and scale, where the scene states the noise.

struct NoiseDiffers {
  std::size_t channel = 0;
  double estimated = 0.0;
  double stated = 0.0;

  static constexpr std::string_view kind = "noise_differs";
  static constexpr std::string_view text =
      "The noise is more than twice what the scene states, or less than half of it.";
  static constexpr auto described = std::tuple{
      field("channel", &NoiseDiffers::channel, "The channel that differs most."),
      field("estimated", &NoiseDiffers::estimated, Measure::reading, "The rms that frames show."),
      field("stated", &NoiseDiffers::stated, Measure::reading, "The rms that the scene states.")};
};

struct NoiseColoured {
  double correlation = 0.0;

  static constexpr std::string_view kind = "noise_coloured";
  static constexpr std::string_view text =
      "The noise of one frame is found again in the next frame.";
  static constexpr auto described =
      std::tuple{field("correlation", &NoiseColoured::correlation,
                       "The correlation of a reading's noise with that of the frame before.")};
};

struct ResidualDiffers {
  double times = 0.0;

  static constexpr std::string_view kind = "residual_differs";
  static constexpr std::string_view text =
      "Tractions leave more than 5 times the noise stated, or less than a fifth of it.";
  static constexpr auto described =
      std::tuple{field("times", &ResidualDiffers::times,
                       "The residual over the noise stated, median of the frames solved.")};
};

struct ScaleBy1000 {
  double times = 0.0;

  static constexpr std::string_view kind = "scale_by_1000";
  static constexpr std::string_view text =
      "Noise or residual are 300 to 3000 times off what the scene states, as kPa taken for Pa are.";
  static constexpr auto described =
      std::tuple{field("times", &ScaleBy1000::times,
                       "Noise or residual over the noise stated: about 1000, or 1/1000.")};
};

// The calibration.

struct GainsChanged {
  std::vector<std::size_t> readings{};
  std::vector<double> changes{};
  std::vector<double> sds{};

  static constexpr std::string_view kind = "gains_changed";
  static constexpr std::string_view text =
      "No contact explains these readings beside the others with the gains of `[calibration]`: "
      "calibrate again.";
  static constexpr auto described =
      std::tuple{field("readings", &GainsChanged::readings,
                       "Readings whose gain changed, counted channel after channel."),
                 field("changes", &GainsChanged::changes,
                       "How much each changed: -0.03 reads 3 % less than calibrated."),
                 field("sds", &GainsChanged::sds, "The standard deviation of each change.")};
};

// The sign.

struct WholePadPulled {
  std::size_t pulled = 0;
  std::size_t loaded = 0;

  static constexpr std::string_view kind = "whole_pad_pulled";
  static constexpr std::string_view text =
      "Nearly all tractions pull in most loaded frames: the sign of the readings is wrong.";
  static constexpr auto described = std::tuple{
      field("pulled", &WholePadPulled::pulled, "Frames whose tractions nearly all pull."),
      field("loaded", &WholePadPulled::loaded, "Frames solved that hold more than noise.")};
};

// The order of the taxels, or what comes to the same, the signs and names of their channels.

struct OrderMirrored {
  bool along_y = false;
  bool along_z = false;
  bool exchanged = false;
  std::size_t frames = 0;
  std::size_t of = 0;

  static constexpr std::string_view kind = "order_mirrored";
  static constexpr std::string_view text =
      "The readings are likelier those of taxels in another order, or of a shear with the other "
      "sign or another name.";
  static constexpr auto described = std::tuple{
      field("along_y", &OrderMirrored::along_y, "Whether taxels are numbered against y."),
      field("along_z", &OrderMirrored::along_z, "Whether taxels are numbered against z."),
      field("exchanged", &OrderMirrored::exchanged,
            "Whether rows were taken for columns, before any mirroring."),
      field("frames", &OrderMirrored::frames, "Loaded frames that are likelier so."),
      field("of", &OrderMirrored::of, "Loaded frames that were asked.")};
};

struct OrderSerpentine {
  bool columns = false;
  std::size_t first = 0;
  std::size_t frames = 0;
  std::size_t of = 0;

  static constexpr std::string_view kind = "order_serpentine";
  static constexpr std::string_view text =
      "The readings are likelier those of a skin of which every second row or column is read "
      "backwards, as a wire that turns at each end does.";
  static constexpr auto described =
      std::tuple{field("columns", &OrderSerpentine::columns,
                       "Whether columns are read backwards; false: rows are."),
                 field("first", &OrderSerpentine::first, "The first of those that are: 0 or 1."),
                 field("frames", &OrderSerpentine::frames, "Loaded frames that are likelier so."),
                 field("of", &OrderSerpentine::of, "Loaded frames that were asked.")};
};

// Readings and stiffness.

struct StrainTooLarge {
  double strain = 0.0;

  static constexpr std::string_view kind = "strain_too_large";
  static constexpr std::string_view text =
      "Strains exceed 100 %: pixels taken for millimetres, or percents for strains.";
  static constexpr auto described = std::tuple{
      field("strain", &StrainTooLarge::strain, "The largest strain that readings show.")};
};

struct TractionExceedsModulus {
  double times = 0.0;

  static constexpr std::string_view kind = "traction_exceeds_modulus";
  static constexpr std::string_view text =
      "The largest traction is more than 3 times Young's modulus.";
  static constexpr auto described =
      std::tuple{field("times", &TractionExceedsModulus::times, "Traction over modulus.")};
};

struct DeformationTiny {
  double times = 0.0;

  static constexpr std::string_view kind = "deformation_tiny";
  static constexpr std::string_view text =
      "The largest traction is below a 10,000th of Young's modulus: hardly a touch.";
  static constexpr auto described =
      std::tuple{field("times", &DeformationTiny::times, "Traction over modulus.")};
};

// The scene alone.

struct MixedUnits {
  double modulus = 0.0;
  double length = 0.0;

  static constexpr std::string_view kind = "mixed_units";
  static constexpr std::string_view text =
      "The modulus looks like Pa and the lengths like mm, or the modulus like MPa and the lengths "
      "like m.";
  static constexpr auto described = std::tuple{
      field("modulus", &MixedUnits::modulus, Measure::stress, "Young's modulus in the scene."),
      field("length", &MixedUnits::length, Measure::length, "The array's length.")};
};

struct DepthBeyondArray {
  double depth = 0.0;
  double length = 0.0;

  static constexpr std::string_view kind = "depth_beyond_array";
  static constexpr std::string_view text = "The taxels lie deeper than the array is long.";
  static constexpr auto described = std::tuple{
      field("depth", &DepthBeyondArray::depth, Measure::length, "The largest depth."),
      field("length", &DepthBeyondArray::length, Measure::length, "The array's length.")};
};

struct PitchCoarse {
  double pitch = 0.0;
  double depth = 0.0;

  static constexpr std::string_view kind = "pitch_coarse";
  static constexpr std::string_view text = "The pitch is more than twice the depth.";
  static constexpr auto described =
      std::tuple{field("pitch", &PitchCoarse::pitch, Measure::length, "From taxel to taxel."),
                 field("depth", &PitchCoarse::depth, Measure::length, "The least depth.")};
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

/// Its kind: "dead_taxels".
[[nodiscard]] inline std::string_view name(const Finding& finding) {
  return std::visit([](const auto& one) { return one.kind; }, finding);
}

}  // namespace tactile_net::lab
