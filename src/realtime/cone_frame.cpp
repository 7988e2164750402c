#include "realtime/cone_frame.hpp"

#include <algorithm>
#include <cmath>

namespace tactile_net {
namespace {

/// Residual of a step, over the linear frame, beyond which its acceleration begins again.
constexpr double astray = 1e6;

}  // namespace
ReadyCone::ReadyCone(const ConePlan& plan, std::size_t unknowns, std::size_t values,
                     InstructionSet set, const Kernels& frame_loops)
    : cones{values, unknowns - 1,
            plan.friction_limit ? *plan.friction_limit * plan.tangential_scale : 0.0},
      drag_scale(plan.tangential_scale),
      bound(plan.bound),
      rounding(plan.rounding),
      unknown_offsets(plan.unknown_offsets),
      steps(plan.steps),
      product(plan.step, frame_loops.most_lines, frame_loops.most_shared),
      loops(frame_loops),
      cone_loops(cone_kernels(set)) {}

ConeScratch::ConeScratch(const ReadyCone& ready)
    : size_(ready.cones.cells * (1 + ready.cones.drags)),
      padded_(padded<float>(size_)),
      kept_(padded_),
      free_(padded_),
      v_(padded_),
      z_(padded_),
      input_(padded_),
      moved_(padded_),
      residual_(padded_),
      change_(padded_),
      zero_(padded_),
      pairs_(2 * anderson_pairs * padded_),
      product_(ready.product.scratch_size()) {}

ConeScratch::Done ConeScratch::bind(const ReadyCone& ready, std::span<double> tractions,
                                    std::size_t steps, bool each, Look look,
                                    void* context) noexcept {
  const std::size_t normal = ready.cones.cells;
  ConeVectors of{
      free_.data(),   v_.data(), z_.data(), input_.data(), moved_.data(), residual_.data(),
      change_.data(), {},        {}};
  for (std::size_t k = 0; k < anderson_pairs; ++k) {
    of.residuals[k] = pairs_.data() + 2 * k * padded_;
    of.combined[k] = of.residuals[k] + padded_;
  }
  std::copy(tractions.begin(), tractions.end(), kept_.data());
  double* const f0 = free_.data();
  std::copy(tractions.begin(), tractions.end(), f0);
  for (std::size_t i = normal; i < size_; ++i) f0[i] *= ready.drag_scale;
  // One unit for all: the power of two of the largest, so that frames times one have the same bits.
  const double unit = magnitude_of(ready.loops, f0, size_);
  for (std::size_t i = 0; i < size_; ++i) v_[i] = f0[i] /= unit;

  const auto norm = [&](const double* x) noexcept {
    return std::sqrt(ready.loops.dot(x, x, size_));
  };
  const double free_norm = norm(f0);
  AndersonGram gram{};
  Done done;
  bool fresh = true;       // no step was taken from which this one's changes are
  std::size_t pairs = 0;   // that there are
  std::size_t newest = 0;  // where the next one goes
  for (std::size_t step = 0;; ++step) {
    ready.cone_loops.project(of, ready.cones);
    (void)ready.loops.multiply32(ready.product, {input_.data(), zero_.data()}, moved_.data(),
                                 product_.data(), magnitude_of(ready.loops, input_.data(), size_),
                                 {}, unlimited);
    if (!fresh && pairs < anderson_pairs) ++pairs;
    const ConeSums sums = ready.cone_loops.look(of, padded_, newest, fresh ? 0 : pairs);
    done.steps = step;
    const bool last = step == steps;
    if (last || each || look != nullptr) {
      const auto distance = [&]() noexcept {
        const double input = std::sqrt(sums.input);
        return unit * ready.bound *
               (std::sqrt(sums.residual) / cone_relaxation + ready.rounding * input +
                rounding_of_doubles *
                    (2.0 * free_norm + input + norm(v_.data()) + norm(moved_.data())));
      };
      if (last || each) done.distance = distance();
      if (!last && look != nullptr && look(context, step, done.distance)) {
        if (!each) done.distance = distance();
        break;
      }
      if (last) break;
    }
    AndersonSums weights{};
    if (std::isgreater(std::sqrt(sums.residual), astray * free_norm)) {
      // The acceleration led astray, which has not been seen: begin again.
      std::copy_n(f0, size_, v_.data());
      fresh = true;
      pairs = newest = 0;
      continue;
    }
    if (!fresh) {
      for (std::size_t k = 0; k < pairs; ++k) gram[newest][k] = gram[k][newest] = sums.gram[k];
      weights = anderson_weights(gram, sums.right, pairs);
      newest = (newest + 1) % anderson_pairs;
    }
    fresh = false;
    ready.cone_loops.go(of, padded_, weights, pairs);
  }
  ready.cone_loops.publish(of, ready.cones, unit, unit / ready.drag_scale, tractions.data());
  return done;
}

}  // namespace tactile_net
