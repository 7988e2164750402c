/// @file
/// tactile_net::rt built a second time, with -march=native: a library of its own, with all of its
/// names hidden, so that both builds can be timed in turn in one process.
#pragma once

#include <memory>
#include <span>

#include "tactile_net/realtime/contact_estimator.hpp"

namespace bench {

struct NativeEstimator;
[[gnu::visibility("default")]] NativeEstimator* make_native(const tactile_net::EstimatorPlan& plan);
[[gnu::visibility("default")]] void destroy(NativeEstimator* estimator) noexcept;
[[gnu::visibility("default")]] tactile_net::FrameStatus update(
    NativeEstimator& estimator, std::span<const double> readings,
    tactile_net::ContactEstimate& estimate) noexcept;

struct DestroyNative {
  void operator()(NativeEstimator* estimator) const noexcept { destroy(estimator); }
};
using Native = std::unique_ptr<NativeEstimator, DestroyNative>;

}  // namespace bench
