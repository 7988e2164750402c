#include "tactile_net/skin/large/tikhonov.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "inverse/checks.hpp"
#include "numeric/conjugate_gradients.hpp"
#include "numeric/finite.hpp"
#include "skin/large/preconditioner.hpp"
#include "skin/large/system.hpp"

namespace tactile_net {

struct LargeSkinTikhonov::Parts {
  explicit Parts(std::shared_ptr<LargeSkinSystem> made)
      : system(std::move(made)),
        uniform(uniform_readings(*system)),
        residual(system->rows()),
        image(system->rows()),
        f(system->tractions()),
        gradient(system->tractions()),
        preconditioned(system->tractions()),
        direction(system->tractions()) {}

  /// The least eigenvalue of alpha L'L, at least: that of a constant traction.
  [[nodiscard]] double least_eigenvalue() const noexcept {
    double least = system->size_of(alpha, 0);
    if (system->problem.components > 1) least = std::min(least, system->size_of(alpha, 1));
    return least * least;
  }

  /// Of f = 0: `residual`, in which the stacked right side is, and `gradient`. Where only P x =
  /// right is known there is no `residual`, and right is the gradient.
  ///
  /// @param done  whether `convergence` will do
  template <typename Done>
  void iterate(std::size_t step_limit, bool has_rows, Done&& done) {
    const double right = std::sqrt(dot_in_order(gradient, gradient));
    preconditioner->start(gradient, f);
    if (preconditioner->has_coarse_space()) {
      system->apply(alpha, f, image);
      follow(1.0, has_rows);
    }
    const double least = least_eigenvalue();
    std::array<double, 4> gains{};
    convergence = {.steps = 0, .residual = 1.0, .converged = false};
    const double power = conjugate_gradients(
        {f, gradient, preconditioned, direction}, step_limit,
        [&] {
          system->apply(alpha, direction, image);
          return dot_in_order(image, image);
        },
        [&](double step) { follow(step, has_rows); },
        [&](std::span<const double> from, std::span<double> to) {
          preconditioner->apply(from, to);
        },
        dot_in_order,
        [&](std::size_t steps, double gain) {
          convergence.steps = steps;
          const double size = std::sqrt(dot_in_order(f, f));
          const double left = std::sqrt(dot_in_order(gradient, gradient));
          // What the last steps took off the error in the norm of P: a step later than that, the
          // error was about as large.
          gains[steps % gains.size()] = gain;
          const double gained = std::accumulate(gains.begin(), gains.end(), 0.0);
          convergence.residual = left / right;
          convergence.bound = left / (least * size);
          convergence.estimate =
              steps < gains.size() ? convergence.bound : std::sqrt(gained / least) / size;
          convergence.converged = done(convergence);
          return convergence.converged;
        });
    if (convergence.steps == 0 && power <= 0.0) convergence.converged = true;
  }

  /// Residual and gradient after f went on by `step` times what `image` is the image of.
  void follow(double step, bool has_rows) {
    if (has_rows) {
      add_multiple(residual, -step, image);
      system->apply_transposed(alpha, residual, gradient);
    } else {
      system->apply_transposed(alpha, image, preconditioned);  // P times the direction
      add_multiple(gradient, -step, preconditioned);
    }
  }

