/// @file
/// Arrays on their way between NumPy and the library.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <initializer_list>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net::python {

namespace nb = nanobind;

/// What Python is given.
using Array = nb::ndarray<nb::numpy, double>;
/// Somebody else's values, to be read.
using View = nb::ndarray<nb::numpy, const double>;
/// What the Python layer hands over, checked and converted: one frame a row.
using Rows = nb::ndarray<const double, nb::numpy, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

/// What stands where there is no value.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// An array that owns its values.
[[nodiscard]] inline Array owned(std::vector<double> values,
                                 std::initializer_list<std::size_t> shape) {
  auto* kept = new std::vector<double>(std::move(values));
  const nb::capsule owner(kept,
                          [](void* p) noexcept { delete static_cast<std::vector<double>*>(p); });
  return {kept->data(), shape, owner};
}

[[nodiscard]] inline Array owned(std::vector<double> values) {
  const std::size_t size = values.size();
  return owned(std::move(values), {size});
}

[[nodiscard]] inline Array as_array(Matrix matrix) {
  return owned(std::move(matrix.values), {matrix.rows, matrix.columns});
}

/// Row `index`. @pre  there is one
[[nodiscard]] inline std::span<const double> row(const Rows& rows, std::size_t index) {
  return {rows.data() + index * rows.shape(1), rows.shape(1)};
}

}  // namespace tactile_net::python
