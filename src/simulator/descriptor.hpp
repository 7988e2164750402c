/// @file
/// File descriptors that close themselves, and pairs of them to a child (POSIX).
#pragma once

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace tactile_net {

/// Throws what errno says. @throw std::system_error
[[noreturn]] inline void fail_with_errno(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

class Descriptor {
 public:
  explicit Descriptor(int number = -1) noexcept : number_(number) {}
  ~Descriptor() { reset(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  void reset() noexcept {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  [[nodiscard]] int get() const noexcept { return number_; }
  [[nodiscard]] bool open() const noexcept { return number_ >= 0; }

 private:
  int number_;
};

struct SocketPair {
  Descriptor ours;
  Descriptor theirs;
};

/// Close-on-exec, so that no other child inherits it; a socket, because MSG_NOSIGNAL spares the
/// caller a SIGPIPE when the child does not read its input.
///
/// @param type  SOCK_STREAM, or SOCK_SEQPACKET, which keeps messages apart
/// @throw std::system_error  the system gave none
inline SocketPair socket_pair(int type) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, type | SOCK_CLOEXEC, 0, ends.data()) != 0)
    fail_with_errno("socketpair");
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

}  // namespace tactile_net
