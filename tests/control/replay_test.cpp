#include "tactile_net/control/replay.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/catch.hpp"
#include "tests/realtime/skin_plans.hpp"

using namespace tactile_net;

namespace {

constexpr std::size_t replayed_frames = 301;

std::vector<double> recording(std::size_t readings) {
  std::mt19937 generator(5);
  std::vector<double> all(replayed_frames * readings);
  for (double& reading : all) reading = static_cast<double>(generator()) / 0x1p31 - 1.0;
  return all;
}

struct Answer {
  FrameStatus status;
  std::vector<double> tractions;
  double normal_force;
  bool operator==(const Answer&) const = default;
};

/// What `replay` hands out, until `stop` frames were read: then reading fails.
std::vector<Answer> replayed(ContactEstimator& estimator, const std::vector<double>& recording,
                             const ReplayOptions& options, std::size_t stop = replayed_frames + 1) {
  std::vector<Answer> answers;
  std::size_t read = 0;
  const std::size_t n = estimator.readings();
  const auto next = [&](std::span<double> readings) {
    if (read == stop) throw std::runtime_error("unread");
    if (read * n == recording.size()) return false;
    std::copy_n(recording.begin() + static_cast<std::ptrdiff_t>(read++ * n), n, readings.begin());
    return true;
  };
  const auto use = [&](const ReplayedFrame& frame) {
    // A block of one: answered before the next is read.
    if (options.block == 1) CHECK(read == answers.size() + 1);
    CHECK(frame.readings[0] == recording[answers.size() * n]);
    const auto tractions = frame.estimate.tractions;
    answers.push_back(
        {frame.status, {tractions.begin(), tractions.end()}, frame.estimate.normal_force});
  };
  try {
    replay(estimator, next, use, options);
  } catch (const std::runtime_error& error) {
    CHECK(std::string(error.what()) == "unread");
    CHECK(read == stop);
  }
  return answers;
}

}  // namespace

TEST_CASE("a replayed recording is what the controller answered, to the bit", "[replay][threads]") {
  ContactEstimator estimator(made_skin_plan({.rows = 4, .columns = 4, .exchanged = true}));
  const std::size_t n = estimator.readings();
  const std::vector<double> all = recording(n);
  std::vector<Answer> expected;
  for (std::size_t k = 0; k < replayed_frames; ++k) {
    std::vector<double> tractions(estimator.tractions());
    ContactEstimate estimate{.tractions = tractions};
    REQUIRE(estimator.update(std::span(all).subspan(k * n, n), estimate) == FrameStatus::ok);
    expected.push_back({FrameStatus::ok, tractions, estimate.normal_force});
  }
  for (const std::size_t block : {0U, 1U, 7U, 150U, 301U})
    for (const std::size_t threads : {0U, 1U, 3U}) {
      CAPTURE(block, threads);
      CHECK(replayed(estimator, all, {.threads = threads, .block = block}) == expected);
    }
  CHECK(replayed(estimator, {}, {}).empty());

  // What was read before the source failed is answered.
  for (const std::size_t block : {0U, 1U, 7U}) {
    const std::vector<Answer> before = replayed(estimator, all, {.block = block}, 20);
    REQUIRE(before.size() == 20);
    CHECK(std::equal(before.begin(), before.end(), expected.begin()));
  }
}

TEST_CASE("a bad frame of a replay has its status and nothing else, the others theirs",
          "[replay]") {
  ContactEstimator estimator(made_skin_plan({.rows = 4, .columns = 4, .exchanged = true}));
  const std::size_t n = estimator.readings();
  std::vector<double> all = recording(n);
  const std::vector<Answer> whole = replayed(estimator, all, {});
  all[100 * n] = 1e308;
  all[200 * n + 1] = std::numeric_limits<double>::quiet_NaN();
  all[202 * n] = -std::numeric_limits<double>::infinity();
  const std::size_t block = GENERATE(0U, 1U, 64U);
  const std::vector<Answer> answers = replayed(estimator, all, {.block = block});
  REQUIRE(answers.size() == replayed_frames);
  for (std::size_t k = 0; k < replayed_frames; ++k) {
    CAPTURE(k);
    if (k == 100 || k == 200 || k == 202) {
      CHECK(answers[k].status == (k == 100 ? FrameStatus::too_large : FrameStatus::not_finite));
      CHECK(std::isnan(answers[k].normal_force));
      for (const double traction : answers[k].tractions) CHECK(std::isnan(traction));
    } else {
      CHECK(answers[k] == whole[k]);
    }
  }
}
