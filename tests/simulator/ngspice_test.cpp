#include "tactile_net/simulator/ngspice.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>

#include "tests/catch.hpp"
#include "tests/simulator/caller.hpp"
#include "tests/simulator/failure.hpp"

using namespace tactile_net;
namespace fs = std::filesystem;
using Cause = SimulatorError::Cause;

namespace {

Failure failure(const std::string& deck, const NgspiceOptions& options = {},
                std::span<const std::string> nodes = node_a) {
  Ngspice ngspice(options);
  return failure(ngspice, deck, nodes);
}

/// A simulator that fails in a way of our choice: a shell script, removed at the end.
class FakeSimulator {
 public:
  explicit FakeSimulator(const std::string& script) {
    std::ofstream(path_) << "#!/bin/sh\n" << script << '\n';
    fs::permissions(path_, fs::perms::owner_all);
  }
  ~FakeSimulator() { fs::remove(path_); }
  [[nodiscard]] NgspiceOptions options() const { return {.program = path_.string()}; }

 private:
  fs::path path_ = fs::temp_directory_path() / ("tactile-net-fake-" + std::to_string(::getpid()));
};

}  // namespace

TEST_CASE("a network solved by hand comes back, and no folder stays", "[spice]") {
  std::string own = (fs::temp_directory_path() / "tactile-net-own-XXXXXX").string();
  REQUIRE(::mkdtemp(own.data()) != nullptr);
  ::setenv("TMPDIR", own.c_str(), 1);
  const std::array<std::string, 2> nodes{"b", "a"};
  Ngspice ngspice;
  const OperatingPoint point = operating_point(ngspice, good, nodes);
  CHECK_THAT(point.voltages[0], WithinRel(2.0, 1e-14));
  CHECK_THAT(point.voltages[1], WithinRel(3.0, 1e-14));
  CHECK(fs::is_empty(own));
  ::unsetenv("TMPDIR");
  fs::remove(own);
}

TEST_CASE("ngspice answers a caller without HOME, and one that ignores its children", "[spice]") {
  const Without home("HOME");
  const Ends ignored(SIG_IGN);
  Ngspice ngspice;
  CHECK_THAT(operating_point(ngspice, good, node_a).voltages[0], WithinRel(3.0, 1e-14));
  check_kept(failure(no_element), Cause::failed, "exit status 1");
}

TEST_CASE("what ngspice fails at with exit status 0 is a failure", "[spice]") {
  check_kept(failure(singular), Cause::failed, "singular matrix");
  check_kept(failure(floating), Cause::failed, "singular matrix");
  check_kept(failure(no_value), Cause::failed, "resist");  // resistance, or resistor: by version
}

TEST_CASE("a deck that ngspice cannot parse is a failure", "[spice]") {
  check_kept(failure(no_element), Cause::failed, "exit status 1");
}

TEST_CASE("only a transient diverges", "[spice]") {
  check_kept(failure(explosive), Cause::diverged, "imestep too small");
  // The operating point's last try is a transient too.
  check_kept(failure(voltage_loop), Cause::failed, "singular matrix");
}

TEST_CASE("a node that the deck does not have is named", "[spice]") {
  const std::array<std::string, 1> missing{"n99"};
  const Failure result = failure(good, {}, missing);
  CHECK(result.cause == Cause::bad_result);
  CHECK_THAT(result.text, ContainsSubstring("v(n99)"));
}

TEST_CASE("a simulator that is not installed says how to install it", "[spice]") {
  const Failure result = failure(good, {.program = "no-such-ngspice"});
  CHECK(result.cause == Cause::not_installed);
  CHECK_THAT(result.text, ContainsSubstring("apt install ngspice"));
}

TEST_CASE("a simulator that hangs is stopped", "[spice]") {
  const FakeSimulator fake("sleep 60");
  NgspiceOptions options = fake.options();
  options.time_limit = std::chrono::milliseconds(200);
  check_kept(failure(good, options), Cause::timed_out, "did not end within 0.2");
}

TEST_CASE("a simulator that crashes is told by its signal", "[spice]") {
  const FakeSimulator fake("kill -SEGV $$");
  check_kept(failure(good, fake.options()), Cause::crashed, "Segmentation fault");
}

TEST_CASE("a simulator that prints without end is stopped", "[spice]") {
  const FakeSimulator fake("yes");
  NgspiceOptions options = fake.options();
  options.output_limit = 100'000;
  check_kept(failure(good, options), Cause::too_much_output, "more than 100000 bytes");
}

TEST_CASE("exit status 0 without a raw file is no success", "[spice]") {
  const FakeSimulator fake("exit 0");
  check_kept(failure(good, fake.options()), Cause::bad_result, "no such raw file");
}

TEST_CASE("a short raw file and one without a number are no answers", "[spice]") {
  const std::string header =
      "Title: t\\nPlotname: Operating Point\\nFlags: real\\nNo. Variables: 1\\nNo. Points: 1\\n"
      "Variables:\\n\\t0\\tv(a)\\tvoltage\\n";
  const FakeSimulator half("printf '" + header + "Binary:\\n1234' > result.raw");
  check_kept(failure(good, half.options()), Cause::bad_result, "not a whole raw file");
  const FakeSimulator nan("printf '" + header + "Values:\\n0\\tnan\\n' > result.raw");
  check_kept(failure(good, nan.options()), Cause::bad_result, "not a finite number");
}

TEST_CASE("another analysis than the operating point is no answer", "[spice]") {
  const FakeSimulator fake(
      "printf 'Title: t\\nPlotname: Transient\\nFlags: real\\nNo. Variables: 1\\nNo. Points: 1\\n"
      "Variables:\\n\\t0\\tv(a)\\tvoltage\\nValues:\\n0\\t1\\n' > result.raw");
  const Failure result = failure(good, fake.options());
  CHECK(result.cause == Cause::bad_result);
  CHECK_THAT(result.text, ContainsSubstring("'Transient'"));
}
