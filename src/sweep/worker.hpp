/// @file
/// A fork of the driver that computes points. Private.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>

#include "simulator/descriptor.hpp"
#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/sweep/study.hpp"
#include "tactile_net/system/leftovers.hpp"

namespace tactile_net::sweep {

/// What a worker says of each point it is given, in their order.
struct Report {
  std::uint64_t index = 0;
  int error = 0;  ///< errno of the journal, which could not be written; 0: the point is done
};

class Worker {
 public:
  /// Forks. What the worker needs is there by then: nothing is read anew.
  /// @throw std::system_error  the system gave no process
  Worker(const Study& study, const std::filesystem::path& journal,
         const lab::SimulatorChoice& simulator);
  ~Worker();  ///< kills it
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Points that one message holds.
  static constexpr std::size_t most_points_at_once = 64;

  /// @pre  idle(), 1 ... most_points_at_once points. A worker that is dead is known by `report`.
  void give(std::deque<std::size_t> points);
  /// Its next report, if there is one; nothing and `dead()`: none will come.
  [[nodiscard]] std::optional<Report> report();

  [[nodiscard]] int socket() const noexcept { return pair_.ours.get(); }
  /// What it was given and has not reported; the first is the one it is at.
  [[nodiscard]] const std::deque<std::size_t>& points() const noexcept { return points_; }
  [[nodiscard]] bool idle() const noexcept { return points_.empty(); }
  [[nodiscard]] bool dead() const noexcept { return dead_; }

 private:
  SocketPair pair_;
  pid_t child_ = -1;
  std::optional<LeftoverChild> leftover_{};
  std::deque<std::size_t> points_{};
  bool dead_ = false;
};

/// Appends a text in one write. @return 0, or errno
[[nodiscard]] int append(int file, const std::string& text) noexcept;

/// Opens a journal to append to, and writes its head where it is empty.
/// @return the file; or -1: errno says why not
[[nodiscard]] int open_journal(const std::filesystem::path& journal, const Study& study) noexcept;

}  // namespace tactile_net::sweep
