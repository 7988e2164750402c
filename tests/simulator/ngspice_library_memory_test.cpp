#include <unistd.h>

#include <fstream>

#include "tactile_net/simulator/ngspice_library.hpp"
#include "tests/catch.hpp"
#include "tests/simulator/network_deck.hpp"

using namespace tactile_net;

namespace {

/// Memory of the process that is not swapped out [kB].
double resident(int process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/statm");
  double size = 0.0;
  double pages = 0.0;
  file >> size >> pages;
  return pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1024.0;
}

}  // namespace

TEST_CASE("the worker's memory does not grow with the decks", "[spice]") {
  NgspiceLibrary library;
  const Network network = make_network(Realization::nic, 12, 3);
  const auto run = [&](int decks) {
    for (int i = 0; i < decks; ++i) (void)library.run(network.deck);
  };
  run(30);
  const int worker = library.worker();
  const double before = resident(worker);
  run(200);
  const double kilobytes_per_deck = (resident(worker) - before) / 200.0;
  CAPTURE(kilobytes_per_deck);  // measured: 1
  CHECK(library.worker() == worker);
  CHECK(kilobytes_per_deck < 10.0);
}
