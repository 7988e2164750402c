// The command and who sits before it: what a terminal shows, what comes by standard input, what
// stands already where results go.
#if __has_include(<pty.h>)
#include <pty.h>
#else
#include <util.h>
#endif
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

/// What the program writes on a terminal of so many columns.
std::string on_terminal(unsigned short columns, const std::vector<std::string>& arguments) {
  winsize size{.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
  int master = -1;
  const pid_t child = ::forkpty(&master, nullptr, nullptr, &size);
  if (child == 0) {
    std::vector<char*> argv{const_cast<char*>(TOOL)};
    for (const std::string& argument : arguments)
      argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    ::execv(TOOL, argv.data());
    ::_exit(127);
  }
  REQUIRE(child > 0);
  std::string text;
  char block[4096];
  for (ssize_t count = 0; (count = ::read(master, block, sizeof block)) > 0;)
    text.append(block, static_cast<std::size_t>(count));
  ::close(master);
  ::waitpid(child, nullptr, 0);
  return text;
}

/// Of what is seen: without the characters that make it bold.
std::size_t widest_line(std::string text) {
  for (std::size_t at = 0; (at = text.find('\033')) != std::string::npos;)
    text.erase(at, text.find('m', at) - at + 1);
  std::istringstream lines(text);
  std::size_t widest = 0;
  for (std::string line; std::getline(lines, line);)
    widest = std::max(widest, line.find_last_not_of('\r') + 1);
  return widest;
}

const std::string loaded_scene = small_scene + cylinder_load;

}  // namespace

TEST_CASE("help is as wide as the terminal, and bold on one alone", "[cli]") {
  ::setenv("TERM", "xterm", 1);
  ::unsetenv("NO_COLOR");
  ::setenv("COLUMNS", "70", 1);  // a terminal's own width counts
  const std::string on_50 = on_terminal(50, {"run", "--help"});
  CHECK(widest_line(on_50) <= 50);
  CHECK(widest_line(on_50) > 40);
  CHECK_THAT(on_50, ContainsSubstring("\033[1moptions\033[0m"));
  CHECK(widest_line(on_terminal(20, {"help", "run"})) > 30);     // narrower is not read
  CHECK(widest_line(on_terminal(300, {"help", "run"})) <= 100);  // nor wider

  ::setenv("NO_COLOR", "1", 1);
  CHECK(on_terminal(80, {"help", "run"}).find('\033') == std::string::npos);
  ::unsetenv("NO_COLOR");
  ::setenv("TERM", "dumb", 1);
  CHECK(on_terminal(80, {"help", "run"}).find('\033') == std::string::npos);

  const std::string piped = program({"run", "--help"}).output;
  CHECK(piped.find('\033') == std::string::npos);
  CHECK(widest_line(piped) <= 70);
  CHECK(widest_line(piped) > 60);
  ::setenv("COLUMNS", "wide", 1);
  CHECK(program({"run", "--help"}).output == run_tool({"run", "--help"}).output);
  ::unsetenv("COLUMNS");
}

TEST_CASE("quiet leaves errors alone", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene + "nonnegative = true\n");
  const std::vector<std::string> loud = {"plan", path};
  REQUIRE_THAT(run_tool(loud).errors, ContainsSubstring("warning: a plan is linear"));
  for (const auto& arguments : std::vector<std::vector<std::string>>{{"-q", "plan", path},
                                                                     {"--quiet", "plan", path},
                                                                     {"plan", path, "--quiet"},
                                                                     {"plan", "-q", path}}) {
    const ProcessResult result = run_tool(arguments);
    CHECK(result.code == 0);
    CHECK(result.errors.empty());
    CHECK_THAT(result.output, ContainsSubstring("bytes"));
  }
  const ProcessResult bad = run_tool({"solve", path, "--readings", "-", "-q"},
                                     "stress_x_0,stress_x_1,stress_x_2\n1,x,3\n");
  CHECK(bad.code == 2);
  CHECK_THAT(bad.errors, ContainsSubstring("<stdin>:2:3: error: 'x'"));
  CHECK_THAT(run_tool({"rnu", "-q"}).errors, ContainsSubstring("did you mean 'run'?"));
}

