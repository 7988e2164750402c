#include "tactile_net/decks/deck_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>

#include "decks/deck_cards.hpp"
#include "decks/deck_rules.hpp"
#include "numeric/lower_case.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/bounded_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::decks {
namespace {

constexpr std::uintmax_t largest_deck = std::uintmax_t{64} << 20;
constexpr std::size_t most_nodes = 65'536;

[[noreturn]] void refuse(const std::string& path, std::size_t line, const std::string& message,
                         const std::string& hint) {
  throw InputError({Diagnostic{path, line, line == 0 ? 0U : 1U, message, hint, {}, 0}});
}

double number_in(const DeckComment& comment, const std::string& value, const char* example,
                 const std::string& path) {
  double result = 0.0;
  if (!read_number(value, result) || !std::isfinite(result))
    refuse(path, comment.line, "'*" + comment.text.substr(0, 80) + "' does not end with a number",
           example);
  return result;
}

/// What the deck's header expects.
DeckAnswer header_of(const DeckText& deck, const std::string& path) {
  DeckAnswer answer;
  for (const DeckComment& comment : deck.comments) {
    std::istringstream words(comment.text);
    std::string key;
    std::string value;
    words >> key;
    if (key == "expect") {
      NodeAnswer one;
      words >> one.node >> value;
      one.expected = number_in(comment, value, "* expect n0 1.25e-3", path);
      answer.nodes.push_back(one);
      if (answer.nodes.size() > most_nodes)
        refuse(path, comment.line,
               "more than " + std::to_string(most_nodes) + " voltages are expected",
               "one '* expect' line for each node that is compared");
    } else if (key == "within") {
      words >> value;
      answer.within = number_in(comment, value, "* within 1e-9", path);
      if (answer.within < 0.0) refuse(path, comment.line, "a difference allowed must be >= 0", {});
    }
  }
  if (answer.nodes.empty())
    refuse(path, 0, "states no voltage to compare with",
           "for each node a line such as '* expect n0 1.25e-3', as `tactile-net gen` writes them");
  return answer;
}

/// The cards that were checked and nothing else: what the file's text could mean beyond them, to
/// one simulator or another, is not there any more.
std::string as_checked(const DeckText& deck) {
  std::string text = "* deck\n";
  for (const DeckCard& card : deck.cards) text.append(card.text) += '\n';
  return text + ".end\n";
}

}  // namespace

bool is_deck(const std::string& path) {
  constexpr std::array endings = {".cir", ".sp", ".spice", ".net"};
  const std::string name = lower_case(path);
  return std::any_of(endings.begin(), endings.end(),
                     [&](const char* ending) { return name.ends_with(ending); });
}

void refuse_deck(const std::string& path) {
  if (is_deck(path))
    refuse(path, 0, "is a deck; this command takes a scene (TOML)",
           "tactile-net relax takes decks too");
}

DeckAnswer relax_deck(const std::string& path, Simulator& simulator) {
  const DeckText deck = deck_cards(
      bounded_text(path, largest_deck, "the deck of 1500 taxels is about as large"), path);
  check_cards(deck, path);
  DeckAnswer answer = header_of(deck, path);
  std::vector<std::string> names;
  std::vector<double> expected;
  for (const NodeAnswer& one : answer.nodes) {
    names.push_back(one.node);
    expected.push_back(one.expected);
  }
  const OperatingPoint point = operating_point(simulator, as_checked(deck), names);
  answer.ngspice_seconds = point.seconds;
  for (std::size_t i = 0; i < names.size(); ++i) answer.nodes[i].found = point.voltages[i];
  answer.difference = l2_difference(point.voltages, expected);
  return answer;
}

}  // namespace tactile_net::decks
