#include "tactile_net/frames/output_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <ostream>
#include <system_error>

#include "frames/checked_file.hpp"
#include "frames/partial.hpp"
#include "tactile_net/frames/folder_lock.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::frames {

namespace fs = std::filesystem;

namespace {

/// Of a file that is there, and of no link.
std::optional<fs::perms> permissions_of(const fs::path& path) {
  std::error_code none;
  const fs::file_status status = fs::symlink_status(path, none);
  return fs::is_regular_file(status) ? std::optional(status.permissions() & fs::perms::all)
                                     : std::nullopt;
}

/// @param permissions  absent: as it was made
void put_in_place(const fs::path& made, const fs::path& path,
                  std::optional<fs::perms> permissions) {
  if (permissions) fs::permissions(made, *permissions);
  fs::rename(made, path);
}

}  // namespace

OutputFile::OutputFile(const fs::path& path, std::ostream* standard_output)
    : path_(path), standard_output_(path.empty() || path == "-" ? standard_output : nullptr) {
  if (standard_output_ != nullptr) return;
  std::error_code error;
  if (fs::is_symlink(path, error)) path_ = fs::weakly_canonical(path, error);
  const fs::file_status status = fs::status(path_, error);
  const bool direct = fs::exists(status) && !fs::is_regular_file(status);
  if (fs::is_directory(status)) throw CannotCreate(path.string() + ": error: is a folder");
  constexpr fs::perms all_may = fs::perms(0666);
  constexpr fs::perms we_may = fs::perms::owner_read | fs::perms::owner_write;
  permissions_ = permissions_of(path_);
  partial_ = std::make_unique<Partial>();
  const auto made = [&] {
    if (direct) return true;
    return partial_->make_file_beside(path_, permissions_ ? *permissions_ | we_may : all_may);
  };
  if (made()) file_ = std::make_unique<CheckedFile>(direct ? path_ : partial_->path(), path_);
  if (!file_ || !file_->opened())
    throw CannotCreate(path.string() +
                       ": error: cannot be created: " + std::generic_category().message(errno));
}

OutputFile::~OutputFile() = default;

std::ostream& OutputFile::stream() noexcept {
  if (standard_output_ != nullptr) return *standard_output_;
  return *file_;
}

bool OutputFile::is_direct() const noexcept { return partial_ == nullptr || !partial_->there(); }

void OutputFile::commit() {
  if (standard_output_ != nullptr) {
    errno = 0;
    if (!standard_output_->flush()) not_written("standard output");
    return;
  }
  file_->close();
  if (is_direct()) return;
  put_in_place(partial_->path(), path_, permissions_);
  partial_->moved();
}

fs::path OutputFile::commit_partial() {
  const bool direct = standard_output_ != nullptr || is_direct();
  if (!direct) path_ += ".partial";
  const fs::path kept = direct ? fs::path{} : path_;
  commit();
  return kept;
}

void write_file(const fs::path& path, std::string_view content) {
  OutputFile file(path);
  file.stream().write(content.data(), std::ssize(content));
  file.commit();
}

void check_replaceable(const fs::path& path, Existing existing) {
  const fs::file_status status = fs::symlink_status(path);
  if (existing == Existing::kept && fs::exists(status) && !fs::is_directory(status))
    throw CannotCreate(path.string() +
                       ": error: is there already, and not from an earlier run; nothing was "
                       "written: choose another folder, or replace it by " +
                       option(Option::force));
}

OutputFolder::OutputFolder(const fs::path& path, Existing existing)
    : path_(path), existing_(existing) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_directory(status))
    throw CannotCreate(path.string() + ": error: is a file, not a folder");
  if (status.type() == fs::file_type::none)
    throw CannotCreate(path.string() + ": error: cannot be created: " + error.message());
  if (!fs::exists(status) && fs::is_symlink(path, error))
    throw CannotCreate(path.string() +
                       ": error: is a link to a folder that is not there: make that, or remove the "
                       "link");
  error.clear();
  lock_ = std::make_unique<FolderLock>(path);
  const bool is_there = fs::is_directory(status);
  if (!path.has_filename() && !is_there) path_ = path.parent_path();
  if (!is_there && path_.has_parent_path()) fs::create_directories(path_.parent_path(), error);
  staging_ = std::make_unique<Partial>();
  errno = error.value();
  const bool made =
      !error && (is_there ? staging_->make_folder_in(path) : staging_->make_folder_beside(path_));
  if (!made || ::access(staging_->path().c_str(), W_OK) != 0)
    throw CannotCreate(path.string() + ": error: the folder cannot be written to: " +
                       std::generic_category().message(errno));
}

OutputFolder::~OutputFolder() = default;

fs::path OutputFolder::place(std::string_view name) const { return staging_->path() / name; }

void OutputFolder::write(std::string_view name, std::string_view content) const {
  CheckedFile file(staging_->path() / name, path_ / name);
  if (!file.opened()) not_written(path_ / name);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
}

std::vector<std::string> OutputFolder::commit() {
  if (!fs::is_directory(path_)) {
    fs::rename(staging_->path(), path_);
    staging_->moved();
    lock_.reset();
    return {};
  }
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(staging_->path())) {
    names.insert(entry.path().filename().string());
    const fs::path target = path_ / entry.path().filename();
    if (fs::is_directory(target))
      throw CannotCreate(target.string() + ": error: is a folder; nothing was written");
    check_replaceable(target, existing_);
  }
  for (const std::string& name : names)
    put_in_place(staging_->path() / name, path_ / name, permissions_of(path_ / name));
  fs::remove(staging_->path());
  staging_->moved();
  lock_.reset();
  return other_results(path_, names);
}

std::vector<std::string> other_results(const fs::path& folder,
                                       const std::set<std::string>& written) {
  std::vector<std::string> others;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string kind = entry.path().extension().string();
    std::string name = entry.path().filename().string();
    if (!written.contains(name) && (kind == ".csv" || kind == ".svg" || kind == ".cir"))
      others.push_back(std::move(name));
  }
  std::sort(others.begin(), others.end());
  return others;
}

}  // namespace tactile_net::frames
