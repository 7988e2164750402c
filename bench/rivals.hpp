/// @file
/// What else turns readings into tractions, for the machine at hand (-march=native): a library of
/// its own, so that Eigen's functions for this machine never meet those for every machine.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace bench {

/// Every product takes g, `rows` readings, to f, `columns` tractions.
class [[gnu::visibility("default")]] Rivals {
 public:
  /// @param kernel  K, rows x columns, row-major
  /// @param normal  P = K'K + ..., columns x columns
  Rivals(const double* kernel, const double* normal, std::size_t rows, std::size_t columns);
  ~Rivals();
  Rivals(const Rivals&) = delete;
  Rivals& operator=(const Rivals&) = delete;

  /// M = P^-1 K', column-major, columns x rows.
  [[nodiscard]] const double* matrix() const noexcept;

  void eigen_product(const double* g, double* f) const noexcept;
  void openblas_product(const double* g, double* f) const noexcept;
  /// K' g and P's factors.
  void ldlt(const double* g, double* f) const noexcept;
  /// P's factors alone, given b = K' g.
  void ldlt_solve(const double* b, double* f) const noexcept;
  /// Factors P in every frame.
  void factor_and_solve(const double* g, double* f);

  /// Reads M once and sums it up: no product can be faster than its matrix arrives. Two ways, of
  /// which the faster counts.
  [[nodiscard]] double stream() const noexcept;
  [[nodiscard]] double stream_with_prefetch() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Sums `count` doubles on a cache line, a multiple of eight, as `Rivals::stream` does.
[[gnu::visibility("default")]] double sum(const double* values, std::size_t count) noexcept;

/// f = M g by Eigen, M columns x rows and column-major.
[[gnu::visibility("default")]] void eigen_product(const double* matrix, std::size_t rows,
                                                  std::size_t columns, const double* g,
                                                  double* f) noexcept;

/// The same by OpenBLAS on one thread; nothing where it is not installed.
[[gnu::visibility("default")]] void openblas_product(const double* matrix, std::size_t rows,
                                                     std::size_t columns, const double* g,
                                                     double* f) noexcept;

/// F = M G by Eigen, of `frames` g and f, one after the other.
[[gnu::visibility("default")]] void eigen_batch(const double* matrix, std::size_t rows,
                                                std::size_t columns, std::size_t frames,
                                                const double* g, double* f) noexcept;

/// Products that a round of `multiply_in_registers` adds up: no other can be faster.
[[gnu::visibility("default")]] extern const std::size_t products_of_a_round;
[[gnu::visibility("default")]] double multiply_in_registers(std::size_t rounds) noexcept;

/// OpenBLAS' version and kernels; empty: not installed.
[[gnu::visibility("default")]] std::string openblas();

}  // namespace bench
