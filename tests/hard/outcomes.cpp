#include "tests/hard/outcomes.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <stdexcept>

#include "tactile_net/inverse/error_bound.hpp"
#include "tactile_net/inverse/fft_tikhonov.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/thesis/closed_form.hpp"
#include "tactile_net/inverse/thesis/dft.hpp"
#include "tactile_net/inverse/thesis/dft_tikhonov.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tests/eigen.hpp"
#include "tests/hard/reference.hpp"

namespace tactile_net::hard {
namespace {

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2.0;

/// A problem as the reference sees it: [W K; sqrt(alpha) L] f = [W g; 0] and its solution.
struct Exact {
  Exact(const Case& c, bool circular, double alpha_)
      : alpha(alpha_),
        ratio(c.options.smoothing_length / c.array.pitch),
        count(c.array.count),
        kernel(reference_matrix(c.array, c.material, c.options, circular)) {
    for (std::size_t i = 0; i < c.readings.size(); ++i) {
      Real weight = c.options.channel_rms.empty()
                        ? Real(1)
                        : 1 / Real(c.options.channel_rms[i / c.array.count]);
      if (!circular)
        for (const std::size_t dead : c.options.dead_taxels)
          if (dead == i % c.array.count) weight = 0;
      right.push_back(weight * Real(c.readings[i]));
    }
    f = reference_minimiser(kernel, right, alpha, ratio, count, circular);

    // Condition and norm of the stacked matrix: to a few digits, from its rounded entries.
    const auto rows = static_cast<Eigen::Index>(kernel.rows);
    const auto n = static_cast<Eigen::Index>(kernel.columns);
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows + 2 * n, n);
    for (Eigen::Index i = 0; i < rows; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        a(i, j) =
            static_cast<double>(kernel(static_cast<std::size_t>(i), static_cast<std::size_t>(j)));
    const double root = std::sqrt(alpha);
    const auto block = static_cast<Eigen::Index>(count);
    for (Eigen::Index i = 0; i < n; ++i) {
      a(rows + i, i) = root;
      if (!circular && (i + 1) % block == 0) continue;
      a(rows + n + i, i) -= root * ratio;
      a(rows + n + i, i / block * block + (i + 1) % block) += root * ratio;
    }
    const Eigen::VectorXd s = Eigen::JacobiSVD<Eigen::MatrixXd>(a).singularValues();
    norm_of_matrix = s(0);
    condition = s(0) / s(n - 1);

    Real square = 0;
    for (std::size_t i = 0; i < kernel.rows; ++i) {
      Real residual = -right[i];
      for (std::size_t j = 0; j < kernel.columns; ++j) residual += kernel(i, j) * f[j];
      square += residual * residual;
    }
    for (std::size_t j = 0; j < f.size(); ++j) {
      square += Real(alpha) * f[j] * f[j];
      if (!circular && (j + 1) % count == 0) continue;
      const Real difference = Real(ratio) * (f[j / count * count + (j + 1) % count] - f[j]);
      square += Real(alpha) * difference * difference;
    }
    residual_norm = sqrt(square);
  }

  /// Wedin's bound, in 50 digits where squares would leave a double.
  [[nodiscard]] double wedin(double perturbation) const {
    const Real size = Real(norm_of_matrix) * norm(f);
    if (size == 0) return 0.0;
    const Real kappa = condition;
    return static_cast<double>(
        perturbation * (kappa * (1 + norm(right) / size + kappa * residual_norm / size) + 1));
  }

  double alpha, ratio;
  std::size_t count;
  RealMatrix kernel;
  Reals right, f;
  double condition = 0.0;
  double norm_of_matrix = 0.0;
  Real residual_norm = 0;
};

class Judge {
 public:
  Judge(const Case& hard_case, std::vector<Outcome>& outcomes)
      : case_(hard_case), outcomes_(outcomes) {}

