#include "decks/deck_cards.hpp"

#include <cctype>

#include "numeric/lower_case.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::decks {
namespace {

std::string_view without_blanks(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Without what follows `;`, or a `$` that stands for itself. It is left out of what the simulator
/// gets, so that it cannot be read otherwise there.
std::string_view without_comment(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == ';' || (text[i] == '$' && i > 0 && (text[i - 1] == ' ' || text[i - 1] == '\t')))
      return text.substr(0, i);
  return text;
}

/// Gathers a deck's cards, line by line.
class Cutter {
 public:
  Cutter(const std::string& file, DeckText& deck, FirstLine first)
      : file_(file), deck_(deck), first_(first) {}

  void add(std::string_view whole) {
    ++line_;
    const std::string_view text = without_blanks(whole);
    column_ = text.empty() ? 1 : static_cast<std::size_t>(text.data() - whole.data()) + 1;
    if (line_ == 1) check_first(text);
    if (line_ == 1 && first_ == FirstLine::title) return add_title(text);
    if (commands_) {
      commands_ = lower_case(text) != ".endc";
      return;
    }
    if (text.empty() || text.front() == ';' || text.front() == '$') return;
    if (text.front() == '*') return add_comment(text);
    check_characters(without_comment(text));
    const std::string card = lower_case(without_blanks(without_comment(text)));
    commands_ = ended_ && card == ".control";
    if (commands_) return;
    if (ended_) fail("stands behind .end, where a deck is over", "remove it, or move it up");
    if (card.front() == '+')
      add_continuation(card.substr(1));
    else if (card == ".end")
      ended_ = true;
    else if (card.front() == '.' || std::isalpha(static_cast<unsigned char>(card.front())) != 0)
      deck_.cards.push_back({line_, column_, card});
    else
      fail("a card begins with a letter, a dot or +, a comment with *", "remove this line");
  }

 private:
  void check_first(std::string_view text) const {
    if (lower_case(text).starts_with("*ng_script"))
      fail("'*ng_script' makes ngspice run the file as commands, of any kind",
           "a circuit needs none: remove this line, and every command below it");
  }
  void add_title(std::string_view text) {
    if (text.starts_with('*')) add_comment(text);
  }
  void add_comment(std::string_view text) {
    deck_.comments.push_back({line_, lower_case(text.substr(1))});
  }
  void add_continuation(const std::string& text) {
    if (deck_.cards.empty()) fail("continues no card", "a card begins without the +");
    deck_.cards.back().text += ' ' + text;
  }
  /// Printable ASCII without what a simulator's command language, or an older deck's, gives a
  /// meaning that no circuit needs.
  void check_characters(std::string_view text) {
    for (const char c : text) {
      const bool printed = c == '\t' || (c >= 0x20 && c < 0x7F);
      if (printed && std::string_view("\"\\`$%").find(c) == std::string_view::npos) continue;
      fail("a card has no place for the character '" + std::string(1, c) + "'",
           "names are made of ASCII letters, digits and _; text in quotes is not allowed");
    }
  }
  [[noreturn]] void fail(const std::string& message, const std::string& hint) const {
    throw InputError({Diagnostic{file_, line_, column_, message, hint, {}, 1}});
  }

  const std::string& file_;
  DeckText& deck_;
  FirstLine first_;
  std::size_t line_ = 0;
  std::size_t column_ = 1;
  bool ended_ = false;
  bool commands_ = false;  ///< between .control and .endc, behind .end
};

}  // namespace

DeckText deck_cards(std::string_view text, const std::string& file, FirstLine first) {
  DeckText deck;
  Cutter cutter(file, deck, first);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    cutter.add(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return deck;
}

}  // namespace tactile_net::decks
