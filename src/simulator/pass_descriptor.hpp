/// @file
/// From the child to its parent, over a socket: an open file, or why it could not start. Private.
#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "simulator/descriptor.hpp"

namespace tactile_net {

/// Sends an open file, with the number 0. Safe after fork. @return false: errno says why not
inline bool send_descriptor(int socket, int descriptor) noexcept {
  int number = 0;
  iovec text{&number, sizeof number};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof descriptor)> room{};
  msghdr message{};
  message.msg_iov = &text;
  message.msg_iovlen = 1;
  message.msg_control = room.data();
  message.msg_controllen = room.size();
  cmsghdr* header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(sizeof descriptor);
  std::memcpy(CMSG_DATA(header), &descriptor, sizeof descriptor);
  return ::sendmsg(socket, &message, MSG_NOSIGNAL) == static_cast<ssize_t>(sizeof number);
}

/// Waits for a number, and takes the open file that comes with it, if one does.
///
/// @return as recvmsg: 0 when the other end is closed, with the program's start
inline ssize_t receive(int socket, int& number, Descriptor& descriptor) noexcept {
  iovec text{&number, sizeof number};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> room{};
  msghdr message{};
  message.msg_iov = &text;
  message.msg_iovlen = 1;
  message.msg_control = room.data();
  message.msg_controllen = room.size();
  ssize_t got = 0;
  do got = ::recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
  while (got < 0 && errno == EINTR);
  const cmsghdr* header = got > 0 ? CMSG_FIRSTHDR(&message) : nullptr;
  if (header != nullptr && header->cmsg_type == SCM_RIGHTS) {
    int taken = -1;
    std::memcpy(&taken, CMSG_DATA(header), sizeof taken);
    descriptor = Descriptor(taken);
  }
  return got;
}

}  // namespace tactile_net
