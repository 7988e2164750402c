// What the command says of itself: help, the manual page, completion, suggestions.
#include "tools/tactile-net/command_line/help.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <sstream>

#include "tactile_net/simulator/child_process.hpp"
#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"
#include "tools/tactile-net/command_line/completion.hpp"
#include "tools/tactile-net/command_line/man_page.hpp"
#include "tools/tactile-net/option_words.hpp"
#include "tools/tactile-net/options.hpp"

using namespace tactile_net;
namespace fs = std::filesystem;

namespace {

const tool::CommandLine& line() { return tool::command_line(); }

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

void usage_refused(const std::vector<std::string>& arguments, const std::string& message) {
  const ProcessResult result = test::run_in_process(arguments, "");
  CAPTURE(arguments, result.errors);
  CHECK(result.code == 2);
  CHECK(result.output.empty());
  CHECK_THAT(result.errors, ContainsSubstring(message));
}

/// Of a program that may not be there.
bool is_installed(const std::string& program) {
  return run_process({"sh", "-c", "command -v " + program}, {}).code == 0;
}

}  // namespace

TEST_CASE("an option that there is not is named, with the one that was meant", "[cli]") {
  usage_refused({"run", "--jsno", "x", "S"}, "run has no option '--jsno'; did you mean '--json'?");
  usage_refused({"run", "--jsno=x", "S"}, "run has no option '--jsno'; did you mean '--json'?");
  usage_refused({"run", "-json", "-", "S"}, "run has no option '-json'; did you mean '--json'?");
  usage_refused({"solve", "S", "--reading", "x"},
                "solve has no option '--reading'; did you mean '--readings'?");
  usage_refused({"--versoin"}, "tactile-net has no option '--versoin'; did you mean '--version'?");
  usage_refused({"gen", "S", "--quite"}, "did you mean '--quiet'?");
  usage_refused({"run", "S", "--zzzzzz"},
                "run has no option '--zzzzzz'\nhint: tactile-net help run\n");
  usage_refused({"run", "S", "---"}, "run has no option '---'");
  usage_refused({"solve", "S", "--columns", "-3", "--jsno"},
                "no option '--jsno'");  // -3 is a value
  usage_refused({"run", "S", "--", "--jsno"}, "not expected: --jsno");
}

TEST_CASE("a value that there is not is told with those that there are", "[cli]") {
  usage_refused(
      {"gen", "S", "--realization", "crosbar"},
      "--realization: 'crosbar' is none of ideal, nic, rail, crossbar, least_squares, lattice, lc, "
      "ndr; "
      "did you mean 'crossbar'?");
  usage_refused({"plan", "S", "--precision", "float16"}, "'float16' is none of float64, float32");
  usage_refused({"run", "S", "--frame", "-1"}, "'-1' is not a whole number");
  usage_refused({"relax", "S", "--tolerance", "1,5"}, "'1,5' is not a number");
  usage_refused({"help", "slove"}, "did you mean 'solve'?");
  usage_refused({"schema", "chekc"}, "did you mean 'check'?");
  usage_refused({"help", "solve", "--man"}, "--man: is one page of all commands");
}

TEST_CASE("a value stands behind its option or is glued to it", "[cli]") {
  using Words = std::vector<std::string>;
  for (const Words& output :
       {Words{"-o", "d.cir"}, Words{"-od.cir"}, Words{"-o=d.cir"}, Words{"--output", "d.cir"},
        Words{"--output=d.cir"}, Words{"-qo", "d.cir"}, Words{"-qqod.cir"}}) {
    for (const bool before : {true, false}) {
      Words words = {"gen"};
      if (!before) words.emplace_back("S");
      words.insert(words.end(), output.begin(), output.end());
      if (before) words.emplace_back("S");
      CAPTURE(words);
      const tool::Invocation parsed = tool::parse(words);
      const auto& options = std::get<tool::GenOptions>(parsed.command);
      CHECK(options.scene == "S");
      CHECK(options.output == "d.cir");
      CHECK(parsed.quiet == output.front().starts_with("-q"));
    }
  }
  const auto gen = [](const Words& words) {
    return std::get<tool::GenOptions>(tool::parse(words).command);
  };
  CHECK(gen({"gen", "--", "-q"}).scene == "-q");
  CHECK(gen({"gen", "S", "--output=--json"}).output == "--json");
  CHECK(gen({"gen", "S", "--output=a=b"}).output == "a=b");
  CHECK(gen({"gen", "-", "-o", "-"}).output == "-");
  CHECK(gen({"gen", "-5"}).scene == "-5");
  CHECK(tool::parse(Words{"-q", "gen", "S"}).quiet);
  CHECK(tool::parse(Words{"-q", "gen", "S", "--quiet", "-q"}).quiet);
  CHECK_FALSE(tool::parse(Words{"gen", "S"}).quiet);
  CHECK(std::get<tool::MergeOptions>(tool::parse(Words{"merge", "a", "--force", "b", "c"}).command)
            .files == Words{"a", "b", "c"});
}

