/// @file
/// A circuit whose arrays have lines of real wire: every crossing two nodes.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/network/arrays.hpp"
#include "tactile_net/network/circuit.hpp"

namespace tactile_net {

/// In place of each cell of K, K' and P: a resistor from a crossing on its line to one on its row,
/// and segments of `ohm` along both, to the output and to the summing node at the first corner.
inline Circuit with_wires(Circuit circuit, double ohm) {
  std::map<Array, std::vector<Resistor>> arrays;
  std::vector<Resistor> others;
  for (const Resistor& r : circuit.resistors) {
    const Array array = place_of(r.name).array;
    const bool cell =
        array == Array::kernel || array == Array::transposed || array == Array::conductances;
    (cell ? arrays[array] : others).push_back(r);
  }
  circuit.resistors = others;
  std::size_t wires = 0;
  const auto wire = [&](Node from, Node to) {
    circuit.resistors.push_back({"Rwire" + std::to_string(wires++), from, to, 1.0 / ohm});
  };
  for (const auto& [array, cells] : arrays) {
    // Lines in the order of the columns, an output beside its inverse; rows in their own order.
    std::map<std::pair<std::size_t, std::size_t>, const Resistor*> at;
    std::map<std::size_t, Node> ends_of_rows;
    std::map<std::size_t, Node> ends_of_lines;
    // A lattice's residuals are pairs of nodes u, v, and so are its inputs p, s.
    const auto name_of = [&](Node node) { return circuit.nodes[node][0]; };
    const bool pairs = std::any_of(cells.begin(), cells.end(), [&](const Resistor& r) {
      return name_of(r.to) == 'u' || name_of(r.from) == 'u';
    });
    const bool turned = array == Array::transposed;
    for (const Resistor& r : cells) {
      const ResistorPlace place = place_of(r.name);
      const char first = name_of(r.from);
      const std::size_t second = first == 'r' || first == 'q' || first == 'v' ? 1U : 0U;
      const std::size_t line = 2 * (turned ? place.row : place.column) + second;
      std::size_t row = turned ? place.column : place.row;
      if (pairs) row = 2 * row + (name_of(r.to) == 'v' || name_of(r.to) == 's' ? 1U : 0U);
      at[{row, line}] = &r;
      ends_of_rows[row] = r.to;
      ends_of_lines[line] = r.from;
    }
    // A line without a cell is there too: it ends nowhere, and carries nothing.
    const std::size_t rows = ends_of_rows.rbegin()->first + 1;
    const std::size_t lines = (ends_of_lines.rbegin()->first / 2 + 1) * 2;
    const std::string prefix = "w" + std::to_string(static_cast<int>(array)) + "_";
    std::vector<Node> above(lines);
    for (std::size_t c = 0; c < lines; ++c)
      if (ends_of_lines.contains(c)) above[c] = ends_of_lines[c];
    for (std::size_t i = 0; i < rows; ++i) {
      Node before = ends_of_rows.contains(i) ? ends_of_rows[i] : 0;
      for (std::size_t c = 0; c < lines; ++c) {
        const std::string crossing = prefix + std::to_string(i) + "_" + std::to_string(c);
        const Node on_row = add_node(circuit, crossing + "r");
        const Node on_line = add_node(circuit, crossing + "l");
        wire(on_row, before);
        wire(on_line, above[c]);
        if (const auto cell = at.find({i, c}); cell != at.end())
          circuit.resistors.push_back({cell->second->name, on_line, on_row, cell->second->siemens});
        before = on_row;
        above[c] = on_line;
      }
    }
  }
  return circuit;
}

}  // namespace tactile_net
