// Writes docs/bands.md: how often bands hold what they promise.
#include <charconv>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

#include "docs/figures/bands/tables.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/numeric/sha256.hpp"

namespace {

using namespace tactile_net;

constexpr const char* introduction = R"(# How often we are right

The force is 506 N/m, it says, and with 95 %: 493 to 519. How often does the true one lie in there? About 95 times in 100 as long as pad and noise are as the scene says, whatever
presses: the [table](#in-short) below has every kind of array and contact that was tried. If they are not, less often: [what breaks it](#what-breaks-it) says how much, and what to do.

This page is about lines that are answered by the [mixture](scene.md#reconstruct), the default where the noise is stated (what that is: [internals/mixture.md](internals/mixture.md)). Nothing in the
mixture was fitted to these contacts. Of skins there are [ranks](#loads-that-the-model-does-know) here, and contacts in [internals](internals/mixture.md#skins).
)";

struct Arguments {
  std::string file;
  sbc::Options options;
};

std::size_t number(std::string_view option, std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value == 0)
    throw std::invalid_argument(std::string(option) + " must be a whole number > 0, but is '" +
                                std::string(text) + "'");
  return value;
}

Arguments arguments(int argc, char** argv) {
  Arguments given;
  given.options.threads = std::max(1U, std::thread::hardware_concurrency());
  for (int i = 1; i < argc; ++i) {
    const std::string_view one = argv[i];
    if (!one.starts_with("--")) {
      if (!given.file.empty()) throw std::invalid_argument("two files are named");
      given.file = one;
      continue;
    }
    if (one == "--quick") {
      given.options.draws = 200;
      given.options.contacts = 40;
      continue;
    }
    if (i + 1 == argc) throw std::invalid_argument(std::string(one) + " lacks its number");
    const std::size_t value = number(one, argv[++i]);
    if (one == "--seed")
      given.options.seed = value;
    else if (one == "--draws")
      given.options.draws = value;
    else if (one == "--contacts")
      given.options.contacts = value;
    else if (one == "--threads")
      given.options.threads = value;
    else
      throw std::invalid_argument("there is no option " + std::string(one));
  }
  if (given.file.empty()) throw std::invalid_argument("no file is named");
  return given;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments given;
  try {
    given = arguments(argc, argv);
  } catch (const std::invalid_argument& error) {
    std::cerr << "tactile-net-sbc: error: " << error.what()
              << "\nusage: tactile-net-sbc FILE.md [--seed S] [--draws N] [--contacts N] [--quick] "
                 "[--threads N]\n";
    return 2;
  }
  try {
    const sbc::Options& options = given.options;
    std::string picture;
    const sbc::Section ranks = sbc::ranks_section(options, picture);
    const sbc::Section contacts = sbc::contacts_section(options);
    const sbc::Section broken = sbc::broken_section(options);
    const std::string hash = sha256_text(ranks.drawn + contacts.drawn + broken.drawn);
    const std::filesystem::path page = given.file;
    const std::filesystem::path folder = page.parent_path() / page.stem();
    std::filesystem::create_directories(folder);
    frames::write_file(folder / "ranks.svg", picture);
    frames::write_file(
        page, introduction + contacts.text + broken.text + '\n' + ranks.text +
                  sbc::text("\n## Where these numbers come from\n\nWritten by `tactile-net-sbc "
                            "docs/bands.md --seed %llu --draws %zu --contacts %zu` (target "
                            "`tactile_net_sbc`); no number here is typed in. SHA-256 of all its "
                            "draws, readings and truths:\n`%s`.\n",
                            static_cast<unsigned long long>(options.seed), options.draws,
                            options.contacts, hash.c_str()));
  } catch (const std::exception& error) {
    std::cerr << "tactile-net-sbc: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
