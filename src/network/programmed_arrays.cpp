#include "network/programmed_arrays.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "network/random.hpp"
#include "network/wired_array.hpp"

namespace tactile_net {
namespace {

/// Where a cell stands in its array. K' is turned: its rows are the tractions'.
struct Crossing {
  std::size_t row = 0;
  std::size_t line = 0;
};
Crossing crossing(const ResistorPlace& place, Reduction::Feed feed) {
  const bool turned = place.array == Array::transposed;
  const std::size_t column = turned ? place.row : place.column;
  return {turned ? place.column : place.row,
          2 * column + (feed == Reduction::Feed::inverse ? 1U : 0U)};
}

/// The resistors that are cells, by array.
std::map<Array, std::vector<std::size_t>> cells_of(const Reduction& reduction) {
  std::map<Array, std::vector<std::size_t>> arrays;
  const auto resistors = reduction.resistors();
  for (std::size_t r = 0; r < resistors.size(); ++r) {
    const Array array = place_of(resistors[r]).array;
    if (array == Array::kernel || array == Array::transposed || array == Array::conductances)
      arrays[array].push_back(r);
  }
  if (arrays.contains(Array::kernel)) {
    arrays.erase(Array::conductances);
    return arrays;
  }
  for (const std::size_t r : arrays[Array::conductances])
    if (reduction.feed(r) == Reduction::Feed::none)
      throw std::invalid_argument(
          "bits, cell_noise and wire_resistance are of arrays: of the realisations crossbar, "
          "least_squares and lattice");
  return arrays;
}

/// Whether an array leads from outputs into summing nodes, whose voltages its lines do not change.
bool is_driven(const Reduction& reduction, std::span<const std::size_t> resistors) {
  const bool driven = std::all_of(resistors.begin(), resistors.end(), [&](std::size_t r) {
    const Reduction::Feed feed = reduction.feed(r);
    return feed == Reduction::Feed::output || feed == Reduction::Feed::inverse;
  });
  if (!driven && reduction.has_subcircuits())
    throw std::invalid_argument(
        "wire_resistance is of arrays with complementary outputs: leave out inverters");
  return driven;
}

/// The ends of an array's rows, or of its lines, in their order: one or two at each place, the
/// circuit's nodes in pairs.
class Ends {
 public:
  void add(std::size_t place, Node node) {
    if (places_.size() <= place) places_.resize(place + 1);
    places_[place].insert(node);
  }

  /// Once all are added. A single one of a pair is the first if it is an output.
  void number(const Reduction& reduction) {
    const bool pairs = std::any_of(places_.begin(), places_.end(),
                                   [](const std::set<Node>& one) { return one.size() > 1; });
    for (const std::set<Node>& place : places_) {
      std::size_t at = nodes_.size();
      nodes_.resize(at + (pairs ? 2 : 1));
      if (pairs && place.size() == 1 && !reduction.is_output(*place.begin())) ++at;
      for (const Node node : place) {
        nodes_[at] = node;
        at_[node] = at++;
      }
    }
  }

  [[nodiscard]] std::size_t count() const noexcept { return nodes_.size(); }
  [[nodiscard]] std::size_t at(Node node) const { return at_.at(node); }
  [[nodiscard]] const std::vector<Node>& nodes() const noexcept { return nodes_; }  // 0: none

