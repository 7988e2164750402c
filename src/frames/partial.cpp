#include "frames/partial.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
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

/// Whether a name is `prefix` and a process' number.
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

fs::path named(const fs::path& folder, const std::string& prefix) {
  sweep(folder.empty() ? "." : folder, prefix);
  return folder / (prefix + std::to_string(::getpid()));
}

}  // namespace

fs::path Partial::name_beside(const fs::path& path) {
  return named(path.parent_path(), path.filename().string() + std::string(mark));
}

fs::path Partial::name_in(const fs::path& folder) { return named(folder, std::string(mark)); }

void Partial::will_be(const fs::path& path) {
  path_ = path;
  leftover_ = Leftover(path);
}

void Partial::made() {
  if (auto lock = FileLock::of(path_)) lock_ = std::move(*lock);
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
