/// @file
/// The child's side of `NgspiceLibrary`: the only file that calls ngspice's library.
///
/// A request is one message, the path of a folder that holds deck.cir. The worker writes
/// ngspice.log and, if there is an answer, result.raw into it and sends one `WorkerReply`. Without
/// a reply, its exit status tells.
#pragma once

#include <sys/types.h>

#include <cstddef>

#include "tactile_net/simulator/child_process.hpp"

namespace tactile_net {

struct WorkerReply {
  ProcessResult::End end = ProcessResult::End::exited;  ///< exited or too_much_output
  int code = 0;                                         ///< what ngspice would have exited with
};

/// Called in the child, right after fork: makes it a process of its own and serves one deck after
/// another, until the parent hangs up or a deck fails.
///
/// @param socket        SOCK_SEQPACKET, to the parent
/// @param parent        process id
/// @param output_limit  of what one deck prints [bytes]
[[noreturn]] void serve_decks(int socket, pid_t parent, std::size_t output_limit) noexcept;

}  // namespace tactile_net
