#include "deck_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "tactile_net/inverse/comparison.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::tool {
namespace {

[[noreturn]] void refuse(const std::string& path, std::size_t line, const std::string& message,
                         const std::string& hint) {
  throw InputError({Diagnostic{path, line, line == 0 ? 0U : 1U, message, hint, {}, 0}});
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

bool is_deck(const std::string& path) {
  constexpr std::array endings = {".cir", ".sp", ".spice", ".net"};
  const std::string name = lower(path);
  return std::any_of(endings.begin(), endings.end(),
                     [&](const char* ending) { return name.ends_with(ending); });
}

DeckAnswer relax_deck(const std::string& path, Simulator& simulator) {
  std::ifstream file(path);
  if (!file) refuse(path, 0, "cannot be opened", {});
  DeckAnswer answer;
  std::string deck;
  bool control = false;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.ends_with('\r')) line.pop_back();
    const std::string word = lower(line.substr(0, line.find_first_of(" \t")));
    if (word == ".control") control = true;
    if (!control && !line.starts_with("*#")) deck += line + '\n';
    if (word == ".endc") control = false;
    const auto number_in = [&](const std::string& text, const char* example) {
      double value = 0.0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        refuse(path, number, "'" + line + "' does not end with a number", example);
      return value;
    };
    std::istringstream words(line.size() > 9 ? line.substr(9) : std::string());
    std::string node;
    std::string value;
    if (line.starts_with("* expect ")) {
      words >> node >> value;
      answer.nodes.push_back({node, number_in(value, "* expect n0 1.25e-3"), 0.0});
    } else if (line.starts_with("* within ")) {
      words >> value;
      answer.within = number_in(value, "* within 1e-9");
    }
  }
  if (answer.nodes.empty())
    refuse(path, 0, "states no voltage to compare with",
           "for each node a line such as '* expect n0 1.25e-3', as `tactile-net gen` writes them");

  std::vector<std::string> names;
  std::vector<double> expected;
  for (const NodeAnswer& one : answer.nodes) {
    names.push_back(lower(one.node));
    expected.push_back(one.expected);
  }
  const OperatingPoint point = operating_point(simulator, deck, names);
  answer.ngspice_seconds = point.seconds;
  for (std::size_t i = 0; i < names.size(); ++i) answer.nodes[i].found = point.voltages[i];
  answer.difference = relative_l2_error(point.voltages, expected);
  if (std::isnan(answer.difference))
    answer.difference =
        std::all_of(point.voltages.begin(), point.voltages.end(), [](double v) { return v == 0.0; })
            ? 0.0
            : std::numeric_limits<double>::infinity();
  return answer;
}

}  // namespace tactile_net::tool
