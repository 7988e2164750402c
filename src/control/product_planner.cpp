#include "control/product_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "control/circulant.hpp"
#include "control/class_factors.hpp"
#include "control/grid_classes.hpp"
#include "numeric/decompositions.hpp"

namespace tactile_net {
namespace {

/// What one factor costs besides its bytes, in bytes: loop ends, and waiting for the one before.
constexpr double cost_of_a_factor = 1600.0;

/// What scaling a frame for floats costs, and converting it there and back.
constexpr double cost_of_floats = 4096.0;

/// What a transform of m real values costs, in bytes over m log2(m): measured (bench/fft_bench).
constexpr double cost_of_a_transform = 25.0;

/// What parting a skin's vector into classes and joining them again costs, in bytes over its
/// length; a line's costs nothing beside its factors.
constexpr double cost_of_folding = 40.0;

/// Places that a skin's sum over a class adds up before and after its factors. Of a line it is one
/// sum each, which `rounding` has.
constexpr std::size_t folded_places = 16;

/// How far A may be from its images, over |A|: beyond, no class is worth a try.
constexpr double largest_asymmetry = 1e-6;

/// Bound of one FFT's error over its result, in the 2-norm; see planner.hpp.
double transform_rounding(std::size_t size) {
  constexpr double eta = 6.7 * 0x1p-53;
  return 2.0 * eta * std::log2(2.0 * static_cast<double>(size));
}

void check_structure(const ProductTask& task, bool symmetric) {
  if (!task.structure) return;
  if (has_reflections(*task.structure) && !symmetric)
    throw std::invalid_argument(
        "the array is not mirror symmetric (dead or uneven taxels, gains?): " +
        std::string(name(*task.structure)) + " cannot be used");
  if (task.structure == Structure::fft && task.precision == Precision::float32)
    throw std::invalid_argument("fft has precision float64 only");
}

/// True if low rank paid in the candidates without the exchange of y and z: two factors for each
/// class cost less than one. It then pays with the exchange too, since the ranks are the same.
bool low_rank_pays(const std::vector<Candidate>& tried) {
  const auto cost_of = [&](Structure structure) {
    double cost = std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : tried)
      if (candidate.structure == structure && !candidate.exchanged)
        cost = std::min(cost, candidate.cost);
    return cost;
  };
  return cost_of(Structure::reflections_low_rank) < cost_of(Structure::reflections);
}

class Planner {
 public:
  explicit Planner(const ProductTask& task) : task_(task) {
    const Eigen::MatrixXd& target = task.target.size() > 0 ? task.target : task.matrix;
    norm_ = norm_from_below(target);
    explained_norm_ = norm_bound(task.explained);
    whole_.push_back({target, task.row_factors, task.column_factors, task.explained});
    if (task.row_grid.size() > 0)
      part_grid();
    else
      asymmetry_ = target.norm();  // no classes give anything of it
  }

