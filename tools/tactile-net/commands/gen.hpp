/// @file
/// The command `gen`: a scene's circuit as a SPICE deck.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "commands/network_options.hpp"
#include "commands/share.hpp"
#include "streams.hpp"
#include "tactile_net/network/dialect.hpp"

namespace tactile_net::tool {

struct GenOptions {
  std::string scene{};
  std::string output{};
  NetworkOptions network{};
  std::optional<Share> budget{};
  std::optional<std::size_t> refine{};  ///< its cycle; absent: the circuit as it is
  std::string board{};  ///< a file of KiCad, whose copper the circuit has; empty: none
  Dialect dialect = Dialect::ngspice;
  std::string subcircuit{};  ///< its name; empty: a deck
  std::string symbol{};      ///< LTspice's, of the sub-circuit; empty: none
};

/// @throw CheckFailed  devices' curves leave no answer, or no list of parts keeps to the budget
void run(const GenOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
