#include "tactile_net/numeric/fft.hpp"
#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

void check(const std::vector<std::string>& arguments, int code, const std::string& message) {
  const ProcessResult result = run_tool(arguments);
  CAPTURE(message, result.errors);
  CHECK(result.end == ProcessResult::End::exited);
  CHECK(result.code == code);
  CHECK_THAT(result.errors, ContainsSubstring(message));
}

}  // namespace

TEST_CASE("wrong usage is told with what was meant", "[cli]") {
  check({}, 2, "a command is required");
  check({"rnu"}, 2, "did you mean 'run'?");
  check({"run"}, 2, "SCENE is required");
  check({"run", scene("nic.toml"), "--no-such-option"}, 2, "--no-such-option");
  check({"gen", scene("nic.toml"), "--realization", "crossbars"}, 2,
        "'crossbars' is none of ideal, nic");
  check({"solve", scene("nic.toml"), "--readings", "-", "--method", "network"}, 2,
        "'network' is none of dft, tikhonov, closed_form");
  check({"solve", scene("nic.toml"), "--readings", "no-such.csv"}, 2, "cannot be opened");
  check({"solve", scene("nic.toml"), "--readings", "/"}, 2, "is a folder");
  check({"relax", scene("nic.toml"), "--time-limit", "0"}, 2, "must be > 0");
}

TEST_CASE("help and version are no failures", "[cli]") {
  for (const char* command : {"run", "gen", "relax", "solve", "grasp"})
    CHECK(run_tool({command, "--help"}).code == 0);
  CHECK(run_tool({"--help"}).code == 0);
  CHECK_THAT(run_tool({"--version"}).output,
             StartsWith("tactile-net ") && ContainsSubstring(std::string(name(fft_library()))));
}

TEST_CASE("a scene that is none is refused", "[cli]") {
  const Folder folder;
  check({"run", folder.path().string()}, 2, "is a folder");
  check({"run", folder / "none.toml"}, 2, "no such file");
  check({"run", folder.write("empty.toml", "")}, 2, "the scene is empty");
  check({"run", folder.write("binary.toml", std::string("a\0b", 3))}, 2, "it holds a zero byte");
  check({"run", "/dev/zero"}, 2, "not a regular file");
  const std::string big = folder.write("big.toml", "");
  std::filesystem::resize_file(big, 1u << 30);
  std::string deep_key = "a";
  for (int i = 0; i < 1'000'000; ++i) deep_key += ".a";  // overflows a recursive parser's stack
  check({"run", folder.write("deep.toml", deep_key + " = 1\n")}, 2, "deep.toml:1:");
  check({"run", big}, 2, "is larger than 16 MiB");
}

TEST_CASE("an output that cannot be made is told before anything is computed", "[cli]") {
  const Folder folder;
  const std::string file = folder.write("file", "mine");
  check({"run", scene("nic.toml"), "--out", file}, 2, "is a file, not a folder");
  check({"run", scene("nic.toml"), "--out", "/proc/nowhere"}, 2, "cannot be written to");
  check({"gen", scene("nic.toml"), "-o", folder / "none/x.cir"}, 2, "cannot be created");
  check({"gen", scene("nic.toml"), "-o", folder.path().string()}, 2, "is a folder");
  CHECK(read_text(file) == "mine");
}

TEST_CASE("a full disk is a failure", "[cli]") {
  check({"gen", scene("nic.toml"), "-o", "/dev/full"}, 1, "could not be written");
  check({"solve", scene("recorded/thick-pad.toml"), "--readings", scene("recorded/thick-pad.csv"),
         "-o", "/dev/full"},
        1, "could not be written");
}

TEST_CASE("a scene without a contact says that its readings are noise", "[cli]") {
  const Folder folder;
  const std::string pad =
      "[sensor]\ncount = 21\npitch = 0.5\ndepth = 1.0\nreads = [\"stress_x\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n[noise]\nrms = 1e-3\n";
  const std::string by_rule = folder.write("rule.toml", pad);
  const std::string given = folder.write("given.toml", pad + "[reconstruct]\nalpha = 1e-3\n");
  CHECK_THAT(run_tool({"run", by_rule}).output, ContainsSubstring("its readings are noise"));
  for (const char* command : {"certify", "gen", "relax"}) {
    CAPTURE(command);
    const ProcessResult result = run_tool({command, by_rule});
    CHECK(result.code == 2);
    CHECK_THAT(result.errors, ContainsSubstring("would be chosen on noise"));
    CHECK(result.output.empty());
    CHECK(run_tool({command, given}).code == 0);
  }
}
