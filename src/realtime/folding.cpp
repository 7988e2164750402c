#include "realtime/folding.hpp"

namespace tactile_net {

std::size_t class_size(const GridBlocks& grid, GridClass of) noexcept {
  std::size_t size = 0;
  for (std::size_t b = 0; b < grid.signs_y.size(); ++b) {
    const HalfGrid half = half_grid(grid, b, of);
    size += half.rows * half.columns;
  }
  return size;
}

std::size_t places_on_diagonal(const GridBlocks& grid, GridClass of) noexcept {
  std::size_t count = 0;
  for (std::size_t b = 0; b < grid.signs_y.size(); ++b)
    if (grid.partners[b] == b) count += half_grid(grid, b, of).rows;
  return count;
}

std::vector<std::uint32_t> exchanged_places(const GridBlocks& grid, GridClass of) {
  const GridClass other{of.z, of.y};
  std::vector<std::size_t> first(grid.signs_y.size());
  std::size_t next = 0;
  for (std::size_t b = 0; b < first.size(); ++b) {
    first[b] = next;
    const HalfGrid half = half_grid(grid, b, other);
    next += half.rows * half.columns;
  }
  std::vector<std::uint32_t> places;
  places.reserve(class_size(grid, of));
  for (std::size_t b = 0; b < first.size(); ++b) {
    const HalfGrid half = half_grid(grid, b, of);
    for (std::size_t i = 0; i < half.rows; ++i)
      for (std::size_t j = 0; j < half.columns; ++j)
        places.push_back(static_cast<std::uint32_t>(first[grid.partners[b]] + j * half.rows + i));
  }
  return places;
}

template <class T>
Folding<T>::Folding(const GridBlocks& grid) : rows_(grid.rows), columns_(grid.columns) {
  for (std::size_t c = 0; c < grid_classes.size(); ++c) {
    reflected_[c] = size_;
    size_ += padded<T>(class_size(grid, grid_classes[c]));
  }
  std::array<std::size_t, 4> next = reflected_;
  for (std::size_t b = 0; b < grid.signs_y.size(); ++b) {
    // In the class where this block has those parities.
    const auto where = [&](int y, int z) {
      return next[(grid.signs_y[b] * y > 0 ? 0U : 2U) + (grid.signs_z[b] * z > 0 ? 0U : 1U)];
    };
    blocks_.push_back({where(1, 1), where(1, -1), where(-1, 1), where(-1, -1)});
    for (std::size_t c = 0; c < grid_classes.size(); ++c) {
      const HalfGrid half = half_grid(grid, b, grid_classes[c]);
      next[c] += half.rows * half.columns;
    }
  }
  if (grid.partners.empty()) {
    offsets_.assign(reflected_.begin(), reflected_.end());
    is_line_ = rows_ == 1;
    return;
  }
  for (const std::size_t size : class_sizes(grid)) {
    offsets_.push_back(size_);
    size_ += padded<T>(size);
    if (offsets_.size() == 3) {
      second_ = size_;
      size_ += padded<T>(size);
    }
  }
  for (std::size_t c = 0; c < 2; ++c) {
    const std::vector<std::uint32_t> places = exchanged_places(grid, grid_classes[3 * c]);
    for (std::uint32_t k = 0; k < places.size(); ++k) {
      if (places[k] == k) exchanges_[c].alone.push_back(k);
      if (places[k] <= k) continue;
      exchanges_[c].first.push_back(k);
      exchanges_[c].second.push_back(places[k]);
    }
  }
  transposed_ = exchanged_places(grid, grid_classes[2]);
}

template <class T>
void Folding<T>::part_exchanged(T* folded) const noexcept {
  for (std::size_t c = 0; c < 2; ++c) {
    const Exchange& exchange = exchanges_[c];
    const T* const in = folded + reflected_[3 * c];
    T* const sums = folded + offsets_[3 * c];
    T* const differences = folded + offsets_[3 * c + 1];
    const std::size_t pairs = exchange.first.size();
    for (std::size_t k = 0; k < pairs; ++k) {
      sums[k] = in[exchange.first[k]] + in[exchange.second[k]];
      differences[k] = in[exchange.first[k]] - in[exchange.second[k]];
    }
    for (std::size_t k = 0; k < exchange.alone.size(); ++k) sums[pairs + k] = in[exchange.alone[k]];
  }
  const std::size_t mixed = transposed_.size();
  for (std::size_t k = 0; k < mixed; ++k) {
    folded[offsets_[2] + k] = folded[reflected_[1] + k];
    folded[second_ + transposed_[k]] = folded[reflected_[2] + k];
  }
}

template <class T>
void Folding<T>::join_exchanged(T* folded) const noexcept {
  for (std::size_t c = 0; c < 2; ++c) {
    const Exchange& exchange = exchanges_[c];
    T* const out = folded + reflected_[3 * c];
    const T* const sums = folded + offsets_[3 * c];
    const T* const differences = folded + offsets_[3 * c + 1];
    const std::size_t pairs = exchange.first.size();
    for (std::size_t k = 0; k < pairs; ++k) {
      out[exchange.first[k]] = sums[k] + differences[k];
      out[exchange.second[k]] = sums[k] - differences[k];
    }
    for (std::size_t k = 0; k < exchange.alone.size(); ++k)
      out[exchange.alone[k]] = sums[pairs + k];
  }
  const std::size_t mixed = transposed_.size();
  for (std::size_t k = 0; k < mixed; ++k) {
    folded[reflected_[1] + k] = folded[offsets_[2] + k];
    folded[reflected_[2] + k] = folded[second_ + transposed_[k]];
  }
}

template class Folding<double>;
template class Folding<float>;

}  // namespace tactile_net
