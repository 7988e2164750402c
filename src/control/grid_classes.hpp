/// @file
/// The classes that reflections, and the exchange of y and z, make of a matrix. Private.
#pragma once

#include <vector>

#include "control/class_factors.hpp"
#include "control/product_planner.hpp"

namespace tactile_net {

struct GridClasses {
  std::vector<MatrixClass> classes{};
  double asymmetry = 0.0;  ///< |A - the classes put together again|_F
};

/// In the order of product_plan.hpp. O(size of A) for each.
[[nodiscard]] GridClasses grid_classes_of(const ProductTask& task, const GridBlocks& rows,
                                          const GridBlocks& columns);

}  // namespace tactile_net
