#include "tactile_net/lab/deck_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::lab {
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

void refuse_deck(const std::string& path) {
  if (is_deck(path))
    refuse(path, 0, "is a deck; this command takes a scene (TOML)",
           "tactile-net relax takes decks too");
}

DeckAnswer relax_deck(const std::string& path, Simulator& simulator) {
  if (std::filesystem::is_directory(path)) refuse(path, 0, "is a folder, not a deck", {});
  std::ifstream file(path);
  if (!file) refuse(path, 0, "cannot be opened", {});
  DeckAnswer answer;
  std::string deck;
  bool control = false;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.ends_with('\r')) line.pop_back();
    // Simulators look past leading blanks and at no letter's case: so must what is left out here.
    const std::size_t begin = line.find_first_not_of(" \t");
    const std::string text = begin == std::string::npos ? "" : lower(line.substr(begin));
    if (text.starts_with(".control")) control = true;
    if (!control && !text.starts_with("*#")) deck += line + '\n';
    if (text.starts_with(".endc")) control = false;
    if (!text.starts_with('*')) continue;
    const auto number_in = [&](const std::string& value, const char* example) {
      double result = 0.0;
      const auto [end, error] =
          number_from_chars(value.data(), value.data() + value.size(), result);
      if (error != std::errc{} || end != value.data() + value.size() || !std::isfinite(result))
        refuse(path, number, "'" + line.substr(0, 80) + "' does not end with a number", example);
      return result;
    };
    std::istringstream words(text.substr(1));
    std::string key;
    std::string value;
    words >> key;
    if (key == "expect") {
      NodeAnswer one;
      words >> one.node >> value;
      one.expected = number_in(value, "* expect n0 1.25e-3");
      answer.nodes.push_back(one);
    } else if (key == "within") {
      words >> value;
      answer.within = number_in(value, "* within 1e-9");
      if (answer.within < 0.0) refuse(path, number, "a difference allowed must be >= 0", {});
    }
  }
  if (answer.nodes.empty())
    refuse(path, 0, "states no voltage to compare with",
           "for each node a line such as '* expect n0 1.25e-3', as `tactile-net gen` writes them");

  std::vector<std::string> names;
  std::vector<double> expected;
  for (const NodeAnswer& one : answer.nodes) {
    names.push_back(one.node);
    expected.push_back(one.expected);
  }
  const OperatingPoint point = operating_point(simulator, deck, names);
  answer.ngspice_seconds = point.seconds;
  for (std::size_t i = 0; i < names.size(); ++i) answer.nodes[i].found = point.voltages[i];
  answer.difference = l2_difference(point.voltages, expected);
  return answer;
}

}  // namespace tactile_net::lab