  /// @param solve  fills the outcome's condition and bound, returns the tractions
  void add(const std::string& method, const Exact& exact, double kernel_error,
           const std::function<std::vector<double>(Outcome&)>& solve) {
    Outcome outcome{.method = method};
    outcome.condition = exact.condition;
    // One unit of rounding everywhere, what a layer's kernels are known to, and what is lost to
    // readings and tractions near the smallest double.
    double perturbation = unit_roundoff + kernel_error / exact.norm_of_matrix;
    const double scale = largest(case_.readings);
    if (scale > 0.0)
      perturbation += std::numeric_limits<double>::denorm_min() *
                      std::sqrt(static_cast<double>(case_.readings.size())) / scale;
    outcome.wedin = exact.wedin(perturbation);
    try {
      const std::vector<double> f = solve(outcome);
      outcome.finite =
          std::all_of(f.begin(), f.end(), [](double value) { return std::isfinite(value); });
      outcome.error = relative_error(f, exact.f);
    } catch (const std::domain_error& error) {
      outcome.answered = false;
      outcome.verdict = std::string("refused: ") + error.what();
    }
    outcomes_.push_back(std::move(outcome));
  }

 private:
  static double largest(std::span<const double> values) {
    double result = 0.0;
    for (const double value : values) result = std::max(result, std::abs(value));
    return result;
  }
  const Case& case_;
  std::vector<Outcome>& outcomes_;
};

void check(FrameStatus status) {
  if (status != FrameStatus::ok)
    throw std::logic_error("a finite frame of the right size was refused");
}

void matrix_methods(const Case& c, Judge& judge) {
  const Exact exact(c, false, c.alpha);
  const LinearProblem problem = make_problem(c.array, c.material, c.options);
  const double kernel_error = c.material.layer ? problem.kernel_error : 0.0;
  const auto bound = [&](const std::vector<double>& f, double condition) {
    return forward_bound(problem, c.alpha, c.readings, f, condition);
  };
  const auto by_matrix = [&](Outcome& outcome, const Reconstruction& inverse) {
    std::vector<double> f(inverse.tractions());
    check(inverse.solve(c.readings, f));
    outcome.bound = bound(f, inverse.condition());
    return f;
  };
  judge.add("tikhonov, matrix", exact, kernel_error,
            [&](Outcome& outcome) { return by_matrix(outcome, tikhonov(problem, c.alpha)); });
  judge.add("tikhonov, direct", exact, kernel_error, [&](Outcome& outcome) {
    const std::vector<double> f = tikhonov_solve(problem, c.alpha, c.readings);
    outcome.bound = bound(f, exact.condition);
    return f;
  });
  judge.add("tikhonov, family", exact, kernel_error, [&](Outcome& outcome) {
    const TikhonovFamily family(problem);
    const std::vector<double> f = family.solve(family.analyse(c.readings), c.alpha);
    outcome.bound = bound(f, exact.condition);
    return f;
  });
  judge.add("closed_form", exact, kernel_error,
            [&](Outcome& outcome) { return by_matrix(outcome, closed_form(problem, c.alpha)); });
  judge.add("conjugate gradients", exact, kernel_error, [&](Outcome& outcome) {
    FftTikhonov inverse(c.array, c.material, c.options, c.alpha);
    std::vector<double> f(inverse.tractions());
    check(inverse.solve(c.readings, f, 1e-12, 500));
    if (!inverse.convergence().converged) outcome.verdict = "not_converged";
    outcome.bound = bound(f, exact.condition) + inverse.convergence().bound;
    return f;
  });
}

void circular_methods(const Case& c, Judge& judge) {
  if (!c.options.dead_taxels.empty()) return;
  const Exact exact(c, true, c.alpha);
  const double kernel_error =
      c.material.layer ? make_problem(c.array, c.material, c.options).kernel_error : 0.0;
  judge.add("dft, regularised", exact, kernel_error, [&](Outcome& outcome) {
    DftTikhonov inverse(c.array, c.material, c.options);
    std::vector<double> f(c.options.unknowns * c.array.count);
    check(inverse.solve(c.readings, c.alpha, f));
    outcome.bound = inverse.forward_bound(c.readings, c.alpha, f);
    if (!inverse.null_modes().empty()) outcome.verdict = "null_mode";
    return f;
  });
  if (c.array.reads.size() * c.array.depths.size() > 1) return;
  try {
    DftInverse inverse(c.array, c.material);
    // alpha = 0 in 50 digits: the circular system itself.
    const Exact plain(c, true, 0.0);
    judge.add("dft", plain, kernel_error, [&](Outcome& outcome) {
      std::vector<double> f(c.array.count);
      check(inverse.solve(c.readings, f));
      outcome.bound = inverse.forward_bound(c.readings);
      outcome.verdict = name(inverse.verdict(c.readings));
      return f;
    });
  } catch (const std::domain_error& error) {
    judge.add("dft", exact, kernel_error,
              [&](Outcome&) -> std::vector<double> { throw std::domain_error(error.what()); });
  }
}

/// One large array with one unknown: the reference by refining a double factorisation with
/// residuals in 50 digits, until a step is below 1e-25.
Reals refined_minimiser(const Case& c, const RealMatrix& kernel, const Reals& right) {
  const double ratio = c.options.smoothing_length / c.array.pitch;
  const LinearProblem problem = make_problem(c.array, c.material, c.options);
  const Matrix p = normal_matrix(problem, c.alpha);
  const auto n = static_cast<Eigen::Index>(p.rows);
  const Eigen::LLT<Eigen::MatrixXd> factors(view(p));
  Reals f(p.rows, 0);
  for (int step = 0; step < 30; ++step) {
    const Reals gradient = reference_gradient(kernel, right, c.alpha, ratio, c.array.count, f);
    const Real scale = norm(gradient);
    if (scale == 0) return f;
    Eigen::VectorXd g(n);
    for (Eigen::Index i = 0; i < n; ++i)
      g(i) = static_cast<double>(gradient[static_cast<std::size_t>(i)] / scale);
    const Eigen::VectorXd change = factors.solve(g);
    Real square = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Real delta = scale * Real(change(i));
      f[static_cast<std::size_t>(i)] -= delta;
      square += delta * delta;
    }
    if (sqrt(square) < Real("1e-25") * norm(f)) return f;
  }
  throw std::logic_error("the refinement did not converge");
}

}  // namespace

