#include "network/wired_array.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <stdexcept>

namespace tactile_net {

Matrix seen_from_ends(std::span<const ArrayCell> cells, std::size_t rows, std::size_t lines,
                      double ohm) {
  const double wire = 1.0 / ohm;
  const std::size_t crossings = rows * lines;
  const auto on_row = [&](std::size_t i, std::size_t c) {
    return static_cast<Eigen::Index>(i * lines + c);
  };
  const auto on_line = [&](std::size_t i, std::size_t c) {
    return static_cast<Eigen::Index>(crossings + c * rows + i);
  };
  std::vector<Eigen::Triplet<double>> entries;
  const auto to_end = [&](Eigen::Index a) { entries.emplace_back(a, a, wire); };
  const auto add = [&](Eigen::Index a, Eigen::Index b, double siemens) {
    entries.emplace_back(a, a, siemens);
    entries.emplace_back(b, b, siemens);
    entries.emplace_back(a, b, -siemens);
    entries.emplace_back(b, a, -siemens);
  };
  for (std::size_t i = 0; i < rows; ++i) to_end(on_row(i, 0));
  for (std::size_t c = 0; c < lines; ++c) to_end(on_line(0, c));
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t c = 0; c < lines; ++c) {
      if (c + 1 < lines) add(on_row(i, c), on_row(i, c + 1), wire);
      if (i + 1 < rows) add(on_line(i, c), on_line(i + 1, c), wire);
    }
  for (const ArrayCell& cell : cells)
    add(on_row(cell.row, cell.line), on_line(cell.row, cell.line), cell.siemens);

  const auto size = static_cast<Eigen::Index>(2 * crossings);
  Eigen::SparseMatrix<double> network(size, size);
  network.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(network);
  if (factors.info() != Eigen::Success)
    throw std::domain_error("the network of an array's lines has no answer");
  // Reciprocity: the current into a row's end per volt at a line's is that into the line's end per
  // volt at the row's, and there are fewer rows.
  Matrix seen{rows, lines, std::vector<double>(crossings)};
  for (std::size_t i = 0; i < rows; ++i) {
    Eigen::VectorXd current = Eigen::VectorXd::Zero(size);
    current(on_row(i, 0)) = wire;
    const Eigen::VectorXd volts = factors.solve(current);
    for (std::size_t c = 0; c < lines; ++c) seen(i, c) = wire * volts(on_line(0, c));
  }
  return seen;
}

}  // namespace tactile_net
