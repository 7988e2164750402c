#include "tactile_net/simulator/ngspice_library.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

#include "tactile_net/simulator/ngspice.hpp"
#include "tests/simulator/caller.hpp"
#include "tests/simulator/failure.hpp"
#include "tests/simulator/network_deck.hpp"

using namespace tactile_net;
using namespace std::chrono_literals;
namespace fs = std::filesystem;
using Cause = SimulatorError::Cause;

namespace {

/// Takes minutes.
const std::string endless = "* endless\nR1 a 0 1\nC1 a 0 1\nI1 0 a 1\n.tran 1u 100\n.end\n";
const std::string undefined_parameter = "* undefined\nR1 a 0 {nowhere}\nI1 0 a 1m\n.op\n.end\n";

/// The voltage of a, in an own deck for each number.
std::string deck_of(double volts) {
  return "* own\nR1 a 0 1\nI1 0 a DC " + std::to_string(volts) + "\n.op\n.end\n";
}

double voltage(Simulator& simulator, const std::string& deck) {
  return operating_point(simulator, deck, node_a).voltages.front();
}

/// Every vector of the one is in the other, bit by bit.
void check_equal(const RawFile& one, const RawFile& other) {
  CHECK(one.plot == other.plot);
  REQUIRE(one.names.size() == other.names.size());
  REQUIRE(one.imaginary.size() == other.imaginary.size());
  for (std::size_t i = 0; i < one.names.size(); ++i) {
    CAPTURE(one.names[i]);
    const auto found = std::find(other.names.begin(), other.names.end(), one.names[i]);
    REQUIRE(found != other.names.end());
    const auto j = static_cast<std::size_t>(found - other.names.begin());
    CHECK(one.values[i] == other.values[j]);
    if (!one.imaginary.empty()) CHECK(one.imaginary[i] == other.imaginary[j]);
  }
}

/// The folder in which temporary ones are made, as long as this lives; removed with all it holds.
class OwnTemporaryFolder {
 public:
  OwnTemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "tactile-net-own-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
    ::setenv("TMPDIR", path_.c_str(), 1);
  }
  ~OwnTemporaryFolder() {
    ::unsetenv("TMPDIR");
    fs::remove_all(path_);
  }
  OwnTemporaryFolder(const OwnTemporaryFolder&) = delete;
  OwnTemporaryFolder& operator=(const OwnTemporaryFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

bool runs(int process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string state;
  file >> state >> state >> state;
  return file && state != "Z" && state != "X";
}

std::ptrdiff_t open_descriptors(const std::string& process) {
  return std::distance(fs::directory_iterator("/proc/" + process + "/fd"), {});
}

}  // namespace

TEST_CASE("a network solved by hand comes back, and no folder stays", "[spice]") {
  const OwnTemporaryFolder own;
  const std::array<std::string, 2> nodes{"b", "a"};
  {
    NgspiceLibrary library;
    CHECK(library.worker() == 0);
    for (int i = 0; i < 3; ++i) {
      const OperatingPoint point = operating_point(library, good, nodes);
      CHECK_THAT(point.voltages[0], WithinRel(2.0, 1e-14));
      CHECK_THAT(point.voltages[1], WithinRel(3.0, 1e-14));
      const fs::directory_iterator of_the_worker(own.path());
      CHECK(fs::is_empty(of_the_worker->path()));
      CHECK(std::distance(of_the_worker, {}) == 1);
    }
  }
  CHECK(fs::is_empty(own.path()));
}

TEST_CASE("library and program give the same bits", "[spice]") {
  NgspiceLibrary library;
  Ngspice program;
  for (const Realization realization :
       {Realization::ideal, Realization::nic, Realization::rail, Realization::crossbar})
    for (const std::size_t n : {2U, 5U, 12U}) {
      CAPTURE(name(realization), n);
      const Network network = make_network(realization, n, 3);
      const std::vector<double> voltages =
          operating_point(program, network.deck, network.nodes).voltages;
      CHECK(operating_point(library, network.deck, network.nodes).voltages == voltages);
      // The same with commands, by which the program would write no raw file.
      const Network printed = make_network(realization, n, 3, Answer::printed);
      CHECK(operating_point(library, printed.deck, printed.nodes).voltages == voltages);
    }
  const std::string ladder = "* ladder\nV1 a 0 DC 1 AC 1 SIN(0 1 1k)\nR1 a b 1k\nC1 b 0 1u\n";
  for (const char* analysis : {".op", ".ac dec 5 1 1meg", ".tran 10u 2m"}) {
    CAPTURE(analysis);
    const std::string deck = ladder + analysis + "\n.end\n";
    check_equal(library.run(deck).plot, program.run(deck).plot);
  }
}

TEST_CASE("library and program fail alike", "[spice]") {
  NgspiceLibrary library;
  Ngspice program;
  for (const std::string& deck :
       {singular, floating, no_value, no_element, voltage_loop, explosive, undefined_parameter}) {
    CAPTURE(deck);
    const Failure ours = failure(library, deck);
    check_kept(ours, failure(program, deck).cause, "ngspice: ");
    CHECK(library.worker() == 0);
    CHECK_THAT(voltage(library, good), WithinRel(3.0, 1e-14));
  }
}

TEST_CASE("failures of the library are named", "[spice]") {
  NgspiceLibrary library;
  check_kept(failure(library, singular), Cause::failed, "singular matrix");
  check_kept(failure(library, no_element), Cause::failed, "Error on line 2");
  check_kept(failure(library, explosive), Cause::diverged, "imestep too small");
  check_kept(failure(library, voltage_loop), Cause::failed, "singular matrix");
  check_kept(failure(library, undefined_parameter), Cause::failed, "exit status 1");
  check_kept(failure(library, "* idle\nR1 a 0 1\nI1 0 a 1\n.end\n"), Cause::failed, "No job");
  check_kept(failure(library, ""), Cause::failed, "ngspice: ");
}

TEST_CASE("a node that the deck does not have is named", "[spice]") {
  NgspiceLibrary library;
  const std::array<std::string, 1> missing{"n99"};
  const Failure result = failure(library, good, missing);
  CHECK(result.cause == Cause::bad_result);
  CHECK_THAT(result.text, ContainsSubstring("v(n99)"));
}

TEST_CASE("no deck gets the numbers of another", "[spice]") {
  NgspiceLibrary library;
  for (int i = 1; i <= 10; ++i) {
    CHECK_THAT(voltage(library, deck_of(i)), WithinRel(static_cast<double>(i), 1e-14));
    if (i % 3 == 0) CHECK(failure(library, no_element).cause == Cause::failed);
    if (i % 4 == 0) CHECK(failure(library, floating).cause == Cause::failed);
    if (i % 5 == 0) CHECK(failure(library, undefined_parameter).cause == Cause::failed);
    // The node of the deck before is none of this one's.
    CHECK(failure(library, "* other\nR1 c 0 1\nI1 0 c 1\n.op\n.end\n").cause == Cause::bad_result);
  }
}

TEST_CASE("a deck's title, commands and end do no harm", "[spice]") {
  const std::string elements = "R1 a 0 1\nI1 0 a 2\n.op\n";
  const std::string deck = GENERATE_COPY(
      "\n" + elements + ".end\n", ".end\n" + elements + ".END\n", "*# quit\n" + elements + ".end\n",
      "R1 a 0 5\n" + elements, "* no end\n" + elements,
      "* commands\n*# quit 0\n.control\nquit\n.endc\n" + elements + ".end\n*# quit 0\nR3 a 0 1\n",
      std::string("* crlf\r\nR1 a 0 1\r\nI1 0 a 2\r\n\r\n.op\r\n.end\r\n"));
  CAPTURE(deck);
  NgspiceLibrary library;
  CHECK(voltage(library, deck) == 2.0);
  CHECK(voltage(library, deck_of(3.0)) == 3.0);
}

TEST_CASE("a deck that takes too long is stopped", "[spice]") {
  NgspiceLibrary library({.time_limit = 1s});
  check_kept(failure(library, endless), Cause::timed_out, "did not end within 1.0");
  CHECK(library.worker() == 0);
  CHECK_THAT(voltage(library, good), WithinRel(3.0, 1e-14));
}

TEST_CASE("a deck that prints too much is stopped", "[spice]") {
  NgspiceLibrary library({.output_limit = 500});
  check_kept(failure(library, singular), Cause::too_much_output, "more than 500 bytes");
  CHECK_THAT(voltage(library, good), WithinRel(3.0, 1e-14));
}

TEST_CASE("a worker that crashes is told by its signal, and replaced", "[spice]") {
  NgspiceLibrary library;
  CHECK(voltage(library, deck_of(1.0)) == 1.0);
  const int first = library.worker();
  ::kill(first, SIGSEGV);
  check_kept(failure(library, deck_of(2.0)), Cause::crashed, "Segmentation fault");
  CHECK(voltage(library, deck_of(3.0)) == 3.0);
  CHECK(library.worker() != first);

  std::thread killer([worker = library.worker()] {
    std::this_thread::sleep_for(200ms);
    ::kill(worker, SIGSEGV);
  });
  check_kept(failure(library, endless), Cause::crashed, "Segmentation fault");
  killer.join();
  CHECK(voltage(library, deck_of(4.0)) == 4.0);
}

TEST_CASE("a caller without HOME that ignores its children gets the same", "[spice]") {
  const Without home("HOME");
  const Ends ignored(SIG_IGN);
  NgspiceLibrary library;
  CHECK(voltage(library, deck_of(1.0)) == 1.0);
  check_kept(failure(library, singular), Cause::failed, "singular matrix");
  CHECK(voltage(library, deck_of(2.0)) == 2.0);
  // Nobody can tell the signal; that it crashed is known.
  ::kill(library.worker(), SIGSEGV);
  check_kept(failure(library, deck_of(3.0)), Cause::crashed, "SIGCHLD");
  CHECK(voltage(library, deck_of(4.0)) == 4.0);
}

TEST_CASE("the worker ends with the object", "[spice]") {
  int worker = 0;
  {
    NgspiceLibrary library;
    (void)voltage(library, good);
    worker = library.worker();
    CHECK(runs(worker));
  }
  CHECK(!runs(worker));
}

TEST_CASE("the worker ends with its parent, even in the middle of a deck", "[spice]") {
  const bool busy = GENERATE(false, true);
  const OwnTemporaryFolder own;  // for what the killed parent leaves
  std::array<int, 2> ends{};
  REQUIRE(::pipe(ends.data()) == 0);
  const pid_t parent = ::fork();
  if (parent == 0) {
    NgspiceLibrary library;
    (void)voltage(library, good);
    const int worker = library.worker();
    (void)!::write(ends[1], &worker, sizeof worker);
    if (busy) (void)library.run(endless);
    ::pause();
  }
  int worker = 0;
  REQUIRE(::read(ends[0], &worker, sizeof worker) == static_cast<ssize_t>(sizeof worker));
  if (busy) std::this_thread::sleep_for(200ms);
  CHECK(runs(worker));
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  for (int i = 0; i < 500 && runs(worker); ++i) std::this_thread::sleep_for(10ms);
  CHECK(!runs(worker));
  for (const int end : ends) ::close(end);
}

TEST_CASE("the worker outlives the thread that started it", "[spice]") {
  NgspiceLibrary library;
  std::thread([&] { (void)library.run(good); }).join();
  const int worker = library.worker();
  CHECK(voltage(library, deck_of(2.0)) == 2.0);
  CHECK(library.worker() == worker);
}

TEST_CASE("the worker takes nothing over from its parent", "[spice]") {
  const Network network = make_network(Realization::ideal, 12, 3);
  Ngspice program;
  const std::vector<double> expected =
      operating_point(program, network.deck, network.nodes).voltages;
  std::fesetround(FE_UPWARD);
  const auto handler = std::signal(SIGUSR1, SIG_IGN);
  NgspiceLibrary library;
  const std::vector<double> voltages =
      operating_point(library, network.deck, network.nodes).voltages;
  std::fesetround(FE_TONEAREST);
  std::signal(SIGUSR1, handler);
  CHECK(voltages == expected);
  CHECK(open_descriptors(std::to_string(library.worker())) == 4);
  ::kill(library.worker(), SIGUSR1);
  check_kept(failure(library, good), Cause::crashed, "User defined signal 1");
}

TEST_CASE("no descriptor is leaked", "[spice]") {
  NgspiceLibrary library;
  const auto run = [&] {
    for (int i = 0; i < 20; ++i) (void)library.run(good);
    (void)failure(library, floating);
  };
  run();
  const auto before = open_descriptors("self");
  run();
  CHECK(open_descriptors("self") == before);
}
