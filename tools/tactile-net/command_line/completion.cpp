#include "command_line/completion.hpp"

#include <map>
#include <string_view>
#include <vector>

#include "tactile_net/numeric/text.hpp"

namespace tactile_net::tool {
namespace {

/// Where the texts of a script's tables come in.
std::string filled(std::string text, const std::map<std::string, std::string>& parts) {
  for (const auto& [mark, part] : parts)
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += part.size())
      text.replace(at, mark.size(), part);
  return text;
}

std::string option_names(const CommandLine& line, const CommandTable* command) {
  std::vector<std::string> names;
  for (const Argument* argument : line.arguments(command))
    if (argument->is_option())
      names.insert(names.end(), argument->names.begin(), argument->names.end());
  return join(names, " ");
}

/// What the bash script knows of a value: its kind, and choices or endings behind that.
std::string in_bash(const Value& value) {
  switch (value.kind) {
    case Value::Kind::choice:
      return "choice " + join(value.choices, " ");
    case Value::Kind::file:
      return "file " + join(value.endings, " ");
    case Value::Kind::folder:
      return "folder";
    case Value::Kind::text:
      return "text";
    case Value::Kind::none:
      break;
  }
  return {};
}

constexpr std::string_view bash_script =
    R"(# bash completion of @program@, made by: @program@ completion bash

# What the value of an option of a command is, or its argument without a dash.
_@function@_value() {
  case $1:$2 in
@values@  esac
}

_@function@() {
  local current=${COMP_WORDS[COMP_CWORD]} command= option= used= word value i
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    if [[ $word == = ]]; then  # bash takes --name=value apart
      continue
    elif [[ -n $option ]]; then
      option=
    elif [[ $word == -* ]]; then
      [[ -n $command && -n $(_@function@_value "$command" "$word") ]] && option=$word
    elif [[ -z $command ]]; then
      command=$word
    else
      used=yes
    fi
  done
  [[ $current == = ]] && current=

  if [[ -n $option ]]; then
    value=$(_@function@_value "$command" "$option")
  elif [[ $current == -* ]]; then
    case $command in
@options@      *) value='choice @global@' ;;
    esac
  elif [[ -z $command ]]; then
    value='choice @commands@'
  elif [[ -z $used ]]; then
    value=$(_@function@_value "$command" '')
  fi

  local kind=${value%% *} rest=${value#* }
  [[ $rest == "$value" ]] && rest=
  local IFS=$'\n'
  case $kind in
    choice)
      COMPREPLY=($(compgen -W "${rest// /$'\n'}" -- "$current"))
      ;;
    folder)
      compopt -o filenames 2>/dev/null
      COMPREPLY=($(compgen -d -- "$current"))
      ;;
    file)
      compopt -o filenames 2>/dev/null
      if [[ -z $rest ]]; then
        COMPREPLY=($(compgen -f -- "$current"))
      else
        COMPREPLY=($(compgen -d -- "$current"))
        IFS=' '
        for word in $rest; do
          IFS=$'\n'
          COMPREPLY+=($(compgen -f -X "!*.$word" -- "$current"))
        done
      fi
      ;;
  esac
}

complete -F _@function@ @program@
)";

std::string bash_completion(const CommandLine& line, const std::string& function) {
  std::map<std::string, std::string> values;  // the patterns of what has the same value
  std::string options;
  std::vector<std::string> commands;
  for (const CommandTable& command : line.commands) {
    commands.push_back(command.name);
    options += "      " + command.name +
               ") value=" + shell_quoted("choice " + option_names(line, &command)) + " ;;\n";
    for (const Argument& argument : command.arguments) {
      if (argument.is_flag()) continue;
      std::string& patterns = values[in_bash(argument.value)];
      for (const std::string& name : argument.names)
        patterns += (patterns.empty() ? "" : " | ") + command.name + ":" +
                    (argument.is_option() ? name : "");
    }
  }
  std::string rows;
  for (const auto& [value, patterns] : values)
    rows += "    " + patterns + ")\n      echo " + shell_quoted(value) + "\n      ;;\n";
  return filled(std::string(bash_script), {{"@program@", line.program},
                                           {"@function@", function},
                                           {"@values@", rows},
                                           {"@options@", options},
                                           {"@global@", option_names(line, nullptr)},
                                           {"@commands@", join(commands, " ")}});
}

/// As a part of an argument of zsh's _arguments: what would end the part is escaped.
std::string in_zsh(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == ':' || c == '[' || c == ']' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

/// ":FILE:_files -g '*.toml'": how a value is named and completed.
std::string zsh_value(const Value& value, const std::string& name) {
  const std::string message = ":" + in_zsh(name) + ":";
  switch (value.kind) {
    case Value::Kind::choice:
      return message + "(" + join(value.choices, " ") + ")";
    case Value::Kind::folder:
      return message + "_files -/";
    case Value::Kind::file:
      return message + (value.endings.empty()
                            ? "_files"
                            : "_files -g \"*.(" + join(value.endings, "|") + ")(-.)\"");
    case Value::Kind::text:
      return message + " ";
    case Value::Kind::none:
      break;
  }
  return {};
}

/// The arguments of zsh's _arguments for one of ours, each on a line.
std::string zsh_arguments(const std::vector<const Argument*>& arguments) {
  std::string rows;
  for (const Argument* argument : arguments) {
    if (!argument->is_option()) {
      rows += " \\\n        " + shell_quoted("1" + zsh_value(argument->value, argument->name()));
      continue;
    }
    const std::string excluded = "(" + join(argument->names, " ") + ")";
    for (const std::string& name : argument->names) {
      const std::string value =
          argument->is_flag() ? "" : zsh_value(argument->value, argument->value.shown());
      const std::string glued = argument->is_flag() ? "" : name.starts_with("--") ? "=" : "+";
      rows += " \\\n        " +
              shell_quoted(excluded + name + glued + "[" + in_zsh(argument->text) + "]" + value);
    }
  }
  return rows;
}

constexpr std::string_view zsh_script = R"(#compdef @program@
# zsh completion of @program@, made by: @program@ completion zsh

_@program@() {
  local curcontext=$curcontext state
  local -a commands
  commands=(
@commands@  )
  _arguments -C@global@ \
        '1: :->command' '*:: :->arguments'
  case $state in
    command) _describe -t commands command commands ;;
    arguments)
      curcontext=${curcontext%:*}-$words[1]:
      case $words[1] in
@arguments@      esac
      ;;
  esac
}

if [[ $funcstack[1] == _@program@ ]]; then
  _@program@ "$@"
else
  compdef _@program@ @program@
fi
)";

std::string zsh_completion(const CommandLine& line) {
  std::string commands;
  std::string arguments;
  for (const CommandTable& command : line.commands) {
    commands += "    " + shell_quoted(in_zsh(command.name) + ":" + command.text) + "\n";
    arguments += "      " + command.name + ")\n        _arguments -s" +
                 zsh_arguments(line.arguments(&command)) + "\n        ;;\n";
  }
  return filled(std::string(zsh_script), {{"@program@", line.program},
                                          {"@commands@", commands},
                                          {"@global@", zsh_arguments(line.arguments(nullptr))},
                                          {"@arguments@", arguments}});
}

}  // namespace

std::string name(Shell shell) { return shell == Shell::bash ? "bash" : "zsh"; }

std::string completion_script(const CommandLine& line, Shell shell) {
  std::string function = line.program;  // a name of POSIX: without dashes
  for (char& c : function)
    if (c == '-') c = '_';
  return shell == Shell::bash ? bash_completion(line, function) : zsh_completion(line);
}

}  // namespace tactile_net::tool
