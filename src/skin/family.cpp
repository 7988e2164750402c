#include "tactile_net/skin/family.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/degrees_of_freedom.hpp"
#include "inverse/window_sums.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "skin/face_coordinates.hpp"
#include "skin/family_factors.hpp"

namespace tactile_net {

using Eigen::Index;

double stabiliser_condition(const LinearProblem& problem) {
  const Eigen::VectorXd spectrum = stabiliser_spectrum(problem);
  return std::sqrt(spectrum.maxCoeff() / spectrum.minCoeff());
}

SkinFamily::Factors::Factors(const LinearProblem& problem,
                             std::shared_ptr<const TractionCoordinates> basis,
                             std::vector<MirrorClass> classes, double condition)
    : weighting(problem), coordinates(std::move(basis)), stabiliser_condition(condition) {
  const Eigen::MatrixXd all = coordinates->sums(as_eigen(problem.kernel).transpose());  // T' K' W
  for (MirrorClass& part : classes) {
    const Eigen::MatrixXd selected = all(part.waves, Eigen::indexing::all);
    const Eigen::MatrixXd transposed = selected * part.readings.transpose();
    Block block{.part = std::move(part)};
    if (transposed.size() > 0) {
      Svd svd = long_singular_value_decomposition(transposed);
      block.u = std::move(svd.v);
      block.v = std::move(svd.u);
      block.gamma = std::move(svd.values);
    } else {
      block.u.resize(transposed.cols(), 0);
      block.v.resize(transposed.rows(), 0);
    }
    gamma.insert(gamma.end(), block.gamma.begin(), block.gamma.end());
    blocks.push_back(std::move(block));
  }
}

Eigen::MatrixXd SkinFamily::Factors::components(const Eigen::MatrixXd& from) const {
  Eigen::MatrixXd result(std::ssize(gamma), from.cols());
  Index first = 0;
  for (const Block& block : blocks) {
    result.middleRows(first, block.gamma.size()) =
        block.v.transpose() * from(block.part.waves, Eigen::indexing::all);
    first += block.gamma.size();
  }
  return result;
}

Eigen::MatrixXd SkinFamily::Factors::from_components(const Eigen::MatrixXd& from) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(coordinates->count(), from.cols());
  Index first = 0;
  for (const Block& block : blocks) {
    result(block.part.waves, Eigen::indexing::all) =
        block.v * from.middleRows(first, block.gamma.size());
    first += block.gamma.size();
  }
  return result;
}

namespace {

bool is_kept(const RowMajor& roots) {
  constexpr std::size_t most = std::size_t{256} << 20;  // bytes
  return static_cast<std::size_t>(roots.size()) * sizeof(double) <= most;
}

}  // namespace

std::shared_ptr<const RowMajor> SkinFamily::Factors::roots() const {
  const std::lock_guard lock(kept->mutex);
  if (kept->roots) return kept->roots;
  auto made = std::make_shared<RowMajor>(coordinates->count(), std::ssize(gamma));
  Index first = 0;
  for (const Block& block : blocks) {
    Eigen::MatrixXd vectors = Eigen::MatrixXd::Zero(coordinates->count(), block.gamma.size());
    vectors(block.part.waves, Eigen::indexing::all) = block.v;
    const Eigen::MatrixXd own = coordinates->tractions(vectors);
    if (first == 0) made->resize(own.rows(), made->cols());
    made->middleCols(first, block.gamma.size()) = own;
    first += block.gamma.size();
  }
  if (is_kept(*made)) kept->roots = made;
  return made;
}

std::shared_ptr<const RowMajor> SkinFamily::Factors::window_roots(const SurfaceGrid& grid,
                                                                  const CellWindow& window) const {
  const std::shared_ptr<const RowMajor> cells = roots();
  const std::lock_guard lock(kept->mutex);
  if (kept->windows && kept->windows->first.rows == window.rows &&
      kept->windows->first.columns == window.columns)
    return kept->windows->second;
  Eigen::MatrixXd sums = cells->topRows(static_cast<Index>(grid.count()));
  for (Index j = 0; j < sums.cols(); ++j)
    window_sums(grid, window, std::span(sums.col(j).data(), grid.count()));
  auto made = std::make_shared<const RowMajor>(sums);
  if (is_kept(*made)) kept->windows.emplace(window, made);
  return made;
}

