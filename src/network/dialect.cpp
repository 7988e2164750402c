#include "tactile_net/network/dialect.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string>
#include <vector>

#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

constexpr std::array<std::string_view, 3> names = {"ngspice", "ltspice", "xyce"};

/// Packages that Xyce's `.options` is followed by, of those that decks have a use for.
constexpr std::array<std::string_view, 5> xyce_packages = {"timeint", "nonlin", "linsol", "device",
                                                           "output"};

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& one : result) one = static_cast<char>(std::tolower(static_cast<unsigned char>(one)));
  return result;
}

std::vector<std::string> words_of(const std::string& card) {
  std::vector<std::string> words;
  std::size_t at = 0;
  while ((at = card.find_first_not_of(" \t", at)) != std::string::npos) {
    const std::size_t end = card.find_first_of(" \t", at);
    words.push_back(card.substr(at, end - at));
    if (end == std::string::npos) break;
    at = end;
  }
  return words;
}

/// One deck, as far as it has been read.
struct Reading {
  Dialect dialect;
  bool says_untested = false;  // of negative resistors
  bool analysis = false;
  bool prints = false;
};

using Words = std::vector<std::string>;

bool is_negative_resistor(const Words& words) {
  double ohm = 0.0;
  return words[0][0] == 'r' && words.size() > 3 && read_number(words[3], ohm) && ohm < 0.0;
}

/// A card that a dialect does not take, and why.
struct Rule {
  std::string_view why;
  bool (*breaks)(const std::string& card, const Words& words, const Reading& reading);
};

constexpr std::array rules = {
    Rule{"'^' in a B card is a power to ngspice and an exclusive or to LTspice: write the product",
         [](const std::string& card, const Words&, const Reading&) {
           return card[0] == 'b' && card.find('^') != std::string::npos;
         }},
    Rule{"noopac is an option of ngspice alone",
         [](const std::string& card, const Words& words, const Reading& reading) {
           return reading.dialect != Dialect::ngspice && words[0].starts_with(".option") &&
                  card.find("noopac") != std::string::npos;
         }},
    Rule{"Xyce's .options wants a package first, such as timeint",
         [](const std::string&, const Words& words, const Reading& reading) {
           return reading.dialect == Dialect::xyce && words[0].starts_with(".option") &&
                  (words.size() < 2 || std::find(xyce_packages.begin(), xyce_packages.end(),
                                                 words[1]) == xyce_packages.end());
         }},
    Rule{".save means another thing to Xyce, whose results need .print",
         [](const std::string&, const Words& words, const Reading& reading) {
           return reading.dialect == Dialect::xyce && words[0] == ".save";
         }},
    Rule{"Xyce wants a B card's current in braces: I={...}",
         [](const std::string& card, const Words&, const Reading& reading) {
           return reading.dialect == Dialect::xyce && card[0] == 'b' &&
                  card.find("i={") == std::string::npos;
         }},
    Rule{"Xyce wants a sub-circuit's parameters behind PARAMS:",
         [](const std::string& card, const Words& words, const Reading& reading) {
           return reading.dialect == Dialect::xyce && (words[0] == ".subckt" || card[0] == 'x') &&
                  card.find('=') != std::string::npos && card.find("params:") == std::string::npos;
         }},
    Rule{"negative resistors are not known to work in this simulator, and the deck does not say so",
         [](const std::string&, const Words& words, const Reading& reading) {
           return reading.dialect != Dialect::ngspice && !reading.says_untested &&
                  is_negative_resistor(words);
         }},
};

[[noreturn]] void fail(std::size_t line, Dialect dialect, std::string_view why) {
  throw std::invalid_argument("a deck for " + std::string(name(dialect)) + ", line " +
                              std::to_string(line) + ": " + std::string(why));
}

}  // namespace

std::string_view name(Dialect dialect) noexcept { return names[static_cast<std::size_t>(dialect)]; }

void check_dialect(std::string_view deck, Dialect dialect) {
  Reading reading{.dialect = dialect};
  reading.says_untested = deck.find(negative_resistors_untested) != std::string_view::npos;
  std::size_t line = 0;
  while (!deck.empty()) {
    const std::size_t end = std::min(deck.find('\n'), deck.size());
    const std::string card = lower(deck.substr(0, std::min(end, deck.find(';'))));
    deck.remove_prefix(std::min(end + 1, deck.size()));
    ++line;
    const Words words = words_of(card);
    if (line == 1 || words.empty() || card[0] == '*') continue;
    for (const Rule& rule : rules)
      if (rule.breaks(card, words, reading)) fail(line, dialect, rule.why);
    const bool runs =
        words[0] == ".op" || words[0] == ".dc" || words[0] == ".ac" || words[0] == ".tran";
    reading.analysis = reading.analysis || runs;
    reading.prints = reading.prints || words[0] == ".print";
  }
  if (dialect == Dialect::xyce && reading.analysis && !reading.prints)
    fail(line, dialect, "Xyce writes no result without .print");
}

}  // namespace tactile_net
