/// @file
/// A recording's frames through a controller's plan, on as many cores as there are.
///
///     std::vector<ContactEstimate> estimates(frames);  // each with the memory of its tractions
///     if (update_batch(estimator, readings, estimates) != FrameStatus::ok) ...
#pragma once

#include <cstddef>
#include <span>

#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net {

/// `ContactEstimator::update_batch` on several threads, with the same bits and status however many
/// threads there are: frames are independent. Allocates scratch of about 50 numbers per reading and
/// traction for each thread beyond the first; not for the control loop. Not thread-safe, as the
/// estimator.
///
/// @param threads  at most so many; 0: one a processor. Fewer where a thread would have less than
///                 64 frames, and where the system gives none
FrameStatus update_batch(ContactEstimator& estimator, std::span<const double> readings,
                         std::span<ContactEstimate> estimates, std::size_t threads = 0);

}  // namespace tactile_net
