// Writes thesis.md and its pictures into a folder: chapters 2 to 4 of the source, computed anew.
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "docs/figures/thesis/chapter.hpp"
#include "docs/figures/thesis/gnuplot.hpp"
#include "tactile_net/frames/output_file.hpp"

namespace {

using namespace tactile_net::thesis;

constexpr const char* introduction =
    R"(# The thesis, computed anew

R. Yang, *Tactile Perception for Multifingered Hands*, M.S. thesis, University of Maryland, 1987: every figure and number of
its chapters 2 to 4, by this library. Written by `tactile-net-thesis docs` (target `tactile_net_thesis`); no number of ours
here is typed in, those of the thesis are. The scenes in `scenes/thesis` run the examples with the command.

)";

std::string page(const std::filesystem::path& folder) {
  std::string text = introduction;
  for (const auto make :
       {kernels, example_3_1, example_3_2, forty_one_sensors, example_4_1, example_4_2, errata}) {
    const Chapter chapter = make();
    const std::vector<std::string> pictures =
        chapter.plots.empty() ? std::vector<std::string>{} : draw(chapter.plots);
    std::string part = chapter.text;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      tactile_net::frames::write_file(folder / "thesis" / (chapter.names[i] + ".svg"), pictures[i]);
      const std::string mark = "{" + std::to_string(i) + "}";
      part.replace(part.find(mark), mark.size(),
                   "![" + chapter.plots[i].title + "](thesis/" + chapter.names[i] + ".svg)");
    }
    text += part;
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: tactile-net-thesis FOLDER\n";
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder / "thesis");
    tactile_net::frames::write_file(folder / "thesis.md", page(folder));
  } catch (const std::exception& error) {
    std::cerr << "tactile-net-thesis: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
