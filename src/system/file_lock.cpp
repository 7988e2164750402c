#include "tactile_net/system/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <string>

namespace tactile_net {
namespace {

/// The number that stands in a lock file; 0: none.
pid_t written_in(int descriptor) noexcept {
  std::array<char, 24> text{};
  const ssize_t got = ::pread(descriptor, text.data(), text.size(), 0);
  pid_t owner = 0;
  if (got > 0) (void)std::from_chars(text.data(), text.data() + got, owner);
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

std::optional<pid_t> RunLock::take(const std::filesystem::path& file) {
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
    const std::string number = std::to_string(::getpid()) + '\n';
    if (::ftruncate(lock.descriptor_, 0) != 0 ||
        ::pwrite(lock.descriptor_, number.data(), number.size(), 0) < 0) {
      // Without the number the lock still holds.
    }
    file_ = file;
    lock_ = std::move(lock);
    leftover_ = Leftover(file_);
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace tactile_net
