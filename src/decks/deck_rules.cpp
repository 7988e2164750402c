#include "decks/deck_rules.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include "decks/deck_size.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::decks {
namespace {

constexpr std::string_view elements = "rclefghivbdx";
constexpr std::string_view more_of_macromodels = "sqjmtwk";
constexpr std::array<std::string_view, 10> dot_cards = {
    ".subckt", ".ends", ".model", ".param", ".ic", ".op", ".tran", ".ac", ".options", ".option"};
constexpr std::array<std::string_view, 5> dot_cards_of_macromodels = {".subckt", ".ends", ".model",
                                                                      ".param", ".func"};
constexpr std::array<std::string_view, 7> model_types = {"r", "res", "c", "cap", "l", "ind", "d"};

constexpr std::array<std::string_view, 10> more_model_types = {
    "npn", "pnp", "njf", "pjf", "nmos", "pmos", "sw", "csw", "vswitch", "iswitch"};

/// How equations are solved. Other options become variables of ngspice's command language.
constexpr std::array<std::string_view, 30> known_options = {
    "abstol",   "autostop", "chgtol", "cshunt", "gmin",   "gminsteps", "interp", "itl1",
    "itl2",     "itl3",     "itl4",   "itl5",   "itl6",   "klu",       "maxord", "method",
    "noopac",   "noopiter", "numdgt", "pivrel", "pivtol", "reltol",    "rshunt", "sparse",
    "srcsteps", "temp",     "tnom",   "trtol",  "vntol",  "xmu"};

/// What a refused card would do, and what to do instead.
struct Refusal {
  std::string_view card;
  std::string_view why;
  std::string_view hint;
};
constexpr std::string_view copy_it = "copy what the circuit needs of that file into this one";
constexpr std::string_view no_commands =
    "a deck that is relaxed has no commands; its header says what to expect: * expect n0 1.25e-3";
constexpr std::array refusals = {
    Refusal{".include", "reads another file, which may hold commands", copy_it},
    Refusal{".inc", "reads another file, which may hold commands", copy_it},
    Refusal{".incl", "reads another file, which may hold commands", copy_it},
    Refusal{".lib", "reads another file, which may hold commands", copy_it},
    Refusal{".control", "begins commands to ngspice, of any kind", no_commands},
    Refusal{".endc", "ends commands to ngspice", no_commands},
};

template <std::size_t N>
bool is_one_of(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Names, numbers and such, without blanks, signs and brackets.
std::vector<std::string_view> words_in(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const auto begin = std::find_if(text.begin(), text.end(), in_word);
    const auto end = std::find_if_not(begin, text.end(), in_word);
    if (begin != end) words.emplace_back(begin, end);
    text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
  }
  return words;
}

std::size_t fields_in(std::string_view text) {
  std::size_t count = 0;
  bool inside = false;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\t';
    if (!blank && !inside) ++count;
    inside = !blank;
  }
  return count;
}

/// Of an element that only macromodels have: its name, its nodes, its model.
std::size_t least_fields(char letter) {
  if (letter == 's' || letter == 'm') return 6;
  return letter == 'k' ? 4 : 5;
}

std::string_view first_word(std::string_view text) {
  return text.substr(0, text.find_first_of(" \t"));
}

class Rules {
 public:
  Rules(const std::string& file, DeckKind kind)
      : file_(file), macromodel_(kind == DeckKind::macromodel) {}

  void check(const DeckCard& card) const {
    if (card.text.front() == '.')
      check_dot(card);
    else
      check_element(card);
    for (const std::string_view word : words_in(card.text))
      if (word.find("file") != std::string_view::npos)
        fail(card, "'" + std::string(word) + "' names a file, which a circuit need not read",
             "write values into the deck; rename what is only called so");
  }

