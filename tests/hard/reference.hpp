/// @file
/// The same problems in 50 decimal digits, by other ways: kernels from complex potentials and from
/// boundary conditions, minimisers from the normal equations, which 50 digits can afford.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/sensing/array.hpp"
#include "tactile_net/sensing/surface.hpp"

namespace tactile_net::hard {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                           boost::multiprecision::et_off>;
using Reals = std::vector<Real>;

/// A dense matrix, row-major.
struct RealMatrix {
  std::size_t rows = 0;
  std::size_t columns = 0;
  Reals values{};
  [[nodiscard]] Real& operator()(std::size_t i, std::size_t j) { return values[i * columns + j]; }
  [[nodiscard]] const Real& operator()(std::size_t i, std::size_t j) const {
    return values[i * columns + j];
  }
};

/// k(m D) D for m = -(count - 1) ... count - 1, as `sampled_kernel`.
[[nodiscard]] Reals reference_kernel(const Channel& channel, Traction load,
                                     const Material& material, std::size_t count, double pitch);

/// W K, of the true Toeplitz blocks or of the circular ones.
[[nodiscard]] RealMatrix reference_matrix(const SensorArray& array, const Material& material,
                                          const LineProblemOptions& options, bool circular);

/// The x of p x = f by U'D U, of p's upper triangle alone.
///
/// @throws std::domain_error if p is not positive definite
[[nodiscard]] Reals solved(RealMatrix p, Reals f);

/// The minimiser of linear_problem.hpp's functional.
///
/// @param ratio     l / D
/// @param circular  the stabiliser's differences close around the circle
[[nodiscard]] Reals reference_minimiser(const RealMatrix& kernel, const Reals& right, double alpha,
                                        double ratio, std::size_t count, bool circular);

/// W K of tractions that are hats on a surface, for taxels anywhere, and the minimiser of
/// linear_problem.hpp's functional there. Taxels are points.
[[nodiscard]] RealMatrix reference_hat_matrix(const SensorArray& array, const Material& material,
                                              const LineProblemOptions& options,
                                              const Surface& surface);
[[nodiscard]] Reals reference_hat_minimiser(const RealMatrix& kernel, const Reals& right,
                                            double alpha, const LinearProblem& problem);

/// P f - b for the true blocks.
[[nodiscard]] Reals reference_gradient(const RealMatrix& kernel, const Reals& right, double alpha,
                                       double ratio, std::size_t count, const Reals& f);

[[nodiscard]] Real norm(std::span<const Real> x);

/// |x - reference|_2 / |reference|_2; 0 if both are zero, infinite if only the reference is.
[[nodiscard]] double relative_error(std::span<const double> x, std::span<const Real> reference);

}  // namespace tactile_net::hard
