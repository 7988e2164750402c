#include "network/ladder.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace tactile_net {
namespace {

/// What goes to ground over what is fed, at the node where it is least. More of it costs swing of
/// the amplifiers (|y| grows by 1 + ground_share), less costs siemens of the ladder.
constexpr double ground_share = 1.0;

/// Blocks of nodes that R couples, numbered by their first node.
std::vector<std::size_t> blocks_of(const Matrix& stabiliser) {
  std::vector<std::size_t> block(stabiliser.rows);
  std::iota(block.begin(), block.end(), std::size_t{0});
  const auto first = [&](std::size_t i) {
    while (block[i] != i) i = block[i];
    return i;
  };
  for (std::size_t i = 0; i < block.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (stabiliser(i, j) != 0.0) {
        const std::size_t a = first(i);
        const std::size_t b = first(j);
        block[std::max(a, b)] = std::min(a, b);
      }
  for (std::size_t i = 0; i < block.size(); ++i) block[i] = first(i);
  return block;
}

std::vector<double> row_sums(const Matrix& stabiliser) {
  std::vector<double> sums;
  for (std::size_t i = 0; i < stabiliser.rows; ++i) {
    for (std::size_t j = 0; j < stabiliser.columns; ++j)
      if (i != j && stabiliser(i, j) > 0.0)
        throw std::invalid_argument(
            "a ladder makes no stabiliser with entries > 0 beside its diagonal: leave out ladder");
    const auto row = stabiliser.row(i);
    sums.push_back(std::accumulate(row.begin(), row.end(), 0.0));
    if (!(sums.back() > 0.0))
      throw std::invalid_argument(
          "a ladder makes no stabiliser with a row whose sum is not > 0: leave out ladder");
  }
  return sums;
}

}  // namespace

std::vector<LadderNode> ladder_of(const Matrix& stabiliser, std::span<const double> loads) {
  const std::vector<double> sums = row_sums(stabiliser);
  const std::vector<std::size_t> blocks = blocks_of(stabiliser);
  std::vector<double> least(sums.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < sums.size(); ++i)
    least[blocks[i]] = std::min(least[blocks[i]], sums[i]);

  std::vector<LadderNode> nodes;
  std::vector<double> feed(sums.size());
  double largest_feed = 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    nodes.push_back({.block = blocks[i], .d = least[blocks[i]] / (1.0 + ground_share)});
    double& own = feed[blocks[i]];
    own = std::max(own, loads[i] / (sums[i] / nodes[i].d - 1.0));
    largest_feed = std::max(largest_feed, own);
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    nodes[i].feed = feed[nodes[i].block];
    if (nodes[i].feed == 0.0) nodes[i].feed = largest_feed;  // nothing sees these tractions
    nodes[i].to_ground = nodes[i].feed * (sums[i] / nodes[i].d - 1.0);
  }
  return nodes;
}

}  // namespace tactile_net
