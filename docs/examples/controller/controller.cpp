// A control loop at 1 kHz, between a thread that reads frames and a thread that prints estimates.
//
// The loop itself does nothing that can make it wait: no file, no lock, no memory from the heap, no
// exception; its only system calls are the clock's. Frames come to it and estimates leave it
// through rings of slots that were there before it began. What may block has a thread of its own.
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <time.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tactile_net/realtime/contact_estimator.hpp>
#include <tactile_net/realtime/load_plan.hpp>
#include <thread>
#include <vector>

#include "frame_reader.hpp"
#include "histogram.hpp"
#include "ring.hpp"

namespace {

using tactile_net::ContactEstimate;
using tactile_net::ContactEstimator;
using tactile_net::FrameStatus;

// What a signal handler may touch: an atomic without a lock.
std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free);
void stop_on_signal(int) { stop = true; }

struct Options {
  std::string plan, frames;
  double rate = 1000.0;  // [Hz]
  long repeat = 1;
};

struct Tally {
  Histogram update;    // duration of `update`
  Histogram lateness;  // from the tick to the loop's awakening
  long answered = 0;
  long refused = 0;      // frames whose status was not ok
  long idle = 0;         // ticks without a frame
  long missed = 0;       // ticks that passed while the loop was busy or not scheduled
  long not_printed = 0;  // estimates for which the printer had no slot left
  FrameStatus last_refusal = FrameStatus::ok;
};

constexpr std::int64_t second = 1'000'000'000;

// CLOCK_MONOTONIC never jumps, and Linux reads it without entering the kernel.
std::int64_t now() noexcept {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * second + time.tv_nsec;
}

// To a point in time, not for a duration: the error of one tick is not carried to the next.
void sleep_until(std::int64_t tick) noexcept {
  const timespec time{tick / second, tick % second};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR && !stop) {
  }
}

/// The loop. `noexcept` is no wish: nothing it calls throws.
void control(ContactEstimator& estimator, Ring<Frame>& frames, Ring<ContactEstimate>& estimates,
             std::span<double> tractions, std::int64_t period, Tally& tally) noexcept {
  ContactEstimate estimate;
  estimate.tractions = tractions;
  std::int64_t tick = now();
  while (!stop && !frames.finished()) {
    tick += period;
    sleep_until(tick);
    if (stop) break;
    const std::int64_t start = now();
    tally.lateness.add(static_cast<std::uint64_t>(start - tick));
    // Too late for the ticks after this one as well: leave them out, do not run after them.
    for (; tick + period <= start; tick += period) ++tally.missed;

    Frame* const frame = frames.to_empty();
    if (frame == nullptr) {
      ++tally.idle;
      continue;
    }
    const std::int64_t before = now();
    const FrameStatus status = estimator.update(frame->readings, estimate, frame->time);
    tally.update.add(static_cast<std::uint64_t>(now() - before));
    frames.emptied();
    if (status != FrameStatus::ok) {  // `estimate` is the last good one; a robot might slow down
      ++tally.refused;
      tally.last_refusal = status;
      continue;
    }
    ++tally.answered;

    // Here a controller would act: on estimate.normal_force, on estimate.friction_margin < 0 ...

    // No condition variable: waking the printer would be a system call. It looks by itself.
    if (ContactEstimate* const slot = estimates.to_fill()) {
      *slot = estimate;
      slot->tractions = {};  // the loop's own memory
      estimates.filled();
    } else {
      ++tally.not_printed;
    }
  }
  estimates.close();
}

