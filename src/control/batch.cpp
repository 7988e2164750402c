#include "tactile_net/control/batch.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

#include "numeric/threads.hpp"

namespace tactile_net {
namespace {

/// Some of the frames, on one thread.
struct Part {
  ContactEstimator* estimator;
  std::span<const double> readings;
  std::span<ContactEstimate> estimates;
  FrameStatus status = FrameStatus::ok;

  void solve() noexcept { status = estimator->update_batch(readings, estimates); }
};

constexpr std::size_t least_frames = 64;  // to which starting a thread is little

}  // namespace

FrameStatus update_batch(ContactEstimator& estimator, std::span<const double> readings,
                         std::span<ContactEstimate> estimates, std::size_t threads) {
  const std::size_t frames = estimates.size();
  const std::size_t n = estimator.readings();
  const std::size_t most = threads == 0 ? processors() : threads;
  const std::size_t parts = std::min(most, frames / least_frames);
  const bool fit = readings.size() == n * frames &&
                   std::all_of(estimates.begin(), estimates.end(), [&](const auto& estimate) {
                     return estimate.tractions.size() == estimator.tractions();
                   });
  if (parts < 2 || !fit) return estimator.update_batch(readings, estimates);

  std::vector<ContactEstimator> others(parts - 1, estimator);
  std::vector<Part> all;
  for (std::size_t k = 0; k < parts; ++k) {
    const std::size_t first = frames * k / parts;
    const std::size_t count = frames * (k + 1) / parts - first;
    all.push_back({k == 0 ? &estimator : &others[k - 1], readings.subspan(first * n, count * n),
                   estimates.subspan(first, count)});
  }
  {
    Threads running;
    std::size_t started = 1;
    try {
      for (; started < parts; ++started) running.start([&part = all[started]] { part.solve(); });
    } catch (const std::system_error&) {  // what has no thread is solved here
    }
    all[0].solve();
    for (std::size_t k = started; k < parts; ++k) all[k].solve();
  }
  const auto bad = std::find_if(all.begin(), all.end(),
                                [](const Part& part) { return part.status != FrameStatus::ok; });
  return bad == all.end() ? FrameStatus::ok : bad->status;
}

}  // namespace tactile_net
