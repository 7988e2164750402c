#include "tactile_net/realtime/product_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "realtime/finite.hpp"
#include "realtime/folding.hpp"

namespace tactile_net {
namespace {

void require_of_product(bool holds, const char* rule) {
  if (!holds) throw std::invalid_argument(std::string("product plan: ") + rule);
}

/// @param empty  of a class that a narrow grid has no place for
void check_values(const Factor& factor, Precision precision, bool empty) {
  require_of_product(
      empty ? factor.values.empty()
            : factor.rows > 0 && factor.columns > 0 &&
                  factor.values.size() / factor.columns == factor.rows &&
                  factor.values.size() % factor.columns == 0,
      "a factor needs rows x columns values, at least one, and none in a class without places");
  for (const double value : factor.values) {
    require_of_product(std::isfinite(value), "a factor is not finite");
    if (precision == Precision::float32)
      require_of_product(
          std::abs(value) <= 0x1p20 && static_cast<double>(static_cast<float>(value)) == value,
          "a factor of precision float32 needs floats of at most 2^20");
  }
}

bool is_transform_size(std::size_t size) {
  if (size == 0 || size % 2 != 0 || size >= std::size_t{1} << 30) return false;
  for (const std::size_t prime : {2U, 3U, 5U, 7U})
    while (size % prime == 0) size /= prime;
  return size == 1;
}

/// After the grids.
void check_convolution(const ProductPlan& plan) {
  require_of_product(plan.precision == Precision::float64 && plan.scale == 1.0,
                     "fft needs precision float64 and scale 1");
  const std::size_t n = plan.row_grid.columns;
  require_of_product(plan.row_grid.rows == 1 && plan.column_grid.rows == 1 &&
                         plan.row_grid.partners.empty() && plan.column_grid.columns == n,
                     "fft needs lines: blocks of one row and one length, without partners");
  require_of_product(
      is_transform_size(plan.transform_size) && plan.transform_size >= n,
      "the transform's size must be even, at least a block's, < 2^30, and without a prime "
      "factor above 7");
  const std::size_t bins = plan.transform_size / 2 + 1;
  const std::size_t blocks = plan.row_grid.signs_z.size() * plan.column_grid.signs_z.size();
  require_of_product(plan.spectra.size() % bins == 0 && plan.spectra.size() / bins == blocks,
                     "fft needs a spectrum for each block");
  require_of_product(std::all_of(plan.spectra.begin(), plan.spectra.end(),
                                 [](double value) { return std::isfinite(value); }),
                     "a spectrum is not finite");
}

void check_grid(const GridBlocks& grid, std::size_t size) {
  // Places are counted in 32 bits.
  require_of_product(grid.rows > 0 && grid.columns > 0 && std::in_range<std::uint32_t>(size) &&
                         !grid.signs_y.empty() && grid.signs_y.size() == grid.signs_z.size(),
                     "reflections need grids, and two signs for each block");
  // By division: a product of sizes from a file may be beyond any integer.
  require_of_product(grid.columns <= size / grid.rows &&
                         grid.signs_y.size() <= size / (grid.rows * grid.columns) &&
                         grid.size() == size,
                     "the grids do not fit the product's size");
  for (const auto* signs : {&grid.signs_y, &grid.signs_z})
    require_of_product(
        std::all_of(signs->begin(), signs->end(), [](int sign) { return sign == 1 || sign == -1; }),
        "a block's sign must be 1 or -1");
  if (grid.partners.empty()) return;
  require_of_product(grid.rows == grid.columns && grid.partners.size() == grid.signs_y.size(),
                     "partners need square grids, and one for each block");
  for (std::size_t b = 0; b < grid.partners.size(); ++b) {
    const std::size_t other = grid.partners[b];
    require_of_product(other < grid.partners.size() && grid.partners[other] == b &&
                           grid.signs_y[other] == grid.signs_z[b],
                       "partners must be mutual, and their signs exchanged");
  }
}

/// Sizes of x and y by classes.
struct ClassesOf {
  std::vector<std::size_t> columns, rows;
};

ClassesOf classes_of(const ProductPlan& plan) {
  if (has_reflections(plan.structure)) {
    check_grid(plan.row_grid, plan.rows);
    check_grid(plan.column_grid, plan.columns);
    require_of_product(plan.row_grid.partners.empty() == plan.column_grid.partners.empty(),
                       "partners are of both sides or of none");
    return {class_sizes(plan.column_grid), class_sizes(plan.row_grid)};
  }
  require_of_product(plan.row_grid.size() == 0 && plan.column_grid.size() == 0,
                     "grids belong to reflections alone");
  return {{plan.columns}, {plan.rows}};
}

}  // namespace

GridBlocks line_blocks(std::size_t count, std::vector<std::int8_t> signs) {
  GridBlocks blocks{.rows = 1, .columns = count};
  blocks.signs_y.assign(signs.size(), 1);
  blocks.signs_z = std::move(signs);
  return blocks;
}

std::vector<std::size_t> class_sizes(const GridBlocks& grid) {
  std::vector<std::size_t> sizes;
  for (const GridClass one : grid_classes) {
    const std::size_t size = class_size(grid, one);
    if (grid.partners.empty()) {
      sizes.push_back(size);
    } else if (one.y == one.z) {
      const std::size_t alone = places_on_diagonal(grid, one);
      sizes.push_back((size + alone) / 2);
      sizes.push_back((size - alone) / 2);
    } else if (one.y > one.z) {
      sizes.push_back(size);
    }
  }
  return sizes;
}

void check(const ProductPlan& plan) {
  require_of_product(is_known(plan.structure) && is_known(plan.precision),
                     "structure or precision is unknown");
  require_of_product(plan.rows > 0 && plan.columns > 0, "sizes must be > 0");
  require_of_product(plan.scale > 0.0 && std::isfinite(plan.scale), "scale must be > 0 and finite");
  const auto [in, out] = classes_of(plan);
  if (plan.structure == Structure::fft) check_convolution(plan);
  const std::size_t per_class = is_low_rank(plan.structure) ? 2 : 1;
  require_of_product(plan.factors.size() == in.size() * per_class, "wrong number of factors");
  bool has_values = false;
  for (std::size_t c = 0; c < in.size(); ++c) {
    const Factor& first = plan.factors[c * per_class];
    const Factor& last = plan.factors[c * per_class + per_class - 1];
    const bool empty = has_reflections(plan.structure) && (in[c] == 0 || out[c] == 0);
    for (std::size_t k = 0; k < per_class; ++k)
      check_values(plan.factors[c * per_class + k], plan.precision, empty);
    require_of_product(first.columns == in[c] && last.rows == out[c] &&
                           (per_class == 1 || first.rows == last.columns),
                       "the factors' sizes do not fit");
    // Whatever is made ready for a product is bounded by the values that it holds.
    require_of_product(!empty || per_class == 1 || first.rows == 0,
                       "two factors of a class without places must have rank 0");
    has_values = has_values || !empty;
  }
  require_of_product(has_values, "no class has places on both sides: nothing is multiplied");
}

std::size_t streamed_bytes(const ProductPlan& plan) noexcept {
  std::size_t values = plan.spectra.size();
  for (const Factor& factor : plan.factors) values += factor.values.size();
  return values * (plan.precision == Precision::float64 ? sizeof(double) : sizeof(float));
}

}  // namespace tactile_net
