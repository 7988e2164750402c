// What `prepare` promises, as the kernel sees it: a first frame without page faults, and memory
// that is locked, all of it.
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tactile_net/tactile_net.h"
#include "tests/catch.hpp"
#include "tests/realtime/answer.hpp"
#include "tests/realtime/child_process.hpp"
#include "tests/realtime/plans.hpp"
#include "tests/realtime/skin_plans.hpp"

using namespace tactile_net;

namespace {

/// Plans whose estimators have every kind of memory.
std::vector<EstimatorPlan> large_plans() {
  std::vector<EstimatorPlan> all;
  for (const Precision precision : {Precision::float64, Precision::float32}) {
    all.push_back(made_plan({.count = 301, .unknowns = 1, .precision = precision}));
    all.push_back(made_skin_plan({.rows = 12,
                                  .columns = 12,
                                  .structure = Structure::reflections,
                                  .precision = precision,
                                  .exchanged = true,
                                  .dead = 3}));
    EstimatorPlan& skin = all.back();
    skin.cells->deviations.assign(skin.values, 1e-3);
    skin.cells->window_deviations.assign(skin.values, 1e-3);
    skin.cells->window_rows = skin.cells->window_columns = 1;
  }
  all.push_back(made_skin_plan({.rows = 14, .columns = 9, .structure = Structure::dense}));
  return all;
}

/// Readings that press.
std::vector<double> pressing_frame(const EstimatorPlan& plan) {
  ContactEstimator estimator(plan);
  for (const double value : {1e6, -1e6}) {
    std::vector<double> frame(plan.readings(), value);
    if (answer(estimator, frame).estimate.contact) return frame;
  }
  FAIL("no constant presses");
  return {};
}

long page_faults() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

/// Page faults of a frame that presses, the first of a child: it has none of its parent's pages
/// that are written to, nor its code, until it touches them. -1: the frame was not answered.
long faults_of_first_frame(ContactEstimator& estimator, const std::vector<double>& frame,
                           bool prepared) {
  std::vector<double> room(estimator.tractions());
  ContactEstimate estimate;
  const int status = in_child([&]() -> bool {
    if (prepared) (void)estimator.prepare();
    // What the caller owns is the caller's to touch.
    for (double& traction : room) traction = 1.0;
    estimate = {.tractions = room};
    (void)page_faults();
    const long before = page_faults();
    const FrameStatus answered = estimator.update(frame, estimate);
    const long faults = page_faults() - before;
    ::_exit(answered == FrameStatus::ok && estimate.contact
                ? static_cast<int>(std::min(faults, 100L))
                : 255);
  });
  REQUIRE(WIFEXITED(status));
  return WEXITSTATUS(status) == 255 ? -1 : WEXITSTATUS(status);
}

std::size_t bytes_in_use() {
  const auto heap = ::mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

/// VmLck of this process, in bytes.
std::size_t locked_bytes() {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("VmLck:")) return 1024 * std::stoul(line.substr(6));
  return 0;
}

/// Whether the system locks so many bytes.
bool can_lock(std::size_t bytes) {
  std::vector<char> probe(bytes);
  const bool can = ::mlock(probe.data(), probe.size()) == 0;
  ::munlock(probe.data(), probe.size());
  return can;
}

}  // namespace

TEST_CASE("after prepare the first frame takes no page fault", "[prepare]") {
  for (const EstimatorPlan& plan : large_plans()) {
    CAPTURE(plan.label, name(plan.reconstruction.precision));
    const std::vector<double> frame = pressing_frame(plan);
    ContactEstimator estimator(plan);
    CHECK(faults_of_first_frame(estimator, frame, false) > 0);
    CHECK(faults_of_first_frame(estimator, frame, true) == 0);
  }
}

TEST_CASE("prepare locks all memory that the constructor took, where the system allows it",
          "[prepare]") {
  for (const EstimatorPlan& plan : large_plans()) {
    CAPTURE(plan.label, name(plan.reconstruction.precision));
    const std::size_t before = bytes_in_use();
    ContactEstimator estimator(plan);
    const std::size_t taken = bytes_in_use() - before;
    const Preparation done = estimator.prepare();
    CAPTURE(done.bytes, taken);
    // The heap counts small pieces that it keeps for itself.
    CHECK(static_cast<double>(done.bytes) > 0.98 * static_cast<double>(taken));
    CHECK(static_cast<double>(done.bytes) < 1.02 * static_cast<double>(taken));
    CHECK(done.locked == can_lock(2 * done.bytes));
    if (done.locked) CHECK(locked_bytes() >= done.bytes);
  }
}

TEST_CASE("where the system locks nothing, prepare says so and frames are as ever", "[prepare]") {
  const EstimatorPlan plan = large_plans().front();
  const std::vector<double> frame = pressing_frame(plan);
  ContactEstimator estimator(plan);
  const auto expected = answer(estimator, frame).bits();
  CHECK(succeeded(in_child([&] {
    if (!filter_system_calls(SYS_mlock, SECCOMP_RET_ERRNO | EPERM, SECCOMP_RET_ALLOW)) return false;
    const Preparation done = estimator.prepare();
    return !done.locked && done.bytes > 0 && answer(estimator, frame).bits() == expected;
  })));
}

TEST_CASE("prepare changes no later answer, and is no frame", "[prepare]") {
  for (const EstimatorPlan& plan : large_plans()) {
    const std::vector<double> frame = pressing_frame(plan);
    ContactEstimator estimator(plan);
    REQUIRE(estimator.set_baseline(std::vector<double>(plan.readings(), 0.125)) == FrameStatus::ok);
    estimator.set_options({.flush_denormals = true, .hold = true});
    const auto expected = answer(estimator, frame).bits();
    const FrameCounters counted = estimator.counters();
    (void)estimator.prepare();
    CHECK(estimator.counters() == counted);
    Answer out(estimator);
    const auto nothing = out.bits();
    CHECK(estimator.update({}, out.estimate) == FrameStatus::wrong_size);
    CHECK(out.bits() == nothing);  // what it held is forgotten, not the frames of its own given
    CHECK(answer(estimator, frame).bits() == expected);
  }
}

TEST_CASE("C prepares an estimator, too", "[prepare]") {
  const EstimatorPlan plan = large_plans().front();
  const std::vector<std::byte> bytes = encode_plan(plan);
  tactile_net_estimator* const estimator =
      tactile_net_decode(TACTILE_NET_INTERFACE, bytes.data(), bytes.size());
  REQUIRE(estimator != nullptr);
  tactile_net_preparation done{};
  tactile_net_prepare(estimator, &done);
  tactile_net_prepare(estimator, nullptr);
  ContactEstimator same(plan);
  const Preparation expected = same.prepare();
  CHECK(done.bytes == expected.bytes);
  CHECK(done.locked == expected.locked);
  tactile_net_destroy(estimator);
}