TEST_CASE("no command takes an empty name of a file or a folder", "[cli]") {
  std::size_t places = 0;
  for (const tool::CommandTable& command : line().commands)
    for (const tool::Argument& argument : command.arguments) {
      if (!argument.is_place()) continue;
      if (!argument.is_option() && &argument != &command.arguments.front()) continue;
      ++places;
      std::vector<std::string> words{command.name};
      if (argument.is_option()) words.push_back(argument.name());
      words.emplace_back();
      usage_refused(words, argument.name() + ": " + argument.value.shown() + " is an empty name");
    }
  CHECK(places > 40);
  usage_refused({"certify", "S", "--out="}, "--out: FOLDER is an empty name; give one, or leave");
}

TEST_CASE("what is missing, given twice or too much is named", "[cli]") {
  usage_refused({"gen", "S", "-o"}, "--output: FILE is missing");
  usage_refused({"plan", "S", "--json", "--precision", "float32"},
                "--json: FILE is missing before '--precision'; where that is meant, write "
                "--json=--precision");
  usage_refused({"gen", "S", "-o", "-q"}, "--output: FILE is missing before '-q'");
  usage_refused({"gen", "S", "-o", "a", "--output", "b"}, "--output: is given twice");
  usage_refused({"run", "S", "--force=no"}, "--force: takes no value, and 'no' is given");
  usage_refused({"gen", "S", "-output", "x"}, "no option '-output'; did you mean '--output'?");
  usage_refused({"gen", "S", "-qx"}, "gen has no option '-x'");
  usage_refused({"run", "S", "T"},
                "argument not expected: T (usage: tactile-net run [OPTIONS] SCENE)");
  usage_refused({"solve", "S"}, "--readings is required");
  usage_refused({"merge"}, "FILE is required");
  usage_refused({"--", "run", "S"}, "tactile-net has no option '--'");
  usage_refused({"--json", "run", "S"}, "tactile-net has no option '--json'");
  usage_refused({""}, "there is no command ''");
}

