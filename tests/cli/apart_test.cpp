// No command replaces what it reads, however the file is named.
#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;
namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

/// A scene that is complete for every command, frames of it, and a study of it.
struct Inputs {
  Folder folder;
  std::string pad =
      folder.write("pad.toml", small_scene +
                                   "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\n"
                                   "force = 1.0\n");
  std::string frames =
      folder.write("frames.csv", "stress_x_0,stress_x_1,stress_x_2\n0.1,0.5,0.1\n0.2,0.6,0.2\n");
  std::string study = folder.write(
      "study.toml", "scene = \"pad.toml\"\n[[axis]]\nkey = \"sensor.depth\"\nvalues = [1.0]\n");
  std::string link = folder / "link";

  Inputs() { fs::create_symlink("frames.csv", link); }
};

}  // namespace

TEST_CASE("no command replaces a file that it reads", "[cli]") {
  const Inputs in;
  const std::string out = in.folder / "out";
  const Words solve = {"solve", in.pad, "--readings", in.frames};
  const std::pair<Words, Words> wrong[] = {
      {solve, {"-o", in.frames}},
      {solve, {"-o", in.folder / "./frames.csv"}},
      {solve, {"-o", in.link}},
      {solve, {"-o", in.pad}},
      {solve, {"--out", out, "--json", in.frames}},
      {solve, {"-o", out, "--uncertainty", in.frames}},
      {{"solve", in.pad, "--readings", in.link}, {"-o", in.frames}},
      {{"simulate", in.pad}, {"-o", in.pad}},
      {{"simulate", in.pad, "-o", out}, {"--truth", in.pad}},
      {{"simulate", in.pad, "-o", out}, {"--json", in.pad}},
      {{"check", in.pad, "--readings", in.frames}, {"--json", in.frames}},
      {{"check", in.pad, "--readings", in.frames}, {"--json", in.pad}},
      {{"sweep", in.study, "-o", out}, {"--json", in.study}},
      {{"sweep", in.study}, {"-o", in.study}},
      {{"plan", in.pad, "--readings", in.frames}, {"-o", in.frames}},
      {{"plan", in.pad}, {"--json", in.pad}},
      {{"identify", in.pad}, {"--json", in.pad}},
      {{"gen", in.pad}, {"-o", in.pad}},
      {{"run", in.pad}, {"--json", in.pad}},
  };
  const Words names = {in.pad, in.frames, in.study};
  Words before;
  for (const std::string& name : names) before.push_back(read_text(name));
  for (const auto& [command, output] : wrong) {
    Words words = command;
    words.insert(words.end(), output.begin(), output.end());
    CAPTURE(command[0], output.back());
    const ProcessResult result = run_tool(words);
    CHECK(result.code == 2);
    CHECK_THAT(result.errors,
               ContainsSubstring("is the file that is read") && ContainsSubstring("name another"));
  }
  for (std::size_t i = 0; i < names.size(); ++i) CHECK(read_text(names[i]) == before[i]);
  CHECK_FALSE(fs::exists(out));
}

TEST_CASE("two outputs need a file each; devices may be named twice", "[cli]") {
  const Inputs in;
  const ProcessResult same = run_tool({"solve", in.pad, "--readings", in.frames, "-o",
                                       in.folder / "a", "--json", in.folder / "b/../a"});
  CHECK(same.code == 2);
  CHECK_THAT(same.errors, ContainsSubstring("they need one each"));
  CHECK_FALSE(fs::exists(in.folder / "a"));
  CHECK(
      run_tool({"solve", in.pad, "--readings", in.frames, "-o", "/dev/null", "--json", "/dev/null"})
          .code == 0);
}

TEST_CASE("standard output holds one document", "[cli]") {
  const Inputs in;
  const std::string log = scene("calibration/rod-layer.csv");
  const std::string toml = scene("calibration/rod-layer.toml");
  const std::string file = in.folder / "out";
  const Words solve = {"solve", in.pad, "--readings", in.frames};
  const Words plan = {"plan", in.pad};
  const Words simulate = {"simulate", in.pad};
  const Words calibrate = {"calibrate", log, "--scene", toml};
  struct Case {
    Words command;
    Words first;   // an output on standard output
    Words second;  // another
  };
  const Case cases[] = {
      {simulate, {}, {"--truth", "-"}},
      {simulate, {"-o", "-"}, {"--json", "-"}},
      {simulate, {"-o", "-"}, {"--truth", "/dev/stdout"}},
      {simulate, {"-o", file, "--truth", "-"}, {"--json", "-"}},
      {solve, {}, {"--uncertainty", "-"}},
      {solve, {}, {"--json", "-"}},
      {solve, {"--out", file, "--json", "-"}, {"--uncertainty", "-"}},
      {plan, {"-o", "-"}, {"--json", "-"}},
      {calibrate, {"-o", "-"}, {"--json", "-"}},
  };
  for (const auto& [command, first, second] : cases) {
    Words words = command;
    words.insert(words.end(), first.begin(), first.end());
    words.insert(words.end(), second.begin(), second.end());
    CAPTURE(words);
    const ProcessResult both = run_tool(words);
    CHECK(both.code == 2);
    CHECK(both.output.empty());
    CHECK_THAT(both.errors, ContainsSubstring("one of the two") && ContainsSubstring("a file"));
    CHECK_FALSE(fs::exists(file));
  }
  // As the message has it: a file for either, and there is no other document.
  const std::string json = in.folder / "s.json";
  CHECK(run_tool({"simulate", in.pad, "--json", json}).output ==
        run_tool({"simulate", in.pad}).output);
  CHECK(run_tool({"simulate", in.pad, "-o", file, "--json", "-"}).output == read_text(json));
  CHECK(run_tool(
            {"solve", in.pad, "--readings", in.frames, "--out", in.folder / "page", "--json", "-"})
            .output.starts_with("{"));
}