 private:
  void check_element(const DeckCard& card) const {
    const char letter = card.text.front();
    if (elements.find(letter) != std::string_view::npos) return;
    if (macromodel_ && more_of_macromodels.find(letter) != std::string_view::npos) {
      // "shell ls" begins as a switch does.
      if (fields_in(card.text) >= least_fields(letter)) return;
      fail(
          card, "'" + std::string(first_word(card.text)) + "' is neither an element nor a card",
          "remove it: commands do not run, and a transistor, switch or line has nodes and a model");
    }
    const std::string name(first_word(card.text));
    if (letter == 'a')
      fail(card, "'" + name + "' is a code model (A), which may open files and start programs",
           "build it of R, C, L, controlled and B sources");
    fail(card, "'" + name + "' is an element of a kind that is not allowed",
         macromodel_ ? "only R C L E F G H I V B D X S W Q J M T and K are allowed"
                     : "only R C L E F G H I V B D and X are allowed");
  }

  void check_dot(const DeckCard& card) const {
    const std::string_view word = first_word(card.text);
    if (word == ".model") return check_model(card);
    if (!macromodel_ && (word == ".options" || word == ".option")) return check_options(card);
    if (macromodel_ ? is_one_of(dot_cards_of_macromodels, word) : is_one_of(dot_cards, word))
      return;
    for (const Refusal& refusal : refusals)
      if (word == refusal.card)
        fail(card, "'" + std::string(word) + "' " + std::string(refusal.why),
             std::string(refusal.hint));
    fail(card, "'" + std::string(word) + "' is a card that is not allowed",
         macromodel_
             ? "only .subckt .ends .model .param and .func are allowed: remove the others"
             : "only .subckt .ends .model .param .ic .op .tran .ac .options .end are allowed: "
               "remove the others");
  }

  void check_model(const DeckCard& card) const {
    const std::vector<std::string_view> words = words_in(card.text);
    if (words.size() >= 3 && (is_one_of(model_types, words[2]) ||
                              (macromodel_ && is_one_of(more_model_types, words[2]))))
      return;
    const std::string type(words.size() >= 3 ? words[2] : "");
    fail(card,
         "'" + type +
             "' is a kind of model that is not allowed: it may open files or start programs",
         std::string(macromodel_ ? "only the models r, c, l, d, of transistors and of switches"
                                 : "only the models r, c, l and d") +
             " are allowed, with the type behind the name: .model clamp "
             "d(is=1e-14)");
  }

  /// The words that stand for themselves or before `=`; behind it is a value.
  void check_options(const DeckCard& card) const {
    std::string_view rest = std::string_view(card.text).substr(first_word(card.text).size());
    while (!rest.empty()) {
      const auto begin = std::find_if(rest.begin(), rest.end(), in_word);
      const auto end = std::find_if_not(begin, rest.end(), in_word);
      const std::string_view name(begin, end);
      rest.remove_prefix(static_cast<std::size_t>(end - rest.begin()));
      if (name.empty()) return;
      if (!is_one_of(known_options, name))
        fail(card, "'" + std::string(name) + "' is an option that is not allowed",
             "only those of solving are allowed: method, reltol, abstol, vntol, gmin, itl1, ...");
      const std::size_t sign = rest.find_first_not_of(" \t");
      if (sign == std::string_view::npos || rest[sign] != '=') continue;
      rest.remove_prefix(sign + 1);
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
      rest.remove_prefix(std::min(rest.find_first_of(" \t,"), rest.size()));
    }
  }

  [[noreturn]] void fail(const DeckCard& card, const std::string& message,
                         const std::string& hint) const {
    throw InputError({Diagnostic{file_, card.line, card.column, message, hint, {}, 1}});
  }

  const std::string& file_;
  bool macromodel_;
};

}  // namespace

void check_cards(const DeckText& deck, const std::string& file, DeckKind kind) {
  const Rules rules(file, kind);
  for (const DeckCard& card : deck.cards) rules.check(card);
  (void)check_size(deck, file);
}

}  // namespace tactile_net::decks