 private:
  std::vector<std::set<Node>> places_;
  std::vector<Node> nodes_;
  std::map<Node, std::size_t> at_;
};

}  // namespace

void check_arrays(const ToleranceOptions& options) {
  if (options.bits && !(*options.bits >= 1 && *options.bits <= 32))
    throw std::invalid_argument("bits must be from 1 to 32");
  if (options.cell_noise && !(*options.cell_noise > 0.0 && *options.cell_noise < 1.0))
    throw std::invalid_argument("a cell's noise must be > 0 and < 1");
  if (options.wire_resistance &&
      !(*options.wire_resistance > 0.0 && std::isfinite(*options.wire_resistance)))
    throw std::invalid_argument("a wire's resistance must be > 0 and finite");
  if (options.series && programs_cells(options))
    throw std::invalid_argument(
        "a series is of resistors that are bought: not beside bits or cell_noise");
}

ProgrammedArrays::ProgrammedArrays(const Reduction& reduction, const ToleranceOptions& options)
    : options_(options), programmed_(reduction.resistors().size()) {
  if (!is_of_arrays(options)) return;
  const auto siemens = reduction.siemens();
  for (const auto& [array, resistors] : cells_of(reduction)) {
    double largest = 0.0;
    for (const std::size_t r : resistors) largest = std::max(largest, std::abs(siemens[r]));
    const std::size_t first = cells_.size();
    for (const std::size_t r : resistors) {
      cells_.push_back({r, largest});
      programmed_[r] = programs_cells(options);
    }
    if (!options.wire_resistance) continue;
    const std::span<Cell> own = std::span(cells_).subspan(first);
    if (is_driven(reduction, resistors))
      find_shares(reduction, own);
    else
      find_paths(reduction, array, own);
  }
}

void ProgrammedArrays::find_shares(const Reduction& reduction, std::span<Cell> cells) {
  std::vector<double> siemens(reduction.siemens().begin(), reduction.siemens().end());
  round(siemens);
  std::vector<ArrayCell> crossings;
  std::size_t rows = 0;
  std::size_t lines = 0;
  for (const Cell& cell : cells) {
    const Crossing at =
        crossing(place_of(reduction.resistors()[cell.resistor]), reduction.feed(cell.resistor));
    crossings.push_back({at.row, at.line, siemens[cell.resistor]});
    rows = std::max(rows, at.row + 1);
    lines = std::max(lines, (at.line / 2 + 1) * 2);
  }
  const Matrix seen = seen_from_ends(crossings, rows, lines, *options_.wire_resistance);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const ArrayCell& one = crossings[k];
    if (one.siemens == 0.0) continue;
    // A line and its inverse carry opposite voltages.
    cells[k].share = (seen(one.row, one.line) - seen(one.row, one.line ^ 1U)) / one.siemens;
  }
}

void ProgrammedArrays::find_paths(const Reduction& reduction, Array array, std::span<Cell> cells) {
  Ends rows;
  Ends lines;
  for (const Cell& cell : cells) {
    const ResistorPlace place = place_of(reduction.resistors()[cell.resistor]);
    const auto [from, to] = reduction.ends(cell.resistor);
    rows.add(place.row, array == Array::transposed ? from : to);
    lines.add(place.column, array == Array::transposed ? to : from);
  }
  rows.number(reduction);
  lines.number(reduction);
  std::vector<double> siemens(reduction.siemens().begin(), reduction.siemens().end());
  round(siemens);
  std::vector<ArrayCell> crossings;
  for (const Cell& cell : cells) {
    const auto [from, to] = reduction.ends(cell.resistor);
    const bool turned = array == Array::transposed;
    crossings.push_back(
        {rows.at(turned ? from : to), lines.at(turned ? to : from), siemens[cell.resistor]});
  }
  Matrix between = between_ends(crossings, rows.count(), lines.count(), *options_.wire_resistance);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const ArrayCell& one = crossings[k];
    if (one.siemens == 0.0) continue;
    double& seen = between(one.row, rows.count() + one.line);
    cells[k].share = seen / one.siemens;
    seen = 0.0;  // its resistor carries it
  }
  std::vector<Node> nodes = rows.nodes();
  const std::vector<Node> of_lines = lines.nodes();
  nodes.insert(nodes.end(), of_lines.begin(), of_lines.end());
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (std::size_t b = a + 1; b < nodes.size(); ++b)
      if (between(a, b) != 0.0 && nodes[a] != 0 && nodes[b] != 0)
        paths_.push_back({"Rw" + std::to_string(paths_.size()), nodes[a], nodes[b], between(a, b)});
}

void ProgrammedArrays::round(std::vector<double>& siemens) const {
  if (!options_.bits) return;
  const double steps = std::ldexp(1.0, *options_.bits) - 1.0;
  for (const Cell& cell : cells_)
    if (cell.largest > 0.0) {
      const double step = cell.largest / steps;
      siemens[cell.resistor] = step * std::round(siemens[cell.resistor] / step);
    }
}

void ProgrammedArrays::disturb(std::vector<double>& siemens, std::size_t trial) const {
  if (!options_.cell_noise) return;
  for (const Cell& cell : cells_) {
    double& value = siemens[cell.resistor];
    value = std::max(0.0, value + *options_.cell_noise * cell.largest *
                                      normal(options_.seed, trial, cell.resistor));
  }
}

void ProgrammedArrays::add_variances(std::span<const double> siemens,
                                     std::span<double> variances) const {
  if (!options_.cell_noise) return;
  for (const Cell& cell : cells_)
    variances[cell.resistor] +=
        std::pow(*options_.cell_noise * cell.largest / siemens[cell.resistor], 2);
}

void ProgrammedArrays::through_lines(std::vector<double>& siemens) const {
  for (const Cell& cell : cells_) siemens[cell.resistor] *= cell.share;
}

}  // namespace tactile_net
