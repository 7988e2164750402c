#include "tactile_net/system/leftovers.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

namespace tactile_net {
namespace {

enum State : int { vacant, being_written, entered };

/// The path stands in the slot itself, so that the handler never reads freed memory.
struct PathSlot {
  std::atomic<int> state{vacant};
  std::array<char, PATH_MAX> path{};
};

struct ChildSlot {
  std::atomic<pid_t> leader{0};
};

std::array<PathSlot, 64> paths;
std::array<ChildSlot, 64> children;
std::atomic<pid_t> owner{0};

/// The entries of a folder as the kernel writes them: `opendir` allocates, which no handler may.
struct DirectoryEntry {
  std::uint64_t inode;
  std::int64_t offset;
  unsigned short size;
  unsigned char type;
  char name[1];  // and on, up to a zero
};

void remove_tree(int parent, const char* name, int depth) noexcept;

/// Removes what the folder holds. A pass may miss entries that moved up: until one finds none.
void empty_folder(int folder, int depth) noexcept {
  alignas(DirectoryEntry) std::array<char, 4096> buffer;
  constexpr int most_passes = 64;
  for (int pass = 0; pass < most_passes; ++pass) {
    ::lseek(folder, 0, SEEK_SET);
    bool found = false;
    for (;;) {
      const long got = ::syscall(SYS_getdents64, folder, buffer.data(), buffer.size());
      if (got <= 0) break;
      for (long at = 0; at < got;) {
        const auto* entry = reinterpret_cast<const DirectoryEntry*>(buffer.data() + at);
        const char* name = buffer.data() + at + offsetof(DirectoryEntry, name);
        if (std::strcmp(name, ".") != 0 && std::strcmp(name, "..") != 0) {
          found = true;
          remove_tree(folder, name, depth + 1);
        }
        at += entry->size;
      }
    }
    if (!found) return;
  }
}

/// A file, or a folder with all it holds; links are removed, not followed.
void remove_tree(int parent, const char* name, int depth) noexcept {
  constexpr int deepest = 16;
  if (::unlinkat(parent, name, 0) == 0 || depth > deepest) return;
  if (errno != EISDIR && errno != EPERM) return;
  const int folder = ::openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0) return;
  empty_folder(folder, depth);
  ::close(folder);
  ::unlinkat(parent, name, AT_REMOVEDIR);
}

}  // namespace

Leftover::Leftover(const std::filesystem::path& path) {
  std::error_code error;
  const std::string text = std::filesystem::absolute(path, error).string();
  if (error || text.size() >= PATH_MAX) return;
  owner = ::getpid();
  for (std::size_t i = 0; i < paths.size(); ++i) {
    int expected = vacant;
    if (!paths[i].state.compare_exchange_strong(expected, being_written)) continue;
    std::copy_n(text.c_str(), text.size() + 1, paths[i].path.data());
    paths[i].state = entered;
    slot_ = i;
    return;
  }
}

Leftover::Leftover(Leftover&& other) noexcept : slot_(std::exchange(other.slot_, none)) {}

Leftover& Leftover::operator=(Leftover&& other) noexcept {
  std::swap(slot_, other.slot_);
  return *this;
}

void Leftover::release() noexcept {
  if (slot_ != none) paths[slot_].state = vacant;
  slot_ = none;
}

LeftoverChild::LeftoverChild(pid_t leader) noexcept {
  owner = ::getpid();
  for (std::size_t i = 0; i < children.size(); ++i) {
    pid_t expected = 0;
    if (!children[i].leader.compare_exchange_strong(expected, leader)) continue;
    slot_ = i;
    return;
  }
}

LeftoverChild::~LeftoverChild() {
  if (slot_ != none) children[slot_].leader = 0;
}

void remove_leftovers() noexcept {
  if (owner != ::getpid()) return;
  for (ChildSlot& slot : children) {
    const pid_t leader = slot.leader;
    if (leader <= 0) continue;
    ::kill(-leader, SIGKILL);
    ::kill(leader, SIGKILL);  // it may not lead a group yet
    int status = 0;
    while (::waitpid(leader, &status, 0) < 0 && errno == EINTR) {
    }
  }
  for (PathSlot& slot : paths)
    if (slot.state == entered) remove_tree(AT_FDCWD, slot.path.data(), 0);
}

}  // namespace tactile_net
