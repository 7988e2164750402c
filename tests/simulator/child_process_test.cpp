#include "tactile_net/simulator/child_process.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/catch.hpp"
#include "tests/simulator/caller.hpp"

using namespace tactile_net;
using namespace std::chrono_literals;
using End = ProcessResult::End;

namespace {

ProcessResult shell(const std::string& script, const ProcessOptions& options = {}) {
  return run_process({"sh", "-c", script}, options);
}

std::ptrdiff_t open_descriptors() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
}

void collect_all(int) {
  const int saved = errno;
  while (::waitpid(-1, nullptr, WNOHANG) > 0) {
  }
  errno = saved;
}

}  // namespace

TEST_CASE("output, errors and exit status come back apart", "[child_process]") {
  const ProcessResult result = shell("echo out; echo err >&2; exit 3");
  CHECK(result.end == End::exited);
  CHECK(result.code == 3);
  CHECK(result.output == "out\n");
  CHECK(result.errors == "err\n");
}

TEST_CASE("megabytes go in and out without a deadlock", "[child_process]") {
  const std::string input(5'000'000, 'x');
  CHECK(run_process({"cat"}, {.input = input}).output == input);
}

TEST_CASE("a child that does not read its input does no harm", "[child_process]") {
  const ProcessResult result = shell("exec 0<&-; exit 0", {.input = std::string(5'000'000, 'x')});
  CHECK(result.end == End::exited);
}

TEST_CASE("a crash is told by its signal", "[child_process]") {
  const ProcessResult result = shell("kill -SEGV $$");
  CHECK(result.end == End::signalled);
  CHECK(result.code == SIGSEGV);
}

TEST_CASE("a child that hangs is killed at the limit", "[child_process]") {
  const ProcessResult result = shell("sleep 30", {.time_limit = 200ms});
  CHECK(result.end == End::timed_out);
  CHECK(result.seconds < 10.0);
}

TEST_CASE("a child that closes its streams and hangs is killed too", "[child_process]") {
  CHECK(shell("exec >&- 2>&-; sleep 30", {.time_limit = 200ms}).end == End::timed_out);
}

TEST_CASE("a grandchild that keeps the streams open is not waited for", "[child_process]") {
  const ProcessResult result = shell("sleep 30 & echo done; exit 0", {.time_limit = 20s});
  CHECK(result.end == End::exited);
  CHECK(result.output == "done\n");
  CHECK(result.seconds < 10.0);
}

TEST_CASE("endless output is stopped", "[child_process]") {
  const ProcessResult result = run_process({"yes"}, {.output_limit = 100'000});
  CHECK(result.end == End::too_much_output);
  CHECK(result.output.size() < 1'000'000);
}

TEST_CASE("a program that is not there, or not to be run, is not found", "[child_process]") {
  CHECK(run_process({"no-such-program-at-all"}).end == End::not_found);
  CHECK(run_process({"/etc/passwd"}).end == End::not_found);
}

TEST_CASE("the folder and the environment are as asked", "[child_process]") {
  CHECK(shell("pwd", {.folder = "/"}).output == "/\n");
  ::setenv("TACTILE_NET_TEST", "seen", 1);
  CHECK(shell("echo $TACTILE_NET_TEST").output == "seen\n");
  CHECK(shell("echo $TACTILE_NET_TEST", {.unset = {"TACTILE_NET_TEST"}}).output == "\n");
}

TEST_CASE("a default is for who has no such variable", "[child_process]") {
  ::setenv("TACTILE_NET_TEST", "seen", 1);
  CHECK(shell("echo $TACTILE_NET_TEST", {.defaults = {"TACTILE_NET_TEST=default"}}).output ==
        "seen\n");
  const Without home("HOME");
  CHECK(shell("echo $HOME", {.defaults = {"HOME=/nowhere"}}).output == "/nowhere\n");
  // Hidden and given anew: what the caller has does not get through.
  CHECK(shell("echo $TACTILE_NET_TEST",
              {.unset = {"TACTILE_NET_TEST"}, .defaults = {"TACTILE_NET_TEST=own"}})
            .output == "own\n");
}

TEST_CASE("an end is the same whatever the caller does with the ends of its children",
          "[child_process]") {
  const auto before = open_descriptors();
  const std::string input(300'000, 'x');
  for (void (*const handler)(int) : {SIG_DFL, SIG_IGN, &collect_all})
    for (int round = 0; round < 2; ++round) {
      const Ends ends(handler);
      CAPTURE(handler == SIG_DFL, handler == SIG_IGN, round);
      const ProcessResult failed = shell("echo out; echo err >&2; exit 3");
      CHECK(failed.end == End::exited);
      CHECK(failed.code == 3);
      CHECK(failed.output == "out\n");
      CHECK(failed.errors == "err\n");
      CHECK(shell("exec >&- 2>&-; exit 4").code == 4);
      const ProcessResult crashed = shell("kill -SEGV $$");
      CHECK(crashed.end == End::signalled);
      CHECK(crashed.code == SIGSEGV);
      CHECK(shell("kill -9 0").end == End::signalled);
      // What it starts has the usual ends of children, too.
      CHECK(shell("(exit 7); echo $?").output == "7\n");
      CHECK(shell("sleep 30", {.time_limit = 20ms}).end == End::timed_out);
      CHECK(shell("exec >&- 2>&-; sleep 30", {.time_limit = 20ms}).end == End::timed_out);
      CHECK(run_process({"cat"}, {.input = input}).output == input);
      CHECK(run_process({"yes"}, {.output_limit = 100'000}).end == End::too_much_output);
      CHECK(run_process({"no-such-program-at-all"}).end == End::not_found);
      CHECK(run_process({"sh", "-c", "exit 5"}, {.confined = true}).code == 5);
      CHECK(shell("sleep 30 & echo done").output == "done\n");
    }
  CHECK(open_descriptors() == before);
  // No child of ours is left, running or not collected.
  CHECK(::waitpid(-1, nullptr, WNOHANG) == -1);
}

TEST_CASE("no descriptor is leaked", "[child_process]") {
  (void)shell("exit 0");
  const auto before = open_descriptors();
  for (int i = 0; i < 20; ++i) (void)shell("exit 0");
  (void)run_process({"no-such-program-at-all"});
  CHECK(open_descriptors() == before);
}

TEST_CASE("a process that is not wanted any more is killed, soon", "[child_process]") {
  static int asked = 0;
  asked = 0;
  const ProcessResult result =
      run_process({"sleep", "60"}, {.cancelled = [] { return ++asked > 3; }});
  CHECK(result.end == ProcessResult::End::cancelled);
  CHECK(asked == 4);
  CHECK(result.seconds < 30.0);
}
