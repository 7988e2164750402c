#include "control/product_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "control/circulant.hpp"
#include "numeric/decompositions.hpp"

namespace tactile_net {
namespace {

/// What one factor costs besides its bytes, in bytes: loop ends, and waiting for the one before.
constexpr double cost_of_a_factor = 1600.0;

/// What scaling a frame for floats costs, and converting it there and back.
constexpr double cost_of_floats = 4096.0;

/// What a transform of m real values costs, in bytes over m log2(m): measured (bench/fft_bench).
constexpr double cost_of_a_transform = 25.0;

/// One class of the matrix in its orthonormal basis; without parity the matrix itself.
struct Class {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd row_scale;  // to plain sums and differences, and the task's factors
  Eigen::VectorXd column_scale;
  Eigen::MatrixXd explained;  // the task's, in this basis
  std::optional<Svd> svd{};
};

/// Bounds of what is computed minus A: norm of the difference, of the difference times `explained`,
/// and of the rounding of the sums.
struct Error {
  double matrix = 0.0;
  double explained = 0.0;
  double rounding = 0.0;
};

/// Bound of a sum of `terms` terms, over the sum of their magnitudes (Higham 2002, 3.1), and of
/// three more roundings: the entry's, the reading's, the result's.
double rounding(Precision precision, std::size_t terms) {
  const double unit = precision == Precision::float64 ? 0x1p-53 : 0x1p-24;
  const double k = static_cast<double>(terms + 3) * unit;
  return k < 1.0 ? k / (1.0 - k) : std::numeric_limits<double>::infinity();
}

/// Bound of one FFT's error over its result, in the 2-norm; see planner.hpp.
double transform_rounding(std::size_t size) {
  constexpr double eta = 6.7 * 0x1p-53;
  return 2.0 * eta * std::log2(2.0 * static_cast<double>(size));
}

Factor factor_of(const Eigen::MatrixXd& a) {
  Factor factor{static_cast<std::size_t>(a.rows()), static_cast<std::size_t>(a.cols()), {}};
  factor.values.reserve(factor.rows * factor.columns);
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j) factor.values.push_back(a(i, j));
  return factor;
}

double largest(const std::vector<Eigen::MatrixXd>& matrices) {
  double size = 0.0;
  for (const Eigen::MatrixXd& matrix : matrices)
    size = std::max(size, matrix.size() > 0 ? matrix.cwiseAbs().maxCoeff() : 0.0);
  return size;
}

/// The power of two that brings the largest entry into [1/2, 1).
double power_of_two(double size) {
  return size > 0.0 ? std::ldexp(1.0, -std::ilogb(size) - 1) : 1.0;
}

/// |A|_2 from below, by power iteration.
double norm_from_below(const Eigen::MatrixXd& a) {
  Eigen::Index widest = 0;
  a.colwise().norm().maxCoeff(&widest);
  Eigen::VectorXd x = Eigen::VectorXd::Unit(a.cols(), widest);
  double norm = 0.0;
  for (int i = 0; i < 50; ++i) {
    const Eigen::VectorXd y = a * x;
    norm = y.norm();
    if (!(norm > 0.0)) break;
    x = (a.transpose() * y).normalized();
  }
  return norm;
}

class Planner {
 public:
  explicit Planner(const ProductTask& task) : task_(task) {
    const Eigen::MatrixXd mirror = mirrored(task.matrix, task.row_signs, task.column_signs);
    asymmetry_ = 0.5 * (task.matrix - mirror).norm();
    norm_ = norm_from_below(task.matrix);
    explained_norm_ = norm_bound(task.explained);
    whole_.push_back({task.matrix, task.row_factors, task.column_factors, task.explained});
    if (!task.symmetric) return;
    for (const int which : {0, 1}) {
      const auto factors = [&](const Eigen::VectorXd& all, const Signs& signs) {
        const Eigen::MatrixXd basis = class_basis(signs, all.size(), which);
        // Constant within a block, so any entry that the basis vector touches has it.
        Eigen::VectorXd scale = class_scale(signs, all.size(), which);
        for (Eigen::Index k = 0; k < basis.cols(); ++k) {
          Eigen::Index touched = 0;
          basis.col(k).cwiseAbs().maxCoeff(&touched);
          scale(k) *= all(touched);
        }
        return std::pair(basis, scale);
      };
      const auto [rows, row_scale] = factors(task.row_factors, task.row_signs);
      const auto [columns, column_scale] = factors(task.column_factors, task.column_signs);
      classes_.push_back({rows.transpose() * task.matrix * columns, row_scale, column_scale,
                          task.explained.size() > 0
                              ? Eigen::MatrixXd(columns.transpose() * task.explained)
                              : Eigen::MatrixXd()});
    }
    if (classes_[0].matrix.size() == 0 || classes_[1].matrix.size() == 0) classes_.clear();
  }

