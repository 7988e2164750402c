#include "study/matrix_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "inverse/checks.hpp"
#include "inverse/coordinates.hpp"
#include "numeric/conjugate_gradients.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net::study {

struct SkinMatrixGradients::System {
  System(const LinearProblem& given, double weight)
      : problem(given),
        alpha(weight),
        waves(problem, stabiliser_spectrum(problem).cwiseSqrt()),
        kernel(waves.sums(as_eigen(problem.kernel).transpose()).transpose()) {}

  LinearProblem problem;
  double alpha;
  WaveCoordinates waves;
  RowMajor kernel;  // W K L^-1
};

SkinMatrixGradients::SkinMatrixGradients(const LinearProblem& problem, double alpha) {
  check_alpha(alpha);
  system_ = std::make_unique<const System>(problem, alpha);
}
SkinMatrixGradients::~SkinMatrixGradients() = default;
SkinMatrixGradients::SkinMatrixGradients(SkinMatrixGradients&&) noexcept = default;
SkinMatrixGradients& SkinMatrixGradients::operator=(SkinMatrixGradients&&) noexcept = default;

FrameStatus SkinMatrixGradients::solve(std::span<const double> readings,
                                       std::span<double> tractions, std::size_t steps) const {
  const System& s = *system_;
  if (tractions.size() != s.problem.kernel.columns)
    throw std::invalid_argument("tractions have the wrong size");
  const std::vector<double> right = weighted(s.problem, readings);
  const double scale = as_eigen(std::span(right)).cwiseAbs().maxCoeff();
  if (!all_finite(right)) return FrameStatus::too_large;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(s.kernel.cols());
  if (scale > 0.0) {
    Eigen::VectorXd residual = as_eigen(std::span(right)) / scale;
    Eigen::VectorXd gradient = s.kernel.transpose() * residual;
    Eigen::VectorXd preconditioned(gradient.size());
    Eigen::VectorXd direction(gradient.size());
    Eigen::VectorXd image(residual.size());
    const double power = conjugate_gradients(
        {as_span(x), as_span(gradient), as_span(preconditioned), as_span(direction)}, steps,
        [&] {
          image = s.kernel * direction;
          return image.squaredNorm() + s.alpha * direction.squaredNorm();
        },
        [&](double step) {
          residual -= step * image;
          gradient.noalias() = s.kernel.transpose() * residual;  // stays where it is
          gradient -= s.alpha * x;
        },
        not_preconditioned,
        [&](std::span<const double>, std::span<const double>) { return gradient.squaredNorm(); },
        [](std::size_t, double) { return false; });
    if (std::isnan(power)) return FrameStatus::too_large;
    x *= scale;
  }
  const Eigen::VectorXd f = s.waves.tractions(x);
  if (!f.allFinite()) return FrameStatus::too_large;
  std::copy(f.begin(), f.end(), tractions.begin());
  return FrameStatus::ok;
}

}  // namespace tactile_net::study
