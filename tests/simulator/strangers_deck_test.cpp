// Decks that attack, given to ngspice itself, past every check of their cards.
#include <fstream>

#include "simulator/private_folder.hpp"
#include "tactile_net/simulator/confinement.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tests/catch.hpp"
#include "tests/simulator/failure.hpp"
#include "tests/simulator/own_folder.hpp"

using namespace tactile_net;
namespace fs = std::filesystem;

namespace {

void run_whatever_comes(const std::string& deck) {
  Ngspice ngspice;
  try {
    (void)ngspice.run(deck);
  } catch (const SimulatorError& error) {
    error.discard();
  }
}

const std::string circuit_cards = "R1 a 0 1k\nI1 0 a 1m\n.op\n";

}  // namespace

TEST_CASE("commands in a deck start nothing and write nothing outside", "[spice][strangers]") {
  if (!confinement().files || !confinement().processes) return;
  const OwnFolder own;
  const std::string mark = (own / "ran").string();
  const std::string evil = (own / "evil.inc").string();
  std::ofstream(evil) << ".control\nshell touch " << mark << "\n.endc\n";
  for (const std::string& deck :
       {"* t\n" + circuit_cards + ".control\nshell touch " + mark + "\n.endc\n.end\n",
        "*ng_script\nshell touch " + mark + "\nquit\n",
        "* t\n.include " + evil + "\n" + circuit_cards + ".end\n",
        "* t\n" + circuit_cards + ".control\nrun\nwrite " + mark + "\n.endc\n.end\n",
        "* t\n" + circuit_cards + ".control\nrun\nprint a > " + mark + "\n.endc\n.end\n",
        "* t\n" + circuit_cards + ".control\nset rawfile=" + mark +
            "\nrun\nwrite\n.endc\n.end\n"}) {
    CAPTURE(deck);
    run_whatever_comes(deck);
    CHECK_FALSE(fs::exists(mark));
  }
  CHECK(own.left() == 0);
}

TEST_CASE("a failing circuit leaves its deck and its log, and nothing else", "[spice][strangers]") {
  const OwnFolder own;
  Ngspice ngspice;
  try {
    (void)ngspice.run(explosive);
    FAIL("it converged");
  } catch (const SimulatorError& error) {
    CHECK(own.left() == 1);
    CHECK(fs::exists(error.folder() / "deck.cir"));
    CHECK(fs::exists(error.folder() / "ngspice.log"));
    CHECK(std::distance(fs::directory_iterator(error.folder()), {}) == 2);
    CHECK_THAT(error.what(), ContainsSubstring((error.folder() / "deck.cir").string()));
    error.discard();
  }
  CHECK(own.left() == 0);
}

TEST_CASE("what a killed process left is swept away by the next one, and nothing else",
          "[spice][strangers]") {
  const OwnFolder own;
  const fs::path abandoned = own.tmp() / "tactile-net-run-abcdef";
  const fs::path in_use = own.tmp() / "tactile-net-run-locked";
  const fs::path young = own.tmp() / "tactile-net-run-young0";
  const fs::path kept = own.tmp() / "tactile-net-kept00";
  for (const fs::path& folder : {abandoned, in_use, young, kept}) {
    fs::create_directory(folder);
    std::ofstream(folder / "deck.cir") << "x";
  }
  const auto hour_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  for (const fs::path& folder : {abandoned, in_use, kept}) fs::last_write_time(folder, hour_ago);
  const auto lock = FileLock::of(in_use);
  REQUIRE(lock.has_value());
  sweep_private_folders(own.tmp());
  CHECK_FALSE(fs::exists(abandoned));
  CHECK(fs::exists(in_use / "deck.cir"));
  CHECK(fs::exists(young));
  CHECK(fs::exists(kept));
}

TEST_CASE("a temporary folder that is not there is named", "[spice][strangers]") {
  const OwnFolder own;
  ::setenv("TMPDIR", "/nonexistent", 1);
  Ngspice ngspice;
  CHECK_THROWS_WITH(ngspice.run(good), ContainsSubstring("/nonexistent") &&
                                           ContainsSubstring("TMPDIR") &&
                                           ContainsSubstring("No such file or directory"));
}
