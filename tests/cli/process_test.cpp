// What only a process has: its own standard streams, and an environment.
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

/// The program with pipes at both ends.
class Piped {
 public:
  explicit Piped(const std::vector<std::string>& arguments) {
    std::array<int, 2> to{};
    std::array<int, 2> from{};
    if (::pipe(to.data()) != 0 || ::pipe(from.data()) != 0) std::abort();
    std::vector<char*> argv{const_cast<char*>(TOOL)};
    for (const std::string& argument : arguments)
      argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    child_ = ::fork();
    if (child_ == 0) {
      ::dup2(to[0], STDIN_FILENO);
      ::dup2(from[1], STDOUT_FILENO);
      for (const int end : {to[0], to[1], from[0], from[1]}) ::close(end);
      ::execv(TOOL, argv.data());
      ::_exit(127);
    }
    ::close(to[0]);
    ::close(from[1]);
    in_ = to[1];
    out_ = from[0];
  }
  ~Piped() { ::close(out_); }
  Piped(const Piped&) = delete;
  Piped& operator=(const Piped&) = delete;

  void write(const std::string& text) const {
    REQUIRE(::write(in_, text.data(), text.size()) == std::ssize(text));
  }
  /// Waits for a whole line.
  [[nodiscard]] std::string line() const {
    std::string text;
    for (char c = 0; ::read(out_, &c, 1) == 1 && c != '\n';) text += c;
    return text;
  }
  /// Closes its input; its exit status.
  [[nodiscard]] int end() const {
    ::close(in_);
    int status = 0;
    ::waitpid(child_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t child_ = -1;
  int in_ = -1;
  int out_ = -1;
};

}  // namespace

TEST_CASE("the program does what its function does", "[cli]") {
  ::unsetenv("COLUMNS");  // help is as wide as it says
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  const std::vector<std::vector<std::string>> commands = {
      {},
      {"--version"},
      {"--help"},
      {"solve", "--help"},
      {"rnu"},
      {"run", "none"},
      {"simulate", path},
      {"gen", path, "-o", folder / "none/x.cir"},
      {"relax", path, "--ngspice", "no-such-ngspice"}};
  for (const std::vector<std::string>& arguments : commands) {
    CAPTURE(arguments);
    const ProcessResult here = run_tool(arguments);
    const ProcessResult there = program(arguments);
    CHECK(there.end == ProcessResult::End::exited);
    CHECK(there.code == here.code);
    CHECK(there.output == here.output);
    CHECK(there.errors == here.errors);
  }
}

TEST_CASE("each frame is answered before the next one comes", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  const Piped solve({"solve", path, "--readings", "-"});
  solve.write("t,stress_x_0,stress_x_1,stress_x_2\n0.5,1,2,3\n");
  CHECK(solve.line() == "t,normal_0,normal_1,normal_2");
  CHECK_THAT(solve.line(), StartsWith("0.5,"));
  solve.write("0.6,3,2,1\n");
  CHECK_THAT(solve.line(), StartsWith("0.6,"));
  CHECK(solve.end() == 0);
}

TEST_CASE("output that is lost is a failure", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  const ProcessResult lost = run_process({"sh", "-c", TOOL " run '" + path + "' > /dev/full"});
  CHECK(lost.code == 1);
  CHECK_THAT(lost.errors, ContainsSubstring("standard output could not be written"));
}

TEST_CASE("a report's figures need no other program", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  const ProcessResult result =
      run_process({"env", "PATH=/nowhere", TOOL, "run", path, "--out", folder / "out"});
  CHECK(result.code == 0);
  CHECK_THAT(result.errors, !ContainsSubstring("install"));
  CHECK_THAT(read_text(folder / "out/report.html"), ContainsSubstring("class=\"chart\""));
}

TEST_CASE("a simulator that lies is caught, and its deck kept", "[cli]") {
  const Folder folder;
  const std::string fake = folder.write("fake", "#!/bin/sh\nexit 0\n");
  std::filesystem::permissions(fake, std::filesystem::perms::owner_all);
  const ProcessResult result = run_process({"env", "TMPDIR=" + folder.path().string(), TOOL,
                                            "relax", scene("nic.toml"), "--ngspice", fake});
  CHECK(result.code == 1);
  CHECK_THAT(result.errors,
             ContainsSubstring("without a usable answer") && ContainsSubstring("deck.cir"));
}
