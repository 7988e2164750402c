// Real signals to real processes: the command ends, and nothing of it stays.
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;
namespace fs = std::filesystem;

namespace {

/// A simulator that writes its process id beside itself and never ends, as one process.
std::string endless(const Folder& folder) {
  const std::string fake = folder.write(
      "fake",
      "#!/bin/sh\necho x > result.raw\necho $$ > pid.new\nmv pid.new pid\nexec sleep 300\n");
  fs::permissions(fake, fs::perms::owner_all);
  return fake;
}

bool is_running(long process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string state;
  file >> state >> state >> state;
  return file && state != "Z" && state != "X";
}

/// Waits for it, ten seconds at most.
bool comes_true(const auto& condition) {
  for (int i = 0; i < 10'000 && !condition(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return condition();
}

/// The program in the background, its temporary files in `tmp` of the folder.
class Started {
 public:
  Started(const Folder& folder, std::vector<std::string> arguments, const std::string& feed = {}) {
    fs::create_directories(folder.path() / "tmp");
    tmp_ = folder / "tmp";
    arguments.insert(arguments.begin(), TOOL);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    child_ = ::fork();
    REQUIRE(child_ >= 0);
    if (child_ == 0) {
      ::setpgid(0, 0);
      ::setenv("TMPDIR", tmp_.c_str(), 1);
      const auto redirect = [](const std::string& path, int flags, int stream) {
        const int file = ::open(path.c_str(), flags, 0600);
        if (file < 0 || ::dup2(file, stream) < 0) ::_exit(126);
      };
      if (!feed.empty()) redirect(feed, O_RDONLY, STDIN_FILENO);
      redirect(folder / "stderr", O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
      redirect("/dev/null", O_WRONLY, STDOUT_FILENO);
      ::execv(TOOL, argv.data());
      ::_exit(127);
    }
  }
  ~Started() {
    ::kill(child_, SIGKILL);
    if (!waited_) ::waitpid(child_, nullptr, 0);
  }
  Started(const Started&) = delete;
  Started& operator=(const Started&) = delete;

  /// The process id of the simulator that it has started.
  [[nodiscard]] long simulator() const {
    long pid = 0;
    comes_true([&] {
      std::error_code ignored;
      for (fs::recursive_directory_iterator entry(tmp_, ignored), end; entry != end;
           entry.increment(ignored))
        if (entry->path().filename() == "pid") std::ifstream(entry->path()) >> pid;
      return pid != 0;
    });
    return pid;
  }
  void send(int signal) const { ::kill(child_, signal); }
  /// The signal that ended it; 0: it exited.
  [[nodiscard]] int ended_by() {
    int status = 0;
    ::waitpid(child_, &status, 0);
    waited_ = true;
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }
  [[nodiscard]] bool left_nothing() const { return fs::is_empty(tmp_); }

 private:
  pid_t child_ = -1;
  bool waited_ = false;
  std::string tmp_;
};

/// Names in a folder that a half-written output has.
std::vector<std::string> partial_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().string().find("partial") != std::string::npos ||
        entry.path().string().find(".lock") != std::string::npos)
      names.push_back(entry.path().filename().string());
  return names;
}

const std::string circuit_scene =
    "[sensor]\ncount = 7\npitch = 0.5\ndepth = 1.5\nreads = [\"strain_x\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 1.0\n"
    "[reconstruct]\nmethods = [\"network\"]\nalpha = 1e-3\nsmoothing_length = 1.0\n[network]\n";

}  // namespace

TEST_CASE("a signal ends the simulator with the command, in every command that runs it",
          "[cli][left-behind]") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    for (const std::string command : {"run", "relax"}) {
      CAPTURE(signal, command);
      const Folder folder;
      const std::string fake = endless(folder);
      std::vector<std::string> arguments = {command, folder.write("s.toml", circuit_scene),
                                            "--ngspice", fake};
      if (command == "run") arguments.insert(arguments.end(), {"--out", folder / "out"});
      Started started(folder, arguments);
      const long simulator = started.simulator();
      REQUIRE(simulator > 0);
      CHECK(is_running(simulator));
      started.send(signal);
      CHECK(started.ended_by() == signal);
      CHECK(comes_true([&] { return !is_running(simulator); }));
      CHECK(started.left_nothing());
      CHECK(partial_in(folder.path()).empty());
      CHECK_FALSE(fs::exists(folder / "out"));
    }
}

