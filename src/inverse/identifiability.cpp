#include "tactile_net/inverse/identifiability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "inverse/coordinates.hpp"
#include "inverse/line_stabiliser.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "numeric/finite.hpp"

namespace tactile_net {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr std::size_t most_modes = 6;  // described in one space
constexpr double pure = 0.9;           // share from which a mode belongs to one traction

/// Columns 2 m and 2 m + 1: the cosine and the sine of m half waves in the array, centred, of unit
/// norm; a wave that is zero at every taxel is a column of zeros.
Eigen::MatrixXd half_waves(Eigen::Index n) {
  Eigen::MatrixXd waves(n, 2 * (n + 1));
  for (Eigen::Index m = 0; m <= n; ++m)
    for (Eigen::Index i = 0; i < n; ++i) {
      // The phase m (2 i + 1 - n) pi / (2 n), reduced while it is a whole number.
      const Eigen::Index turns = (m * (2 * i + 1 - n)) % (4 * n);
      const double phase =
          std::numbers::pi * static_cast<double>(turns) / (2.0 * static_cast<double>(n));
      waves(i, 2 * m) = std::cos(phase);
      waves(i, 2 * m + 1) = std::sin(phase);
    }
  for (Eigen::Index column = 0; column < waves.cols(); ++column) {
    const double norm = waves.col(column).norm();
    if (norm > 0.5)  // at least 1/sqrt(2), or zero but for rounding
      waves.col(column) /= norm;
    else
      waves.col(column).setZero();
  }
  return waves;
}

/// Describes modes of one problem by their waves.
class Describer {
 public:
  explicit Describer(const LinearProblem& problem)
      : problem_(problem),
        count_(static_cast<Eigen::Index>(problem.grid.count())),
        unknowns_(static_cast<Eigen::Index>(problem.components)),
        waves_(half_waves(count_)) {
    require_line(problem);
  }

  [[nodiscard]] TractionMode describe(const Eigen::VectorXd& mode) const;

  /// @param basis      orthonormal columns
  /// @param described  how many modes, at most
  [[nodiscard]] ModeSpace describe_space(const Eigen::Ref<const Eigen::MatrixXd>& basis,
                                         std::size_t described = most_modes) const;

 private:
  /// Coefficients in the waves of every traction: 2 rows for each traction, for each m.
  [[nodiscard]] Eigen::MatrixXd spectrum(const Eigen::Ref<const Eigen::MatrixXd>& vectors) const {
    Eigen::MatrixXd rows(2 * unknowns_ * (count_ + 1), vectors.cols());
    for (Eigen::Index u = 0; u < unknowns_; ++u) {
      const Eigen::MatrixXd block = waves_.transpose() * vectors.middleRows(u * count_, count_);
      for (Eigen::Index m = 0; m <= count_; ++m)
        rows.middleRows(2 * (m * unknowns_ + u), 2) = block.middleRows(2 * m, 2);
    }
    return rows;
  }
  [[nodiscard]] auto at(Eigen::MatrixXd& spectrum, Eigen::Index m) const {
    return spectrum.middleRows(2 * unknowns_ * m, 2 * unknowns_);
  }
  [[nodiscard]] double wavelength(Eigen::Index m) const {
    return m == 0 ? infinity
                  : 2.0 * static_cast<double>(count_) * problem_.grid.spacing_y /
                        static_cast<double>(m);
  }

