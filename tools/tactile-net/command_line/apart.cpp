#include "command_line/apart.hpp"

#include <filesystem>
#include <system_error>

#include "failure.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::tool {
namespace {

namespace fs = std::filesystem;

bool is_file(const Given& given) {
  std::error_code none;  // of what is not there: it may become a file
  return given.argument->value.kind == Value::Kind::file && given.value != "-" &&
         !given.value.empty() && !fs::is_other(given.value, none);
}

/// One that is there, by whatever names and links; one that is not yet, by its path.
bool are_same(const std::string& one, const std::string& other) {
  std::error_code none;
  if (fs::equivalent(one, other, none)) return true;
  const auto plain = [&](const std::string& path) {
    const fs::path whole = fs::weakly_canonical(path, none);
    return none ? fs::path(path) : whole;
  };
  return plain(one) == plain(other);
}

}  // namespace

void require_apart(std::span<const Given> given) {
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (!is_file(given[i]) || !given[i].argument->value.is_output) continue;
    for (std::size_t k = 0; k < given.size(); ++k) {
      const bool later = given[k].argument->value.is_output && k <= i;
      if (later || !is_file(given[k]) || !are_same(given[i].value, given[k].value)) continue;
      if (given[k].argument->value.is_output)
        throw WrongUsage(
            given[k].argument->name(),
            "is the file that " + given[i].argument->name() + " names too: they need one each");
      throw WrongUsage(given[i].argument->name(), "is the file that is read, " +
                                                      printable(given[k].value) +
                                                      ", and would replace it: name another");
    }
  }
}

}  // namespace tactile_net::tool
