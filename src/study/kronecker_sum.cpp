#include "study/kronecker_sum.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net::study {
namespace {

using Eigen::Index;

/// The sides of a block: a component's cells and a channel's taxels.
struct Sides {
  Index cell_rows, cell_columns, taxel_rows, taxel_columns;
};

/// Rows (cell row, taxel row), columns (cell column, taxel column).
Eigen::MatrixXd rearranged(const auto& inverse, const Sides& s, Index first_row,
                           Index first_column) {
  Eigen::MatrixXd result(s.cell_rows * s.taxel_rows, s.cell_columns * s.taxel_columns);
  for (Index i = 0; i < s.cell_rows; ++i)
    for (Index k = 0; k < s.cell_columns; ++k)
      for (Index j = 0; j < s.taxel_rows; ++j)
        for (Index l = 0; l < s.taxel_columns; ++l)
          result(i * s.taxel_rows + j, k * s.taxel_columns + l) =
              inverse(first_row + i * s.cell_columns + k, first_column + j * s.taxel_columns + l);
  return result;
}

}  // namespace

struct KroneckerSum::Parts {
  /// Of one block: its terms along z, (term, taxel column) x cell column.
  struct Second {
    Index terms = 0;
    RowMajor along_z{};
  };
  /// Of one channel: the terms along y of all components, one after the other, (component, cell
  /// row, term) x taxel row. What they make of a frame is read anew as cell row x (term, taxel
  /// column).
  struct Channel {
    RowMajor along_y{};
    RowMajor product{};
    std::vector<Second> components{};
  };
  Sides sides{};
  std::vector<Channel> channels{};
  std::size_t terms = 0;
  double error = 0.0;
};

