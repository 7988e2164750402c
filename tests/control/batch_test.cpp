#include "tactile_net/control/batch.hpp"

#include <limits>
#include <random>
#include <vector>

#include "tests/catch.hpp"
#include "tests/realtime/skin_plans.hpp"

using namespace tactile_net;

namespace {

/// Frames one after the other, each with room for its answer.
struct Batch {
  Batch(const ContactEstimator& estimator, std::size_t frames)
      : tractions(frames * estimator.tractions(), 17.0), estimates(frames) {
    for (std::size_t k = 0; k < frames; ++k)
      estimates[k].tractions =
          std::span(tractions).subspan(k * estimator.tractions(), estimator.tractions());
  }
  std::vector<double> tractions;
  std::vector<ContactEstimate> estimates;
};

}  // namespace

TEST_CASE("a batch on several threads is the batch on one, to the bit", "[batch][threads]") {
  const EstimatorPlan plan = made_skin_plan({.rows = 4, .columns = 4, .exchanged = true});
  ContactEstimator estimator(plan);
  const std::size_t n = plan.readings();
  constexpr std::size_t frames = 1003;
  std::mt19937 generator(5);
  std::vector<double> readings(frames * n);
  for (double& reading : readings) reading = static_cast<double>(generator()) / 0x1p31 - 1.0;
  REQUIRE(estimator.set_baseline(std::span(readings).first(n)) == FrameStatus::ok);
  const bool dead = estimator.set_dead(3);  // which every thread must know
  REQUIRE(dead);

  Batch one(estimator, frames);
  REQUIRE(estimator.update_batch(readings, one.estimates) == FrameStatus::ok);
  for (const std::size_t threads : {0U, 1U, 2U, 3U, 7U, 100U}) {
    CAPTURE(threads);
    Batch some(estimator, frames);
    CHECK(update_batch(estimator, readings, some.estimates, threads) == FrameStatus::ok);
    CHECK(some.tractions == one.tractions);
    for (std::size_t k = 0; k < frames; ++k)
      CHECK(some.estimates[k].normal_force == one.estimates[k].normal_force);
  }

  // The first bad frame is told, whichever thread had it; the others are solved.
  readings[400 * n] = 1e308;
  readings[900 * n + 1] = std::numeric_limits<double>::quiet_NaN();
  Batch bad(estimator, frames);
  CHECK(update_batch(estimator, readings, bad.estimates, 5) == FrameStatus::too_large);
  for (const std::size_t frame : {400U, 900U}) CHECK(bad.estimates[frame].tractions[0] == 17.0);
  CHECK(bad.estimates[901].tractions[0] == one.estimates[901].tractions[0]);
}

TEST_CASE("a batch of a wrong size is refused whole, whatever the threads", "[batch][threads]") {
  const EstimatorPlan plan = made_skin_plan({});
  ContactEstimator estimator(plan);
  std::vector<double> readings(200 * plan.readings());
  Batch batch(estimator, 200);
  CHECK(update_batch(estimator, std::span(readings).subspan(1), batch.estimates, 2) ==
        FrameStatus::wrong_size);
  batch.estimates[150].tractions = batch.estimates[150].tractions.subspan(1);
  CHECK(update_batch(estimator, readings, batch.estimates, 2) == FrameStatus::wrong_size);
  CHECK(batch.tractions == std::vector<double>(200 * estimator.tractions(), 17.0));
  CHECK(update_batch(estimator, {}, {}, 2) == FrameStatus::ok);
}
