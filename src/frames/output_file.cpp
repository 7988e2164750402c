#include "tactile_net/frames/output_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ostream>
#include <system_error>

namespace tactile_net::frames {
namespace {

namespace fs = std::filesystem;

std::string suffix() { return ".partial-" + std::to_string(::getpid()); }

[[noreturn]] void not_written(const fs::path& path) {
  const std::string reason = errno == 0 ? "" : ": " + std::generic_category().message(errno);
  throw std::runtime_error(path.string() + " could not be written" + reason +
                           "; nothing was changed there");
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
  if (!direct) {
    temporary_ = path_;
    temporary_ += suffix();
  }
  errno = 0;
  file_.open(direct ? path_ : temporary_, std::ios::binary | std::ios::trunc);
  if (!file_) {
    temporary_.clear();
    throw CannotCreate(path.string() +
                       ": error: cannot be created: " + std::generic_category().message(errno));
  }
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

std::ostream& OutputFile::stream() noexcept {
  if (standard_output_ != nullptr) return *standard_output_;
  return file_;
}

void OutputFile::commit() {
  errno = 0;
  std::ostream& out = stream();
  out.flush();
  file_.close();
  if (!out) not_written(standard_output_ != nullptr ? "standard output" : path_);
  if (temporary_.empty()) return;
  fs::rename(temporary_, path_);
  temporary_.clear();
}

fs::path OutputFile::commit_partial() {
  if (!temporary_.empty()) path_ += ".partial";
  const fs::path kept = temporary_.empty() ? fs::path{} : path_;
  commit();
  return kept;
}

void write_file(const fs::path& path, std::string_view content) {
  OutputFile file(path);
  file.stream().write(content.data(), std::ssize(content));
  file.commit();
}

OutputFolder::OutputFolder(const fs::path& path) : path_(path) {
  std::error_code error;
  if (fs::exists(path) && !fs::is_directory(path))
    throw CannotCreate(path.string() + ": error: is a file, not a folder");
  if (fs::is_directory(path)) {
    staging_ = path / suffix();
  } else {
    staging_ = (path.has_filename() ? path : path.parent_path());
    path_ = staging_;
    staging_ += suffix();
  }
  fs::create_directories(staging_, error);
  if (error || ::access(staging_.c_str(), W_OK) != 0) {
    const fs::path failed = staging_;
    staging_.clear();
    throw CannotCreate(path.string() + ": error: the folder cannot be written to: " +
                       (error ? error.message() : "permission denied"));
  }
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
}

void OutputFolder::write(std::string_view name, std::string_view content) const {
  errno = 0;
  std::ofstream file(staging_ / name, std::ios::binary | std::ios::trunc);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) not_written(path_ / name);
}

std::vector<std::string> OutputFolder::commit() {
  if (!fs::is_directory(path_)) {
    fs::rename(staging_, path_);
    staging_.clear();
    return {};
  }
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(staging_)) {
    names.insert(entry.path().filename().string());
    const fs::path target = path_ / entry.path().filename();
    if (fs::is_directory(target))
      throw CannotCreate(target.string() + ": error: is a folder; nothing was written");
  }
  for (const std::string& name : names) fs::rename(staging_ / name, path_ / name);
  fs::remove(staging_);
  staging_.clear();
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
