// Decks from strangers: what is taken, what is refused, and what reaches the simulator.
#include "tactile_net/decks/deck_file.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tactile_net/scene/diagnostic.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
namespace fs = std::filesystem;

namespace {

/// Answers 1 V at every node of `header`, and keeps the deck that it got.
class Recorder final : public Simulator {
 public:
  Simulation run(const std::string& deck) override {
    ++runs;
    got = deck;
    return {.plot = {.title = {},
                     .plot = "Operating Point",
                     .points = 1,
                     .names = {"v(a)"},
                     .values = {{1.0}}}};
  }
  int runs = 0;
  std::string got{};
};

struct DeckFile {
  explicit DeckFile(const std::string& text) {
    std::string name = (fs::temp_directory_path() / "tactile-net-deck-XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    folder = name;
    path = (folder / "x.cir").string();
    std::ofstream(path, std::ios::binary) << text;
  }
  ~DeckFile() { fs::remove_all(folder); }
  DeckFile(const DeckFile&) = delete;
  DeckFile& operator=(const DeckFile&) = delete;
  fs::path folder;
  std::string path;
};

/// What the simulator gets of a deck that is taken.
std::string passed(const std::string& text) {
  const DeckFile file(text);
  Recorder simulator;
  (void)decks::relax_deck(file.path, simulator);
  CHECK(simulator.runs == 1);
  return simulator.got;
}

/// The message of a deck that is refused, which no simulator ever saw.
std::string refused(const std::string& text) {
  const DeckFile file(text);
  Recorder simulator;
  std::string message;
  try {
    (void)decks::relax_deck(file.path, simulator);
  } catch (const InputError& error) {
    message = error.what();
  }
  CHECK(simulator.runs == 0);
  CHECK_FALSE(message.empty());
  return message;
}

const std::string head = "title\n* expect a 1\n";
const std::string circuit = "R1 a 0 1k\nI1 0 a 1m\n";

/// The message of a deck whose fifth line is `card`.
std::string with(const std::string& card) {
  return refused(head + circuit + card + "\n.op\n.end\n");
}

}  // namespace

TEST_CASE("every element and card of the list is taken, in any case and indented", "[deck]") {
  const std::string deck = passed(
      "A title. .include \"nothing\" | `ls` $HOME\n* EXPECT A 1\n.PARAM g=1k ; a comment\n"
      "  r1 A 0 {g}\n\tC1 a 0 1p\nL1 a b 1u\nR2 b 0\n+ 2k\n* between\n+ tc1=0 $ and another\n"
      "E1 e 0 a 0 2\nR3 e 0 1k\nF1 0 f V1 1\nG1 0 g a 0 1m\nH1 h 0 V1 1\nI1 0 a DC 1m\nV1 v 0 1\n"
      "B1 k 0 I='V(a,0)*exp(-V(b)/2)^2'\nD1 a 0 clamp\n.model clamp D (is=1e-14)\n.subckt one p q "
      "r=1k\n"
      "R1 p q {r}\n.ends one\nX1 a 0 one r = 2k\nX2 a 0 one params: r=3k\n.ic v(a)=0\n"
      ".options method=trap reltol = 1e-5, noopac\n.OP\r\n.END\n*# quit 0\n\n");
  CHECK_THAT(deck, StartsWith("* deck\n.param g=1k\nr1 a 0 {g}\nc1 a 0 1p\n"));
  CHECK_THAT(deck, ContainsSubstring("\nr2 b 0  2k  tc1=0\n") &&
                       ContainsSubstring("\n.op\n.end\n") && EndsWith(".end\n"));
  // Nothing of the title and of the comments.
  for (const char* text : {"nothing", "quit", "between", "comment", "another", "expect"})
    CHECK_THAT(deck, !ContainsSubstring(text));
}

TEST_CASE("commands behind the end are left out, and nothing else may stand there", "[deck]") {
  const std::string whole = head + circuit + ".op\n.end\n";
  const std::string commands =
      ".control\nset numdgt=17\nrun\nprint v(a)\nshell `ls`\nquit 0\n.endc\n";
  CHECK(passed(whole + commands) == passed(whole));
  CHECK(passed(whole + "\n  .Control\r\nrun\r\n.ENDC\r\n* more\n" + commands) == passed(whole));
  CHECK_THAT(refused(whole + commands + "R2 a 0 1\n"), ContainsSubstring("behind .end"));
  CHECK_THAT(refused(head + circuit + ".op\n.control\nrun\n.endc\n.end\n"),
             ContainsSubstring("commands to ngspice"));
}

TEST_CASE("cards that read files or run commands are refused with what to do", "[deck]") {
  CHECK_THAT(with(".include /etc/passwd"),
             ContainsSubstring("x.cir:5:1: error: '.include' reads another file") &&
                 ContainsSubstring("hint: copy what the circuit needs"));
  CHECK_THAT(with("  .LIB evil.lib x"),
             ContainsSubstring(":5:3: error: '.lib' reads another file"));
  for (const char* card : {".inc x", ".INCL x", ".Include x", "\t.inc x"})
    CHECK_THAT(with(card), ContainsSubstring("reads another file"));
  CHECK_THAT(with(".control\nshell touch x\n.endc"), ContainsSubstring("commands to ngspice"));
  CHECK_THAT(with(" .CONTROL"), ContainsSubstring("commands to ngspice"));
  CHECK_THAT(refused("*ng_script\nshell touch x\n"),
             ContainsSubstring(":1:1:") && ContainsSubstring("makes ngspice run the file"));
  CHECK_THAT(refused(" *NG_SCRIPT foo\n" + head + circuit), ContainsSubstring("ngspice run"));
}

TEST_CASE("devices that open files and start programs are refused", "[deck]") {
  CHECK_THAT(with("aproc [d1] d1 null [d2] proc"), ContainsSubstring("code model (A)"));
  CHECK_THAT(with(".model proc d_process(process_file=\"/bin/sh\")"),
             ContainsSubstring("no place for the character '\"'"));
  CHECK_THAT(with(".model proc d_process(process_file=/bin/sh)"),
             ContainsSubstring("'d_process' is a kind of model"));
  CHECK_THAT(with(".model\n+ src\n+ filesource (file=/etc/passwd)"),
             ContainsSubstring("'filesource' is a kind of model"));
  CHECK_THAT(with("V2 b 0 PWL file=/etc/passwd"), ContainsSubstring("names a file"));
  CHECK_THAT(with("B2 b 0 v=table(infile)"), ContainsSubstring("names a file"));
  for (const char* kind : {"Q1 a b c m", "M1 a b c d m", "N1 a b m", "U1 a b", "S1 a b c d m"})
    CHECK_THAT(with(kind), ContainsSubstring("of a kind that is not allowed"));
}

TEST_CASE("whatever is not known is refused", "[deck]") {
  for (const char* card : {".print v(a)", ".save all", ".func f(x) {x}", ".global a", ".if (1)",
                           ".csparam x=1", ".opt x", ".codemodel x.cm", ".pre_osdi x", ".title x",
                           ".endl", ".opx", ".", ".measure x", ".plot"})
    CHECK_THAT(with(card), ContainsSubstring("is a card that is not allowed"));
  for (const char* option :
       {".options spicepath=/x", ".option sourcepath=(a b)", ".options method=gear editor=x",
        ".options\n+ shell=/bin/sh", ".options filetype=ascii"})
    CHECK_THAT(with(option), ContainsSubstring("not allowed") || ContainsSubstring("names a file"));
  for (const char* line : {"# x", "| x", "1", "=", "(R2 a 0 1)", "@x"})
    CHECK_THAT(with(line), ContainsSubstring("a card begins with a letter"));
  for (const char* line : {"R2 a 0 `touch x`", "R2 a 0 \"1\"", "R2 a 0 1\\\\", "R2 a 0 1$x",
                           "R2 \x1b[2J 0 1", "R2 a 0 1\rshell x", "R2 \xC3\xA4 0 1", "%R2 a 0 1"})
    CHECK_THAT(with(line), ContainsSubstring("no place for the character"));
  CHECK_THAT(refused("t\n+ x\n" + head), ContainsSubstring("continues no card"));
  CHECK_THAT(refused(head + circuit + ".op\n.end\n.include x\n"), ContainsSubstring("behind .end"));
}

TEST_CASE("a control character is not passed on by the message", "[deck]") {
  CHECK_THAT(with("R2 \x1b[2J 0 1"), ContainsSubstring("'\\x1b'") && !ContainsSubstring("\x1b"));
}

TEST_CASE("sub-circuits are as large as they can be, not larger", "[deck]") {
  std::string bomb = head + ".subckt s0 a\nR1 a 0 1\n.ends\n";
  for (int level = 1; level < 12; ++level) {
    bomb += ".subckt s" + std::to_string(level) + " a\n";
    for (int i = 0; i < 10; ++i)
      bomb += "X" + std::to_string(i) + " a s" + std::to_string(level - 1) + "\n";
    bomb += ".ends\n";
  }
  CHECK_THAT(refused(bomb + "X1 a s11\nI1 0 a 1\n.op\n.end\n"),
             ContainsSubstring("more than ten million elements"));
  (void)passed(bomb + "X1 a s3\nI1 0 a 1\n.op\n.end\n");
  CHECK_THAT(refused(head + ".subckt s a\nX1 a s\n.ends\nX1 a s\n.op\n"),
             ContainsSubstring("contains itself"));
  CHECK_THAT(
      refused(head + ".subckt s a\nX1 a t\n.ends\n.subckt t a\nX1 a s\n.ends\nX1 a s\n.op\n"),
      ContainsSubstring("contains itself"));
  CHECK_THAT(with("X1 a none"), ContainsSubstring("'none' is not a sub-circuit of this deck"));
  CHECK_THAT(refused(head + ".subckt s a\n" + circuit), ContainsSubstring("is not closed"));
  CHECK_THAT(with(".ends"), ContainsSubstring("ends no .subckt"));
  std::string deep = head + ".subckt s0 a\nR1 a 0 1\n.ends\n";
  for (int level = 1; level < 20'000; ++level)
    deep += ".subckt s" + std::to_string(level) + " a\nX1 a s" + std::to_string(level - 1) +
            "\n.ends\n";
  CHECK_THAT(refused(deep + "X1 a s19999\n"), ContainsSubstring("nested too deep"));
}

TEST_CASE("a deck is bounded in bytes and in what it expects", "[deck]") {
  std::string many = "t\n";
  while (many.size() < (std::size_t{2} << 20)) many += "* expect a 1\n";
  CHECK_THAT(refused(many + circuit), ContainsSubstring("more than 65536 voltages"));
  const DeckFile large(head);
  fs::resize_file(large.path, (std::size_t{64} << 20) + 1);
  Recorder simulator;
  CHECK_THROWS_WITH(decks::relax_deck(large.path, simulator),
                    ContainsSubstring("larger than 64 MiB"));
  CHECK_THROWS_WITH(decks::relax_deck("/dev/zero", simulator),
                    ContainsSubstring("not a regular file"));
  const std::string pipe = (large.folder / "pipe.cir").string();
  REQUIRE(std::system(("mkfifo " + pipe).c_str()) == 0);
  CHECK_THROWS_WITH(decks::relax_deck(pipe, simulator), ContainsSubstring("not a regular file"));
  CHECK(simulator.runs == 0);
}

TEST_CASE("every shipped library's cards are taken", "[deck]") {
  int libraries = 0;
  for (const auto& entry : fs::directory_iterator(CIRCUITS)) {
    if (!entry.is_regular_file()) continue;  // data sheets of parts
    std::ifstream file(entry.path());
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    CAPTURE(entry.path());
    (void)passed(head + circuit + text + ".op\n.end\n");
    ++libraries;
  }
  CHECK(libraries == 13);
}
