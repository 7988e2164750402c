/// @file
/// ngspice as a child process: it may crash, hang, or exit 0 on failure, and must not take its
/// caller down or hand it a stale number.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace tactile_net {

struct NgspiceOptions {
  std::string program = "ngspice";               ///< looked up in PATH
  std::chrono::milliseconds time_limit{60'000};  ///< > 0
  std::size_t output_limit = 16U << 20;          ///< of what it prints [bytes], > 0
};

/// ngspice failed. The text says how, and where the deck and the log were kept.
class SimulatorError : public std::runtime_error {
 public:
  enum class Cause { not_installed, timed_out, too_much_output, crashed, failed, bad_result };
  SimulatorError(Cause cause, const std::string& text, std::filesystem::path folder)
      : std::runtime_error(text), cause_(cause), folder_(std::move(folder)) {}
  [[nodiscard]] Cause cause() const noexcept { return cause_; }
  /// Holds deck.cir and ngspice.log; empty if nothing was kept.
  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }

 private:
  Cause cause_;
  std::filesystem::path folder_;
};

struct OperatingPoint {
  std::vector<double> voltages{};  ///< [V], one per node asked for
  double seconds = 0.0;            ///< wall time of the process
};

/// Runs `ngspice -b` on a deck with an `.op` card, in a private temporary folder that is removed
/// on success, and reads the voltages of `nodes` from its raw file.
///
/// Caught: not installed, time or output limit, crash, exit status, "singular matrix" and other
/// failures it reports with exit status 0, missing nodes, a short file, NaN and infinity.
///
/// @throw SimulatorError      as above
/// @throw std::runtime_error  no temporary folder can be made or written
[[nodiscard]] OperatingPoint operating_point(const std::string& deck,
                                             std::span<const std::string> nodes,
                                             const NgspiceOptions& options = {});

}  // namespace tactile_net
