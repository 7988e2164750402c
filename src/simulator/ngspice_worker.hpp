/// @file
/// The child's side of `NgspiceLibrary`: the only file that calls ngspice's library.
///
/// A request is one message, the path of a folder that holds deck.cir. The worker writes
/// ngspice.log and, if there is an answer, result.raw into it and sends one `WorkerReply`. Without
/// a reply, its exit status tells.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>

#include "tactile_net/simulator/child_process.hpp"

namespace tactile_net {

struct WorkerReply {
  ProcessResult::End end = ProcessResult::End::exited;  ///< exited or too_much_output
  int code = 0;                                         ///< what ngspice would have exited with
};

struct WorkerOptions {
  int socket = -1;               ///< SOCK_SEQPACKET, to the parent
  pid_t parent = 0;              ///< process id
  const char* folder = nullptr;  ///< each deck's folder is in this one: it writes nowhere else
  std::chrono::milliseconds time_limit{};  ///< of one deck, which the parent holds it to as well
  std::size_t output_limit = 0;            ///< of what one deck prints [bytes]
};

/// Called in the child, right after fork: makes it a process of its own, confined, and serves one
/// deck after another, until the parent hangs up or a deck fails.
[[noreturn]] void serve_decks(const WorkerOptions& options) noexcept;

}  // namespace tactile_net
