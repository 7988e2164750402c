#include "frames/partial.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <random>
#include <string_view>
#include <system_error>
#include <utility>

namespace tactile_net::frames {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = ".partial-";

/// Old enough that who made it has locked it by now.
bool may_be_abandoned(const fs::path& path) {
  constexpr std::time_t seconds_to_lock = 10;
  struct stat state {};
  return ::lstat(path.c_str(), &state) == 0 && state.st_uid == ::geteuid() &&
         (S_ISREG(state.st_mode) || S_ISDIR(state.st_mode)) &&
         std::time(nullptr) - state.st_mtime > seconds_to_lock;
}

/// Whether a name is `prefix` and a number.
bool is_partial(std::string_view name, std::string_view prefix) {
  if (!name.starts_with(prefix) || name.size() == prefix.size()) return false;
  name.remove_prefix(prefix.size());
  return std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

void sweep(const fs::path& folder, const std::string& prefix) {
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
    if (!is_partial(entry->path().filename().string(), prefix) || !may_be_abandoned(entry->path()))
      continue;
    if (const auto lock = FileLock::of(entry->path())) fs::remove_all(entry->path(), ignored);
  }
}

}  // namespace

bool Partial::make(const fs::path& folder, const std::string& prefix, const Maker& maker) {
  sweep(folder.empty() ? "." : folder, prefix);
  std::random_device random;
  constexpr int tries = 100;
  for (int i = 0; i < tries; ++i) {
    path_ = folder / (prefix + std::to_string(random()));
    leftover_ = Leftover(path_);  // what a signal in between finds goes too
    if (maker(path_)) {
      if (auto lock = FileLock::of(path_)) lock_ = std::move(*lock);
      return true;
    }
    const int why = errno;
    moved();  // it is not there, or somebody else's
    errno = why;
    if (why != EEXIST) return false;
  }
  return false;
}

bool Partial::make_file_beside(const fs::path& path, fs::perms permissions) {
  return make(path.parent_path(), path.filename().string() + std::string(mark),
              [=](const fs::path& name) {
                const int descriptor =
                    ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                           static_cast<mode_t>(permissions));
                if (descriptor < 0) return false;
                ::close(descriptor);
                return true;
              });
}

bool Partial::make_folder_beside(const fs::path& path) {
  return make(path.parent_path(), path.filename().string() + std::string(mark),
              [](const fs::path& name) { return ::mkdir(name.c_str(), 0777) == 0; });
}

bool Partial::make_folder_in(const fs::path& folder) {
  return make(folder, std::string(mark),
              [](const fs::path& name) { return ::mkdir(name.c_str(), 0700) == 0; });
}

void Partial::moved() noexcept {
  path_.clear();
  leftover_.release();
  lock_.reset();
}

void Partial::remove() noexcept {
  std::error_code ignored;
  if (there()) fs::remove_all(path_, ignored);
}

}  // namespace tactile_net::frames