KroneckerSum::KroneckerSum(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
KroneckerSum::~KroneckerSum() = default;
KroneckerSum::KroneckerSum(KroneckerSum&&) noexcept = default;
KroneckerSum& KroneckerSum::operator=(KroneckerSum&&) noexcept = default;

std::size_t KroneckerSum::terms() const noexcept { return parts_->terms; }
double KroneckerSum::error() const noexcept { return parts_->error; }

std::size_t KroneckerSum::multiplications() const noexcept {
  Index count = 0;
  for (const Parts::Channel& channel : parts_->channels) {
    count += channel.along_y.size() * parts_->sides.taxel_columns;
    for (const Parts::Second& one : channel.components)
      count += one.along_z.size() * parts_->sides.cell_rows;
  }
  return static_cast<std::size_t>(count);
}

void KroneckerSum::apply(std::span<const double> readings, std::span<double> tractions) {
  const Sides& s = parts_->sides;
  std::fill(tractions.begin(), tractions.end(), 0.0);
  Index first = 0;
  for (Parts::Channel& channel : parts_->channels) {
    const Eigen::Map<const RowMajor> frame(readings.data() + first, s.taxel_rows, s.taxel_columns);
    first += frame.size();
    channel.product.noalias() = channel.along_y.operator*(frame);
    const double* product = channel.product.data();
    double* cells = tractions.data();
    for (const Parts::Second& one : channel.components) {
      if (one.terms > 0) {
        const Eigen::Map<const RowMajor> left(product, s.cell_rows, one.terms * s.taxel_columns);
        Eigen::Map<RowMajor>(cells, s.cell_rows, s.cell_columns).noalias() +=
            left.operator*(one.along_z);
        product += left.size();
      }
      cells += s.cell_rows * s.cell_columns;
    }
  }
}

struct KroneckerTerms::Blocks {
  Sides sides{};
  std::size_t components = 0;
  std::vector<double> weights{};  // of each channel
  /// Component after component, channel after channel; u: (cell row, taxel row) x terms, v: (cell
  /// column, taxel column) x terms.
  std::vector<Svd> blocks{};
};

KroneckerTerms::KroneckerTerms(const LinearProblem& problem, const Reconstruction& inverse) {
  const SurfaceGrid& grid = problem.grid;
  if (grid.stride_rows == 0)
    throw std::invalid_argument("Kronecker products need taxels in rows and columns");
  if (inverse.readings() != problem.weights.size() ||
      inverse.tractions() != problem.components * grid.count())
    throw std::invalid_argument("the inverse is of another problem");
  const std::size_t channels = problem.sites.back().channel + 1;
  std::size_t taxel_rows = 1;  // taxels of a channel come row after row: their y tell the rows
  const std::size_t taxels = problem.weights.size() / channels;
  for (std::size_t i = 1; i < taxels; ++i)
    if (problem.sites[i].y != problem.sites[i - 1].y) ++taxel_rows;
  auto made = std::make_unique<Blocks>();
  made->sides = {static_cast<Index>(grid.rows), static_cast<Index>(grid.columns),
                 static_cast<Index>(taxel_rows), static_cast<Index>(taxels / taxel_rows)};
  const Sides& s = made->sides;
  const auto longest = static_cast<std::size_t>(
      std::max(s.cell_rows * s.taxel_rows, s.cell_columns * s.taxel_columns));
  if (longest > longest_side)
    throw std::invalid_argument("the rearranged matrix has a side of " + std::to_string(longest) +
                                ", above " + std::to_string(longest_side) +
                                ": its decomposition would take minutes");
  made->components = problem.components;
  // Channels of different noise, and of different units, count by what they weigh.
  made->weights.assign(channels, 0.0);
  for (std::size_t i = 0; i < problem.weights.size(); ++i) {
    double& weight = made->weights[problem.sites[i].channel];
    weight = std::max(weight, problem.weights[i]);
  }
  for (double& weight : made->weights)
    if (!(weight > 0.0)) weight = 1.0;
  const auto matrix = as_eigen(inverse.transposed()).transpose();
  for (std::size_t u = 0; u < problem.components; ++u)
    for (std::size_t channel = 0; channel < channels; ++channel)
      made->blocks.push_back(singular_value_decomposition(
          Eigen::MatrixXd(rearranged(matrix, s, static_cast<Index>(u * grid.count()),
                                     static_cast<Index>(channel * taxels)) /
                          made->weights[channel])));
  blocks_ = std::move(made);
}

KroneckerTerms::~KroneckerTerms() = default;

KroneckerSum KroneckerTerms::sum(double accuracy) const {
  if (!(accuracy > 0.0)) throw std::invalid_argument("accuracy must be > 0");
  const Sides& s = blocks_->sides;
  const std::size_t channels = blocks_->weights.size();
  std::vector<double> all;
  for (const Svd& block : blocks_->blocks)
    all.insert(all.end(), block.values.begin(), block.values.end());
  std::sort(all.begin(), all.end());
  double whole = 0.0;
  for (const double value : all) whole += value * value;
  // As many of the least as may be left out, of all blocks together.
  double left_out = 0.0;
  double least = 0.0;
  for (const double value : all) {
    if (left_out + value * value > accuracy * accuracy * whole) break;
    left_out += value * value;
    least = value;
  }
  auto parts = std::make_unique<KroneckerSum::Parts>();
  parts->sides = s;
  parts->error = whole > 0.0 ? std::sqrt(left_out / whole) : 0.0;
  for (std::size_t c = 0; c < channels; ++c) {
    KroneckerSum::Parts::Channel channel;
    std::vector<const Svd*> of_channel;
    Index terms = 0;
    for (std::size_t u = 0; u < blocks_->components; ++u) {
      const Svd& block = blocks_->blocks[u * channels + c];
      const auto kept = static_cast<Index>(std::count_if(
          block.values.begin(), block.values.end(), [&](double value) { return value > least; }));
      channel.components.push_back({.terms = kept, .along_z = {}});
      of_channel.push_back(&block);
      terms += kept;
    }
    parts->terms += static_cast<std::size_t>(terms);
    channel.along_y.resize(s.cell_rows * terms, s.taxel_rows);
    channel.product.resize(s.cell_rows * terms, s.taxel_columns);
    Index first = 0;
    for (std::size_t u = 0; u < of_channel.size(); ++u) {
      const Svd& block = *of_channel[u];
      KroneckerSum::Parts::Second& second = channel.components[u];
      second.along_z.resize(second.terms * s.taxel_columns, s.cell_columns);
      for (Index t = 0; t < second.terms; ++t) {
        const double size = block.values(t) * blocks_->weights[c];
        for (Index i = 0; i < s.cell_rows; ++i)
          for (Index j = 0; j < s.taxel_rows; ++j)
            channel.along_y(first + i * second.terms + t, j) =
                size * block.u(i * s.taxel_rows + j, t);
        for (Index k = 0; k < s.cell_columns; ++k)
          for (Index l = 0; l < s.taxel_columns; ++l)
            second.along_z(t * s.taxel_columns + l, k) = block.v(k * s.taxel_columns + l, t);
      }
      first += s.cell_rows * second.terms;
    }
    parts->channels.push_back(std::move(channel));
  }
  return KroneckerSum(std::move(parts));
}

}  // namespace tactile_net::study
