/// @file
/// Computes the points of a study on the processors of this machine, goes on with what is done, and
/// survives the death of its workers.
///
///     const sweep::Study study(read_study("depth.toml"));
///     sweep::Observer observer;
///     if (sweep::sweep(study, "out", {.jobs = 4}, observer).complete())
///       use(sweep::merge(std::vector<std::filesystem::path>{"out"}));
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>

#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/sweep/study.hpp"

namespace tactile_net::sweep {

/// Point i is shard (i mod count) + 1's, so that points that take long are spread.
struct Shard {
  std::size_t number = 1;  ///< 1 ... count
  std::size_t count = 1;

  [[nodiscard]] bool has(std::size_t index) const noexcept { return index % count + 1 == number; }
};

/// "3/8". @throw std::invalid_argument  it is none, or its number is not from 1 to its count
[[nodiscard]] Shard shard_in(std::string_view text);

struct Options {
  std::size_t jobs = 0;  ///< workers; 0: one for each processor that this process may use
  Shard shard{};
  lab::SimulatorChoice simulator{};  ///< for scenes with the method network
  lab::Clock clock = lab::monotonic_time;
};

struct Progress {
  std::size_t points = 0;                ///< of this shard
  std::size_t done = 0;                  ///< of those, by whoever
  std::size_t earlier = 0;               ///< of those, before this call
  std::size_t deaths = 0;                ///< workers that ended other than asked to
  std::optional<double> seconds_left{};  ///< at the pace so far

  [[nodiscard]] bool complete() const noexcept { return done == points; }
};

class Observer {
 public:
  virtual ~Observer() = default;
  /// About five times a second, and at the end, on the thread that called.
  virtual void progress(const Progress& /*progress*/) {}
  /// True ends the work: points that were begun are lost, and done the next time.
  [[nodiscard]] virtual bool stop() const { return false; }
};

/// A point whose workers have died so often has a row that says so.
inline constexpr std::size_t most_deaths = 3;

/// Workers are forks of this process that compute points, each into a journal of its own in
/// `folder`/shard-K-of-N, and end with it, however it ends. Points that any journal in the folder
/// has are done.
///
/// @return how far it came: all, unless the observer stopped it
/// @throw InputError            a journal in the folder is another study's
/// @throw frames::CannotCreate  the folder cannot be made; another sweep is at work on this shard
/// @throw std::runtime_error    a journal cannot be written: a full disk
/// @throw std::invalid_argument the simulator's options are wrong
[[nodiscard]] Progress sweep(const Study& study, const std::filesystem::path& folder,
                             const Options& options, Observer& observer);

}  // namespace tactile_net::sweep
