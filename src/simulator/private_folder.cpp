#include "simulator/private_folder.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <mutex>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace tactile_net {
namespace {

namespace fs = std::filesystem;

// Folders in use and folders kept have other names, so that only the former are ever swept away.
constexpr std::string_view in_use = "tactile-net-run-";
constexpr std::string_view kept = "tactile-net-";

/// The system's temporary folder. @throw std::runtime_error  naming it
fs::path temporary_folder() {
  std::error_code error;
  const fs::path folder = fs::temp_directory_path(error);
  if (!error) return folder;
  const char* variable = std::getenv("TMPDIR");
  const std::string name = variable == nullptr ? "/tmp" : variable;
  throw std::runtime_error("no temporary folder can be made in " + name +
                           (variable == nullptr ? "" : " (TMPDIR)") + ": " + error.message() +
                           "; set TMPDIR to a folder that can be written to");
}

fs::path make_folder(const fs::path& in, std::string_view prefix) {
  std::string name = (in / prefix).string() + "XXXXXX";
  if (::mkdtemp(name.data()) == nullptr)
    throw std::runtime_error("no temporary folder can be made in " + in.string() + ": " +
                             std::generic_category().message(errno) +
                             "; set TMPDIR to a folder that can be written to");
  return name;
}

/// Ours, and old enough that who made it has locked it by now.
bool may_be_abandoned(const fs::path& folder) {
  constexpr std::time_t seconds_to_lock = 10;
  struct stat state {};
  return ::lstat(folder.c_str(), &state) == 0 && S_ISDIR(state.st_mode) &&
         state.st_uid == ::geteuid() && std::time(nullptr) - state.st_mtime > seconds_to_lock;
}

/// Once a process.
fs::path swept(const fs::path& temporary) {
  static std::once_flag done;
  std::call_once(done, sweep_private_folders, temporary);
  return temporary;
}

}  // namespace

PrivateFolder::PrivateFolder() : PrivateFolder(swept(temporary_folder())) {}

PrivateFolder::PrivateFolder(const fs::path& in)
    : path_(make_folder(in, in_use)), leftover_(path_) {
  if (auto lock = FileLock::of(path_)) lock_ = std::move(*lock);
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path PrivateFolder::keep(std::initializer_list<std::string_view> names) const {
  const fs::path place = make_folder(temporary_folder(), kept);
  std::error_code ignored;
  for (const std::string_view name : names) fs::rename(path_ / name, place / name, ignored);
  return place;
}

void sweep_private_folders(const fs::path& temporary) {
  std::error_code ignored;
  for (fs::directory_iterator entry(temporary, ignored), end; entry != end;
       entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(in_use) || !may_be_abandoned(entry->path())) continue;
    if (const auto lock = FileLock::of(entry->path())) fs::remove_all(entry->path(), ignored);
  }
}

void write_file(const fs::path& path, std::string_view content) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  const int reason = errno;
  file.close();
  if (file) return;
  throw std::runtime_error(path.string() + ": error: could not be written: " +
                           std::generic_category().message(errno == 0 ? reason : errno));
}

}  // namespace tactile_net
