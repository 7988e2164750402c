#include "tactile_net/skin/large/face.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/face_coordinates.hpp"
#include "numeric/conjugate_gradients.hpp"
#include "numeric/eigen.hpp"
#include "skin/large/coordinate_products.hpp"
#include "skin/large/solved_sums.hpp"
#include "skin/scaled_deviation.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

constexpr double enough = 1e-6;  // of a residual; a variance is off by about its square
constexpr std::size_t most_steps = 3000;

}  // namespace

/// In coordinates of the face in which the stabiliser is simple, f = T c, P is A'A + alpha with
/// A = W K T.
struct LargeSkinFaceCovariance::Parts {
  /// [A; 1] (A'A + alpha)^-1 T' weights, by conjugate gradients; without a value where they do not
  /// come to their end.
  [[nodiscard]] Eigen::VectorXd solved(const Eigen::VectorXd& weights) {
    const Eigen::VectorXd right = coordinates.sums(weights);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(right.size());
    Eigen::VectorXd image = Eigen::VectorXd::Zero(static_cast<Index>(system->readings()));
    Eigen::VectorXd gradient = right;
    Eigen::VectorXd preconditioned(right.size());
    Eigen::VectorXd direction(right.size());
    Eigen::VectorXd read;
    const CoordinateProducts a{*system, coordinates};
    const double goal = enough * right.norm();
    double left = right.norm();
    conjugate_gradients(
        {as_span(x), as_span(gradient), as_span(preconditioned), as_span(direction)}, most_steps,
        [&] {
          read = a.readings(direction);
          return read.squaredNorm() + alpha * direction.squaredNorm();
        },
        [&](double step) {
          image += step * read;
          gradient -= step * (a.sums(read) + alpha * direction);
        },
        not_preconditioned,
        [&](std::span<const double>, std::span<const double>) { return gradient.squaredNorm(); },
        [&](std::size_t, double) {
          left = gradient.norm();
          return !(left > goal);
        });
    if (!(left <= goal)) return {};
    Eigen::VectorXd both(image.size() + x.size());
    both << image, x;
    return both;
  }

  std::pair<Eigen::VectorXd, double> image(std::span<const double> weights) {
    const std::vector<double> own = part.tractions(weights);
    const Index rows = static_cast<Index>(system->readings()) + coordinates.count();
    auto found = sums_made.image(problem_of(*system).grid, own, rows,
                                 [&](const Eigen::VectorXd& one) { return solved(one); });
    if (found.first.size() == 0) ++unsolved;
    return found;
  }

  /// What `ask` answers, or where a solve for it does not come to its end what `otherwise` does.
  auto all_solved(const auto& ask, const auto& otherwise) {
    const std::size_t before = unsolved;
    auto answer = ask();
    return unsolved == before ? answer : otherwise();
  }

  const LargeSkinPart& part;
  std::shared_ptr<LargeSkinSystem> system;
  FaceCoordinates coordinates;
  double alpha;
  double prior_alpha;
  double degrees;
  const Covariance& free;
  SolvedSums sums_made{};
  std::size_t unsolved = 0;  // sums that were asked for and are not
};

LargeSkinFaceCovariance::LargeSkinFaceCovariance(const LargeSkinPart& part, const ActiveFace& face,
                                                 double alpha, double prior_alpha,
                                                 double degrees_of_freedom,
                                                 const Covariance& free) {
  check_alpha(alpha);
  check_alpha(prior_alpha);
  parts_.reset(new Parts{part, part.system(), FaceCoordinates(problem_of(*part.system()), face),
                         alpha, prior_alpha, degrees_of_freedom, free});
}
LargeSkinFaceCovariance::~LargeSkinFaceCovariance() = default;

std::vector<double> LargeSkinFaceCovariance::deviations() const {
  return parts_->free.deviations();
}

double LargeSkinFaceCovariance::deviation(std::span<const double> weights) const {
  const std::size_t cells = weights.size() / problem_of(*parts_->system).components;
  return is_of_one_cell(weights, cells) ? parts_->free.deviation(weights)
                                        : scaled_deviation(*this, weights);
}

double LargeSkinFaceCovariance::covariance(std::span<const double> a,
                                           std::span<const double> b) const {
  Parts& p = *parts_;
  const auto of_a = p.image(a);
  const auto of_b = p.image(b);
  if (of_a.first.size() == 0 || of_b.first.size() == 0) return p.free.covariance(a, b);
  return image_product(of_a, of_b, static_cast<Index>(p.system->readings()),
                       p.alpha * (p.alpha / p.prior_alpha));
}

std::vector<double> LargeSkinFaceCovariance::deviations_of(
    std::span<const std::vector<double>> weights) const {
  return parts_->all_solved([&] { return Covariance::deviations_of(weights); },
                            [&] { return parts_->free.deviations_of(weights); });
}

Matrix LargeSkinFaceCovariance::covariances(std::span<const std::vector<double>> weights) const {
  return parts_->all_solved([&] { return Covariance::covariances(weights); },
                            [&] { return parts_->free.covariances(weights); });
}

double LargeSkinFaceCovariance::degrees_of_freedom() const noexcept { return parts_->degrees; }
bool LargeSkinFaceCovariance::converged() const noexcept { return parts_->unsolved == 0; }

}  // namespace tactile_net