TEST_CASE("ngspice itself is ended by a signal, and its folder goes", "[cli][spice][left-behind]") {
  const Folder folder;
  // Settles nowhere near: ngspice has work for minutes.
  const std::string deck = folder.write(
      "s.cir", "T\n* expect a 1\nr1 a 0 1k\nc1 a 0 1u\ni1 0 a 1m\n.tran 1n 1000 0 1n\n.end\n");
  Started started(folder, {"relax", deck});
  CHECK(comes_true([&] { return !started.left_nothing(); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  started.send(SIGTERM);
  CHECK(started.ended_by() == SIGTERM);
  CHECK(started.left_nothing());
}

TEST_CASE(
    "a command that is killed outright takes its simulator with it, and the next one cleans up",
    "[cli][left-behind]") {
  const Folder folder;
  const std::string scene = folder.write("s.toml", circuit_scene);
  const std::string fake = endless(folder);
  {
    Started started(folder, {"run", scene, "--ngspice", fake, "--out", folder / "out"});
    const long simulator = started.simulator();
    REQUIRE(simulator > 0);
    started.send(SIGKILL);
    CHECK(started.ended_by() == SIGKILL);
    CHECK(comes_true([&] { return !is_running(simulator); }));
    CHECK_FALSE(started.left_nothing());
    CHECK(partial_in(folder.path()).size() == 2);  // the staged folder, and its lock
  }
  const auto hour_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  for (const fs::path& where : {folder.path(), folder.path() / "tmp"})
    for (const auto& entry : fs::directory_iterator(where))
      fs::last_write_time(entry.path(), hour_ago);
  Started next(folder, {"run", scene, "--out", folder / "out"});
  CHECK(next.ended_by() == 0);
  CHECK(next.left_nothing());
  CHECK(partial_in(folder.path()).empty());
  CHECK(fs::exists(folder / "out/report.html"));
}

TEST_CASE("a half-written file goes at a signal", "[cli][left-behind]") {
  const Folder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  for (const int signal : {SIGINT, SIGTERM}) {
    Started started(folder,
                    {"solve", folder.write("s.toml", small_scene), "--readings", "-", "-o",
                     folder / "f.csv", "--json", folder / "f.json"},
                    folder / "pipe");
    std::ofstream feed(folder / "pipe");
    feed << "stress_x_0,stress_x_1,stress_x_2\n1,2,3\n" << std::flush;
    CHECK(comes_true([&] { return partial_in(folder.path()).size() == 2; }));
    started.send(signal);
    CHECK(started.ended_by() == signal);
    CHECK(partial_in(folder.path()).empty());
    CHECK_FALSE(fs::exists(folder / "f.csv"));
  }
}

TEST_CASE("a signal that is ignored stays ignored", "[cli][left-behind]") {
  const Folder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  const std::string path = folder.write("s.toml", small_scene);
  struct sigaction before {};
  ::sigaction(SIGHUP, nullptr, &before);
  ::signal(SIGHUP, SIG_IGN);
  Started started(folder, {"solve", path, "--readings", "-", "-o", folder / "f.csv"},
                  folder / "pipe");
  ::sigaction(SIGHUP, &before, nullptr);
  {
    std::ofstream feed(folder / "pipe");
    feed << "stress_x_0,stress_x_1,stress_x_2\n1,2,3\n" << std::flush;
    CHECK(comes_true([&] { return partial_in(folder.path()).size() == 1; }));
    started.send(SIGHUP);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  CHECK(started.ended_by() == 0);
  CHECK(fs::exists(folder / "f.csv"));
}

TEST_CASE("two runs into one folder: the second is told who has it", "[cli][left-behind]") {
  const Folder folder;
  const std::string fake = endless(folder);
  const std::string path = folder.write("s.toml", circuit_scene);
  const std::string out = folder / "out";
  Started first(folder, {"run", path, "--ngspice", fake, "--out", out});
  REQUIRE(first.simulator() > 0);
  for (const std::vector<std::string>& second :
       {std::vector<std::string>{"run", path, "--out", out},
        {"tradeoff", path, "--out", out + "/"},
        {"certify", path, "--out", folder / "./out"}}) {
    const ProcessResult result = run_tool(second);
    CHECK(result.code == 2);
    CHECK_THAT(result.errors, ContainsSubstring("out") && ContainsSubstring("error: process ") &&
                                  ContainsSubstring("is writing results into this folder"));
  }
  first.send(SIGKILL);
  CHECK(first.ended_by() == SIGKILL);
  CHECK(run_tool({"certify", path, "--out", out}).code == 0);
}

TEST_CASE("failing circuits leave what their message promises", "[cli][spice][left-behind]") {
  const Folder folder;
  const std::string deck =
      folder.write("s.cir", "T\n* expect a 1\nr1 a 0 1k\nr2 a 0 -1k\ni1 0 a 1m\n.op\n.end\n");
  Started started(folder, {"relax", deck});
  CHECK(started.ended_by() == 0);
  const std::string errors = read_text(folder / "stderr");
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "tmp")) {
    if (entry.is_directory()) continue;
    ++files;
    CHECK_THAT(errors, ContainsSubstring(entry.path().filename().string()) &&
                           ContainsSubstring(entry.path().parent_path().string()));
  }
  CHECK(files == 2);
}

TEST_CASE("errors name the reason and the place", "[cli][left-behind]") {
  const Folder folder;
  const ProcessResult nowhere = run_process(
      {"env", "TMPDIR=/nonexistent", TOOL, "relax", folder.write("s.toml", circuit_scene)});
  CHECK(nowhere.code == 1);
  CHECK_THAT(nowhere.errors, ContainsSubstring("/nonexistent (TMPDIR): No such file or directory"));
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"gen", scene("nic.toml"), "-o", "/dev/full"},
        {"solve", scene("recorded/thick-pad.toml"), "--readings", scene("recorded/thick-pad.csv"),
         "-o", "/dev/full"},
        {"simulate", folder.write("t.toml", small_scene), "-o", "/dev/full"}})
    CHECK_THAT(run_tool(arguments).errors,
               ContainsSubstring("/dev/full could not be written: No space left"));
}
