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
Folding<T>::Folding(const GridBlocks& grid) : grid_(grid) {
  for (std::size_t c = 0; c < grid_classes.size(); ++c) {
    reflected_[c] = size_;
    size_ += padded<T>(class_size(grid, grid_classes[c]));
  }
  if (grid.partners.empty()) {
    offsets_.assign(reflected_.begin(), reflected_.end());
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

namespace {

/// Where the sums and differences of one block go or come from, by the parities of rows and values.
template <class T>
struct Quarters {
  T* plus_plus;
  T* plus_minus;
  T* minus_plus;
  T* minus_minus;
};

template <class T>
std::array<T*, 4> beginnings(T* folded, const std::array<std::size_t, 4>& offsets) {
  return {folded + offsets[0], folded + offsets[1], folded + offsets[2], folded + offsets[3]};
}

/// Calls `block(quarters)` for every block in turn.
template <class T>
void for_each_block(const GridBlocks& grid, const std::array<T*, 4>& classes, const auto& block) {
  std::array<T*, 4> at = classes;
  for (std::size_t b = 0; b < grid.signs_y.size(); ++b) {
    // The class in which this block has those parities.
    const auto where = [&](int y, int z) {
      return at[(grid.signs_y[b] * y > 0 ? 0U : 2U) + (grid.signs_z[b] * z > 0 ? 0U : 1U)];
    };
    block(Quarters<T>{where(1, 1), where(1, -1), where(-1, 1), where(-1, -1)});
    for (std::size_t c = 0; c < 4; ++c) {
      const HalfGrid half = half_grid(grid, b, grid_classes[c]);
      at[c] += half.rows * half.columns;
    }
  }
}

}  // namespace

template <class T>
void Folding<T>::fold(Difference x, double factor, T* folded) const noexcept {
  const std::size_t rows = grid_.rows;
  const std::size_t n = grid_.columns;
  const std::size_t half = n / 2;
  const std::array<T*, 4> classes = beginnings(folded, reflected_);
  for_each_block(grid_, classes, [&](Quarters<T> q) {
    for (std::size_t i = 0; i < rows / 2; ++i) {
      const Difference front{x.a + i * n, x.b + i * n};
      const Difference back{x.a + (rows - 1 - i) * n, x.b + (rows - 1 - i) * n};
      for (std::size_t j = 0; j < half; ++j) {
        const T a = static_cast<T>(front[j] * factor);
        const T b = static_cast<T>(front[n - 1 - j] * factor);
        const T c = static_cast<T>(back[j] * factor);
        const T d = static_cast<T>(back[n - 1 - j] * factor);
        q.plus_plus[j] = (a + b) + (c + d);
        q.plus_minus[j] = (a - b) + (c - d);
        q.minus_plus[j] = (a + b) - (c + d);
        q.minus_minus[j] = (a - b) - (c - d);
      }
      if (n % 2 != 0) {
        q.plus_plus[half] =
            static_cast<T>(front[half] * factor) + static_cast<T>(back[half] * factor);
        q.minus_plus[half] =
            static_cast<T>(front[half] * factor) - static_cast<T>(back[half] * factor);
      }
      q.plus_plus += n - half;
      q.minus_plus += n - half;
      q.plus_minus += half;
      q.minus_minus += half;
    }
    if (rows % 2 != 0) {
      const Difference middle{x.a + rows / 2 * n, x.b + rows / 2 * n};
      for (std::size_t j = 0; j < half; ++j) {
        const T a = static_cast<T>(middle[j] * factor);
        const T b = static_cast<T>(middle[n - 1 - j] * factor);
        q.plus_plus[j] = a + b;
        q.plus_minus[j] = a - b;
      }
      if (n % 2 != 0) q.plus_plus[half] = static_cast<T>(middle[half] * factor);
    }
    x.a += rows * n;
    x.b += rows * n;
  });
  if (grid_.partners.empty()) return;
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
void Folding<T>::unfold(T* folded, double factor, double* y) const noexcept {
  if (!grid_.partners.empty()) {
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
  const std::size_t rows = grid_.rows;
  const std::size_t n = grid_.columns;
  const std::size_t half = n / 2;
  const std::array<T*, 4> classes = beginnings(folded, reflected_);
  for_each_block(grid_, classes, [&](Quarters<T> q) {
    for (std::size_t i = 0; i < rows / 2; ++i) {
      double* const front = y + i * n;
      double* const back = y + (rows - 1 - i) * n;
      for (std::size_t j = 0; j < half; ++j) {
        const double pp = static_cast<double>(q.plus_plus[j]);
        const double pm = static_cast<double>(q.plus_minus[j]);
        const double mp = static_cast<double>(q.minus_plus[j]);
        const double mm = static_cast<double>(q.minus_minus[j]);
        front[j] = factor * ((pp + mp) + (pm + mm));
        front[n - 1 - j] = factor * ((pp + mp) - (pm + mm));
        back[j] = factor * ((pp - mp) + (pm - mm));
        back[n - 1 - j] = factor * ((pp - mp) - (pm - mm));
      }
      if (n % 2 != 0) {
        const double pp = static_cast<double>(q.plus_plus[half]);
        const double mp = static_cast<double>(q.minus_plus[half]);
        front[half] = factor * (pp + mp);
        back[half] = factor * (pp - mp);
      }
      q.plus_plus += n - half;
      q.minus_plus += n - half;
      q.plus_minus += half;
      q.minus_minus += half;
    }
    if (rows % 2 != 0) {
      double* const middle = y + rows / 2 * n;
      for (std::size_t j = 0; j < half; ++j) {
        const double pp = static_cast<double>(q.plus_plus[j]);
        const double pm = static_cast<double>(q.plus_minus[j]);
        middle[j] = factor * (pp + pm);
        middle[n - 1 - j] = factor * (pp - pm);
      }
      if (n % 2 != 0) middle[half] = factor * static_cast<double>(q.plus_plus[half]);
    }
    y += rows * n;
  });
}

template class Folding<double>;
template class Folding<float>;

}  // namespace tactile_net
