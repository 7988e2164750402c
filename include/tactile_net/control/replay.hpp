/// @file
/// A recording of any length through a controller's plan, as its controller would have answered,
/// in constant memory and on as many cores as there are.
///
///     replay(
///         estimator, [&](std::span<double> readings) { return source.next(readings); },
///         [&](const ReplayedFrame& frame) { sink.add(frame.estimate.tractions); });
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net {

/// One frame and its answer; valid during the call that is given it.
struct ReplayedFrame {
  std::span<const double> readings;
  FrameStatus status;               ///< not ok: all of the estimate is unknown, NaN
  const ContactEstimate& estimate;  ///< with the tractions
};

struct ReplayOptions {
  std::size_t threads = 0;  ///< at most so many; 0: one a processor (control/batch.hpp)
  /// Frames that are read before the first of them is answered; 1: each is answered before the next
  /// is read; 0: as many as 32 MB hold, at most 4096.
  std::size_t block = 0;
};

/// Answers the frames of a recording one after another, with the bits of `update` on each, whatever
/// the options, at the cost of `update_batch`. Not for the control loop: allocates.
///
/// @param next  fills in the next frame's readings, `estimator.readings()` of them; false: there is
///              none
/// @param use   is called with each frame, in their order; both are called by this thread alone
/// @throw       what `next` and `use` throw; `use` has had all frames before one where `next`
///              throws
void replay(ContactEstimator& estimator,
            const std::function<bool(std::span<double> readings)>& next,
            const std::function<void(const ReplayedFrame& frame)>& use,
            const ReplayOptions& options = {});

}  // namespace tactile_net
