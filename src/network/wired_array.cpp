#include "network/wired_array.hpp"

#include <optional>
#include <stdexcept>

#include "numeric/sparse_elimination.hpp"

namespace tactile_net {
namespace {

/// The sparse network of all crossings, its ends at 0 V.
class Crossings {
 public:
  Crossings(std::span<const ArrayCell> cells, std::size_t rows, std::size_t lines, double ohm)
      : rows_(rows), lines_(lines), wire_(1.0 / ohm) {
    std::vector<Eigen::Triplet<double>> entries;
    const auto to_end = [&](Eigen::Index a) { entries.emplace_back(a, a, wire_); };
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
        if (c + 1 < lines) add(on_row(i, c), on_row(i, c + 1), wire_);
        if (i + 1 < rows) add(on_line(i, c), on_line(i + 1, c), wire_);
      }
    for (const ArrayCell& cell : cells)
      add(on_row(cell.row, cell.line), on_line(cell.row, cell.line), cell.siemens);

    Eigen::SparseMatrix<double> network(size(), size());
    network.setFromTriplets(entries.begin(), entries.end());
    factors_.emplace(network);
    if (!factors_->regular())
      throw std::domain_error("the network of an array's lines has no answer");
  }

  /// Of the rows first: the crossing next to each end.
  [[nodiscard]] Eigen::Index end(std::size_t k) const {
    return k < rows_ ? on_row(k, 0) : on_line(0, k - rows_);
  }

  /// Currents into the ends from `first` on per volt at end k, for k < count.
  [[nodiscard]] Matrix currents(std::size_t count, std::size_t first) const {
    const std::size_t ends = rows_ + lines_ - first;
    Matrix seen{count, ends, std::vector<double>(count * ends)};
    for (std::size_t k = 0; k < count; ++k) {
      Eigen::VectorXd current = Eigen::VectorXd::Zero(size());
      current(end(k)) = wire_;
      const Eigen::VectorXd volts = factors_->solve(current);
      for (std::size_t other = 0; other < ends; ++other)
        if (first + other != k) seen(k, other) = wire_ * volts(end(first + other));
    }
    return seen;
  }

 private:
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(2 * rows_ * lines_); }
  [[nodiscard]] Eigen::Index on_row(std::size_t i, std::size_t c) const {
    return static_cast<Eigen::Index>(i * lines_ + c);
  }
  [[nodiscard]] Eigen::Index on_line(std::size_t i, std::size_t c) const {
    return static_cast<Eigen::Index>(rows_ * lines_ + c * rows_ + i);
  }

  std::size_t rows_ = 0;
  std::size_t lines_ = 0;
  double wire_ = 0.0;
  std::optional<SparseLdl> factors_;
};

}  // namespace

Matrix seen_from_ends(std::span<const ArrayCell> cells, std::size_t rows, std::size_t lines,
                      double ohm) {
  // Reciprocity: the current into a row's end per volt at a line's is that into the line's end per
  // volt at the row's, and there are fewer rows.
  return Crossings(cells, rows, lines, ohm).currents(rows, rows);
}

Matrix between_ends(std::span<const ArrayCell> cells, std::size_t rows, std::size_t lines,
                    double ohm) {
  return Crossings(cells, rows, lines, ohm).currents(rows + lines, 0);
}

}  // namespace tactile_net