SkinFamily::SkinFamily(const LinearProblem& problem)
    : factors_(std::make_shared<const Factors>(
          problem,
          std::make_shared<const WaveCoordinates>(problem,
                                                  stabiliser_spectrum(problem).cwiseSqrt()),
          mirror_classes(problem), tactile_net::stabiliser_condition(problem))) {}

SkinFamily::SkinFamily(const LinearProblem& problem, const ActiveFace& face) {
  auto coordinates = std::make_shared<const FaceCoordinates>(problem, face);
  std::vector<MirrorClass> whole{whole_class(problem, coordinates->count())};
  factors_ = std::make_shared<const Factors>(problem, std::move(coordinates), std::move(whole),
                                             tactile_net::stabiliser_condition(problem));
}
SkinFamily::~SkinFamily() = default;
SkinFamily::SkinFamily(SkinFamily&&) noexcept = default;
SkinFamily& SkinFamily::operator=(SkinFamily&&) noexcept = default;

std::span<const double> SkinFamily::singular_values() const noexcept { return factors_->gamma; }

std::size_t SkinFamily::classes() const noexcept { return factors_->blocks.size(); }

double SkinFamily::condition(double alpha) const noexcept {
  const double root = std::sqrt(alpha);
  const std::vector<double>& gamma = factors_->gamma;
  if (gamma.empty()) return 1.0;  // no reading depends on the tractions
  const auto [least, most] = std::minmax_element(gamma.begin(), gamma.end());
  const bool wide = factors_->coordinates->count() > std::ssize(gamma);
  return std::hypot(*most, root) / std::hypot(wide ? 0.0 : *least, root);
}

double SkinFamily::stacked_condition(double alpha) const noexcept {
  return factors_->stabiliser_condition * condition(alpha);
}

double SkinFamily::degrees_of_freedom(double alpha) const noexcept {
  return degrees_of_freedom_of(factors_->gamma, alpha);
}

FilterFrame SkinFamily::analyse(std::span<const double> readings) const {
  const Factors& factors = *factors_;
  check_readings(readings, static_cast<std::size_t>(factors.weighting.size()));
  FilterFrame frame{.gamma = factors.gamma,
                    .rows = static_cast<std::size_t>(factors.weighting.rows())};
  Eigen::VectorXd g = factors.weighting(readings);
  frame.scale = g.cwiseAbs().maxCoeff();
  if (frame.scale > 0.0) g = g / frame.scale;
  for (const Factors::Block& block : factors.blocks) {
    Eigen::VectorXd own = block.part.readings * g;
    const Eigen::VectorXd beta = block.u.transpose() * own;
    own -= block.u * beta;
    frame.beta.insert(frame.beta.end(), beta.begin(), beta.end());
    frame.outside = std::hypot(frame.outside, own.norm());
  }
  return frame;
}

namespace {

/// gamma / (gamma^2 + alpha), nothing squared.
double filter(double gamma, double root) {
  const double size = std::hypot(gamma, root);
  return gamma / size / size;
}

}  // namespace

std::vector<double> SkinFamily::solve(const FilterFrame& frame, double alpha) const {
  check_alpha(alpha);
  check_same_family(frame, factors_->gamma);
  const double root = std::sqrt(alpha);
  Eigen::VectorXd y(std::ssize(frame.beta));
  for (Index i = 0; i < y.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    y(i) = frame.beta[at] * filter(frame.gamma[at], root);
  }
  const Eigen::VectorXd f =
      factors_->coordinates->tractions(factors_->from_components(y)) * frame.scale;
  return {f.begin(), f.end()};
}

Reconstruction SkinFamily::reconstruction(double alpha) const {
  check_alpha(alpha);
  const Factors& factors = *factors_;
  const double root = std::sqrt(alpha);
  Eigen::MatrixXd coordinates =
      Eigen::MatrixXd::Zero(factors.coordinates->count(), factors.weighting.size());
  for (const Factors::Block& block : factors.blocks) {
    const Eigen::VectorXd filters =
        block.gamma.unaryExpr([=](double gamma) { return filter(gamma, root); });
    const Eigen::MatrixXd own = block.v * filters.asDiagonal() * block.u.transpose();
    coordinates(block.part.waves, Eigen::indexing::all) =
        factors.weighting.applied(Eigen::MatrixXd(own * block.part.readings));
  }
  return {from_eigen(factors.coordinates->tractions(coordinates)), stacked_condition(alpha)};
}

}  // namespace tactile_net
