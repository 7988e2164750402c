/// @file
/// What lies between the pad's ideal response and a recorded reading, one effect at a time.
///
/// Every effect is a plain struct that says how strong it is, in a file of its own, and a function
/// `make_effect` that turns it into a stage of the signal path (signal_path.hpp); it throws
/// std::invalid_argument where a value is out of the range that the struct states, a quantity that
/// the sensor reads has none, or lists do not fit it. A strength of zero makes no stage: it
/// is the effect's absence, bit for bit. What is drawn at random comes from a stream of the
/// effect's own, so that no effect changes what another draws.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net {

/// A strength in the unit of the readings: one for every quantity that the sensor reads.
template <typename T>
using PerQuantity = std::map<Quantity, T>;

/// A moment at which the path is gone through.
struct Instant {
  double time = 0.0;     ///< [s]
  double since = 0.0;    ///< time since the moment before [s]; 0: the load has jumped
  bool recorded = true;  ///< a frame is taken
  bool opens = false;    ///< the next frame's sampling window opens
};

/// What a user must know of the frame last taken: an effect has cut readings off at its range.
struct CutOffNote {
  std::string_view effect{};  ///< its name in a scene: "saturation"
  std::size_t cut_off = 0;    ///< readings that were beyond the range, >= 1
  std::size_t readings = 0;   ///< all readings of the frame
};

/// One stage. Between two moments every reading is a straight line.
class SensorEffect {
 public:
  virtual ~SensorEffect() = default;

  /// Replaces the readings that come in, channels x count, by those that go out.
  virtual void apply(const Instant& at, std::span<double> readings) = 0;

  /// Begins a memory: replaces the readings of a sensor that has been unloaded for ever.
  virtual void rest(std::span<double> readings) { apply(Instant{}, readings); }

  /// True if what goes out depends on what came in before.
  [[nodiscard]] virtual bool has_memory() const noexcept { return false; }

  /// Says of the frame last taken how many readings were cut off; absent: none.
  [[nodiscard]] virtual std::optional<CutOffNote> note() const { return std::nullopt; }
};

}  // namespace tactile_net
