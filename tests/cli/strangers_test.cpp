// Files from strangers: each attack is tried on the command as it would come, and must not succeed.
#include <sys/stat.h>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;
namespace fs = std::filesystem;

namespace {

const std::string deck_header = "T\n* expect a 1\n";
const std::string circuit = "r1 a 0 1k\ni1 0 a 1m\n";

const std::string finger_touched_by =
    "[[finger]]\nbase = [0.0, 0.0]\nlinks = [1.0]\nangles = [0.5]\n"
    "pad = { center = 0.5, side = \"left\" }\ncontact = ";

}  // namespace

TEST_CASE("no deck runs a command", "[cli][spice][strangers]") {
  const Folder folder;
  const std::string mark = folder / "ran";
  const std::string evil =
      folder.write("evil.inc", ".control\nshell touch " + mark + "\n.endc\n.subckt x a\n.ends\n");
  const std::string script = folder.write("p.sh", "#!/bin/sh\ntouch " + mark + "\n");
  fs::permissions(script, fs::perms::owner_all);
  const std::string commands = ".control\nshell touch " + mark + "\n.endc\n";
  for (const std::string& deck :
       {"*ng_script\nshell touch " + mark + "\n",
        deck_header + circuit + ".include " + evil + "\n.op\n.end\n",
        deck_header + circuit + ".lib " + evil + " x\n.op\n.end\n",
        deck_header + circuit + " .INC\n+ " + evil + "\n.op\n.end\n",
        deck_header + circuit + commands + ".op\n.end\n",
        deck_header + circuit + "\t.CONTROL\n shell touch " + mark + "\n .endc\n.op\n.end\n",
        deck_header + circuit +
            "aproc [d1] d1 null [d2] proc\n.model proc d_process(process_file=\"" + script +
            "\")\n.op\n.end\n",
        deck_header + circuit + "afile %vd([b 0]) src\n.model src filesource (file=\"" + evil +
            "\")\n.op\n.end\n",
        deck_header + circuit + "r2 a 0 `touch " + mark + "`\n.op\n.end\n",
        deck_header + circuit + ".options shell=\"touch " + mark + "\"\n.op\n.end\n"}) {
    CAPTURE(deck);
    const std::string path = folder.write("s.cir", deck);
    const ProcessResult result = run_tool({"relax", path});
    CHECK(result.code == 2);
    CHECK_THAT(result.errors, ContainsSubstring("s.cir:") && ContainsSubstring("hint: "));
    CHECK(result.output.empty());
    CHECK_FALSE(fs::exists(mark));
  }
  // Commands behind the end, as decks of ours have them to print the answer, are left out.
  CHECK(run_tool({"relax", folder.write("e.cir", deck_header + circuit + ".op\n.end\n" + commands)})
            .code == 0);
  CHECK_FALSE(fs::exists(mark));
  // Comments are none of the simulator's business.
  const std::string comments = deck_header + circuit + "*# shell touch " + mark +
                               "\n\t*# quit 1\n.op\n" + ".end\n*# shell touch " + mark + "\n";
  CHECK(run_tool({"relax", folder.write("c.cir", comments)}).code == 0);
  CHECK_FALSE(fs::exists(mark));
}

TEST_CASE("the simulator's variables are no way in", "[cli][spice][strangers]") {
  const Folder folder;
  const std::string mark = folder / "ran";
  folder.write(".spiceinit", "shell touch " + mark + "\n");
  folder.write("spinit", "shell touch " + mark + "\n");
  const std::string deck = folder.write("s.cir", deck_header + circuit + ".op\n.end\n");
  const std::string here = folder.path().string();
  const ProcessResult result = run_process({"env", "HOME=" + here, "SPICE_SCRIPTS=" + here,
                                            "SPICE_USERINIT_DIR=" + here, TOOL, "relax", deck},
                                           {.folder = folder.path()});
  CHECK(result.code == 0);
  CHECK_FALSE(fs::exists(mark));
}