  PlannedProduct plan() {
    if (task_.structure && has_parity(*task_.structure) && classes_.empty())
      throw std::invalid_argument("the array is not mirror symmetric (dead taxels, gains?): " +
                                  std::string(name(*task_.structure)) + " cannot be used");
    if (task_.structure == Structure::fft && task_.precision == Precision::float32)
      throw std::invalid_argument("fft has precision float64 only");
    PlannedProduct best{.asymmetry = asymmetry_ / norm_, .symmetric = !classes_.empty()};
    std::optional<std::size_t> chosen;
    for (const Structure structure : structures())
      for (const Precision precision : {Precision::float64, Precision::float32}) {
        if (task_.precision && *task_.precision != precision) continue;
        if (structure == Structure::fft && precision == Precision::float32) continue;
        auto [plan, candidate] =
            structure == Structure::fft ? attempt_fft() : attempt(structure, precision, nullptr);
        const bool forced = task_.structure.has_value() || task_.precision.has_value();
        const auto rank_of = [](const Candidate& c) {
          return std::pair(!c.accurate, c.accurate ? c.cost : c.error_bound);
        };
        if (!chosen || rank_of(candidate) < rank_of(best.candidates[*chosen])) {
          if (candidate.accurate || forced) {
            chosen = best.candidates.size();
            best.plan = std::move(plan);
          }
        }
        best.candidates.push_back(std::move(candidate));
      }
    best.candidates[*chosen].chosen = true;
    return best;
  }

 private:
  [[nodiscard]] std::vector<Structure> structures() const {
    if (task_.structure) return {*task_.structure};
    std::vector<Structure> all{Structure::dense};
    // Parity halves what the others stream: with it, they are never the cheapest.
    if (!classes_.empty()) {
      all.push_back(Structure::parity);
      all.push_back(Structure::parity_low_rank);
    }
    if (classes_.empty() || task_.all_candidates) all.push_back(Structure::low_rank);
    if (!classes_.empty() && task_.allow_fft) all.push_back(Structure::fft);
    return all;
  }

  /// Tries transform sizes from 2n - 1 (no wrap-around) down to n and keeps the cheapest. A shorter
  /// transform is cheaper, but what wraps around has to be corrected by a larger low-rank part.
  std::pair<ProductPlan, Candidate> attempt_fft() {
    const auto n = static_cast<std::size_t>(task_.matrix.rows()) / task_.row_signs.size();
    std::optional<std::pair<ProductPlan, Candidate>> best;
    std::size_t tried = 0;
    for (const std::size_t least : {2 * n - 1, n + n / 2, n + n / 4, n}) {
      const std::size_t size = transform_size(least);
      if (size == std::exchange(tried, size)) continue;
      const Circulant circulant = circulant_of(size);
      auto next = attempt(Structure::fft, Precision::float64, &circulant);
      if (!best || (next.second.accurate && next.second.cost < best->second.cost))
        best = std::move(next);
    }
    return std::move(*best);
  }

  /// T, and what is left of the classes without it.
  struct Circulant {
    std::vector<double> spectra;
    std::size_t size = 0;
    std::vector<Class> rest;
    double norm = 0.0;  // of the magnitudes of its spectra at one frequency, from above
  };

