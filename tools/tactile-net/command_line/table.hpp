/// @file
/// The command line as data: what the parser takes is what help, the man page and the shells'
/// completions are made from.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tactile_net::tool {

/// What an argument's value is: help names it, shells complete it.
struct Value {
  enum class Kind { none, text, file, folder, choice };
  Kind kind = Kind::none;
  std::string name{};                  ///< "FILE"
  std::vector<std::string> endings{};  ///< of files: "toml"; empty: any
  std::vector<std::string> choices{};
  bool is_output = false;  ///< a file that the command writes, and must not read
  /// An output that is written to standard output where neither it nor a folder is given.
  bool is_standard_output = false;

  /// "FILE", "{float64,float32}"; empty for a flag.
  [[nodiscard]] std::string shown() const;
};

struct Argument {
  /// "-o", "--output"; of an argument without a dash its one name, "SCENE". Messages say the last.
  std::vector<std::string> names{};
  Value value{};
  std::string text{};      ///< what it is, in ASCII
  std::string standard{};  ///< what holds where it is absent; empty: nothing, or the text says so
  bool required = false;
  bool many = false;  ///< known by its place, and there may be several: `set` is called for each
  /// Takes the value; of a flag "". @throw WrongUsage  it cannot be this
  std::function<void(const std::string&)> set{};

  [[nodiscard]] const std::string& name() const { return names.back(); }
  [[nodiscard]] bool is_option() const { return name().starts_with('-'); }
  [[nodiscard]] bool is_flag() const { return value.kind == Value::Kind::none; }
  /// Of a file or a folder.
  [[nodiscard]] bool is_place() const {
    return value.kind == Value::Kind::file || value.kind == Value::Kind::folder;
  }
};

struct Example {
  std::string line{};  ///< without the program's name: "run pad.toml --out out"
  std::string text{};  ///< what it is for
};

struct CommandTable {
  std::string name{};
  std::string text{};                 ///< what it does, without a full stop
  std::vector<std::string> pages{};   ///< of docs/ that say more
  std::vector<Example> examples{};    ///< two or three
  std::vector<Argument> arguments{};  ///< in the order of help
  std::function<void()> chosen = {};  ///< called when all its arguments are set
};

/// A part of help and of the man page.
struct Section {
  std::string heading{};  ///< "exit status"
  std::string text{};
};

struct CommandLine {
  std::string program{};
  std::string text{};     ///< what it is for, without a full stop
  std::string version{};  ///< what --version prints
  std::vector<CommandTable> commands{};
  Argument help{};     ///< of the program and of every command
  Argument release{};  ///< --version, of the program alone
  Argument quiet{};    ///< of the program and of every command
  std::vector<Section> sections{};

  /// Null: there is no such command.
  [[nodiscard]] const CommandTable* find(std::string_view command) const;
  /// What can stand behind a command's name; null: behind the program's.
  [[nodiscard]] std::vector<const Argument*> arguments(const CommandTable* command) const;
  /// "run [OPTIONS] SCENE"
  [[nodiscard]] static std::string usage(const CommandTable& command);
};

}  // namespace tactile_net::tool