TEST_CASE("decks of every realisation and option pass", "[cli][spice][strangers]") {
  const Folder folder;
  const std::string base =
      "[sensor]\ncount = 5\npitch = 0.5\ndepth = 1.5\nreads = [\"strain_x\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
      "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 1.0\n"
      "[reconstruct]\nmethods = [\"network\"]\nalpha = 1e-3\nsmoothing_length = 1.0\n[network]\n";
  int taken = 0;
  for (const std::string realization :
       {"ideal", "nic", "rail", "crossbar", "least_squares", "lattice", "lc", "ndr"})
    for (const std::string& options :
         {std::string(), std::string("opamp = { bandwidth = 1e6 }\n"),
          std::string("opamp = { bandwidth = 1e6, second_pole = 2e6, offset = 1e-4 }\n"),
          std::string("opamp = { gain = 1e5, supply = 12.0 }\n"),
          std::string("parasitic = { node = 1e-12, input = 1e-12 }\n"),
          std::string("tolerance = { relative = 0.01 }\n")}) {
      CAPTURE(realization, options);
      const std::string path =
          folder.write("s.toml", base + "realization = \"" + realization + "\"\n" + options);
      const std::string deck = folder / "s.cir";
      if (run_tool({"gen", path, "-o", deck}).code != 0)
        continue;  // no such option for this circuit
      const ProcessResult result = run_tool({"relax", deck});
      CAPTURE(result.errors);
      CHECK(result.code != 2);
      ++taken;
    }
  CHECK(taken > 25);
}

