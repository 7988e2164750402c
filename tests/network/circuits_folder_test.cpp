// The folder circuits/ for KiCad and others: each file is what a deck would carry.
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tactile_net/network/opamp.hpp"
#include "tactile_net/network/subcircuits.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
namespace fs = std::filesystem;

namespace {

std::string text_of(const std::string& name) {
  std::ifstream file(fs::path(CIRCUITS) / (name + ".lib"), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("the folder's files are what decks carry", "[subcircuits]") {
  for (const Subcircuit& one : subcircuits()) CHECK(text_of(std::string(one.name)) == one.text);
  const std::pair<const char*, OpAmp> steps[] = {
      {"nullor", {}},
      {"gain", {.gain = 1e6}},
      {"one_pole", {.gain = 1e6, .bandwidth = 10e6}},
      {"two_poles", {.gain = 1e6, .bandwidth = 10e6, .second_pole = 20e6}},
      {"clamped", {.gain = 1e6, .bandwidth = 10e6, .rail = 12.0}}};
  std::size_t files = subcircuits().size();
  for (const auto& [step, opamp] : steps) {
    CAPTURE(step);
    CHECK(text_of(std::string("opamp_") + step) ==
          subcircuit_text({"opamp", opamp, Outputs::single}));
    CHECK(text_of(std::string("amplifier_") + step) ==
          subcircuit_text({"amplifier", opamp, Outputs::complementary}));
    files += 2;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(CIRCUITS))
    if (entry.path().extension() == ".lib") --files;
  CHECK(files == 0);
}