TEST_CASE("a scene may come from standard input", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", loaded_scene);
  const auto same = [&](std::vector<std::string> arguments) {
    CAPTURE(arguments);
    const ProcessResult by_name = run_tool(arguments);
    REQUIRE(by_name.code == 0);
    for (const char* name : {"-", "/dev/stdin"}) {
      arguments[1] = name;
      const ProcessResult piped = run_tool(arguments, loaded_scene);
      CHECK(piped.code == 0);
      std::string output = piped.output;
      for (std::size_t at = 0; (at = output.find("<stdin>", at)) != std::string::npos;)
        output.replace(at, 7, "s.toml");
      CHECK(output == by_name.output);
    }
  };
  same({"gen", path});
  same({"certify", path, "--json", "-"});
  same({"identify", path, "--json", "-"});
  same({"simulate", path});
  same({"run", path, "--explain"});
  const std::string readings = folder.write("g.csv", run_tool({"simulate", path}).output);
  same({"solve", path, "--readings", readings});
  CHECK_THAT(run_tool({"run", "-", "--json", "-"}, loaded_scene).output,
             ContainsSubstring("\"scene\": \"<stdin>\""));
  CHECK(run_tool({"relax", "-"}, loaded_scene).code == 0);

  const ProcessResult bad = run_tool({"run", "-"}, "[sensor]\ncuont = 3\n");
  CHECK(bad.code == 2);
  CHECK_THAT(bad.errors,
             ContainsSubstring("<stdin>:2:1: error: unknown key") && ContainsSubstring("count?"));
  CHECK_THAT(run_tool({"run", "-"}, "").errors,
             ContainsSubstring("<stdin>: error: the scene is empty"));
  CHECK_THAT(run_tool({"run", "-"}, "#" + std::string(17u << 20, ' ')).errors,
             ContainsSubstring("<stdin>: error: is larger than 16 MiB"));
}

TEST_CASE("the program reads its scene from a pipe", "[cli]") {
  CHECK(program({"gen", "-"}, loaded_scene).output == run_tool({"gen", "-"}, loaded_scene).output);
  CHECK(program({"gen", "/dev/stdin"}, loaded_scene).code == 0);
}

TEST_CASE("standard input holds a scene or readings, not both", "[cli]") {
  for (const char* command : {"solve", "plan"})
    for (const char* readings : {"-", "/dev/stdin"}) {
      const ProcessResult result = run_tool({command, "-", "--readings", readings}, loaded_scene);
      CHECK(result.code == 2);
      CHECK_THAT(result.errors, ContainsSubstring("standard input is the scene already"));
    }
}

TEST_CASE("a hand from standard input names files from the current folder", "[cli]") {
  const std::string hand = read_text(scene("hands/two-fingers.toml"));
  const ProcessResult by_name = run_tool({"grasp", scene("hands/two-fingers.toml"), "--json", "-"});
  ProcessResult piped = run_tool({"grasp", "-", "--json", "-"}, hand);
  REQUIRE(piped.code == 0);
  piped.output.replace(piped.output.find("<stdin>"), 7, "two-fingers.toml");
  CHECK(piped.output == by_name.output);
  const ProcessResult recorded = run_process(
      {"sh", "-c", "cd '" SCENES "/recorded' && exec \"$0\" grasp - < hand.toml", TOOL}, {});
  CHECK(recorded.code == 0);
}

TEST_CASE("a frame is asked of a scene over time", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", loaded_scene);
  CHECK(run_tool({"run", path, "--frame", "0"}).code == 0);
  const ProcessResult result = run_tool({"run", path, "--frame", "3"});
  CHECK(result.code == 2);
  CHECK_THAT(result.errors,
             ContainsSubstring("no frame 3: the scene has no [time], and so frame 0 alone"));
}

TEST_CASE("somebody's own report is not replaced", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", loaded_scene);
  const std::string readings = folder.write("g.csv", run_tool({"simulate", path}).output);
  const std::vector<std::vector<std::string>> commands = {
      {"run", path},
      {"identify", path},
      {"certify", path},
      {"tradeoff", path, "--digital"},
      {"solve", path, "--readings", readings},
      {"grasp", scene("hands/two-fingers.toml")}};
  for (std::vector<std::string> command : commands) {
    CAPTURE(command);
    std::filesystem::remove_all(folder / "out");
    std::filesystem::create_directory(folder / "out");
    folder.write("out/report.html", "<!DOCTYPE html>\nmine");
    command.insert(command.end(), {"--out", folder / "out"});
    const ProcessResult refused = run_tool(command);
    CHECK(refused.code == 2);
    CHECK_THAT(refused.errors,
               ContainsSubstring("out/report.html: error: was not written by tactile-net"));
    CHECK(read_text(folder / "out/report.html") == "<!DOCTYPE html>\nmine");
    CHECK(std::distance(std::filesystem::directory_iterator(folder / "out"), {}) == 1);

    command.emplace_back("--force");
    CHECK(run_tool(command).code == 0);
    command.pop_back();
    CHECK(run_tool(command).code == 0);  // it is ours now
  }
}

TEST_CASE("a file of one's own that a result would replace stays", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", loaded_scene);
  std::filesystem::create_directory(folder / "data");
  folder.write("data/readings.csv", "a day's work");
  const std::vector<std::string> command = {"run", path, "--out", folder / "data"};
  const ProcessResult refused = run_tool(command);
  CHECK(refused.code == 2);
  CHECK_THAT(refused.errors, ContainsSubstring("data/readings.csv: error: is there already") &&
                                 ContainsSubstring("--force"));
  CHECK(read_text(folder / "data/readings.csv") == "a day's work");
  CHECK(std::distance(std::filesystem::directory_iterator(folder / "data"), {}) == 1);

  std::filesystem::rename(folder / "data/readings.csv", folder / "data/mine.csv");
  CHECK(run_tool(command).code == 0);
  CHECK(run_tool(command).code == 0);
}
