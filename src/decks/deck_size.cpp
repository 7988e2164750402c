#include "decks/deck_size.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>
#include <vector>

#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::decks {
namespace {

constexpr double most_elements = 1e7;
constexpr int deepest = 100;

struct Body {
  std::size_t elements = 0;              ///< of its own
  std::vector<const DeckCard*> calls{};  ///< X cards
  double total = -1.0;                   ///< with those it contains; < 0: not counted yet
  bool open = false;                     ///< is being counted
};

std::vector<std::string> tokens(const std::string& text) {
  std::string spaced;
  for (const char c : text)
    if (c == '=')
      spaced += " = ";
    else
      spaced += c == '(' || c == ')' || c == ',' ? ' ' : c;
  std::istringstream words(spaced);
  std::vector<std::string> all;
  for (std::string word; words >> word;) all.push_back(word);
  return all;
}

/// The sub-circuit that an X card names: the last word before its parameters.
std::string called_by(const DeckCard& card) {
  const std::vector<std::string> words = tokens(card.text);
  auto end = std::find(words.begin(), words.end(), "params:");
  const auto sign = std::find(words.begin(), words.end(), "=");
  if (sign < end) end = sign - 1;
  return end - words.begin() >= 2 ? *(end - 1) : "";
}

class Count {
 public:
  explicit Count(const std::string& file) : file_(file) {}

  void read(const DeckText& deck) {
    std::vector<const DeckCard*> opened;
    std::vector<std::string> names{""};  // of the bodies that are open, the deck's own first
    for (const DeckCard& card : deck.cards) {
      const char kind = card.text.front();
      Body& body = bodies_[names.back()];
      if (card.text.starts_with(".subckt")) {
        const std::vector<std::string> words = tokens(card.text);
        if (words.size() < 2) fail(card, "a .subckt has a name and pins", ".subckt opamp p n out");
        names.push_back(words[1]);
        opened.push_back(&card);
      } else if (card.text.starts_with(".ends")) {
        if (opened.empty()) fail(card, "ends no .subckt", "remove it");
        names.pop_back();
        opened.pop_back();
      } else if (kind == 'x') {
        body.calls.push_back(&card);
      } else if (kind != '.') {
        ++body.elements;
      }
    }
    if (!opened.empty()) fail(*opened.back(), "this .subckt is not closed", "close it with .ends");
  }

  /// Of definitions with the same name the sum: more than any of them.
  double total(const std::string& name, const DeckCard* caller, int depth = 0) {
    const auto found = bodies_.find(name);
    if (found == bodies_.end() || name.empty() == (caller != nullptr)) {
      if (caller == nullptr) return 0.0;
      fail(*caller, "'" + name + "' is not a sub-circuit of this deck",
           "copy its .subckt into the deck; libraries are not read");
    }
    Body& body = found->second;
    if (body.open) fail(*caller, "sub-circuit '" + name + "' contains itself", "break the circle");
    if (body.total >= 0.0) return body.total;
    if (depth > deepest) fail(*caller, "sub-circuits are nested too deep", "at most 100 levels");
    body.open = true;
    body.total = static_cast<double>(body.elements);
    for (const DeckCard* call : body.calls) {
      body.total += total(called_by(*call), call, depth + 1);
      if (body.total > most_elements)
        fail(*call, "the circuit has more than ten million elements", "make it smaller");
    }
    body.open = false;
    return body.total;
  }

 private:
  [[noreturn]] void fail(const DeckCard& card, const std::string& message,
                         const std::string& hint) const {
    throw InputError({Diagnostic{file_, card.line, card.column, message, hint, {}, 1}});
  }

  const std::string& file_;
  std::map<std::string, Body> bodies_;
};

}  // namespace

double check_size(const DeckText& deck, const std::string& file) {
  Count count(file);
  count.read(deck);
  return count.total("", nullptr);
}

}  // namespace tactile_net::decks
