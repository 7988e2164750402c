/// @file
/// ngspice as a child process: it may crash, hang, or exit 0 on failure, and must not take its
/// caller down or hand it a stale number.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "tactile_net/simulator/simulator.hpp"

namespace tactile_net {

struct NgspiceOptions {
  std::string program = "ngspice";               ///< looked up in PATH
  std::chrono::milliseconds time_limit{60'000};  ///< > 0
  std::size_t output_limit = 16U << 20;          ///< of what it prints [bytes], > 0
  /// Decks hold macromodels in PSpice's language (`ngbehavior=psa`): the warnings of a search for
  /// an operating point that found it in the end are none.
  bool pspice = false;
  bool (*cancelled)() = nullptr;  ///< as `ProcessOptions::cancelled`
};

/// Runs `ngspice -b` on each deck, confined to a private temporary folder that is removed at the
/// end (`confinement.hpp`), and reads its raw file. Of a failure the deck and the log stay.
///
/// Caught: not installed, time or output limit, crash, exit status, "singular matrix" and other
/// failures it reports with exit status 0, a short file, NaN and infinity.
class Ngspice final : public Simulator {
 public:
  explicit Ngspice(NgspiceOptions options = {});
  [[nodiscard]] Simulation run(const std::string& deck) override;

 private:
  NgspiceOptions options_;
};

}  // namespace tactile_net
