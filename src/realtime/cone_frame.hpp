/// @file
/// A frame's steps from the linear tractions to those that contact allows (cone_plan.hpp). Private.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <span>

#include "realtime/cone_kernels.hpp"
#include "realtime/kernels.hpp"
#include "realtime/ready_product.hpp"
#include "tactile_net/realtime/cone_plan.hpp"

namespace tactile_net {

/// What the plan fixes.
struct ReadyCone {
  ReadyCone(const ConePlan& plan, std::size_t unknowns, std::size_t values, InstructionSet set,
            const Kernels& frame_loops);

  Cones cones;
  double drag_scale;
  double bound, rounding;
  bool unknown_offsets;
  std::size_t steps;
  ReadyProduct<float> product;
  const Kernels& loops;
  const ConeKernels& cone_loops;
};

/// What one thread writes.
class ConeScratch {
 public:
  explicit ConeScratch(const ReadyCone& ready);

  /// The linear frame that the last call began with.
  [[nodiscard]] std::span<const double> free() const noexcept { return {kept_.data(), size_}; }

  struct Done {
    double distance = 0.0;  ///< bound of |f - f*|_P [weighted readings]
    std::size_t steps = 0;
  };
  /// Called after each step with its number, and the bound where `each` is set; true: no more.
  using Look = bool (*)(void* context, std::size_t step, double distance);

  /// Replaces linear tractions, finite ones, by some that obey the constraints, after so many steps
  /// at most. No allocation, no exception, and no floating-point one; the same work for all frames
  /// but for where `look` ends them.
  Done bind(const ReadyCone& ready, std::span<double> tractions, std::size_t steps, bool each,
            Look look, void* context) noexcept;

  /// Calls `use` with each array.
  void for_each_array(auto& use) const noexcept {
    for (const Aligned<double>* const array :
         {&kept_, &free_, &v_, &z_, &input_, &moved_, &residual_, &change_, &zero_})
      use(*array);
    use(pairs_);
    use(product_);
  }

 private:
  /// What rounding in double may add to a distance, over the size of what is summed: 16 roundings.
  static constexpr double rounding_of_doubles = 0x1p-48;

  std::size_t size_;    // of tractions
  std::size_t padded_;  // whole cache lines of floats
  Aligned<double> kept_, free_, v_, z_, input_, moved_, residual_, change_, zero_;
  Aligned<float> pairs_;
  Aligned<float> product_;
};

}  // namespace tactile_net
