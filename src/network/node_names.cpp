#include "network/node_names.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>
#include <unordered_set>

namespace tactile_net {

std::string in_lower_case(std::string name) {
  for (char& one : name) one = static_cast<char>(std::tolower(static_cast<unsigned char>(one)));
  return name;
}

bool is_word(const std::string& name) noexcept {
  const auto stands = [](char one) {
    return (one >= 'a' && one <= 'z') || (one >= 'A' && one <= 'Z') || (one >= '0' && one <= '9') ||
           one == '_' || one == '.';
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), stands);
}

std::string quoted_name(const std::string& name) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text = "'";
  for (const char one : name) {
    const auto code = static_cast<unsigned char>(one);
    if (code >= ' ' && code != 0x7f)
      text += one;
    else
      text.append("\\x").append({digits[code / 16U], digits[code % 16U]});
  }
  return text + "'";
}

void check_node_names(const Circuit& circuit) {
  std::unordered_set<std::string> names = {"0", "gnd"};  // ground's
  std::unordered_set<std::string> instances;
  for (const Instance& x : circuit.instances) instances.insert(in_lower_case(x.name));
  for (std::size_t node = 1; node < circuit.nodes.size(); ++node) {
    const std::string& name = circuit.nodes[node];
    if (!is_word(name))
      throw std::invalid_argument("node " + std::to_string(node) + " is named " +
                                  quoted_name(name) +
                                  ": a node's name must be one word of ASCII letters, digits, _ "
                                  "and .");
    if (!names.insert(in_lower_case(name)).second)
      throw std::invalid_argument("node " + std::to_string(node) + " is named " +
                                  quoted_name(name) +
                                  ": another node of the circuit has that name, whatever its "
                                  "case; give each node a name of its own");
    const std::string lower = in_lower_case(name);
    for (std::size_t dot = lower.find('.'); dot != std::string::npos;
         dot = lower.find('.', dot + 1))
      if (instances.contains(lower.substr(0, dot)))
        throw std::invalid_argument("node " + std::to_string(node) + " is named " +
                                    quoted_name(name) +
                                    ": simulators name nodes inside of the element " +
                                    name.substr(0, dot) + " like that; give it another name");
  }
}

}  // namespace tactile_net
