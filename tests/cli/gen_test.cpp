#include <filesystem>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

TEST_CASE("a sub-circuit and its symbol are both there, or neither is", "[cli]") {
  const Folder folder;
  // So small that all of it is written at the end.
  const std::string three =
      folder.write("s.toml",
                   "[sensor]\ncount = 3\npitch = 0.5\ndepth = 1.5\nreads = [\"strain_x\"]\n"
                   "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
                   "[[contact]]\nshape = \"cylinder\"\nhalf_width = 0.5\nforce = 1.0\n"
                   "[reconstruct]\nmethods = [\"network\"]\nalpha = 1e-3\nsmoothing_length = 1.0\n"
                   "[network]\nrealization = \"ideal\"\n");
  const auto gen = [&](const std::string& deck, const std::string& symbol) {
    return run_tool({"gen", three, "--subcircuit", "pad", "-o", deck, "--symbol", symbol});
  };
  const std::string deck = folder / "pad.lib";
  const std::string symbol = folder / "pad.asy";
  CHECK(gen("/dev/full", symbol).code == 1);
  CHECK_FALSE(std::filesystem::exists(symbol));
  CHECK(gen(deck, "/dev/full").code == 1);
  CHECK_FALSE(std::filesystem::exists(deck));
  CHECK(gen(deck, symbol).code == 0);
  CHECK(std::filesystem::exists(deck));
  CHECK_THAT(read_text(symbol), ContainsSubstring("SYMATTR ModelFile pad.lib\n"));
}

TEST_CASE("relax compares the circuit with the direct solve", "[cli][spice]") {
  const ProcessResult result = run_tool({"relax", scene("nic.toml")});
  CHECK(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("114 op-amps") && ContainsSubstring("(agrees"));
  CHECK_THAT(run_tool({"relax", scene("nic.toml"), "--json", "-"}).output,
             StartsWith("{") && ContainsSubstring("\"difference_to_direct\""));
}

TEST_CASE("the deck on standard output is byte for byte the deck in a file", "[cli]") {
  const Folder folder;
  const std::string deck = folder / "x.cir";
  REQUIRE(run_tool({"gen", scene("nic.toml"), "-o", deck}).code == 0);
  const std::string text = read_text(deck);
  CHECK_THAT(text, StartsWith("* tactile-net ") && ContainsSubstring("realization nic"));
  CHECK(run_tool({"gen", scene("nic.toml")}).output == text);
  CHECK(run_tool({"gen", scene("nic.toml"), "-o", "-"}).output == text);
}
