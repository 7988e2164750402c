/// @file
/// Batches of frames beside the loops that they stand for.
#pragma once

#include <cstddef>
#include <cstring>
#include <random>
#include <vector>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tests/catch.hpp"

namespace tactile_net {

inline std::vector<double> some_readings(std::size_t count, unsigned seed = 3) {
  std::mt19937 generator(seed);
  std::vector<double> readings(count);
  for (double& reading : readings) reading = static_cast<double>(generator()) / 0x1p31 - 1.0;
  return readings;
}

struct Update {
  std::vector<double> tractions;
  ContactEstimate estimate;
  FrameStatus status;
};

inline Update update(ContactEstimator& estimator, const std::vector<double>& readings) {
  Update result{std::vector<double>(estimator.tractions()), {}, FrameStatus::ok};
  result.estimate.tractions = result.tractions;
  result.status = estimator.update(readings, result.estimate);
  return result;
}

/// Everything but the tractions and the time, as numbers whose bits can be compared.
inline std::vector<double> numbers_of(const ContactEstimate& e) {
  return {e.space.force[0],
          e.space.force[2],
          e.space.moment[1],
          e.space.centre[2],
          e.normal_force,
          e.tangential_force,
          e.tangential_y,
          e.tangential_z,
          e.centre,
          e.centre_z,
          e.torsion,
          e.angle,
          e.friction_margin,
          e.slip_margin,
          e.margin_centre,
          e.margin_centre_z,
          e.force_deviation,
          e.residual_rms,
          static_cast<double>(e.contacts),
          static_cast<double>(e.touching),
          static_cast<double>(e.outlier),
          static_cast<double>(32 * e.beyond_edge + 16 * e.baseline_moved + 8 * e.contact +
                              4 * e.pulls + 2 * e.misfit + e.saturated)};
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// A batch beside the loop that it stands for: every bit, and which frames have an answer.
inline void check_batch(ContactEstimator& estimator, const std::vector<double>& readings) {
  const std::size_t frames = readings.size() / estimator.readings();
  std::vector<std::vector<double>> tractions(frames,
                                             std::vector<double>(estimator.tractions(), 17.0));
  std::vector<ContactEstimate> estimates(frames);
  for (std::size_t k = 0; k < frames; ++k) {
    estimates[k].tractions = tractions[k];
    estimates[k].time = static_cast<double>(k);
  }
  const FrameStatus all = estimator.update_batch(readings, estimates);
  FrameStatus first = FrameStatus::ok;
  for (std::size_t k = 0; k < frames; ++k) {
    CAPTURE(k, frames);
    const auto begin = readings.begin() + static_cast<std::ptrdiff_t>(k * estimator.readings());
    const Update alone =
        update(estimator, {begin, begin + static_cast<std::ptrdiff_t>(estimator.readings())});
    if (first == FrameStatus::ok) first = alone.status;
    CHECK(estimates[k].time == static_cast<double>(k));
    if (alone.status == FrameStatus::ok) {
      CHECK(same_bits(tractions[k], alone.tractions));
      CHECK(same_bits(numbers_of(estimates[k]), numbers_of(alone.estimate)));
    } else {
      CHECK(tractions[k] == std::vector<double>(estimator.tractions(), 17.0));
    }
  }
  CHECK(all == first);
}

}  // namespace tactile_net