TEST_CASE("a hand reads no file beyond its folder, and quotes none", "[cli][strangers]") {
  const Folder folder;
  fs::create_directory(folder / "hand");
  folder.write("secret", "root:secret:20228:0\n");
  folder.write("hand/local", "root:secret:20228:0\n");
  folder.write("hand/twice.csv", "secret,secret\n1,2\n");
  fs::create_symlink(folder / "secret", folder / "hand/link");
  const auto grasp = [&](const std::string& contact, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {
        "grasp", folder.write("hand/hand.toml", finger_touched_by + contact)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tool(arguments);
  };
  for (const std::string& path : {folder / "secret", std::string("../secret"), std::string("link"),
                                  std::string("/etc/passwd"), std::string("/dev/zero")})
    for (const std::string& contact :
         {"{ scene = \"" + path + "\" }", "{ tractions = \"" + path + "\", pitch = 1e-3 }"}) {
      CAPTURE(contact);
      const ProcessResult result = grasp(contact);
      CHECK(result.code == 2);
      CHECK_THAT(result.errors, ContainsSubstring("must name a file beside the hand's file") &&
                                    ContainsSubstring("--allow-outside") &&
                                    !ContainsSubstring("20228") && !ContainsSubstring("root:"));
    }
  for (const std::string& contact : {std::string("{ scene = \"local\" }"),
                                     std::string("{ tractions = \"local\", pitch = 1e-3 }"),
                                     std::string("{ tractions = \"twice.csv\", pitch = 1e-3 }")}) {
    CAPTURE(contact);
    const ProcessResult result = grasp(contact);
    CHECK(result.code == 2);
    CHECK_THAT(result.errors,
               ContainsSubstring("is not in order here") && !ContainsSubstring("secret"));
  }
  const ProcessResult allowed = grasp("{ scene = \"../secret\" }", {"--allow-outside"});
  CHECK_THAT(allowed.errors, ContainsSubstring("secret:1:") && !ContainsSubstring("20228"));
}

TEST_CASE("devices and pipes are no files of a hand, and cost no memory", "[cli][strangers]") {
  const Folder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  for (const std::string& path : {std::string("/dev/zero"), std::string("pipe")}) {
    const std::string hand = folder.write(
        "hand.toml", finger_touched_by + "{ tractions = \"" + path + "\", pitch = 1e-3 }");
    const ProcessResult result = run_process(
        {"sh", "-c",
         "ulimit -v " MEMORY_LIMIT "; exec " TOOL " grasp " + hand + " --allow-outside"},
        {.time_limit = std::chrono::seconds(20)});
    CHECK(result.end == ProcessResult::End::exited);
    CHECK(result.code == 2);
    CHECK_THAT(result.errors, ContainsSubstring("is not a regular file"));
  }
}

TEST_CASE("a deck of expectations alone is refused before it fills the memory",
          "[cli][strangers]") {
  const Folder folder;
  std::string deck = "T\n";
  while (deck.size() < (std::size_t{48} << 20)) deck += "* expect a 1\n";
  const ProcessResult result = run_process(
      {"sh", "-c",
       "ulimit -v " MEMORY_LIMIT "; exec " TOOL " relax " + folder.write("x.cir", deck)});
  CHECK(result.code == 2);
  CHECK_THAT(result.errors, ContainsSubstring("more than 65536 voltages are expected"));
}

TEST_CASE("a header line without an end is refused", "[cli][strangers]") {
  const Folder folder;
  folder.write("t.csv", std::string(std::size_t{8} << 20, 'x'));
  const std::string hand =
      folder.write("hand.toml", finger_touched_by + "{ tractions = \"t.csv\", pitch = 1e-3 }");
  const ProcessResult result = run_tool({"grasp", hand});
  CHECK(result.code == 2);
  CHECK(result.errors.size() < 1000);
}

TEST_CASE("a study to go on with is a file, of bounded size", "[cli][strangers]") {
  const Folder folder;
  fs::create_directory(folder / "out");
  fs::create_symlink("/dev/zero", folder / "out/tradeoff.json");
  const std::string path = folder.write("s.toml", small_scene);
  const ProcessResult result = run_tool({"tradeoff", path, "--out", folder / "out", "--resume"});
  CHECK(result.code == 2);
  CHECK_THAT(result.errors, ContainsSubstring("is not a regular file"));
}

TEST_CASE("no control character reaches the terminal or a page", "[cli][strangers]") {
  const Folder folder;
  const auto harmless = [](const std::string& text) {
    for (const char* bad : {"\x1b", "\x07", "\x7f", "\xC2\x9B", "\u202E", "\r"})
      CHECK_THAT(text, !ContainsSubstring(bad));
    CHECK(text.find('\0') == std::string::npos);
  };
  const std::string title = "title = \"a\\u001b[2Jb\\u0000c\\u009b31m\\u202Ed\\u0007\"\n";
  const std::string path = folder.write("s\x1b]0;x\x07.toml", title + small_scene);
  const ProcessResult run = run_tool({"run", path, "--out", folder / "out"});
  harmless(run.output);
  harmless(run.errors);
  CHECK_THAT(run.output, ContainsSubstring("\\x1b"));
  const std::string page = read_text(folder / "out/report.html");
  harmless(page);
  CHECK_THAT(page, ContainsSubstring("a\\x1b[2Jb"));
  harmless(run_tool({"run", path, "--json", "-"}).output);
  harmless(run_tool({"identify", path}).output);
  harmless(run_tool({"gen", path}).output);

  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", "none\x1b[2J.toml"},
        {"run", path, "--\x1b[2J"},
        {"\x1b[2J"},
        {"relax", folder.write("x.cir", "T\n* expect \x1b[2J x\n" + circuit)},
        {"relax", folder.write("y.cir", deck_header + "\x1b[2J\n" + circuit)},
        {"solve", path, "--readings", folder.write("r.csv", "\x1b[2J,\x1b[2J\n")},
        {"grasp", folder.write("h.toml", "\"\\u001b[2J\" = 1\n")},
        {"gen", path, "-o", folder / "\x1b[2J/none.cir"}}) {
    const ProcessResult result = run_tool(arguments);
    CHECK(result.code == 2);
    CHECK_FALSE(result.errors.empty());
    harmless(result.errors);
  }
}

TEST_CASE("a log that drives the terminal is told harmlessly", "[cli][strangers]") {
  const Folder folder;
  const std::string fake = folder.write("fake", "#!/bin/sh\nprintf 'error: \\033[2J\\n'\nexit 1\n");
  fs::permissions(fake, fs::perms::owner_all);
  const std::string deck = folder.write("s.cir", deck_header + circuit + ".op\n.end\n");
  const ProcessResult result = run_process(
      {"env", "TMPDIR=" + folder.path().string(), TOOL, "relax", deck, "--ngspice", fake});
  CHECK(result.code == 1);
  CHECK_THAT(result.errors, ContainsSubstring("\\x1b[2J") && !ContainsSubstring("\x1b"));
}