TEST_CASE("help keeps to the width, and to whole words", "[cli]") {
  std::vector<const tool::CommandTable*> commands{nullptr};
  for (const tool::CommandTable& command : line().commands) commands.push_back(&command);
  for (const tool::CommandTable* command : commands) {
    CAPTURE(command == nullptr ? "" : command->name);
    std::string whole = help_text(line(), command, {.width = 10'000});
    for (const std::size_t width : {40U, 41U, 59U, 60U, 80U, 100U}) {
      CAPTURE(width);
      std::string text = help_text(line(), command, {.width = width});
      std::size_t longest = 0;
      for (const std::string& one : lines_of(text)) longest = std::max(longest, one.size());
      CHECK(longest <= width);
      CHECK(longest > width - 15);
      // The same words. A list in braces may go on in the next line, and an example behind "\".
      std::string joined;
      std::string last;
      for (const std::string& word : words_of(text)) {
        if (word == "\\") continue;
        const bool in_list = last.rfind('{') != std::string::npos && last.ends_with(',');
        if (!in_list) joined += last + ' ', last.clear();
        last += word;
      }
      CHECK(words_of(joined + last) == words_of(whole));
    }
  }
}

TEST_CASE("bold is a matter of style alone", "[cli]") {
  const tool::CommandTable* const run = line().find("run");
  std::string bold = help_text(line(), run, {.bold = true});
  CHECK_THAT(bold, ContainsSubstring("\033[1moptions\033[0m:\n  \033[1m--out\033[0m FOLDER"));
  for (const std::string code : {"\033[1m", "\033[0m"})
    for (std::size_t at = 0; (at = bold.find(code)) != std::string::npos;)
      bold.erase(at, code.size());
  CHECK(bold == help_text(line(), run, {}));
}

TEST_CASE("help names what values are, and what holds without them", "[cli]") {
  const std::string solve = test::run_in_process({"help", "solve"}, "").output;
  for (const char* text :
       {"usage: tactile-net solve [OPTIONS] SCENE --readings FILE\n", "--out FOLDER",
        "--columns LIST", "--method {dft,tikhonov,closed_form}", "(default: tikhonov)",
        "(default: fail)", "[unit of E]", "-o, --output FILE", "docs/results.md"})
    CHECK_THAT(solve, ContainsSubstring(text));
  CHECK(solve.find("[Pa]") == std::string::npos);
  CHECK_THAT(test::run_in_process({"help", "plan"}, "").output, ContainsSubstring("(default: 1e-"));
  CHECK(test::run_in_process({"solve", "--help"}, "").output == solve);
  CHECK(test::run_in_process({"solve", "-h", "--method", "dft"}, "").output == solve);
  CHECK(test::run_in_process({"help"}, "").output == test::run_in_process({"--help"}, "").output);
  CHECK(test::run_in_process({"-V"}, "").output == test::run_in_process({"--version"}, "").output);
}

TEST_CASE("every command has its pages and examples that it takes", "[cli]") {
  for (const tool::CommandTable& command : line().commands) {
    CAPTURE(command.name);
    CHECK(command.examples.size() >= 2);
    CHECK(command.examples.size() <= 3);
    CHECK_FALSE(command.pages.empty());
    for (const std::string& page : command.pages)
      CHECK(fs::exists(fs::path(SCENES "/../docs") / page));
    for (const tool::Example& example : command.examples) {
      CAPTURE(example.line);
      std::vector<std::string> words = words_of(example.line);
      CHECK(words.front() == command.name);
      for (const std::string& word : words)
        if (word.starts_with("scenes/")) CHECK(fs::exists(fs::path(SCENES "/..") / word));
      words.erase(std::find(words.begin(), words.end(), ">"), words.end());
      CHECK_NOTHROW(tool::parse(words));
    }
  }
}

TEST_CASE("texts are what a page of ASCII can hold", "[cli]") {
  const std::string page = man_page(line());
  CHECK(std::all_of(page.begin(), page.end(),
                    [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
}

TEST_CASE("the manual page has every command and option, and no fault", "[cli]") {
  const ProcessResult made = test::run_in_process({"help", "--man"}, "");
  CHECK(made.code == 0);
  for (const tool::CommandTable& command : line().commands) {
    CHECK_THAT(made.output, ContainsSubstring(".SS \"" + command.name + " "));
    for (const tool::Argument& argument : command.arguments) {
      std::string name = argument.name();
      for (std::size_t at = 0; (at = name.find('-', at)) != std::string::npos; at += 2)
        name.insert(at, "\\");
      CHECK_THAT(made.output, ContainsSubstring(name + "\\fR"));
    }
  }
  const std::vector<const char*> requests = {".TH ", ".SH ", ".SS ", ".TP", ".PP",
                                             ".nf",  ".fi",  ".RS",  ".RE", ".\\\""};
  for (const std::string& one : lines_of(made.output)) {
    CAPTURE(one);
    const bool known = !one.starts_with('.') ||
                       std::any_of(requests.begin(), requests.end(),
                                   [&](const char* request) { return one.starts_with(request); });
    CHECK(known);
  }
  const Folder folder;
  const std::string page = folder.write("tactile-net.1", made.output);
  if (is_installed("groff")) {
    const ProcessResult set = run_process({"groff", "-man", "-ww", "-Tascii", "-P-cbou", page}, {});
    CHECK(set.code == 0);
    CHECK(set.errors.empty());
    CHECK_THAT(set.output, ContainsSubstring("NO_COLOR"));
  }
  if (is_installed("mandoc"))
    CHECK(run_process({"mandoc", "-Tlint", "-W", "error", page}, {}).output.empty());
}

TEST_CASE("bash completes what the parser takes", "[cli]") {
  const Folder folder;
  const std::string script =
      folder.write("completion", test::run_in_process({"completion", "bash"}, "").output);
  for (const char* name : {"pad.toml", "my pad.toml", "deck.cir", "frames.csv", "notes.txt"})
    folder.write(name, "");
  fs::create_directory(folder.path() / "out");
  const auto offered = [&](std::vector<std::string> words) {
    std::vector<std::string> command = {
        "bash",
        "--norc",
        "-c",
        "cd '" + folder.path().string() + "' && exec bash '" TESTS "/drive_completion.bash' \"$@\"",
        "drive",
        script,
        "tactile-net"};
    command.insert(command.end(), words.begin(), words.end());
    const ProcessResult result = run_process(command, {});
    CAPTURE(words);
    CHECK(result.errors.empty());
    std::vector<std::string> lines = lines_of(result.output);
    std::sort(lines.begin(), lines.end());
    return lines;
  };
  using Lines = std::vector<std::string>;

  std::vector<std::string> commands;
  for (const tool::CommandTable& command : line().commands) commands.push_back(command.name);
  std::sort(commands.begin(), commands.end());
  CHECK(offered({""}) == commands);
  CHECK(offered({"help", ""}) == commands);
  for (const tool::CommandTable& command : line().commands) {
    Lines options;
    for (const tool::Argument* argument : line().arguments(&command))
      if (argument->is_option())
        options.insert(options.end(), argument->names.begin(), argument->names.end());
    std::sort(options.begin(), options.end());
    CHECK(offered({command.name, "-"}) == options);
  }
  CHECK(offered({"ru"}) == Lines{"run"});
  CHECK(offered({"-q", "ru"}) == Lines{"run"});
  CHECK(offered({"run", "--rea"}) == Lines{"--realization"});
  CHECK(offered({"run", "--realization", "l"}) == Lines{"lattice", "lc", "least_squares"});
  CHECK(offered({"run", "--realization", "=", "cr"}) ==
        Lines{"crossbar"});  // as bash takes it apart
  CHECK(offered({"plan", "--precision", "="}) == Lines{"float32", "float64"});
  CHECK(offered({"run", ""}) == Lines{"my pad.toml", "out", "pad.toml"});
  CHECK(offered({"relax", "d"}) == Lines{"deck.cir"});
  CHECK(offered({"solve", "pad.toml", "--readings", "f"}) == Lines{"frames.csv"});
  CHECK(offered({"solve", "pad.toml", ""}).empty());  // it takes one scene
  CHECK(offered({"solve", "--out", ""}) == Lines{"out"});
  CHECK(offered({"run", "--frame", ""}).empty());
  CHECK(offered({"completion", ""}) == Lines{"bash", "zsh"});
}

TEST_CASE("what messages advise to ask for is an option that the command has", "[cli]") {
  std::set<std::string> options;
  for (const tool::CommandTable& command : line().commands)
    for (const tool::Argument& argument : command.arguments) options.insert(argument.name());
  for (int i = 0; i <= static_cast<int>(Option::time_limit); ++i) {
    const std::string spelled = tool::spelled(static_cast<Option>(i), "");
    CAPTURE(spelled);
    CHECK(options.contains(spelled));
  }
  CHECK(tool::spelled(Option::no_diagnostics, "") == "--no-diagnostics");
  CHECK(tool::spelled(Option::columns, "2-42") == "--columns 2-42");
}

TEST_CASE("zsh understands its script", "[cli]") {
  const std::string text = test::run_in_process({"completion", "zsh"}, "").output;
  CHECK_THAT(text, StartsWith("#compdef tactile-net\n"));
  for (const tool::CommandTable& command : line().commands)
    for (const tool::Argument& argument : command.arguments)
      for (const std::string& choice : argument.value.choices)
        CHECK_THAT(text, ContainsSubstring(choice));
  if (!is_installed("zsh")) {
    WARN("zsh is not installed: tools/install-dependencies zsh");
    return;
  }
  const Folder folder;
  const std::string script = folder.write("_tactile-net", text);
  CHECK(run_process({"zsh", "-f", "-n", script}, {}).errors.empty());
  // What it hands to zsh's own functions, for a command that is being typed.
  const std::string drive =
      "_arguments() { print -rl -- \"$@\"; state=arguments; }; compdef() { :; }; source '" +
      script + "'; words=(run ''); _tactile-net";
  const ProcessResult result = run_process({"zsh", "-f", "-c", drive}, {});
  CHECK(result.errors.empty());
  CHECK_THAT(result.output,
             ContainsSubstring("(--realization)--realization=[How to build the circuit") &&
                 ContainsSubstring(":(ideal nic rail crossbar least_squares lattice lc ndr)") &&
                 ContainsSubstring("1:SCENE:_files -g \"*.(toml)(-.)\"") &&
                 ContainsSubstring("(--out)--out=[Folder") &&
                 ContainsSubstring(":FOLDER:_files -/"));
}
