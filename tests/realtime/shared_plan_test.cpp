// Copies of an estimator share the plan's matrices: one copy a thread, no lock.
#include <atomic>
#include <thread>
#include <vector>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/handover.hpp"
#include "tests/catch.hpp"
#include "tests/realtime/plans.hpp"

using namespace tactile_net;

namespace {

std::vector<double> frame_of(std::size_t size, std::size_t k) {
  std::vector<double> frame(size);
  for (std::size_t i = 0; i < size; ++i) frame[i] = static_cast<double>((i * 7 + k * 13) % 23) - 9;
  return frame;
}

}  // namespace

TEST_CASE("threads with copies of one estimator find what one thread finds",
          "[contact_estimator][threads]") {
  const Precision precision = GENERATE(Precision::float64, Precision::float32);
  ContactEstimator original(made_plan({.count = 41, .unknowns = 2, .precision = precision}));
  constexpr std::size_t frames = 50;
  std::vector<std::vector<double>> expected(frames, std::vector<double>(original.tractions()));
  for (std::size_t k = 0; k < frames; ++k) {
    ContactEstimate estimate{.tractions = expected[k]};
    REQUIRE(original.update(frame_of(original.readings(), k), estimate) == FrameStatus::ok);
  }

  std::atomic<int> different{0};
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t, mine = original]() mutable {
      std::vector<double> tractions(mine.tractions());
      ContactEstimate estimate{.tractions = tractions};
      for (std::size_t k = 0; k < frames; ++k) {
        if (t % 2 == 1) {  // what one copy leaves out does not touch the others
          mine.set_dead(3 + k % 5);
          (void)mine.update(frame_of(mine.readings(), k), estimate);
          mine.revive();
        }
        const FrameStatus status = mine.update(frame_of(mine.readings(), k), estimate);
        different += status != FrameStatus::ok || tractions != expected[k];
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(different == 0);
}

TEST_CASE("a loop goes on while another thread plans anew and hands over",
          "[contact_estimator][handover][threads]") {
  const EstimatorPlan plan = made_plan({.count = 21});
  auto current = std::make_unique<ContactEstimator>(plan);
  std::vector<double> frame = frame_of(current->readings(), 1);
  std::vector<double> tractions(current->tractions());
  ContactEstimate estimate{.tractions = tractions};
  REQUIRE(current->update(frame, estimate) == FrameStatus::ok);
  const std::vector<double> expected = tractions;

  Handover<ContactEstimator> handover;
  std::atomic<int> taken{0};
  std::thread maker([&] {
    for (int i = 1; i <= 20; ++i) {
      EstimatorPlan next = plan;
      next.reconstruction.scale = std::ldexp(plan.reconstruction.scale, i);
      handover.offer(std::make_unique<ContactEstimator>(next));
      while (taken < i) std::this_thread::yield();
    }
  });
  int different = 0;
  while (taken < 20) {
    if (handover.exchange(current)) ++taken;
    different += current->update(frame, estimate) != FrameStatus::ok;
    // The i-th estimator's tractions are 2^i as large, exactly.
    different += tractions[4] != std::ldexp(expected[4], taken);
  }
  maker.join();
  CHECK(different == 0);
}