  [[nodiscard]] Circulant circulant_of(std::size_t size) const {
    const Eigen::Index n = task_.matrix.rows() / std::ssize(task_.row_signs);
    const auto rows = std::ssize(task_.row_signs);
    const auto columns = std::ssize(task_.column_signs);
    Circulant circulant{{}, size, classes_, 0.0};
    Eigen::MatrixXd whole(task_.matrix.rows(), task_.matrix.cols());
    std::vector<Eigen::MatrixXd> magnitudes(size / 2 + 1, Eigen::MatrixXd(rows, columns));
    for (Eigen::Index u = 0; u < rows; ++u)
      for (Eigen::Index c = 0; c < columns; ++c) {
        const int sign = task_.row_signs[static_cast<std::size_t>(u)] *
                         task_.column_signs[static_cast<std::size_t>(c)];
        const double unit = task_.row_factors(u * n) * task_.column_factors(c * n);
        std::vector<double> spectrum =
            circulant_spectrum(task_.matrix.block(u * n, c * n, n, n), sign, size);
        for (double& value : spectrum) {
          value *= unit;
          circulant.spectra.push_back(value);
          value /= unit;  // as it will act, rounding included
        }
        for (std::size_t k = 0; k < spectrum.size(); ++k)
          magnitudes[k](u, c) = std::abs(spectrum[k]);
        whole.block(u * n, c * n, n, n) = circulant_corner(spectrum, sign, n);
      }
    for (const Eigen::MatrixXd& magnitude : magnitudes)
      circulant.norm = std::max(circulant.norm, norm_bound(magnitude));
    for (const int which : {0, 1}) {
      Class& rest = circulant.rest[static_cast<std::size_t>(which)];
      rest.svd.reset();
      rest.matrix -= class_basis(task_.row_signs, whole.rows(), which).transpose() * whole *
                     class_basis(task_.column_signs, whole.cols(), which);
    }
    return circulant;
  }

  [[nodiscard]] double rounding_of(const Circulant& circulant) const {
    const double there = transform_rounding(circulant.size);
    // Two transforms; spectrum, scaling, product, sums over blocks and with the correction.
    return circulant.norm * (2.0 * there + there * there +
                             rounding(Precision::float64, 3 + task_.column_signs.size()));
  }

  [[nodiscard]] double cost_of(const Circulant& circulant) const {
    const auto m = static_cast<double>(circulant.size);
    return cost_of_a_transform * m * std::log2(m) *
           static_cast<double>(task_.row_signs.size() + task_.column_signs.size());
  }

  /// One factor for each class, or two whose product it is but for what the accuracy allows: the
  /// first to act, and the second, in the orthonormal basis.
  [[nodiscard]] std::pair<std::vector<Eigen::MatrixXd>, std::vector<Eigen::MatrixXd>> factors_of(
      std::vector<Class>& parts, Structure structure) const {
    std::vector<Eigen::MatrixXd> first;
    std::vector<Eigen::MatrixXd> second;
    for (Class& part : parts) {
      if (!is_low_rank(structure)) {
        first.push_back(part.matrix);
        continue;
      }
      if (!part.svd) part.svd = singular_value_decomposition(part.matrix);
      const Svd& svd = *part.svd;
      const Eigen::Index rank = rank_for(svd, part.explained);
      first.push_back(svd.v.leftCols(rank).transpose());
      second.push_back(svd.u.leftCols(rank) * svd.values.head(rank).asDiagonal());
    }
    return {std::move(first), std::move(second)};
  }

  /// @param circulant  for fft: the factors are then of what is left without it
  std::pair<ProductPlan, Candidate> attempt(Structure structure, Precision precision,
                                            const Circulant* circulant) {
    const bool parity = has_parity(structure);
    std::vector<Class> rest;
    if (circulant != nullptr) rest = circulant->rest;
    std::vector<Class>& parts = circulant != nullptr ? rest : parity ? classes_ : whole_;
    Candidate candidate{.structure = structure, .precision = precision};

    auto [first, second] = factors_of(parts, structure);
    for (const Eigen::MatrixXd& last : second)
      candidate.ranks.push_back(static_cast<std::size_t>(last.cols()));

    ProductPlan plan{.structure = structure,
                     .precision = precision,
                     .rows = static_cast<std::size_t>(task_.matrix.rows()),
                     .columns = static_cast<std::size_t>(task_.matrix.cols())};
    if (parity) {
      plan.row_signs = task_.row_signs;
      plan.column_signs = task_.column_signs;
    }
    fold(parts, first, second);
    const double shrink_first =
        precision == Precision::float32 ? power_of_two(largest(first)) : 1.0;
    const double shrink_second =
        precision == Precision::float32 ? power_of_two(largest(second)) : 1.0;
    plan.scale = 1.0 / (shrink_first * shrink_second);
    Error error;
    if (parity) error = {asymmetry_, asymmetry_ * explained_norm_, 0.0};
    for (std::size_t c = 0; c < parts.size(); ++c) {
      const auto rounded = [&](Eigen::MatrixXd& matrix, double shrink) {
        matrix *= shrink;
        if (precision == Precision::float32) matrix = matrix.cast<float>().cast<double>().eval();
        plan.factors.push_back(factor_of(matrix));
        matrix /= shrink;
      };
      rounded(first[c], shrink_first);
      if (is_low_rank(structure)) rounded(second[c], shrink_second);
      const Error part =
          error_of(parts[c], first[c], is_low_rank(structure) ? &second[c] : nullptr, precision);
      error.matrix = std::hypot(error.matrix, part.matrix);
      error.explained = std::hypot(error.explained, part.explained);
      error.rounding = std::max(error.rounding, part.rounding);
    }
    if (circulant != nullptr) {
      plan.spectra = circulant->spectra;
      plan.transform_size = candidate.transform_size = circulant->size;
      error.rounding += rounding_of(*circulant);
      candidate.cost += cost_of(*circulant);
    }
    candidate.bytes = streamed_bytes(plan);
    candidate.cost += static_cast<double>(candidate.bytes) +
                      cost_of_a_factor * static_cast<double>(plan.factors.size()) +
                      (precision == Precision::float32 ? cost_of_floats : 0.0);
    candidate.error_bound = std::max((error.matrix + error.rounding) / norm_,
                                     error.explained + error.rounding * explained_norm_);
    candidate.accurate = (structure == Structure::dense && precision == Precision::float64) ||
                         candidate.error_bound <= task_.accuracy;
    return {std::move(plan), std::move(candidate)};
  }

