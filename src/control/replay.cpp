#include "tactile_net/control/replay.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <vector>

#include "tactile_net/control/batch.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t block_bytes = 32'000'000;
constexpr std::size_t most_frames = 4096;

std::size_t frames_of_block(const ContactEstimator& estimator) {
  const std::size_t bytes = (estimator.readings() + estimator.tractions()) * sizeof(double);
  return std::clamp<std::size_t>(block_bytes / bytes, 1, most_frames);
}

/// What no frame has answered.
ContactEstimate unknown_estimate(std::span<double> tractions) {
  std::fill(tractions.begin(), tractions.end(), ContactEstimate::unknown);
  return {.tractions = tractions, .normal_force = ContactEstimate::unknown};
}

}  // namespace

void replay(ContactEstimator& estimator,
            const std::function<bool(std::span<double> readings)>& next,
            const std::function<void(const ReplayedFrame& frame)>& use,
            const ReplayOptions& options) {
  const std::size_t n = estimator.readings();
  const std::size_t m = estimator.tractions();
  const std::size_t block = options.block == 0 ? frames_of_block(estimator) : options.block;
  std::vector<double> readings;
  std::vector<double> tractions;
  std::vector<ContactEstimate> estimates;
  std::exception_ptr unread;
  for (bool more = true; more;) {
    std::size_t frames = 0;
    for (; frames < block; ++frames) {
      if (readings.size() < (frames + 1) * n) readings.resize((frames + 1) * n);
      try {
        more = next(std::span(readings).subspan(frames * n, n));
      } catch (...) {
        unread = std::current_exception();
        more = false;
      }
      if (!more) break;
    }
    if (tractions.size() < frames * m) tractions.resize(frames * m);
    estimates.resize(frames);
    for (std::size_t k = 0; k < frames; ++k)
      estimates[k] = unknown_estimate(std::span(tractions).subspan(k * m, m));
    const std::span<const double> read = std::span(readings).first(frames * n);
    const FrameStatus status = update_batch(estimator, read, estimates, options.threads);
    for (std::size_t k = 0; k < frames; ++k) {
      ReplayedFrame frame{read.subspan(k * n, n), FrameStatus::ok, estimates[k]};
      // Only the first status that is not ok is known, and a bad frame is left as it was.
      if (status != FrameStatus::ok && std::isnan(estimates[k].normal_force))
        frame.status = estimator.update(frame.readings, estimates[k]);
      use(frame);
    }
  }
  if (unread) std::rethrow_exception(unread);
}

}  // namespace tactile_net
