// The second wall: what a program is kept from, whatever it was told to do.
#include "tactile_net/simulator/confinement.hpp"

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "simulator/cell.hpp"
#include "tactile_net/simulator/child_process.hpp"
#include "tests/catch.hpp"
#include "tests/simulator/own_folder.hpp"

using namespace tactile_net;
namespace fs = std::filesystem;

namespace {

ProcessResult confined(const OwnFolder& own, const std::string& script) {
  fs::create_directories(own / "cell");
  return run_process({"sh", "-c", script}, {.folder = own / "cell", .confined = true});
}

}  // namespace

TEST_CASE("a confined program writes in its folder and nowhere else", "[confinement]") {
  const OwnFolder own;
  CHECK(confined(own, "echo x > inside && : > /dev/null").code == 0);
  CHECK(fs::exists(own / "cell/inside"));
  if (!confinement().files) return;
  fs::remove("/dev/shm/tactile-net-outside");  // of a run that failed
  std::ofstream(own / "mine") << "mine";
  for (const std::string& target :
       {(own / "outside").string(), std::string("../outside"), (own / "mine").string(),
        std::string("/proc/self/cwd/../outside"), std::string("/dev/shm/tactile-net-outside")}) {
    CAPTURE(target);
    const ProcessResult result = confined(own, "echo x > " + target);
    CHECK(result.code != 0);
    CHECK_THAT(result.errors, ContainsSubstring("ermission denied"));
  }
  CHECK_FALSE(fs::exists(own / "outside"));
  CHECK_FALSE(fs::exists("/dev/shm/tactile-net-outside"));
  std::string text;
  std::ifstream(own / "mine") >> text;
  CHECK(text == "mine");
}

TEST_CASE("a link in the folder leads out no more than a path does", "[confinement]") {
  if (!confinement().files) return;
  const OwnFolder own;
  fs::create_directories(own / "cell");
  fs::create_symlink(own / "outside", own / "cell/link");
  CHECK(confined(own, "echo x > link").code != 0);
  CHECK_FALSE(fs::exists(own / "outside"));
}

TEST_CASE("a confined program starts nothing and becomes nothing else", "[confinement]") {
  if (!confinement().processes) return;
  const OwnFolder own;
  CHECK(confined(own, "echo begins; (echo x > child)").code != 0);
  CHECK_FALSE(fs::exists(own / "cell/child"));
  CHECK(confined(own, "exec touch became").code != 0);
  CHECK_FALSE(fs::exists(own / "cell/became"));
}

TEST_CASE("a confined program signals nobody", "[confinement]") {
  if (!confinement().processes) return;
  const OwnFolder own;
  CHECK(confined(own, "kill -0 " + std::to_string(::getpid())).code != 0);
}

TEST_CASE("a script's files are confined, and what it starts too", "[confinement]") {
  if (!confinement().files) return;
  const OwnFolder own;
  fs::create_directories(own / "cell");
  std::ofstream(own / "script") << "#!/bin/sh\ntouch inside\ntouch ../outside\nexit 0\n";
  fs::permissions(own / "script", fs::perms::owner_all);
  CHECK(run_process({(own / "script").string()}, {.folder = own / "cell", .confined = true}).code ==
        0);
  CHECK(fs::exists(own / "cell/inside"));
  CHECK_FALSE(fs::exists(own / "outside"));
}

TEST_CASE("a confined process opens no socket and removes nothing outside", "[confinement]") {
  const OwnFolder own;
  fs::create_directories(own / "cell");
  std::ofstream(own / "mine") << "mine";
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const fs::path cell = own / "cell";
    if (confine({.folder = cell.c_str()}) != 0) ::_exit(9);
    int got = 0;
    if (::unlink((own / "mine").c_str()) == 0) got |= 1;
    if (::socket(AF_UNIX, SOCK_STREAM, 0) >= 0) got |= 2;
    if (::rename((own / "mine").c_str(), (own / "cell/mine").c_str()) == 0) got |= 4;
    if (::truncate((own / "mine").c_str(), 0) == 0) got |= 8;
    ::_exit(got);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  const int got = WEXITSTATUS(status);
  REQUIRE(got != 9);
  if (confinement().files) CHECK((got & 5) == 0);
  if (confinement().processes) CHECK((got & 2) == 0);
  if (confinement().files) CHECK(fs::exists(own / "mine"));
}

TEST_CASE("a confined program gets files without a name, of its own", "[confinement]") {
  const OwnFolder own;
  std::ofstream(own / "mine") << "mine";
  // Python's TemporaryFile asks for O_TMPFILE as the C library's tmpfile does.
  const std::string script =
      "import os\nf = os.open('/tmp', os.O_RDWR | os.O_TMPFILE | os.O_EXCL, 0o600)\n"
      "assert os.write(f, b'abc') == 3 and os.pread(f, 9, 0) == b'abc'\n"
      "for name in ('" +
      (own / "mine").string() +
      "', '/tmp/tactile-net-outside'):\n"
      "  for flags in (os.O_WRONLY, os.O_RDWR | os.O_APPEND, os.O_WRONLY | os.O_CREAT | "
      "os.O_TRUNC):\n"
      "    try: os.open(name, flags)\n    except PermissionError: continue\n"
      "    except FileNotFoundError: continue\n    raise SystemExit(3)\n";
  const ProcessResult result = run_process({"python3", "-c", script}, {.confined = true});
  if (result.end == ProcessResult::End::not_found) return;
  CAPTURE(result.errors);
  CHECK(result.code == (confinement().files ? 0 : 3));
}

TEST_CASE("a confined program that is not there is not found", "[confinement]") {
  CHECK(run_process({"no-such-program-at-all"}, {.confined = true}).end ==
        ProcessResult::End::not_found);
}

TEST_CASE("the caller's open files are not the child's", "[confinement]") {
  const OwnFolder own;
  std::ofstream mine(own / "mine");  // opened without O_CLOEXEC
  const ProcessResult result = run_process({"ls", "/proc/self/fd"});
  CHECK(result.code == 0);
  CHECK_THAT(result.output, !ContainsSubstring("4\n"));  // 0 to 2, and the listing itself
}

TEST_CASE("a child is killed with the thread's process that started it", "[child_process]") {
  const OwnFolder own;
  const fs::path pid = own / "pid";
  const pid_t parent = ::fork();
  REQUIRE(parent >= 0);
  if (parent == 0) {
    (void)run_process({"sh", "-c", "echo $$ > " + pid.string() + "; exec sleep 60"});
    ::_exit(0);
  }
  long child = 0;
  for (int i = 0; i < 5000 && child == 0; ++i) {
    ::usleep(1000);
    std::ifstream(pid) >> child;
  }
  REQUIRE(child > 0);
  CHECK(is_running(child));
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  for (int i = 0; i < 5000 && is_running(child); ++i) ::usleep(1000);
  CHECK_FALSE(is_running(child));
}

TEST_CASE("the processors' time is limited too", "[child_process]") {
  const ProcessResult result =
      run_process({"sh", "-c", "ulimit -t"}, {.time_limit = std::chrono::seconds(9)});
  const long processors = ::sysconf(_SC_NPROCESSORS_ONLN);
  CHECK(result.output == std::to_string(10 * processors) + "\n");
}
