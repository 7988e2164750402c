// Streaming recorded frames, CSV to CSV, at 81 taxels. Rival: the loop one would write first, with
// iostreams and the same matrix. Limit to hold: 50,000 frames a second, constant memory.
#include <fstream>
#include <iomanip>
#include <random>
#include <sstream>

#include "bench/measure.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/scene/reader.hpp"

namespace {

constexpr std::size_t taxels = 81;

void write_frames(const std::string& path, std::size_t frames) {
  std::mt19937 generator(1);
  std::ofstream file(path);
  file << std::setprecision(17);
  std::vector<std::string> rows;
  for (int row = 0; row < 100; ++row) {
    std::ostringstream text;
    text << std::setprecision(17);
    for (std::size_t i = 0; i < taxels; ++i)
      text << (i > 0 ? "," : "") << 1e3 * static_cast<double>(generator()) / 4294967295.0;
    rows.push_back(text.str() + "\n");
  }
  for (std::size_t i = 0; i < taxels; ++i) file << (i > 0 ? "," : "") << "stress_x_" << i;
  file << '\n';
  for (std::size_t frame = 0; frame < frames; ++frame) file << rows[frame % rows.size()];
}

void solve_with_iostreams(const tactile_net::Reconstruction& inverse, const std::string& path) {
  std::ifstream in(path);
  std::ofstream out("/dev/null");
  out << std::setprecision(17);
  std::string line;
  std::getline(in, line);
  std::vector<double> g(taxels);
  std::vector<double> f(taxels);
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    char comma = 0;
    for (double& value : g) fields >> value >> comma;
    if (inverse.solve(g, f) != tactile_net::FrameStatus::ok) std::abort();
    for (const double value : f) out << value << ',';
    out << '\n';
  }
}

}  // namespace

int main() {
  using namespace tactile_net;
  const std::string scene_file = SCENES "/array-81.toml";
  const Scene scene = read_scene(scene_file);
  const Reconstruction inverse =
      tikhonov(make_problem(scene.sensor, scene.material,
                            {.smoothing_length = scene.reconstruct.smoothing_length}),
               *scene.reconstruct.alpha);

  constexpr std::size_t frames = 100'000;
  const bench::TemporaryFile csv;
  write_frames(csv.name(), frames);
  const std::vector<std::string> command = {TOOL, "solve", scene_file, "--readings", csv.name()};
  const auto [ours, rival] = bench::compare(
      5, [&] { return bench::run(command); },
      [&] { return bench::in_process([&] { solve_with_iostreams(inverse, csv.name()); }); });
  std::printf(
      "solve, 81 taxels, CSV to CSV: %.0f frames/s; iostream loop %.0f frames/s; ratio %.2f\n",
      frames / ours.seconds, frames / rival.seconds, rival.seconds / ours.seconds);

  const bench::TemporaryFile long_csv;
  write_frames(long_csv.name(), 10 * frames);
  std::vector<std::string> longer = command;
  longer.back() = long_csv.name();
  std::printf("  memory: %.1f MB for 1e5 frames, %.1f MB for 1e6\n", ours.megabytes,
              bench::run(longer).megabytes);
}
