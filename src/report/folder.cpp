#include "tactile_net/report/folder.hpp"

#include <fstream>
#include <string>
#include <system_error>

#include "tactile_net/drawing/html.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::report {

bool is_own_report(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  std::string begin(1024, '\0');
  std::ifstream(file, std::ios::binary).read(begin.data(), std::ssize(begin));
  return begin.find(drawing::written_by) != std::string::npos;
}

frames::Existing existing_in(const std::filesystem::path& folder, bool force) {
  const std::filesystem::path report = folder / "report.html";
  std::error_code ignored;
  if (force || is_own_report(report)) return frames::Existing::replaced;
  if (!std::filesystem::is_regular_file(report, ignored)) return frames::Existing::kept;
  throw frames::CannotCreate(report.string() +
                             ": error: was not written by tactile-net: choose another folder, or "
                             "replace it by " +
                             option(Option::force));
}

}  // namespace tactile_net::report