  const LinearProblem& problem_;
  Eigen::Index count_;
  Eigen::Index unknowns_;
  Eigen::MatrixXd waves_;
};

Parity parity_of(const Eigen::Ref<const Eigen::VectorXd>& block) {
  const double even = (block + block.reverse()).squaredNorm() / (4.0 * block.squaredNorm());
  return even > 0.99 ? Parity::even : even < 0.01 ? Parity::odd : Parity::neither;
}

TractionMode Describer::describe(const Eigen::VectorXd& mode) const {
  TractionMode result{.singular_value = (as_eigen(problem_.kernel) * mode).norm()};
  Eigen::MatrixXd coefficients = spectrum(mode);
  Eigen::Index strongest = 0;
  double most = -1.0;
  for (Eigen::Index m = 0; m <= count_; ++m) {
    const double share = at(coefficients, m).squaredNorm();
    if (share > most + 1e-9) {
      most = share;
      strongest = m;
    }
  }
  result.wave_share = std::min(most, 1.0);
  if (strongest > 0) result.wavelength = wavelength(strongest);

  result.normal_share = unknowns_ == 1 ? 1.0 : std::min(mode.head(count_).squaredNorm(), 1.0);
  const bool normal = result.normal_share >= 0.5;
  if (std::max(result.normal_share, 1.0 - result.normal_share) >= pure)
    result.unknown = normal ? Traction::normal : Traction::tangential_y;
  result.parity = parity_of(normal ? mode.head(count_) : mode.tail(count_));
  result.alternating = strongest > 0 && strongest + 1 >= count_;
  return result;
}

ModeSpace Describer::describe_space(const Eigen::Ref<const Eigen::MatrixXd>& basis,
                                    std::size_t described) const {
  ModeSpace space{.dimension = static_cast<std::size_t>(basis.cols())};
  if (space.dimension == 0) return space;
  Eigen::MatrixXd left = spectrum(basis);

  // The largest share of wavelength m that a combination of unit norm has, and which it is.
  const auto purity = [&](Eigen::Index m) {
    const Eigen::MatrixXd rows = at(left, m);
    return singular_value_decomposition(Eigen::MatrixXd(rows * rows.transpose()));
  };
  for (std::size_t step = 0; step < std::min(space.dimension, described); ++step) {
    std::vector<double> purities;
    for (Eigen::Index m = 0; m <= count_; ++m) purities.push_back(purity(m).values(0));
    if (step == 0)
      for (Eigen::Index m = 0; m <= count_; ++m)
        if (purities[static_cast<std::size_t>(m)] >= 0.5) {
          if (space.shortest == 0.0) space.longest = wavelength(m);
          space.shortest = wavelength(m);
        }
    // Takes the purest wavelength, the longest of those within 1e-6. Among the directions of that
    // wavelength prefers one that moves a single traction, so that it can be named.
    const double most = *std::max_element(purities.begin(), purities.end()) - 1e-6;
    const Eigen::Index m =
        std::find_if(purities.begin(), purities.end(), [&](double p) { return p >= most; }) -
        purities.begin();
    const Eigen::MatrixXd rows = at(left, m);
    Eigen::VectorXd direction = rows.transpose() * purity(m).u.col(0);
    for (Eigen::Index row = 0; row < rows.rows(); ++row)
      if (rows.row(row).squaredNorm() >= most) {
        direction = rows.row(row).transpose();
        break;
      }
    direction.normalize();
    space.modes.push_back(describe(basis * direction));
    left -= (left * direction).eval() * direction.transpose();
  }
  return space;
}

/// W K, and rows of zeros below where it has fewer rows than columns: what they leave unseen then
/// has singular values too, which are 0.
Eigen::MatrixXd tall(const Matrix& kernel) {
  const auto rows = static_cast<Eigen::Index>(kernel.rows);
  const auto columns = static_cast<Eigen::Index>(kernel.columns);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(std::max(rows, columns), columns);
  result.topRows(rows) = as_eigen(kernel);
  return result;
}

/// Where W K's singular values end to count.
double floor_of(const LinearProblem& problem, double largest) {
  const auto size = static_cast<double>(std::max(problem.kernel.rows, problem.kernel.columns));
  return std::max(size * epsilon * largest, problem.kernel_error);
}

/// Whether some tractions show in no reading: by singular values alone, a third of the work.
bool hides(const LinearProblem& problem) {
  if (problem.kernel.rows < problem.kernel.columns) return true;
  const Eigen::VectorXd s = singular_values(as_eigen(problem.kernel));
  return !(s(s.size() - 1) > floor_of(problem, s(0)));
}

/// W K = U S V', and where its singular values end to count.
struct Decomposition {
  explicit Decomposition(const LinearProblem& problem)
      : svd(singular_value_decomposition(tall(problem.kernel))),
        floor(floor_of(problem, svd.values(0))),
        rank((svd.values.array() > floor).count()) {}

  /// The vectors of those at or below `floor`.
  [[nodiscard]] auto null_basis() const { return svd.v.rightCols(svd.values.size() - rank); }

  Svd svd;
  double floor;
  Eigen::Index rank;
};

}  // namespace

Identifiability identifiability(const LinearProblem& problem) {
  const Decomposition decomposition(problem);
  const Svd& svd = decomposition.svd;
  const Eigen::VectorXd& s = svd.values;
  const double largest = s(0);
  const double smallest = s(s.size() - 1);
  Identifiability result{.singular_values = {s.begin(), s.end()}};
  result.condition = smallest > 0.0 ? largest / smallest : infinity;
  result.noise_gain = smallest > 0.0 ? 1.0 / smallest : infinity;
  result.floor = decomposition.floor;
  const Eigen::Index rank = decomposition.rank;
  const Eigen::Index safe =
      (s.array() > std::max(result.floor, std::sqrt(epsilon) * largest)).count();
  result.rank = static_cast<std::size_t>(rank);

  const Describer describer(problem);
  result.null_space = describer.describe_space(decomposition.null_basis());
  result.nearly_null = describer.describe_space(svd.v.middleCols(safe, rank - safe));
  result.weakest = describer.describe(svd.v.rightCols<1>());
  return result;
}

ModeSpace hidden_modes(const LinearProblem& problem) {
  if (!hides(problem)) return {};
  const Decomposition decomposition(problem);
  return Describer(problem).describe_space(decomposition.null_basis(), 1);
}

ModeSpace hidden_modes(const LinearProblem& problem, const TikhonovFamily& family) {
  // W K = U diag(gamma) V' T^-1, and the squares of T^-1's singular values are L's spectrum. Where
  // there are fewer gammas than tractions some of these are hidden.
  const std::span<const double> gamma = family.singular_values();
  if (gamma.size() == problem.kernel.columns) {
    const auto [least, most] = std::minmax_element(gamma.begin(), gamma.end());
    const Eigen::VectorXd squares = stabiliser_spectrum(problem);
    if (*least * std::sqrt(squares.minCoeff()) >
        2.0 * floor_of(problem, *most * std::sqrt(squares.maxCoeff())))
      return {};
  }
  return hidden_modes(problem);
}

std::size_t lost_by_symmetry(const SensorArray& array, std::size_t unknowns) {
  if (!is_even(array)) return 0;
  const std::size_t even = (array.count + 1) / 2;  // dimension of the even vectors
  const std::size_t odd = array.count / 2;
  std::size_t lost = 0;
  for (const bool normal_is_even : {true, false}) {
    const std::size_t wanted = unknowns == 2 ? array.count : normal_is_even ? even : odd;
    std::size_t read = 0;
    for (const Channel& channel : channels(array))
      read += is_odd(channel.quantity, Traction::normal) == normal_is_even ? odd : even;
    if (read < wanted) lost += wanted - read;
  }
  return lost;
}

}  // namespace tactile_net
