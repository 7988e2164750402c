/// @file
/// The discrete sum by FFT (target tactile_net::spectral).
#pragma once

#include <memory>
#include <vector>

#include "tactile_net/sensing/sampled.hpp"

namespace tactile_net {

/// The discrete sum for one field after another: kernels are computed, and transformed where the
/// FFT is faster, when a field first needs them. One object per thread; the first use plans.
class SampledModel {
 public:
  /// @throw std::invalid_argument  the array or the material is out of range
  SampledModel(const SensorArray& array, const Material& material);
  ~SampledModel();
  SampledModel(SampledModel&&) noexcept;
  SampledModel& operator=(SampledModel&&) noexcept;

  /// The readings of `sampled_readings`; each block of a quantity by a traction is equal within
  /// 1e-13 of max|kernel| * sum|traction|.
  ///
  /// @throw std::invalid_argument  the field's sizes do not fit the array
  [[nodiscard]] std::vector<double> readings(const TractionField& field);

 private:
  struct Block;
  SensorArray array_;
  Material material_;
  std::vector<Channel> channels_;
  std::vector<std::unique_ptr<Block>> blocks_;  // per channel: normal, tangential
};

/// As `SampledModel`, which it makes anew on every call.
///
/// @throw std::invalid_argument  as `sampled_readings`
[[nodiscard]] std::vector<double> fast_sampled_readings(const SensorArray& array,
                                                        const Material& material,
                                                        const TractionField& field);

}  // namespace tactile_net