  /// Smallest rank, at least 1, whose discarded part leaves a tenth of the accuracy for rounding.
  [[nodiscard]] Eigen::Index rank_for(const Svd& svd, const Eigen::MatrixXd& explained) const {
    // Of block matrices the error is that of the classes together.
    const double budget = (classes_.empty() ? 0.9 : 0.9 * std::sqrt(0.5)) * task_.accuracy;
    Eigen::VectorXd reach = Eigen::VectorXd::Zero(svd.values.size());
    if (explained.size() > 0)
      reach = svd.values.cwiseProduct((svd.v.transpose() * explained).rowwise().norm());
    Eigen::Index rank = svd.values.size();
    double tail = 0.0;
    double tail_reach = 0.0;
    for (; rank > 1; --rank) {
      tail = std::hypot(tail, svd.values(rank - 1));
      tail_reach = std::hypot(tail_reach, reach(rank - 1));
      if (tail > budget * norm_ || tail_reach > budget) break;
    }
    return rank;
  }

  /// From the orthonormal basis to plain sums and differences, and the task's own units.
  static void fold(const std::vector<Class>& parts, std::vector<Eigen::MatrixXd>& first,
                   std::vector<Eigen::MatrixXd>& second) {
    for (std::size_t c = 0; c < parts.size(); ++c) {
      first[c] = first[c] * parts[c].column_scale.asDiagonal();
      Eigen::MatrixXd& last = second.empty() ? first[c] : second[c];
      last = parts[c].row_scale.asDiagonal() * last;
    }
  }

  /// The difference of the stored factors, measured, and the rounding of the sums, bounded; back in
  /// the orthonormal basis.
  static Error error_of(const Class& part, Eigen::MatrixXd first, const Eigen::MatrixXd* second,
                        Precision precision) {
    const Eigen::VectorXd rows = part.row_scale.cwiseInverse();
    first = first * part.column_scale.cwiseInverse().asDiagonal();
    double rounded = rounding(precision, static_cast<std::size_t>(first.cols()));
    Eigen::MatrixXd difference;
    if (second == nullptr) {
      first = rows.asDiagonal() * first;
      difference = part.matrix - first;
      rounded *= norm_bound(first);
    } else {
      const Eigen::MatrixXd last = rows.asDiagonal() * *second;
      difference = part.matrix - last * first;
      const double again = rounding(precision, static_cast<std::size_t>(last.cols()));
      rounded = (rounded + again + rounded * again) * norm_bound(last) * norm_bound(first);
    }
    return {difference.norm(),
            part.explained.size() > 0 ? (difference * part.explained).norm() : 0.0, rounded};
  }

  const ProductTask& task_;
  double asymmetry_ = 0.0;
  double norm_ = 0.0;            // of A, from below
  double explained_norm_ = 0.0;  // from above
  std::vector<Class> whole_;
  std::vector<Class> classes_;
};

}  // namespace

double norm_bound(const Eigen::MatrixXd& a) {
  if (a.size() == 0) return 0.0;
  return std::sqrt(a.cwiseAbs().rowwise().sum().maxCoeff()) *
         std::sqrt(a.cwiseAbs().colwise().sum().maxCoeff());
}

PlannedProduct plan_product(const ProductTask& task) { return Planner(task).plan(); }

}  // namespace tactile_net
