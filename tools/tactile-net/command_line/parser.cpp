#include "command_line/parser.hpp"

#include <algorithm>
#include <optional>
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

const CommandTable& command_named(const CommandLine& line, const std::string& typed) {
  const CommandTable* const command = line.find(typed);
  if (command != nullptr) return *command;
  std::vector<std::string> names;
  for (const CommandTable& one : line.commands) names.push_back(one.name);
  throw WrongUsage("there is no command '" + typed + "'" + suggestion(typed, names));
}

/// "-" is standard input, and "-5" a number.
bool is_like_option(std::string_view typed) {
  return typed.size() > 1 && typed[0] == '-' && typed[1] != '.' &&
         !(typed[1] >= '0' && typed[1] <= '9');
}

/// Null: there is none of this name.
const Argument* find(const std::vector<const Argument*>& known, std::string_view name) {
  const auto found = std::find_if(known.begin(), known.end(), [&](const Argument* argument) {
    return argument->is_option() &&
           std::find(argument->names.begin(), argument->names.end(), name) != argument->names.end();
  });
  return found == known.end() ? nullptr : *found;
}

/// What one word holds: an option, and what is glued to it.
struct OptionWord {
  const Argument* argument = nullptr;
  std::optional<std::string> value{};
  std::string rest{};  ///< other options: "-o" of "-qo"
};

/// @param command  null: the word stands before the command's name
OptionWord option_in(const CommandLine& line, const CommandTable* command,
                     const std::string& typed) {
  const std::vector<const Argument*> known = line.arguments(command);
  const std::size_t equals = typed.find('=');
  const std::string name = typed.substr(0, equals);
  if (const Argument* const argument = find(known, name)) {
    if (equals == typed.npos) return {.argument = argument};
    return {.argument = argument, .value = typed.substr(equals + 1)};
  }
  // "-oFILE", but not "-output".
  const Argument* const letter = find(known, typed.substr(0, 2));
  if (letter != nullptr && find(known, "-" + name) == nullptr) {
    if (letter->is_flag()) return {.argument = letter, .rest = "-" + typed.substr(2)};
    return {.argument = letter, .value = typed.substr(2)};
  }
  const std::string bare = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  std::vector<std::string> names;
  for (const Argument* argument : known)
    if (argument->name().starts_with("--")) names.push_back(argument->name().substr(2));
  throw WrongUsage((command == nullptr ? line.program : command->name) + " has no option '" + name +
                   "'" + suggestion(bare, names, "--"));
}

/// The words from left to right, and what they have given so far.
class Reader {
 public:
  explicit Reader(const CommandLine& line) : line_(line) {}

  Parsed read(std::span<const std::string> words) {
    bool options_end = false;  // behind "--"
    for (; !words.empty(); words = words.subspan(1)) {
      const std::string& typed = words.front();
      if (options_end || !is_like_option(typed)) {
        if (command_ == nullptr)
          command_ = &command_named(line_, typed);
        else
          set(next_by_place(typed), typed);
        continue;
      }
      options_end = typed == "--" && command_ != nullptr;
      if (options_end) continue;
      for (std::string rest = typed; !rest.empty();) {
        OptionWord option = option_in(line_, command_, rest);
        const Argument& argument = *option.argument;
        if (&argument == &line_.help) return {.command = command_, .help = true};
        if (&argument == &line_.release) return {.release = true};
        if (!argument.is_flag() && !option.value) {
          words = words.subspan(1);
          option.value = value_of(argument, words);
        }
        if (argument.is_flag() && option.value)
          throw WrongUsage(argument.name(), "takes no value, and '" + *option.value + "' is given");
        set(argument, option.value.value_or(""));
        rest = option.rest;
      }
    }
    require_whole();
    command_->chosen();
    return {.command = command_};
  }

 private:
  [[nodiscard]] bool is_given(const Argument& argument) const {
    return std::any_of(given_.begin(), given_.end(),
                       [&](const Given& one) { return one.argument == &argument; });
  }

  /// The first that has no value yet, or takes several.
  [[nodiscard]] const Argument& next_by_place(const std::string& typed) const {
    for (const Argument& argument : command_->arguments)
      if (!argument.is_option() && (argument.many || !is_given(argument))) return argument;
    throw WrongUsage("argument not expected: " + typed + " (usage: " + line_.program + " " +
                     CommandLine::usage(*command_) + ")");
  }

  /// The word behind an option. One that looks like an option is more likely to be the next.
  [[nodiscard]] std::string value_of(const Argument& argument,
                                     std::span<const std::string> words) const {
    const std::string missing = argument.value.shown() + " is missing";
    if (words.empty()) throw WrongUsage(argument.name(), missing);
    const std::string& typed = words.front();
    if (typed.starts_with("--") || find(line_.arguments(command_), typed) != nullptr)
      throw WrongUsage(argument.name(), missing + " before '" + typed + "'; where that is meant, " +
                                            "write " + argument.name() + "=" + typed);
    return typed;
  }

  /// @param value  of a flag ""
  void set(const Argument& argument, const std::string& value) {
    if (is_given(argument) && !argument.is_flag() && !argument.many)
      throw WrongUsage(argument.name(), "is given twice; give it once");
    if (argument.is_place() && value.empty())
      throw WrongUsage(argument.name(),
                       argument.value.shown() + " is an empty name; give one, or leave " +
                           (argument.is_option() ? argument.name() : "it") + " out");
    const std::vector<std::string>& choices = argument.value.choices;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), value) == choices.end())
      throw WrongUsage(argument.name(), "'" + value + "' is none of " + join(choices, ", ") +
                                            suggestion(value, choices));
    given_.push_back({&argument, value});
    try {
      argument.set(value);
    } catch (const std::invalid_argument& error) {
      throw WrongUsage(argument.name(), error.what());
    }
  }

  void require_whole() const {
    if (command_ == nullptr) throw WrongUsage("a command is required");
    for (const Argument& argument : command_->arguments)
      if (argument.required && !is_given(argument))
        throw WrongUsage(argument.name() + " is required");
    require_apart(*command_, given_);
  }

  const CommandLine& line_;
  const CommandTable* command_ = nullptr;
  std::vector<Given> given_;
};

}  // namespace

Parsed parse(const CommandLine& line, std::span<const std::string> arguments) {
  return Reader(line).read(arguments);
}

}  // namespace tactile_net::tool