  PlannedProduct plan() {
    check_structure(task_, !classes_.empty());
    PlannedProduct best{.asymmetry = asymmetry_ / norm_, .symmetric = !classes_.empty()};
    std::optional<std::size_t> chosen;
    for (const auto& [structure, exchanged] : structures())
      for (const Precision precision : {Precision::float64, Precision::float32}) {
        if (task_.precision && *task_.precision != precision) continue;
        if (structure == Structure::fft && precision == Precision::float32) continue;
        if (structure == Structure::reflections_low_rank && exchanged && !task_.structure &&
            !task_.all_candidates && !low_rank_pays(best.candidates))
          continue;
        auto [plan, candidate] = structure == Structure::fft
                                     ? attempt_fft()
                                     : attempt(structure, precision, nullptr, exchanged);
        const bool forced = task_.structure.has_value() || task_.precision.has_value();
        if (!chosen || is_better(candidate, best.candidates[*chosen])) {
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
  /// A structure, and whether it uses the exchange of y and z.
  struct Way {
    Structure structure;
    bool exchanged = false;
  };

  /// Blocks are single rows.
  [[nodiscard]] bool is_line() const { return task_.row_grid.rows == 1; }

  [[nodiscard]] std::vector<Way> structures() const {
    if (task_.structure) {
      std::vector<Way> all{{*task_.structure}};
      if (has_reflections(*task_.structure) && !exchanged_.empty())
        all.push_back({*task_.structure, true});
      return all;
    }
    std::vector<Way> all{{Structure::dense}};
    // Classes are a part of what the others stream: with them, those are never the cheapest.
    const bool symmetric = !classes_.empty();
    for (const bool exchanged : {false, true})
      if (exchanged ? !exchanged_.empty() : symmetric)
        for (const Structure structure : {Structure::reflections, Structure::reflections_low_rank})
          if (!task_.full_rank || !is_low_rank(structure)) all.push_back({structure, exchanged});
    if (task_.full_rank) return all;
    // Of few live readings the rank is theirs.
    if (!symmetric || task_.all_candidates || task_.fill.size() > 0)
      all.push_back({Structure::low_rank});
    if (symmetric && task_.allow_fft) all.push_back({Structure::fft});
    return all;
  }

  /// The classes, as far as there are any.
  void part_grid() {
    GridBlocks rows = task_.row_grid;
    GridBlocks columns = task_.column_grid;
    if (!rows.partners.empty()) exchanged_ = symmetric_classes(rows, columns, exchanged_asymmetry_);
    rows.partners.clear();
    columns.partners.clear();
    classes_ = symmetric_classes(rows, columns, asymmetry_);
    if (task_.fill.size() == 0) return;
    fill_norm_ = norm_bound(task_.fill);
    const double mismatch = (task_.matrix * task_.fill - whole_[0].matrix).norm();
    asymmetry_ = asymmetry_ * fill_norm_ + mismatch;
    exchanged_asymmetry_ = exchanged_asymmetry_ * fill_norm_ + mismatch;
  }

  std::vector<MatrixClass> symmetric_classes(const GridBlocks& rows, const GridBlocks& columns,
                                             double& asymmetry) const {
    GridClasses parted = grid_classes_of(task_, rows, columns);
    asymmetry = parted.asymmetry;
    if (!task_.symmetric || asymmetry > largest_asymmetry * norm_) parted.classes.clear();
    return std::move(parted.classes);
  }

  /// Tries transform sizes from 2n - 1 (no wrap-around) down to n and keeps the best. A shorter
  /// transform is cheaper, but what wraps around has to be corrected by a larger low-rank part.
  std::pair<ProductPlan, Candidate> attempt_fft() {
    const std::size_t n = task_.row_grid.columns;
    std::optional<std::pair<ProductPlan, Candidate>> best;
    std::size_t tried = 0;
    for (const std::size_t least : {2 * n - 1, n + n / 2, n + n / 4, n}) {
      const std::size_t size = transform_size(least);
      if (size == std::exchange(tried, size)) continue;
      const Circulant circulant = circulant_of(size);
      auto next = attempt(Structure::fft, Precision::float64, &circulant, false);
      if (!best || is_better(next.second, best->second)) best = std::move(next);
    }
    return std::move(*best);
  }

  /// T, and what is left of the classes without it.
  struct Circulant {
    std::vector<double> spectra;
    std::size_t size = 0;
    std::vector<MatrixClass> rest;
    double norm = 0.0;  // of the magnitudes of its spectra at one frequency, from above
  };

  [[nodiscard]] Circulant circulant_of(std::size_t size) const {
    const auto n = static_cast<Eigen::Index>(task_.row_grid.columns);
    const auto rows = std::ssize(task_.row_grid.signs_z);
    const auto columns = std::ssize(task_.column_grid.signs_z);
    Circulant circulant{{}, size, {}, 0.0};
    ProductTask rest = task_;
    std::vector<Eigen::MatrixXd> magnitudes(size / 2 + 1, Eigen::MatrixXd(rows, columns));
    for (Eigen::Index u = 0; u < rows; ++u)
      for (Eigen::Index c = 0; c < columns; ++c) {
        const int sign = task_.row_grid.signs_z[static_cast<std::size_t>(u)] *
                         task_.column_grid.signs_z[static_cast<std::size_t>(c)];
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
        rest.matrix.block(u * n, c * n, n, n) -= circulant_corner(spectrum, sign, n);
      }
    for (const Eigen::MatrixXd& magnitude : magnitudes)
      circulant.norm = std::max(circulant.norm, norm_bound(magnitude));
    circulant.rest = grid_classes_of(rest, rest.row_grid, rest.column_grid).classes;
    return circulant;
  }

  [[nodiscard]] double rounding_of(const Circulant& circulant) const {
    const double there = transform_rounding(circulant.size);
    // Two transforms; spectrum, scaling, product, sums over blocks and with the correction; and
    // where readings are filled in those sums.
    return circulant.norm * fill_norm_ *
           (2.0 * there + there * there +
            rounding(Precision::float64, 3 + task_.column_grid.signs_z.size()) + fill_rounding());
  }

  /// Of the sums that fill readings in, over the largest of them.
  [[nodiscard]] double fill_rounding() const {
    return task_.fill.size() > 0
               ? rounding(Precision::float64, static_cast<std::size_t>(task_.fill.cols()))
               : 0.0;
  }

  [[nodiscard]] double cost_of(const Circulant& circulant) const {
    const auto m = static_cast<double>(circulant.size);
    return cost_of_a_transform * m * std::log2(m) *
           static_cast<double>(task_.row_grid.signs_z.size() + task_.column_grid.signs_z.size());
  }

  /// One factor for each class, or two whose product it is but for what the accuracy allows: the
  /// first to act, and the second, in the orthonormal basis.
  [[nodiscard]] std::pair<std::vector<Eigen::MatrixXd>, std::vector<Eigen::MatrixXd>> factors_of(
      std::vector<MatrixClass>& parts, Structure structure) const {
    std::vector<Eigen::MatrixXd> first;
    std::vector<Eigen::MatrixXd> second;
    for (MatrixClass& part : parts) {
      if (!is_low_rank(structure)) {
        first.push_back(part.matrix);
        continue;
      }
      if (part.matrix.size() == 0) {
        first.emplace_back(0, part.matrix.cols());
        second.emplace_back(part.matrix.rows(), 0);
        continue;
      }
      if (!part.svd) part.svd = singular_value_decomposition(part.matrix);
      const Svd& svd = *part.svd;
      const Eigen::Index rank = rank_for(svd, part.explained);
      first.emplace_back(svd.v.leftCols(rank).transpose());
      second.emplace_back(svd.u.leftCols(rank) * svd.values.head(rank).asDiagonal());
    }
    return {std::move(first), std::move(second)};
  }

  /// @param circulant  for fft: the factors are then of what is left without it
  std::pair<ProductPlan, Candidate> attempt(Structure structure, Precision precision,
                                            const Circulant* circulant, bool exchanged) {
    const bool reflections = has_reflections(structure);
    std::vector<MatrixClass> rest;
    if (circulant != nullptr) rest = circulant->rest;
    std::vector<MatrixClass>& parts = circulant != nullptr ? rest
                                      : exchanged          ? exchanged_
                                      : reflections        ? classes_
                                                           : whole_;
    Candidate candidate{.structure = structure, .precision = precision, .exchanged = exchanged};

    auto [first, second] = factors_of(parts, structure);
    for (const Eigen::MatrixXd& last : second)
      if (last.size() > 0) candidate.ranks.push_back(static_cast<std::size_t>(last.cols()));

    ProductPlan plan{.structure = structure,
                     .precision = precision,
                     .rows = static_cast<std::size_t>(task_.matrix.rows()),
                     .columns = static_cast<std::size_t>(task_.matrix.cols())};
    if (reflections) {
      plan.row_grid = task_.row_grid;
      plan.column_grid = task_.column_grid;
      if (!exchanged) {
        plan.row_grid.partners.clear();
        plan.column_grid.partners.clear();
      }
    }
    fold(parts, first, second);
    const double shrink_first =
        precision == Precision::float32 ? power_of_two(largest(first)) : 1.0;
    const double shrink_second =
        precision == Precision::float32 ? power_of_two(largest(second)) : 1.0;
    plan.scale = 1.0 / (shrink_first * shrink_second);
    ProductError error;
    const double asymmetry = exchanged ? exchanged_asymmetry_ : asymmetry_;
    if (reflections) error = {asymmetry, asymmetry * explained_norm_, 0.0};
    const double negligible = is_line() ? 0.0 : 1e-2 * task_.accuracy * std::min(norm_, 1.0);
    for (std::size_t c = 0; c < parts.size(); ++c) {
      const auto rounded = [&](Eigen::MatrixXd& matrix, double shrink) {
        matrix *= shrink;
        if (precision == Precision::float32) matrix = matrix.cast<float>().cast<double>().eval();
        plan.factors.push_back(factor_of(matrix));
        matrix /= shrink;
      };
      rounded(first[c], shrink_first);
      if (is_low_rank(structure)) rounded(second[c], shrink_second);
      ProductError part =
          error_of(parts[c], first[c], is_low_rank(structure) ? &second[c] : nullptr, precision,
                   explained_norm_, negligible);
      if (reflections) part.rounding = folded_rounding(part.rounding, precision, first[c].cols());
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
    if (reflections) {
      candidate.bytes += sizeof(double) * task_.filled * plan.columns;
      if (!is_line())
        candidate.cost += cost_of_folding * (exchanged ? 1.5 : 1.0) *
                          static_cast<double>(plan.rows + plan.columns);
    }
    const auto multiplied =
        std::count_if(plan.factors.begin(), plan.factors.end(),
                      [](const Factor& factor) { return !factor.values.empty(); });
    candidate.cost += static_cast<double>(candidate.bytes) +
                      cost_of_a_factor * static_cast<double>(multiplied) +
                      (precision == Precision::float32 ? cost_of_floats : 0.0);
    candidate.error_bound = std::max((error.matrix + error.rounding) / norm_,
                                     error.explained + error.rounding * explained_norm_);
    candidate.accurate = (structure == Structure::dense && precision == Precision::float64) ||
                         candidate.error_bound <= task_.accuracy;
    return {std::move(plan), std::move(candidate)};
  }

  /// With the sums before and after the factors, and where readings are filled in those too.
  [[nodiscard]] double folded_rounding(double factors, Precision precision,
                                       Eigen::Index columns) const {
    const double more = is_line() ? 0.0
                                  : static_cast<double>(folded_places) /
                                        static_cast<double>(columns > 0 ? columns + 3 : 1);
    return factors * (1.0 + more + fill_rounding() / rounding(precision, 1)) * fill_norm_;
  }

  /// Smallest rank, at least 1, whose discarded part leaves a tenth of the accuracy for rounding.
  [[nodiscard]] Eigen::Index rank_for(const Svd& svd, const Eigen::MatrixXd& explained) const {
    // Of block matrices the error is that of the classes together.
    const double classes = classes_.empty() ? 1.0 : is_line() ? 2.0 : 6.0;
    const double budget = 0.9 / std::sqrt(classes) / fill_norm_ * task_.accuracy;
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

  const ProductTask& task_;
  double asymmetry_ = 0.0;
  double norm_ = 0.0;            // of A, from below
  double explained_norm_ = 0.0;  // from above
  double exchanged_asymmetry_ = 0.0;
  double fill_norm_ = 1.0;  // from above
  std::vector<MatrixClass> whole_;
  std::vector<MatrixClass> classes_;
  std::vector<MatrixClass> exchanged_;  // where exchanging y and z is used too
};

}  // namespace

bool is_better(const Candidate& one, const Candidate& other) {
  if (one.accurate != other.accurate) return one.accurate;
  return one.accurate ? one.cost < other.cost : one.error_bound < other.error_bound;
}

PlannedProduct plan_product(const ProductTask& task) { return Planner(task).plan(); }

}  // namespace tactile_net
