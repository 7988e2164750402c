/// @file
/// What became of a deck, by how ngspice ended and what it printed.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string_view>

#include "simulator/private_folder.hpp"
#include "tactile_net/simulator/child_process.hpp"
#include "tactile_net/simulator/simulator.hpp"

namespace tactile_net {

/// Variables that would turn the raw file into text or name other files to read at the start.
inline constexpr std::array hidden_from_ngspice = {"SPICE_ASCIIRAWFILE", "SPICE_SCRIPTS",
                                                   "SPICE_NO_DATASEG_CHECK", "SPICE_USERINIT_DIR"};

/// ngspice reports success after most failures. A deck of linear elements that it solves draws no
/// line with any of the words that make a complaint.
///
/// @param macromodel  the deck holds one: its operating point may take a search, whose steps are
///                    told as warnings, and its nodes may have any name
[[nodiscard]] bool is_complaint(std::string_view line, bool macromodel = false);

/// What a run was held to.
struct RunLimits {
  std::chrono::milliseconds time_limit{};  ///< for the text
  std::size_t output_limit = 0;            ///< for the text
  bool macromodel = false;                 ///< as of `is_complaint`
};

/// The answer in the folder's result.raw, if `process` ended well and nothing was complained of.
///
/// @param process  how ngspice ended, any way but not_found, and all it printed
/// @throw SimulatorError  as its causes; deck.cir is then kept with ngspice.log beside it
[[nodiscard]] Simulation accept_log(const PrivateFolder& folder, const ProcessResult& process,
                                    const RunLimits& limits);

}  // namespace tactile_net
