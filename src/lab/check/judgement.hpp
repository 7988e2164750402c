/// @file
/// The parts of a recording's check, each of which looks at one kind of
/// evidence. Private.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lab/check/checked_sensor.hpp"
#include "lab/check/code_track.hpp"
#include "lab/check/equal_track.hpp"
#include "lab/check/pattern_solver.hpp"
#include "lab/check/rate_track.hpp"
#include "lab/check/rest.hpp"
#include "lab/check/spike_track.hpp"
#include "lab/check/threshold_track.hpp"
#include "sensing/frame_triples.hpp"
#include "sensing/reading_track.hpp"
#include "tactile_net/lab/readings_check.hpp"

namespace tactile_net::lab {

/// What all judges look at.
struct Evidence {
  const CheckedSensor& sensor;
  std::size_t frames;
  std::span<const ReadingTrack> tracks;  ///< per reading
  std::span<const FrameTriple> triples;
  std::span<const SpikeTrack::Spikes> spikes;  ///< per reading
  const ThresholdTrack& thresholds;
  std::vector<bool> living;  ///< per reading: its taxel is not dead, nor found to be broken

  /// Of each reading its taxel and channel.
  [[nodiscard]] const std::vector<Site>& sites() const { return sensor.layout.readings; }
  /// Readings of one quantity behind one another.
  [[nodiscard]] const std::vector<Channel>& channels() const { return sensor.layout.channels; }

  /// Readings that are cut off at the end of a range: they live, and no contact explains them.
  std::vector<bool> clipped{};

  /// Takes taxels out of what the next judges look at.
  void bury(std::span<const std::size_t> taxels);
  /// Per reading: contacts are sought by it.
  [[nodiscard]] std::vector<bool> telling() const;
};

/// Taxels that are dead, stuck, saturated or noisy, which are buried; and the
/// noise of the others, which nothing says where a threshold hides it. Saturated ones stay alive:
/// what they read below their limit is right.
[[nodiscard]] StillNoise judge_taxels(Evidence& evidence, Findings& findings);

/// Numbers that stand for values that are missing: the same, again and again, far from all others,
/// while nothing happens beside them. Not to be asked of an array so coarse that one taxel alone
/// may feel a load.
void judge_codes(const Evidence& evidence, const CodeTrack& track, const AnyScene& scene,
                 Findings& findings);

/// Readings that are equal in every frame, noise and all.
void judge_equal(const Evidence& evidence, const EqualTrack& track, Findings& findings);

/// Channels that are new in every so many frames only.
///
/// @return  these, whose groups of frames tell noise where `RateTrack::renewed` has put them
[[nodiscard]] std::vector<std::size_t> judge_rates(const RateTrack& track, Findings& findings);

/// Taxels that read far less than the contacts that explain the others would let them, and are
/// buried: as worn ones among those that feel much. Not to be asked beside saturated ones.
void judge_worn(Evidence& evidence, const StillNoise& noise, PatternSolver& solver,
                Findings& findings);

/// Taxels that jump for single frames.
void judge_spikes(const Evidence& evidence, const StillNoise& noise, PatternSolver& solver,
                  Findings& findings);

/// What the readings are when nothing presses, for whoever wants to take it
/// off.
struct RestState {
  /// Of every reading; empty: none was found to be off zero, or a contact is in it.
  std::vector<double> baseline{};
  std::size_t quiet = 0;  ///< groups of frames at rest
  bool loaded = false;    ///< a contact is in them: nothing is ever let go
  /// Rms of each channel about the rest, where it is more than what changes
  /// from frame to frame.
  std::vector<double> noise{};
};

[[nodiscard]] RestState judge_rest(const Evidence& evidence, const StillNoise& noise,
                                   PatternSolver& solver, Findings& findings);

/// Sign and residual, by solving some frames; fills in what the check says of
/// loads.
///
/// @param peak  the frame with the largest reading; empty: there is none
void judge_loads(const Evidence& evidence, std::span<const double> baseline,
                 std::span<const double> peak, PatternSolver& solver, Observer& observer,
                 ReadingsCheck& check);

/// Taxels that are numbered the other way, or rows that are columns: such readings are likelier
/// those of a load than the stated ones are. Where a channel is odd along the axis: a mirror image
/// of readings that know no direction is as true.
///
/// @param loaded  frames under load, without the baseline
void judge_order(const Evidence& evidence, const std::vector<std::vector<double>>& loaded,
                 PatternSolver& solver, ReadingsCheck& check);

/// Every second row or column of a skin read backwards, as by a wire that turns at each end: such
/// readings are likelier those of a load than the stated ones are. Of even skins.
void judge_serpentine(const Evidence& evidence, const AnyScene& scene,
                      std::span<const double> baseline, PatternSolver& solver, Findings& findings);

/// Gains that are no longer what [calibration] says, by frames under loads that nobody knows. Of
/// recordings that are sound otherwise, of up to 128 readings.
///
/// @param check  with the noise of its channels
void judge_gains(const Evidence& evidence, const Scene& scene, ReadingsCheck& check);

/// The noise and the residual beside the noise stated: their scale, before
/// anything else.
void judge_scale(ReadingsCheck& check);

/// Whether a frame's tractions nearly all pull, and how large they are
/// together.
struct Pull {
  double load = 0.0;  ///< sum |f_v| [Pa]
  bool pulled = false;
};
[[nodiscard]] Pull pull_of(std::span<const double> normal) noexcept;

/// Whether a ratio is about 1000 or 1/1000: a prefix that was mistaken for
/// another.
[[nodiscard]] bool is_thousandfold(double ratio) noexcept;

}  // namespace tactile_net::lab
