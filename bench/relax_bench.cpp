// relax at 81 taxels: scene, direct solve, deck, ngspice, comparison. Rival: `ngspice -b` alone on
// the same deck. Limit to hold: 3 times that.
#include "bench/measure.hpp"

int main() {
  const bench::TemporaryFile deck;
  (void)bench::run({TOOL, "gen", SCENES "/array-81.toml", "-o", deck.name()});
  const auto [ours, rival] = bench::compare(
      15,
      [] {
        return bench::run({TOOL, "relax", SCENES "/array-81.toml"});
      },
      [&] {
        return bench::run({"ngspice", "-b", deck.name()});
      });
  std::printf("relax, 81 taxels: %.1f ms; ngspice -b alone %.1f ms; ratio %.2f\n",
              1e3 * ours.seconds, 1e3 * rival.seconds, ours.seconds / rival.seconds);
}
