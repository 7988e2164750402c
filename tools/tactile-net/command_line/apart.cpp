#include "command_line/apart.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "failure.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::tool {
namespace {

namespace fs = std::filesystem;

/// "-", and the names that the system has for it.
bool is_standard_output(const std::string& path) {
  constexpr std::array<std::string_view, 4> names = {"-", "/dev/stdout", "/dev/fd/1",
                                                     "/proc/self/fd/1"};
  return std::find(names.begin(), names.end(), path) != names.end();
}

bool is_file(const Given& given) {
  std::error_code none;  // of what is not there: it may become a file
  return given.argument->value.kind == Value::Kind::file && given.value != "-" &&
         !fs::is_other(given.value, none);
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

/// One document: two would be mixed, line by line.
void require_one_standard_output(const CommandTable& command, std::span<const Given> given) {
  const bool has_folder = std::any_of(given.begin(), given.end(), [](const Given& one) {
    return one.argument->value.kind == Value::Kind::folder;
  });
  const Argument* first = nullptr;
  for (const Argument& argument : command.arguments) {
    if (!argument.value.is_output) continue;
    const auto found = std::find_if(given.begin(), given.end(),
                                    [&](const Given& one) { return one.argument == &argument; });
    const bool is_named = found != given.end();
    const bool goes_there = is_named ? is_standard_output(found->value)
                                     : argument.value.is_standard_output && !has_folder;
    if (!goes_there) continue;
    if (first != nullptr)
      throw WrongUsage(argument.name(), "standard output is " + first->name() +
                                            "'s already, and it holds one of the two: give " +
                                            first->name() + " or " + argument.name() + " a file");
    first = &argument;
  }
}

}  // namespace

void require_apart(const CommandTable& command, std::span<const Given> given) {
  require_one_standard_output(command, given);
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
