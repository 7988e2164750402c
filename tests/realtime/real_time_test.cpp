// The promise of what runs in the control loop: no allocation, no lock, no system call. Counted
// here, and held by the kernel in a child process that may do nothing but exit.
#include <dlfcn.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <vector>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/handover.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tactile_net/tactile_net.h"
#include "tests/catch.hpp"
#include "tests/realtime/child_process.hpp"
#include "tests/realtime/plans.hpp"
#include "tests/realtime/skin_plans.hpp"

namespace {
std::atomic<long> allocations{0};
std::atomic<long> releases{0};
std::atomic<long> locks{0};
}  // namespace

// Every road to the heap ends in one of these: operator new and delete do.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* data, std::size_t size) {
  ++allocations;
  return __libc_realloc(data, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** data, std::size_t alignment, std::size_t size) {
  ++allocations;
  *data = __libc_memalign(alignment, size);
  return *data != nullptr ? 0 : ENOMEM;
}
void free(void* data) {
  if (data != nullptr) ++releases;
  __libc_free(data);
}
int pthread_mutex_lock(pthread_mutex_t* mutex) {
  ++locks;
  using Lock = int (*)(pthread_mutex_t*);
  static std::atomic<Lock> real{nullptr};
  Lock lock = real;
  if (lock == nullptr)
    real = lock = reinterpret_cast<Lock>(::dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  return lock(mutex);
}
}

using namespace tactile_net;

namespace {

struct Counts {
  long allocations, releases, locks;
  bool operator==(const Counts&) const = default;
};
Counts counts() { return {allocations, releases, locks}; }

/// Everything that a loop may call, on every kind of plan. Set-up is not part of `run`.
class Loop {
 public:
  Loop(const EstimatorPlan& plan, const LoopOptions& options) {
    estimator_ = std::make_unique<ContactEstimator>(plan);
    readings_.assign(estimator_->readings(), 1.0);
    bad_ = huge_ = readings_;
    bad_[0] = std::numeric_limits<double>::quiet_NaN();
    huge_[0] = 1e308;
    batch_.assign(frames * readings_.size(), 2.0);
    tractions_.assign(frames * estimator_->tractions(), 0.0);
    for (std::size_t k = 0; k < frames; ++k) {
      estimates_[k].tractions =
          std::span(tractions_).subspan(k * estimator_->tractions(), estimator_->tractions());
      estimates_[k].rows = rows_[k];
    }
    floats_.assign(2 * readings_.size(), 1.0F);
    handover_.offer(std::make_unique<ContactEstimator>(plan));
    options_ = options;
    const std::vector<std::byte> bytes = encode_plan(plan);
    in_c_.reset(tactile_net_decode(TACTILE_NET_INTERFACE, bytes.data(), bytes.size()));
  }

  /// True if every call said what it should.
  bool run() noexcept {
    bool fine = handover_.exchange(estimator_) && !handover_.exchange(estimator_);
    ContactEstimator& estimator = *estimator_;
    ContactEstimate& estimate = estimates_[0];
    estimator.set_options(options_);
    const bool can_predict = estimator.set_dead(2);
    fine &= estimator.update(readings_, estimate) == FrameStatus::ok;
    for (std::size_t taxel = 3; taxel < 12; ++taxel) (void)estimator.set_dead(taxel);
    if (can_predict) fine &= !estimator.set_dead(12);
    fine &= estimator.update(readings_, estimate) == FrameStatus::ok;
    estimator.revive();
    fine &= estimator.set_baseline(readings_) == FrameStatus::ok;
    fine &= estimator.set_baseline(bad_) == FrameStatus::not_finite;
    fine &= estimator.update(readings_, estimate) == FrameStatus::ok;
    fine &= estimator.update(bad_, estimate) == FrameStatus::not_finite;
    fine &= estimator.update(huge_, estimate) == FrameStatus::too_large;
    fine &= estimator.update({}, estimate) == FrameStatus::wrong_size;
    const ReadingView view(floats_.data(), readings_.size(), {.stride = 8, .scale = 2.0});
    fine &= estimator.update(view, estimate) == FrameStatus::ok;
    fine &= estimator.set_baseline(view) == FrameStatus::ok;
    fine &= estimator.counters().frames == 7 && estimator.counters().refused() == 3;
    estimator.reset_counters();
    fine &= estimator.update_batch(batch_, estimates_) == FrameStatus::ok;
    return fine && run_in_c();
  }

 private:
  bool run_in_c() noexcept {
    tactile_net_estimator* const estimator = in_c_.get();
    const std::size_t n = tactile_net_plan_of(estimator)->readings;
    tactile_net_estimate estimate{};
    const auto status = [&](const std::vector<double>& frame) {
      return tactile_net_update(estimator, frame.data(), n, 0.0, tractions_.data(), &estimate);
    };
    const tactile_net_options options{options_.flush_denormals, options_.hold, 3};
    tactile_net_set_options(estimator, &options);
    bool fine = status(readings_) == TACTILE_NET_OK;
    const tactile_net_readings view{floats_.data(), n, TACTILE_NET_FLOAT32, 8, 2.0};
    fine &= tactile_net_update_from(estimator, &view, 0.0, tractions_.data(), &estimate) ==
            TACTILE_NET_OK;
    fine &= tactile_net_set_baseline_from(estimator, &view) == TACTILE_NET_OK;
    tactile_net_counters counters{};
    tactile_net_get_counters(estimator, &counters);
    fine &= counters.frames == 2;
    tactile_net_reset_counters(estimator);
    (void)tactile_net_set_dead(estimator, 2);
    fine &= status(readings_) == TACTILE_NET_OK;
    tactile_net_revive(estimator);
    fine &= tactile_net_set_baseline(estimator, readings_.data(), n) == TACTILE_NET_OK;
    return fine && status(bad_) == TACTILE_NET_NOT_FINITE &&
           tactile_net_status_name(TACTILE_NET_NOT_FINITE)[0] == 'n';
  }