  std::shared_ptr<LargeSkinSystem> system;
  UniformReadings uniform;
  double alpha = 0.0;
  std::shared_ptr<const LowWaves> waves{};
  std::unique_ptr<SkinPreconditioner> preconditioner{};
  SkinConvergence convergence{};
  std::vector<double> residual, image, f, gradient, preconditioned, direction;
};

LargeSkinTikhonov::~LargeSkinTikhonov() = default;
LargeSkinTikhonov::LargeSkinTikhonov(LargeSkinTikhonov&&) noexcept = default;
LargeSkinTikhonov& LargeSkinTikhonov::operator=(LargeSkinTikhonov&&) noexcept = default;

LargeSkinTikhonov::LargeSkinTikhonov(const SkinArray& skin, const Material& material,
                                     const SkinProblemOptions& options, double alpha)
    : LargeSkinTikhonov(make_large_skin_system(skin, material, options), alpha) {}

LargeSkinTikhonov::LargeSkinTikhonov(std::shared_ptr<LargeSkinSystem> system, double alpha)
    : parts_(std::make_unique<Parts>(std::move(system))) {
  use_alpha(alpha);
}

void LargeSkinTikhonov::use_alpha(double alpha) {
  check_alpha(alpha);
  if (alpha == parts_->alpha) return;
  parts_->preconditioner =
      std::make_unique<SkinPreconditioner>(*parts_->system, alpha, parts_->uniform, parts_->waves);
  parts_->alpha = alpha;
}

double LargeSkinTikhonov::alpha() const noexcept { return parts_->alpha; }
const LinearProblem& LargeSkinTikhonov::problem() const noexcept { return parts_->system->problem; }
const SkinConvergence& LargeSkinTikhonov::convergence() const noexcept {
  return parts_->convergence;
}
std::shared_ptr<LargeSkinSystem> LargeSkinTikhonov::system() const noexcept {
  return parts_->system;
}

FrameStatus LargeSkinTikhonov::solve(std::span<const double> readings, std::span<double> tractions,
                                     double tolerance, std::size_t step_limit) {
  Parts& p = *parts_;
  const LargeSkinSystem& system = *p.system;
  if (readings.size() != system.readings() || tractions.size() != p.f.size())
    return FrameStatus::wrong_size;
  if (!all_finite(readings)) return FrameStatus::not_finite;
  p.convergence = {};
  double scale = 0.0;
  std::fill(p.residual.begin(), p.residual.end(), 0.0);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    p.residual[i] = system.problem.weights[i] * readings[i];
    scale = std::max(scale, std::abs(p.residual[i]));
  }
  if (!std::isfinite(scale)) return FrameStatus::too_large;
  if (scale == 0.0) {
    std::fill(tractions.begin(), tractions.end(), 0.0);
    return FrameStatus::ok;
  }
  for (std::size_t i = 0; i < readings.size(); ++i) p.residual[i] /= scale;
  p.system->apply_transposed(p.alpha, p.residual, p.gradient);
  p.iterate(step_limit, true, [&](const SkinConvergence& c) {
    return c.bound <= tolerance || c.estimate <= tolerance;
  });
  for (double& traction : p.f) traction *= scale;
  if (!all_finite(p.f)) return FrameStatus::too_large;
  std::copy(p.f.begin(), p.f.end(), tractions.begin());
  return FrameStatus::ok;
}

std::vector<double> LargeSkinTikhonov::normal_right_side(std::span<const double> readings) {
  LargeSkinSystem& system = *parts_->system;
  check_size(readings, system.readings());
  std::vector<double> weighted(readings.begin(), readings.end());
  for (std::size_t i = 0; i < weighted.size(); ++i) weighted[i] *= system.problem.weights[i];
  std::vector<double> sums(system.tractions());
  system.weighted_sums(weighted, sums);
  return sums;
}

std::vector<double> LargeSkinTikhonov::solve_normal(std::span<const double> right,
                                                    double residual) {
  Parts& p = *parts_;
  std::copy(right.begin(), right.end(), p.gradient.begin());
  p.iterate(500, false, [&](const SkinConvergence& c) { return c.residual <= residual; });
  return p.f;
}

std::vector<double> LargeSkinTikhonov::stacked_product(std::span<const double> tractions) {
  std::vector<double> result(parts_->system->rows());
  parts_->system->apply(parts_->alpha, tractions, result);
  return result;
}

std::size_t LargeSkinTikhonov::stacked_rows() const noexcept { return parts_->system->rows(); }

}  // namespace tactile_net
