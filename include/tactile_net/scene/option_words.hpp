/// @file
/// How the user of a message asks for what it advises: by an option of the command, by an argument
/// in Python. The library says which choice it means; its front end says how that is spelled.
///
///     option(Option::columns, "2-42")   --columns 2-42    in the command
///                                       columns='2-42'    in Python
///                                       columns = 2-42    elsewhere
#pragma once

#include <string>
#include <string_view>

namespace tactile_net {

/// What a message may advise to ask for.
enum class Option {
  accuracy,        ///< of a plan
  allow_outside,   ///< files from anywhere, for a hand or a study
  columns,         ///< which columns hold the readings
  force,           ///< replace, or write all the same
  frame,           ///< which moment of the scene
  json,            ///< every number
  missing,         ///< what becomes of frames that miss readings
  no_diagnostics,  ///< a plan without its residual
  quantity,        ///< which quantities are read
  readings,        ///< a file of recorded frames
  realization,     ///< of the circuit
  resume,          ///< go on with what was stopped
  robust,          ///< outlying values count less
  time_limit,      ///< of the simulator
};

/// "no_diagnostics"
[[nodiscard]] std::string_view name(Option option) noexcept;

/// @param value  empty: the option without one
using OptionWords = std::string (*)(Option option, std::string_view value);

/// How options are spelled from now on, for the whole process; nullptr: as if never called. A front
/// end calls it before anything else.
void spell_options(OptionWords words) noexcept;

[[nodiscard]] std::string option(Option option, std::string_view value = {});

}  // namespace tactile_net