void print(Ring<ContactEstimate>& estimates) {
  std::puts(
      "t,normal_force,tangential_force,centre,friction_margin,residual_rms,saturated,outlier");
  bool whole = true;
  while (!estimates.finished()) {
    if (ContactEstimate* const e = estimates.to_empty()) {
      whole =
          whole && std::printf("%.9g,%.9g,%.9g,%.9g,%.9g,%.3g,%d,%td\n", e->time, e->normal_force,
                               e->tangential_force, e->centre, e->friction_margin, e->residual_rms,
                               e->saturated, e->outlier) > 0;
      estimates.emptied();
    } else {
      whole = whole && std::fflush(stdout) == 0;
      if (!whole) stop = true;  // nobody reads on
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
}

/// Asks for what keeps a loop on time; says so where it may not have it, and goes on.
void become_real_time() {
  // No page of ours is fetched from disk or made on first use while the loop runs.
  if (::mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
    std::fprintf(stderr, "memory is not locked: %s (needs CAP_IPC_LOCK or ulimit -l)\n",
                 std::strerror(errno));
  // Before every ordinary thread; this thread only, the reader and the printer began before.
  sched_param priority{};
  priority.sched_priority = 80;
  if (const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &priority))
    std::fprintf(stderr, "ordinary scheduling: %s (needs CAP_SYS_NICE or ulimit -r)\n",
                 std::strerror(error));
}

void report(const Tally& tally, const Options& options) {
  std::fprintf(
      stderr,
      "%g Hz: %ld frames answered, %ld refused, %ld ticks without a frame, %ld missed, %ld "
      "estimates not printed\n",
      options.rate, tally.answered, tally.refused, tally.idle, tally.missed, tally.not_printed);
  if (tally.refused > 0) {
    const std::string_view why = name(tally.last_refusal);
    std::fprintf(stderr, "last refusal: %.*s\n", static_cast<int>(why.size()), why.data());
  }
  std::fprintf(stderr, "[us]           median       p99     p99.9     worst\n");
  const auto line = [](const char* what, const Histogram& histogram) {
    const auto us = [](std::uint64_t nanoseconds) {
      return 1e-3 * static_cast<double>(nanoseconds);
    };
    std::fprintf(stderr, "%-11s %9.1f %9.1f %9.1f %9.1f\n", what, us(histogram.quantile(0.5)),
                 us(histogram.quantile(0.99)), us(histogram.quantile(0.999)),
                 us(histogram.worst()));
  };
  line("update", tally.update);
  line("awakening", tally.lateness);
}

template <class Number>
Number number(std::string_view text, Number least, Number most) {
  Number value{};
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size() ||
      !(value >= least && value <= most))
    throw std::invalid_argument("'" + std::string(text) + "' is not in its range");
  return value;
}

Options read_options(std::span<char*> arguments) {
  Options options;
  std::vector<std::string> files;
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    const std::string_view argument = arguments[i];
    const auto value = [&] {
      if (++i == arguments.size()) throw std::invalid_argument(std::string(argument) + " what?");
      return std::string_view(arguments[i]);
    };
    if (argument == "--rate")
      options.rate = number(value(), 1.0, 1e5);
    else if (argument == "--repeat")
      options.repeat = number(value(), 1L, 1000000000L);
    else
      files.emplace_back(argument);
  }
  if (files.size() != 2)
    throw std::invalid_argument("usage: controller PLAN FRAMES.csv|- [--rate HZ] [--repeat N]");
  options.plan = files[0];
  options.frames = files[1];
  return options;
}

/// 0: the input came to its end, or a signal; 1: the output broke; 2: bad input.
int run(const Options& options) {
  struct sigaction action {};
  action.sa_handler = stop_on_signal;
  for (const int signal : {SIGINT, SIGTERM}) ::sigaction(signal, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // a write says so

  // All that allocates, throws or is slow, before the loop.
  ContactEstimator estimator(tactile_net::load_plan(options.plan));
  FrameReader reader(options.frames, estimator.readings(), stop);
  std::fprintf(stderr, "plan: %s; columns: %.60s ...\n", std::string(estimator.label()).c_str(),
               reader.header().c_str());
  Ring<Frame> frames(64, {0.0, std::vector<double>(estimator.readings())});
  Ring<ContactEstimate> estimates(1024, {});
  std::vector<double> tractions(estimator.tractions());
  Tally tally;

  std::thread reading([&] { reader.run(frames, options.repeat); });
  std::thread printing([&] { print(estimates); });
  become_real_time();
  control(estimator, frames, estimates, tractions,
          static_cast<std::int64_t>(static_cast<double>(second) / options.rate), tally);
  const bool interrupted = stop.exchange(true);  // the reader too
  reading.join();
  printing.join();

  report(tally, options);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    std::fprintf(stderr, "error: the estimates could not be written\n");
    return 1;
  }
  if (interrupted) std::fprintf(stderr, "interrupted\n");
  if (reader.error().empty()) return 0;
  std::fprintf(stderr, "error: %s\n", reader.error().c_str());
  return 2;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run(read_options({arguments, static_cast<std::size_t>(count)}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  }
}
