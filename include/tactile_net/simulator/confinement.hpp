/// @file
/// What a program that works on a stranger's file is kept from, by the kernel (Linux).
///
/// A deck is a program: what ngspice reads may ask it to write files and to start others. The cards
/// that do so are refused before it sees them (`decks/deck_file.hpp`); this is the second wall.
#pragma once

namespace tactile_net {

/// What is in force where a process is started with `ProcessOptions::confined`.
struct Confinement {
  /// It writes, makes and removes files in its own folder alone, and connects to no port: landlock.
  bool files = false;
  /// It starts no other program, opens no socket, sends no signal and traces nobody: seccomp.
  bool processes = false;
};

/// What this machine's kernel offers; asked once. Where it offers nothing, programs run as ever.
[[nodiscard]] Confinement confinement() noexcept;

}  // namespace tactile_net
