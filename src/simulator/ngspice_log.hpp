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
[[nodiscard]] bool is_complaint(std::string_view line);

/// The answer in the folder's result.raw, if `process` ended well and nothing was complained of.
///
/// @param process  how ngspice ended, any way but not_found, and all it printed
/// @param time_limit, output_limit  what it was held to; for the text
/// @throw SimulatorError  as its causes; deck.cir is then kept with ngspice.log beside it
[[nodiscard]] Simulation accept_log(const PrivateFolder& folder, const ProcessResult& process,
                                    std::chrono::milliseconds time_limit, std::size_t output_limit);

}  // namespace tactile_net
