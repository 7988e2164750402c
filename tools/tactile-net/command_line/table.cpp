#include "command_line/table.hpp"

#include <algorithm>

#include "tactile_net/numeric/text.hpp"

namespace tactile_net::tool {

std::string Value::shown() const {
  return kind == Kind::choice ? "{" + join(choices, ",") + "}" : name;
}

const CommandTable* CommandLine::find(std::string_view command) const {
  const auto found = std::find_if(commands.begin(), commands.end(),
                                  [&](const CommandTable& one) { return one.name == command; });
  return found == commands.end() ? nullptr : &*found;
}

std::vector<const Argument*> CommandLine::arguments(const CommandTable* command) const {
  std::vector<const Argument*> all;
  if (command != nullptr)
    for (const Argument& argument : command->arguments) all.push_back(&argument);
  else
    all.push_back(&release);
  all.push_back(&quiet);
  all.push_back(&help);
  return all;
}

std::string CommandLine::usage(const CommandTable& command) {
  std::string text = command.name + " [OPTIONS]";
  for (const Argument& argument : command.arguments) {
    if (argument.required && argument.is_option())
      text += " " + argument.name() + " " + argument.value.shown();
    if (!argument.is_option())
      text += " " + (argument.required ? argument.name() : "[" + argument.name() + "]") +
              (argument.many ? " ..." : "");
  }
  return text;
}

}  // namespace tactile_net::tool