  struct DestroyInC {
    void operator()(tactile_net_estimator* estimator) const { tactile_net_destroy(estimator); }
  };
  std::unique_ptr<ContactEstimator> estimator_;
  Handover<ContactEstimator> handover_;
  std::unique_ptr<tactile_net_estimator, DestroyInC> in_c_;
  LoopOptions options_;
  std::vector<double> readings_, bad_, huge_, batch_, tractions_;
  std::vector<float> floats_;
  static constexpr std::size_t frames = 27;  // a block, a tile and some beyond
  ContactEstimate estimates_[frames];
  std::array<ContactRow, 3> rows_[frames]{};
};

std::vector<EstimatorPlan> plans() {
  std::vector<EstimatorPlan> all;
  for (const Structure structure : {Structure::dense, Structure::low_rank, Structure::reflections,
                                    Structure::reflections_low_rank})
    for (const Precision precision : {Precision::float64, Precision::float32})
      for (const bool diagnostics : {true, false})
        all.push_back(made_plan({.count = 21,
                                 .channels = 2,
                                 .unknowns = 2,
                                 .structure = structure,
                                 .precision = precision,
                                 .diagnostics = diagnostics}));
  for (const std::size_t lines : {0U, 3U, 4U, 11U})
    add_cone(all.emplace_back(all[lines]), lines % 2 == 0 ? std::optional(0.5) : std::nullopt);
  for (const Structure structure :
       {Structure::dense, Structure::reflections, Structure::reflections_low_rank})
    for (const Precision precision : {Precision::float64, Precision::float32})
      for (const bool exchanged : {true, false})
        for (const bool diagnostics : {true, false}) {
          EstimatorPlan plan = made_skin_plan({.rows = 5,
                                               .columns = exchanged ? 5U : 4U,
                                               .structure = structure,
                                               .precision = precision,
                                               .exchanged = exchanged,
                                               .diagnostics = diagnostics,
                                               .dead = exchanged ? 1U : 0U});
          plan.cells->deviations.assign(plan.values, 1e-3);
          plan.cells->rim_rows = plan.cells->rim_columns = 1;
          all.push_back(plan);
          if (precision == Precision::float64) add_cone(all.emplace_back(std::move(plan)), 0.5);
        }
  return all;
}

/// Wait status of a child that runs `body`, and that the kernel kills at any system call but
/// exit_group; its exit code: 0 if true.
int without_system_calls(const std::function<bool()>& body) {
  return in_child([&] {
    if (!filter_system_calls(SYS_exit_group, SECCOMP_RET_ALLOW, SECCOMP_RET_KILL_PROCESS))
      ::_exit(77);
    return body();
  });
}

}  // namespace

TEST_CASE("the counters count", "[real_time]") {
  const Counts before = counts();
  delete new (std::nothrow) std::vector<double>(100);
  delete new (std::align_val_t{64}) double;
  std::free(std::calloc(3, 3));
  std::mutex mutex;
  { const std::scoped_lock lock(mutex); }
  const Counts after = counts();
  CHECK(after.allocations >= before.allocations + 2);
  CHECK(after.releases >= before.releases + 2);
  CHECK(after.locks == before.locks + 1);
}

TEST_CASE("the control loop's calls allocate, free and lock nothing", "[real_time]") {
  for (const EstimatorPlan& plan : plans())
    for (const bool all_options : {false, true}) {
      CAPTURE(plan.label, name(plan.reconstruction.structure), name(plan.reconstruction.precision),
              plan.prediction.has_value(), all_options);
      Loop loop(plan, {.flush_denormals = all_options, .hold = all_options});
      const Counts before = counts();
      const bool fine = loop.run();
      const Counts after = counts();  // before CHECK, which allocates
      CHECK(fine);
      CHECK(after.allocations == before.allocations);
      CHECK(after.releases == before.releases);
      CHECK(after.locks == before.locks);
    }
}

TEST_CASE("the kernel kills the child that makes a system call", "[real_time]") {
  const int status = without_system_calls([] { return ::syscall(SYS_getpid) > 0; });
  CHECK(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGSYS);
  const int none = without_system_calls([] { return true; });
  CHECK(WIFEXITED(none));
  CHECK(WEXITSTATUS(none) == 0);  // 77: this kernel has no seccomp filters
}

TEST_CASE("the control loop's calls make no system call", "[real_time]") {
  for (const EstimatorPlan& plan : plans())
    for (const bool all_options : {false, true}) {
      CAPTURE(plan.label, name(plan.reconstruction.structure), name(plan.reconstruction.precision),
              plan.prediction.has_value(), all_options);
      Loop loop(plan, {.flush_denormals = all_options, .hold = all_options});
      const int status = without_system_calls([&] { return loop.run(); });
      CHECK_FALSE(WIFSIGNALED(status));
      CHECK(WIFEXITED(status));
      CHECK(WEXITSTATUS(status) == 0);
    }
}
