/// @file
/// Computes the points of a study in their order, on the processors of this machine, into a file of
/// rows; goes on with what is done.
///
///     const sweep::Study study(read_study("depth.toml"));
///     sweep::Observer observer;
///     if (sweep::sweep(study, "rows.csv", {.jobs = 4}, observer).complete())
///       use(sweep::merge(std::vector<std::filesystem::path>{"rows.csv"}));
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>

#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/sweep/merge.hpp"
#include "tactile_net/sweep/study.hpp"

namespace tactile_net::sweep {

struct Options {
  std::size_t jobs = 0;  ///< threads; 0: one for each processor that this process may use
  PointRange points{};
  lab::SimulatorChoice simulator{};  ///< for scenes with the method network
  lab::Clock clock = lab::monotonic_time;
};

struct Progress {
  std::size_t points = 0;                ///< of the range
  std::size_t done = 0;                  ///< of those, by whoever
  std::size_t earlier = 0;               ///< of those, before this call
  std::optional<double> seconds_left{};  ///< at the pace so far

  [[nodiscard]] bool complete() const noexcept { return done == points; }
};

class Observer {
 public:
  virtual ~Observer() = default;
  /// About five times a second, and at the end, on the thread that called.
  virtual void progress(const Progress& /*progress*/) {}
  /// Asked as often, by the same thread. True ends the work: points that were begun are lost, and
  /// done the next time.
  [[nodiscard]] virtual bool stop() const { return false; }
};

/// Appends the rows of those points of the range that the file lacks, in the study's order. A point
/// that cannot be solved has a row that says why.
///
/// @return how far it came: all, unless the observer stopped it
/// @throw InputError            the range has no point of the study; as `RowsFile`
/// @throw frames::CannotCreate, std::runtime_error  as `RowsFile`
/// @throw std::invalid_argument the simulator's options are wrong
[[nodiscard]] Progress sweep(const Study& study, const std::filesystem::path& file,
                             const Options& options, Observer& observer);

}  // namespace tactile_net::sweep
