/// @file
/// Names that simulators can read. Private.
#pragma once

#include <string>

#include "tactile_net/network/circuit.hpp"

namespace tactile_net {

/// Simulators know no case.
[[nodiscard]] std::string in_lower_case(std::string name);

/// Whether every simulator reads the name as one word: ASCII letters, digits, _ and .
[[nodiscard]] bool is_word(const std::string& name) noexcept;

/// The name in quotes, what would break a line of a message as its code.
[[nodiscard]] std::string quoted_name(const std::string& name);

/// Nodes of one name would be one node, and so would one that is named as a simulator names a node
/// inside of an instance; a name with a line break would be two cards.
///
/// @throw std::invalid_argument  a node's name is no word, or two nodes have the same one
void check_node_names(const Circuit& circuit);

}  // namespace tactile_net
