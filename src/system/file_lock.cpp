#include "tactile_net/system/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <string>

namespace tactile_net {
namespace {

std::string this_host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// What stands in a lock file: "1234 host".
LockOwner written_in(int descriptor) {
  std::array<char, 300> text{};
  const ssize_t got = ::pread(descriptor, text.data(), text.size(), 0);
  LockOwner owner;
  if (got <= 0) return owner;
  const char* const end = text.data() + got;
  const auto [stop, error] = std::from_chars(text.data(), end, owner.process);
  if (error != std::errc{} || stop == end || *stop != ' ') return owner;
  const std::string host(stop + 1, std::find(stop, end, '\n'));
  if (host != this_host()) owner.host = host;
  return owner;
}

/// Whether the path still names the open file: its owner before may have removed it meanwhile.
bool is_at(const std::filesystem::path& path, int descriptor) noexcept {
  struct stat open {};
  struct stat named {};
  return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

}  // namespace

std::optional<FileLock> FileLock::of(const std::filesystem::path& path) noexcept {
  FileLock lock(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (lock.descriptor_ < 0 || ::flock(lock.descriptor_, LOCK_EX | LOCK_NB) != 0)
    return std::nullopt;
  return lock;
}

void FileLock::reset() noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

RunLock::~RunLock() {
  if (lock_.descriptor_ >= 0) ::unlink(file_.c_str());  // before the lock goes with the descriptor
}

std::optional<LockOwner> RunLock::take(const std::filesystem::path& file) {
  constexpr int tries = 100;
  for (int i = 0; i < tries; ++i) {
    FileLock lock(
        ::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0644));
    if (lock.descriptor_ < 0) return std::nullopt;
    if (::flock(lock.descriptor_, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) return std::nullopt;
      return written_in(lock.descriptor_);
    }
    if (!is_at(file, lock.descriptor_)) continue;
    const std::string who = std::to_string(::getpid()) + ' ' + this_host() + '\n';
    if (::ftruncate(lock.descriptor_, 0) != 0 ||
        ::pwrite(lock.descriptor_, who.data(), who.size(), 0) < 0) {
      // Without the name the lock still holds.
    }
    file_ = file;
    lock_ = std::move(lock);
    leftover_ = Leftover(file_);
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace tactile_net
