// Emitting the ideal netlist of 401 taxels (80,601 resistors): the whole command, scene to deck.
// Rival: printing as many numbers alone, with 17 digits, by iostreams. Limits to hold: 0.25 s, 100
// MB.
#include <fstream>
#include <iomanip>

#include "bench/measure.hpp"

int main() {
  const auto print_alone = [] {
    std::ofstream out("/dev/null");
    out << std::setprecision(17);
    for (int i = 0; i < 401; ++i)
      for (int j = i; j < 401; ++j)
        out << 'R' << i << '_' << j << " n" << i << " n" << j << ' ' << 1e3 / (1.0 + i + 3.7 * j)
            << '\n';
  };
  const auto [ours, rival] = bench::compare(
      7,
      [] {
        return bench::run({TOOL, "gen", SCENES "/array-401.toml", "-o", "/dev/null"});
      },
      [&] { return bench::in_process(print_alone); });
  std::printf(
      "gen, 401 taxels, ideal: %.3f s, %.0f MB; iostreams printing alone %.3f s; ratio %.2f\n",
      ours.seconds, ours.megabytes, rival.seconds, ours.seconds / rival.seconds);
}
