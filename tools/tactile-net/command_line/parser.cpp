// The one file that knows the parser.
#include "command_line/parser.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "command_line/apart.hpp"
#include "failure.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/scene/nearest.hpp"

namespace tactile_net::tool {
namespace {

/// "; did you mean 'run'?", where one of the names is near.
std::string suggestion(std::string_view typed, const std::vector<std::string>& names,
                       const std::string& before = "") {
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string near(nearest(typed, known));
  return near.empty() ? "" : "; did you mean '" + before + near + "'?";
}

void set(const Argument& argument, const std::string& value, std::vector<Given>& given) {
  const std::vector<std::string>& choices = argument.value.choices;
  if (!choices.empty() && std::find(choices.begin(), choices.end(), value) == choices.end())
    throw WrongUsage(argument.name(), "'" + value + "' is none of " + join(choices, ", ") +
                                          suggestion(value, choices));
  given.push_back({&argument, value});
  try {
    argument.set(value);
  } catch (const std::invalid_argument& error) {
    throw WrongUsage(argument.name(), error.what());
  }
}

void add(CLI::App& app, const Argument& argument, std::vector<Given>& given) {
  const std::string names = join(argument.names, ",");
  if (argument.is_flag()) {
    app.add_flag_function(names, [&](std::int64_t) { set(argument, "", given); });
    return;
  }
  if (argument.many) {
    app.add_option_function<std::vector<std::string>>(names,
                                                      [&](const std::vector<std::string>& values) {
                                                        for (const std::string& value : values)
                                                          set(argument, value, given);
                                                      })
        ->type_name(argument.value.shown())
        ->required(argument.required);
    return;
  }
  app.add_option_function<std::string>(
         names, [&](const std::string& value) { set(argument, value, given); })
      ->type_name(argument.value.shown())
      ->required(argument.required);
}

/// "-" is standard input, and "-5" a number.
bool is_like_option(const std::string& typed) {
  return typed.size() > 1 && typed[0] == '-' && typed[1] != '.' &&
         !(typed[1] >= '0' && typed[1] <= '9');
}

bool is_named(const Argument& argument, std::string_view name) {
  return std::find(argument.names.begin(), argument.names.end(), name) != argument.names.end();
}

/// @param arguments  behind the command's name; null: those before it
/// @throw WrongUsage  names the first option that there is not
void check_options(const CommandLine& line, const CommandTable* command,
                   std::span<const std::string> arguments) {
  const std::vector<const Argument*> known = line.arguments(command);
  for (const std::string& typed : arguments) {
    if (typed == "--") return;
    if (!is_like_option(typed)) continue;
    const std::size_t equals = typed.find('=');
    const bool is_short = typed[1] != '-';
    const auto match = [&](const Argument* argument) {
      return is_named(*argument, std::string_view(typed).substr(0, equals)) ||
             (is_short && is_named(*argument, std::string_view(typed).substr(0, 2)));
    };
    const auto found = std::find_if(known.begin(), known.end(), match);
    if (found != known.end()) continue;
    const std::string name = typed.substr(0, equals);
    const std::string bare = name.substr(std::min(name.find_first_not_of('-'), name.size()));
    std::vector<std::string> names;
    for (const Argument* argument : known)
      if (argument->name().starts_with("--")) names.push_back(argument->name().substr(2));
    throw WrongUsage((command == nullptr ? line.program : command->name) + " has no option '" +
                     name + "'" + suggestion(bare, names, "--"));
  }
}

/// The parser only says that a sub-command is required; says which one was meant.
void check_command(const CommandLine& line, const std::string& typed) {
  if (line.find(typed) != nullptr) return;
  std::vector<std::string> names;
  for (const CommandTable& command : line.commands) names.push_back(command.name);
  throw WrongUsage("there is no command '" + typed + "'" + suggestion(typed, names));
}

}  // namespace

Parsed parse(const CommandLine& line, std::span<const std::string> arguments) {
  CLI::App app;
  app.set_help_flag(join(line.help.names, ","));
  app.set_version_flag(join(line.release.names, ","), line.version);
  app.require_subcommand(1);
  std::vector<Given> given;
  add(app, line.quiet, given);
  std::map<const CLI::App*, const CommandTable*> commands;
  for (const CommandTable& command : line.commands) {
    CLI::App* const sub = app.add_subcommand(command.name);
    for (const Argument& argument : command.arguments) add(*sub, argument, given);
    add(*sub, line.quiet, given);
    commands.emplace(sub, &command);
  }

  const auto first = std::find_if(arguments.begin(), arguments.end(),
                                  [](const std::string& one) { return !one.starts_with('-'); });
  if (first != arguments.end()) check_command(line, *first);
  const auto named = [&]() -> const CommandTable* {
    const auto subs = app.get_subcommands();
    return subs.empty() ? nullptr : commands.at(subs.front());
  };
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForVersion&) {
    return {.release = true};
  } catch (const CLI::CallForHelp&) {
    return {.command = named(), .help = true};
  } catch (const CLI::ParseError& error) {
    // The parser's own words may blame an argument that is as it should be.
    const auto of_command = static_cast<std::size_t>(first - arguments.begin());
    check_options(line, nullptr, arguments.first(of_command));
    if (first != arguments.end())
      check_options(line, line.find(*first), arguments.subspan(of_command + 1));
    throw WrongUsage(error.what());
  }
  require_apart(*named(), given);
  named()->chosen();
  return {.command = named()};
}

}  // namespace tactile_net::tool
