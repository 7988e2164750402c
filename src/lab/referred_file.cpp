#include "lab/referred_file.hpp"

#include <string>
#include <system_error>
#include <vector>

namespace tactile_net::lab {

InputError without_quotes(const InputError& error, const char* advice) {
  std::vector<Diagnostic> told = error.diagnostics();
  for (Diagnostic& one : told) {
    one.source.clear();
    if (one.line == 0) continue;
    one.message = "the file that the hand refers to is not in order here";
    one.hint = std::string("its text is not shown here: ") + advice;
  }
  return InputError(std::move(told));
}

void require_regular(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_directory(status) &&
      !std::filesystem::is_regular_file(status))
    throw InputError({{.file = file.string(),
                       .message = "is not a regular file",
                       .hint = "save it to a file first"}});
}

InputError nothing_presses(const std::filesystem::path& scene) {
  return InputError({{.file = scene.string(),
                      .message = "nothing presses on this fingertip",
                      .hint = "name recorded readings in the hand's file: readings = \"FILE.csv\""
                              ", or give the scene a [[contact]]"}});
}

}  // namespace tactile_net::lab
