#include "bench/native.hpp"

namespace bench {

struct NativeEstimator {
  tactile_net::ContactEstimator estimator;
};

NativeEstimator* make_native(const tactile_net::EstimatorPlan& plan) {
  return new NativeEstimator{tactile_net::ContactEstimator(plan)};
}
void destroy(NativeEstimator* estimator) noexcept { delete estimator; }
tactile_net::FrameStatus update(NativeEstimator& estimator, std::span<const double> readings,
                                tactile_net::ContactEstimate& estimate) noexcept {
  return estimator.estimator.update(readings, estimate);
}

}  // namespace bench
