/// @file
/// ngspice as a library in a worker process of its own: for many small decks, where starting the
/// program anew takes longer than solving.
///
/// The library may crash, ask its host to exit, or answer with the numbers of the deck before; so
/// it lives in a child that is forked, without exec, by the first `run`. The worker holds none of
/// the caller's files, reads no .spiceinit, writes in its private folder alone, starts nothing
/// (`confinement.hpp`), and ends within a second of its parent.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>

#include "tactile_net/simulator/simulator.hpp"

namespace tactile_net {

struct NgspiceLibraryOptions {
  std::chrono::milliseconds time_limit{60'000};  ///< for one deck, > 0
  std::size_t output_limit = 16U << 20;          ///< of what one deck prints [bytes], > 0
};

/// Runs each deck in the worker, in a private temporary folder that is removed on success, and
/// reads the raw file it writes.
///
/// Fails as `Ngspice` does, with the same causes and texts. Whatever goes wrong ends the worker;
/// the next `run` forks another. Commands to ngspice in a deck (lines that begin with `*#`,
/// .control sections) are left out. One object per thread; objects do not share a worker.
class NgspiceLibrary final : public Simulator {
 public:
  explicit NgspiceLibrary(NgspiceLibraryOptions options = {});
  ~NgspiceLibrary() override;
  NgspiceLibrary(const NgspiceLibrary&) = delete;
  NgspiceLibrary& operator=(const NgspiceLibrary&) = delete;

  /// @throw SimulatorError, std::runtime_error  as `Simulator::run`
  /// @throw std::system_error                   the system gave no socket or process
  [[nodiscard]] Simulation run(const std::string& deck) override;

  /// Process id of the worker; 0: none, before the first deck and after a failure.
  [[nodiscard]] int worker() const noexcept;

 private:
  class Worker;
  NgspiceLibraryOptions options_;
  std::unique_ptr<Worker> worker_;
};

}  // namespace tactile_net
