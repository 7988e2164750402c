/// @file
/// What the tests of both ways of running ngspice share.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>

#include "tactile_net/simulator/simulator.hpp"
#include "tests/catch.hpp"

namespace tactile_net {

inline const std::array<std::string, 1> node_a{"a"};

inline const std::string good =
    "* good\nR1 a 0 1000\nR2 a b 1000\nR3 b 0 2000\nI1 0 a DC 4e-3\n.op\n.end\n";
inline const std::string singular = "* singular\nR1 a 0 1k\nR2 a 0 -1k\nI1 0 a 1m\n.op\n.end\n";
inline const std::string floating = "* floating\nR1 a b 1k\nI1 0 a 1m\n.op\n.end\n";
inline const std::string no_value = "* no value\nR1 a 0\nI1 0 a 1m\n.op\n.end\n";
inline const std::string no_element = "* bad\nQ1 a\nR1 a 0 1\n.op\n.end\n";
inline const std::string voltage_loop = "* loop\nV1 a 0 1\nV2 a 0 2\n.op\n.end\n";
/// dv/dt = v up to the largest number and on.
inline const std::string explosive =
    "* explosive\nR1 a 0 -1\nC1 a 0 1 IC=1\n.tran 1 2000 uic\n.end\n";

struct Failure {
  SimulatorError::Cause cause{};
  std::string text{};
  bool kept_deck = false;
  bool kept_log = false;
};

/// Runs the deck, expects a failure and returns it; the folder it kept is removed.
inline Failure failure(Simulator& simulator, const std::string& deck,
                       std::span<const std::string> nodes = node_a) {
  try {
    (void)operating_point(simulator, deck, nodes);
  } catch (const SimulatorError& error) {
    const Failure result{error.cause(), error.what(),
                         std::filesystem::exists(error.folder() / "deck.cir"),
                         std::filesystem::exists(error.folder() / "ngspice.log")};
    if (!error.folder().empty()) std::filesystem::remove_all(error.folder());
    return result;
  }
  FAIL("no failure was reported");
  return {};
}

inline void check_kept(const Failure& result, SimulatorError::Cause cause, const char* text) {
  CHECK(result.cause == cause);
  CHECK_THAT(result.text, ContainsSubstring(text));
  CHECK_THAT(result.text, ContainsSubstring("deck.cir"));
  CHECK(result.kept_deck);
  CHECK(result.kept_log);
}

}  // namespace tactile_net
