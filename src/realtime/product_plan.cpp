#include "tactile_net/realtime/product_plan.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace tactile_net {
namespace {

void require(bool holds, const char* rule) {
  if (!holds) throw std::invalid_argument(std::string("product plan: ") + rule);
}

void check_signs(const std::vector<std::int8_t>& signs, std::size_t size) {
  require(!signs.empty() && size % signs.size() == 0,
          "parity needs the signs of blocks of equal length");
  require(std::all_of(signs.begin(), signs.end(), [](int sign) { return sign == 1 || sign == -1; }),
          "a block's sign must be 1 or -1");
}

void check_values(const Factor& factor, Precision precision) {
  require(factor.rows > 0 && factor.columns > 0 &&
              factor.values.size() / factor.columns == factor.rows &&
              factor.values.size() % factor.columns == 0,
          "a factor needs rows x columns values, at least one");
  for (const double value : factor.values) {
    require(std::isfinite(value), "a factor is not finite");
    if (precision == Precision::float32)
      require(std::abs(value) <= 0x1p20 && static_cast<double>(static_cast<float>(value)) == value,
              "a factor of precision float32 needs floats of at most 2^20");
  }
}

bool is_transform_size(std::size_t size) {
  if (size == 0 || size % 2 != 0 || size >= std::size_t{1} << 30) return false;
  for (const std::size_t prime : {2U, 3U, 5U, 7U})
    while (size % prime == 0) size /= prime;
  return size == 1;
}

/// After the signs.
void check_convolution(const ProductPlan& plan) {
  require(plan.precision == Precision::float64 && plan.scale == 1.0,
          "fft needs precision float64 and scale 1");
  const std::size_t n = plan.rows / plan.row_signs.size();
  require(plan.columns / plan.column_signs.size() == n, "fft needs blocks of one length");
  require(is_transform_size(plan.transform_size) && plan.transform_size >= n,
          "the transform's size must be even, at least a block's, < 2^30, and without a prime "
          "factor above 7");
  const std::size_t bins = plan.transform_size / 2 + 1;
  const std::size_t blocks = plan.row_signs.size() * plan.column_signs.size();
  require(plan.spectra.size() % bins == 0 && plan.spectra.size() / bins == blocks,
          "fft needs a spectrum for each block");
  require(std::all_of(plan.spectra.begin(), plan.spectra.end(),
                      [](double value) { return std::isfinite(value); }),
          "a spectrum is not finite");
}

}  // namespace

std::string_view name(Structure structure) noexcept {
  switch (structure) {
    case Structure::dense:
      return "dense";
    case Structure::low_rank:
      return "low_rank";
    case Structure::parity:
      return "parity";
    case Structure::parity_low_rank:
      return "parity_low_rank";
    case Structure::fft:
      return "fft";
  }
  return "unknown";
}

std::string_view name(Precision precision) noexcept {
  return precision == Precision::float64 ? "float64" : "float32";
}

ClassSizes class_sizes(const std::vector<std::int8_t>& signs, std::size_t size) noexcept {
  ClassSizes sizes;
  const std::size_t n = size / signs.size();
  for (const std::int8_t sign : signs) {
    (sign > 0 ? sizes.even : sizes.odd) += n - n / 2;
    (sign > 0 ? sizes.odd : sizes.even) += n / 2;
  }
  return sizes;
}

void check(const ProductPlan& plan) {
  require(plan.structure <= Structure::fft && plan.precision <= Precision::float32,
          "structure or precision is unknown");
  require(plan.rows > 0 && plan.columns > 0, "sizes must be > 0");
  require(plan.scale > 0.0 && std::isfinite(plan.scale), "scale must be > 0 and finite");
  ClassSizes in{plan.columns, 0};
  ClassSizes out{plan.rows, 0};
  if (has_parity(plan.structure)) {
    check_signs(plan.row_signs, plan.rows);
    check_signs(plan.column_signs, plan.columns);
    in = class_sizes(plan.column_signs, plan.columns);
    out = class_sizes(plan.row_signs, plan.rows);
  }
  if (plan.structure == Structure::fft) check_convolution(plan);
  const std::size_t classes = has_parity(plan.structure) ? 2 : 1;
  const std::size_t per_class = is_low_rank(plan.structure) ? 2 : 1;
  require(plan.factors.size() == classes * per_class, "wrong number of factors");
  for (const Factor& factor : plan.factors) check_values(factor, plan.precision);
  for (std::size_t c = 0; c < classes; ++c) {
    const Factor& first = plan.factors[c * per_class];
    const Factor& last = plan.factors[c * per_class + per_class - 1];
    require(first.columns == (c == 0 ? in.even : in.odd) &&
                last.rows == (c == 0 ? out.even : out.odd) &&
                (per_class == 1 || first.rows == last.columns),
            "the factors' sizes do not fit");
  }
}

std::size_t streamed_bytes(const ProductPlan& plan) noexcept {
  std::size_t values = plan.spectra.size();
  for (const Factor& factor : plan.factors) values += factor.values.size();
  return values * (plan.precision == Precision::float64 ? sizeof(double) : sizeof(float));
}

}  // namespace tactile_net