std::vector<Outcome> outcomes(const Case& hard_case) {
  std::vector<Outcome> all;
  Judge judge(hard_case, all);
  matrix_methods(hard_case, judge);
  circular_methods(hard_case, judge);
  return all;
}

std::vector<Outcome> large_outcomes(const Case& c) {
  const LinearProblem problem = make_problem(c.array, c.material, c.options);
  const Matrix p = normal_matrix(problem, c.alpha);
  const auto n = static_cast<Eigen::Index>(p.rows);
  const Eigen::VectorXd squares =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(view(p), Eigen::EigenvaluesOnly).eigenvalues();
  const double condition = std::sqrt(squares(n - 1) / squares(0));

  const RealMatrix kernel = reference_matrix(c.array, c.material, c.options, false);
  const Reals right(c.readings.begin(), c.readings.end());
  const Reals f = refined_minimiser(c, kernel, right);
  std::vector<Outcome> all;
  const auto add = [&](const std::string& method, const std::vector<double>& answer,
                       double more_bound, const std::string& verdict) {
    const double bound = forward_bound(problem, c.alpha, c.readings, answer, condition);
    all.push_back({.method = method,
                   .verdict = verdict,
                   .condition = condition,
                   .error = relative_error(answer, f),
                   .bound = bound + more_bound,
                   .wedin = 0.0});
  };
  add("tikhonov, direct", tikhonov_solve(problem, c.alpha, c.readings), 0.0, "ok");
  FftTikhonov inverse(c.array, c.material, c.options, c.alpha);
  std::vector<double> answer(inverse.tractions());
  check(inverse.solve(c.readings, answer, 1e-12));
  add("conjugate gradients", answer, inverse.convergence().bound,
      inverse.convergence().converged ? "ok" : "not_converged");
  return all;
}

}  // namespace tactile_net::hard
