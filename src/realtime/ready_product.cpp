#include "realtime/ready_product.hpp"

#include <algorithm>

namespace tactile_net {
namespace {

/// Larger products come from beyond a core's own caches, where hardware fetches too late and not
/// across pages: they are asked for a page ahead. Smaller ones arrive no sooner, and asking costs.
constexpr std::size_t near_cache = std::size_t{1} << 20;

/// One or two rows beyond whole cache lines are multiplied by themselves: 81 taxels would else
/// stream 88 rows.
template <class T>
std::size_t rows_by_themselves(std::size_t rows) noexcept {
  const std::size_t beyond = rows % (cache_line / sizeof(T));
  return sizeof(T) == sizeof(double) && beyond <= 2 ? beyond : 0;
}

}  // namespace

template <class T>
Panels<T>::Panels(const Factor& factor, std::size_t most, bool beyond)
    : columns(factor.columns),
      single_rows(rows_by_themselves<T>(factor.rows)),
      far(beyond),
      values(padded<T>(factor.rows - single_rows) * columns + single_rows * padded<T>(columns)) {
  constexpr std::size_t line = cache_line / sizeof(T);
  const std::size_t in_panels = factor.rows - single_rows;
  const std::size_t all = padded<T>(in_panels) / line;
  panels = (all + most - 1) / most;
  if (panels > 0) {
    lines = all / panels;
    narrow_panels = panels - all % panels;
  }
  T* p = values.data();
  for (std::size_t panel = 0, row = 0; panel < panels; ++panel) {
    const std::size_t width = (lines + (panel < narrow_panels ? 0 : 1)) * line;
    for (std::size_t j = 0; j < columns; ++j, p += width)
      for (std::size_t i = 0; i < width && row + i < in_panels; ++i)
        p[i] = static_cast<T>(factor.values[(row + i) * columns + j]);
    row += width;
  }
  for (std::size_t row = in_panels; row < factor.rows; ++row, p += padded<T>(columns))
    for (std::size_t j = 0; j < columns; ++j)
      p[j] = static_cast<T>(factor.values[row * columns + j]);
}

template <class T>
ReadyProduct<T>::ReadyProduct(const ProductPlan& plan, std::size_t most_lines,
                              std::size_t most_shared)
    : structure(plan.structure),
      rows(plan.rows),
      columns(plan.columns),
      scale(plan.scale),
      input_size(padded<T>(columns) + cache_line),
      middle_size(0),
      output_size(padded<T>(rows) + cache_line) {
  if (has_reflections(structure)) {
    fold_x.emplace(plan.column_grid);
    fold_y.emplace(plan.row_grid);
    input_size = fold_x->scratch_size();
    output_size = fold_y->scratch_size();
  }
  const std::size_t per_class = is_low_rank(structure) ? 2 : 1;
  const bool shares = fold_x && fold_x->exchanges();
  factors.reserve(plan.factors.size());
  for (std::size_t i = 0; i < plan.factors.size(); ++i)
    factors.emplace_back(plan.factors[i], shares && i / per_class == 2 ? most_shared : most_lines,
                         streamed_bytes(plan) > near_cache);
  for (std::size_t i = 0; i < factors.size() && per_class == 2; i += 2)
    middle_size = std::max(middle_size, padded<T>(plan.factors[i].rows));
  if (shares) middle_size *= 2;
  if (!fold_x) classes.emplace_back();
  for (std::size_t c = 0; fold_x && c < fold_x->classes(); ++c) {
    if (plan.factors[(c + 1) * per_class - 1].rows == 0) continue;
    ProductClass& next = classes.emplace_back();
    next = {c * per_class, fold_x->offset(c), fold_y->offset(c), shares && c == 2};
    if (!next.twice) continue;
    next.other_input = fold_x->second_offset();
    next.other_output = fold_y->second_offset();
  }
}

template struct Panels<double>;
template struct Panels<float>;
template struct ReadyProduct<double>;
template struct ReadyProduct<float>;

}  // namespace tactile_net
