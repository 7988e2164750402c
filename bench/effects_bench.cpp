// What effects cost: instructions of the whole command, counted by valgrind's callgrind, so that
// the machine's other work does not matter. Rival: the same command linked without any effect's
// file (no_effects/). Limit to hold: a bare scene, every effect compiled in but absent, takes at
// most 1 % more. Below it, what each effect takes for one reading of one frame, beside the
// operations that run --explain says.
//
// usage: bench_effects [FILE.csv]   the same numbers, as docs/effects.gnuplot draws them
#include <fstream>
#include <string>
#include <string_view>

#include "bench/effect_tables.hpp"
#include "bench/measure.hpp"
#include "tactile_net/lab/workload.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/scene/scene_effects.hpp"

namespace {

constexpr int taxels = 81;
constexpr int frames = 500;

std::string scene(const std::string& time, const std::string& contact, const std::string& effect) {
  return "[sensor]\ncount = " + std::to_string(taxels) +
         "\npitch = 0.25\ndepth = 1.5\nreads = [\"strain_x\"]\n"
         "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n" +
         time + "[[contact]]\nshape = \"cylinder\"\nhalf_width = 2.0\n" + contact + effect;
}

const std::string frames_at_100 = "[time]\nrate = 100.0\nframes = " + std::to_string(frames) + "\n";
const std::string still = "force = 1.0\n";
const std::string moving = "trajectory = [{ t = 0.0, force = 0.0 }, { t = 5.0, force = 1.0 }]\n";

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

/// Instructions of `tool simulate`, its start included.
double instructions(const std::string& tool, const std::string& toml) {
  const bench::TemporaryFile in;
  const bench::TemporaryFile log;
  const bench::TemporaryFile out;
  write(in.name(), toml);
  const std::string npy = out.name() + ".npy";  // numbers of one length, whatever they are
  bench::run({"valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
              "--log-file=" + log.name(), tool, "simulate", in.name(), "-o", npy});
  ::unlink(npy.c_str());
  std::ifstream words(log.name());
  for (std::string word; words >> word;)
    if (word == "Collected") {
      double count = 0.0;
      words >> word >> count;
      return count;
    }
  throw std::runtime_error("callgrind has counted nothing");
}

std::string number(const std::string& name, double count) {
  char text[32];
  std::snprintf(text, sizeof text, ",%.2f\n", count);
  return name + text;
}

double operations(const std::string& toml, std::string_view effect) {
  const tactile_net::Scene parsed = tactile_net::parse_scene(toml, "bench");
  for (const auto& one : tactile_net::lab::workload(parsed).effects)
    if (one.row->name == effect) return one.operations / taxels;
  return 0.0;
}

}  // namespace

int main(int argc, char** argv) {
  if (std::system("valgrind --version >/dev/null 2>&1") != 0) {
    std::fputs("bench_effects counts with valgrind: tools/install-dependencies valgrind\n", stderr);
    return 2;
  }
  bool held = true;
  std::string csv = "what,instructions\n";
  std::printf("effects, %d taxels, one channel; instructions of the whole command\n", taxels);
  for (const auto& [name, toml] :
       {std::pair<const char*, std::string>{"one frame", scene("", still, "")},
        {"500 frames, load stands", scene(frames_at_100, still, "")},
        {"500 frames, load moves", scene(frames_at_100, moving, "")}}) {
    const double ours = instructions(TOOL, toml);
    const double without = instructions(TOOL_WITHOUT_EFFECTS, toml);
    held = held && ours <= 1.01 * without;
    if (toml.find("trajectory") != std::string::npos) {
      csv += number("a bare scene", without / (frames * taxels));
      csv += number("all effects absent", (ours - without) / (frames * taxels));
    }
    std::printf("bare scene, %-24s %11.0f, without effects' files %11.0f: %+.3f %%\n", name, ours,
                without, 100.0 * (ours / without - 1.0));
  }
  std::printf("limit 1 %%: %s\n\n", held ? "held" : "BROKEN");

  std::printf("%-16s %24s %21s\n", "effect", "instructions a reading", "operations planned");
  // Twice the frames less once: what is done once, such as drawing gains, falls out.
  const std::string twice = "[time]\nrate = 100.0\nframes = " + std::to_string(2 * frames) + "\n";
  const auto per_reading = [&](const std::string& effect) {
    return (instructions(TOOL, scene(twice, still, effect)) -
            instructions(TOOL, scene(frames_at_100, still, effect))) /
           (frames * taxels);
  };
  const double bare = per_reading("");
  std::printf("%-16s %24.1f %21s\n", "(bare)", bare, "-");
  for (const tactile_net::SceneEffect& effect : tactile_net::scene_effects()) {
    const std::string table(bench::effect_table(effect.name));
    if (table.empty()) continue;  // friction and layer act before the readings
    const double own = per_reading(table) - bare;
    std::printf("%-16s %24.1f %21.1f\n", std::string(effect.name).c_str(), own,
                operations(scene(frames_at_100, still, table), effect.name));
    csv += number(std::string(effect.name), own);
  }
  if (argc > 1) write(argv[1], csv);
  return held ? 0 : 1;
}
