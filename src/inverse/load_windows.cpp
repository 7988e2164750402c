#include "tactile_net/inverse/load_windows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "inverse/checks.hpp"
#include "inverse/family_factors.hpp"
#include "inverse/window_places.hpp"
#include "numeric/require.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

/// Alphas that halve, of loads from a tenth of the noise up to what double precision still tells
/// from it. Posteriors of few readings are wide in log alpha: the sum over them is the integral.
constexpr Index window_alphas = 61;
constexpr double largest_alpha = 64.0;  // over the largest gamma squared
constexpr double least_noise = 1e-14;   // over the largest reading: below, rounding is larger
constexpr double negligible_probability = 1e-6;  // a probability

}  // namespace

struct LoadWindows::Windows {
  struct Window {
    std::vector<Index> columns{};  // of K: the window's values, of each traction
    Eigen::MatrixXd u{};           // of the family on the window's face
    Eigen::MatrixXd from_components{};
    Eigen::MatrixXd hidden{};     // what no reading shows, the root of its covariance times alpha
    Eigen::VectorXd gamma2{};     // squares
    Eigen::MatrixXd lost{};       // 1 - phi: alphas x components
    Eigen::VectorXd log_prior{};  // of each alpha, with the log of det(I - H)^(1/2)
  };

  Windows(const LinearProblem& problem, double narrowest) : weighting(problem) {
    require_line(problem);
    const auto block = static_cast<Index>(problem.grid.count());
    const auto levels = window_levels(problem.grid, narrowest, {}, true);
    for (auto level = levels.rbegin(); level != levels.rend(); ++level)  // the whole surface first
      for (const auto& [range, column] : *level) {
        Window window;
        ActiveFace face;
        for (std::size_t unknown = 0; unknown < problem.components; ++unknown)
          for (Index i = range.first; i < range.first + range.count; ++i) {
            window.columns.push_back(static_cast<Index>(unknown) * block + i);
            face.free.push_back({.cell = static_cast<std::size_t>(i)});
            face.free.back().along[unknown] = 1.0;
          }
        fill(window, TikhonovFamily(problem, face), -std::log(static_cast<double>(level->size())));
        all.push_back(std::move(window));
      }
  }

  /// @param family  on the window's face
  void fill(Window& window, const TikhonovFamily& family, double log_prior) {
    const std::shared_ptr<const TikhonovFamily::Factors> factors = family.factors();
    const TikhonovFamily::Factors::Block& form = factors->blocks.front();
    const Index n = form.v.rows();
    const Index components = form.v.cols();
    if (alphas.size() == 0) {
      if (!(form.gamma(0) > 0.0)) throw std::invalid_argument(nothing_is_read);
      alphas.resize(window_alphas);
      for (Index a = 0; a < window_alphas; ++a)
        alphas(a) =
            form.gamma(0) * form.gamma(0) * largest_alpha * std::ldexp(1.0, -static_cast<int>(a));
    }
    const auto inside = [&](const Eigen::MatrixXd& coordinates) -> Eigen::MatrixXd {
      return factors->coordinates->tractions(coordinates)(window.columns, Eigen::indexing::all);
    };
    window.from_components = inside(form.v);
    window.hidden.resize(n, 0);
    if (components < n)
      window.hidden = inside(Eigen::MatrixXd::Identity(n, n) - form.v * form.v.transpose());
    window.gamma2 = form.gamma.cwiseAbs2();
    window.u = form.u;
    window.lost.resize(window_alphas, components);
    for (Index a = 0; a < window_alphas; ++a)
      window.lost.row(a) = alphas(a) / (window.gamma2.array() + alphas(a));
    window.log_prior = 0.5 * window.lost.array().log().rowwise().sum() + log_prior;
  }

  Weighting weighting;
  Eigen::VectorXd alphas;
  std::vector<Window> all;  // the whole surface first
};

LoadWindows::LoadWindows(const LinearProblem& problem, double narrowest) {
  require_positive("narrowest", narrowest);
  windows_ = std::make_unique<const Windows>(problem, narrowest);
}
LoadWindows::~LoadWindows() = default;
LoadWindows::LoadWindows(LoadWindows&&) noexcept = default;
LoadWindows& LoadWindows::operator=(LoadWindows&&) noexcept = default;

std::size_t LoadWindows::count() const noexcept { return windows_->all.size(); }

RootCovariance LoadWindows::covariance(std::span<const double> readings,
                                       std::span<const double> tractions, double alpha,
                                       double noise_rms) const {
  const Windows& windows = *windows_;
  const auto n = static_cast<Index>(windows.all.front().columns.size());
  check_readings(readings, static_cast<std::size_t>(windows.weighting.size()));
  check_readings(tractions, static_cast<std::size_t>(n));
  check_alpha(alpha);
  require_positive("noise_rms", noise_rms);

  Eigen::VectorXd g = windows.weighting(readings);
  const double sigma = std::max(noise_rms, least_noise * g.cwiseAbs().maxCoeff());
  g /= sigma;
  const Eigen::VectorXd f = as_eigen(tractions) / sigma;

  std::vector<Eigen::VectorXd> beta;
  Eigen::MatrixXd likely(window_alphas, std::ssize(windows.all));  // logs first
  for (const auto& window : windows.all) {
    beta.push_back(window.u.transpose() * g);
    const Eigen::VectorXd power = beta.back().cwiseAbs2();
    const double outside = (g - window.u * beta.back()).squaredNorm();
    likely.col(std::ssize(beta) - 1) =
        window.log_prior.array() - 0.5 * ((window.lost * power).array() + outside);
  }
  likely = (likely.array() - likely.maxCoeff()).exp();
  likely /= likely.sum();

  // S, C = S S', by its blocks of columns.
  std::vector<Eigen::VectorXd> columns;
  for (Index w = 0; w < likely.cols(); ++w) {
    if (!(likely.col(w).sum() > negligible_probability)) continue;
    const auto& window = windows.all[static_cast<std::size_t>(w)];
    const auto add = [&](const Eigen::MatrixXd& inside) {
      for (Index i = 0; i < inside.cols(); ++i) {
        columns.emplace_back(Eigen::VectorXd::Zero(n));
        columns.back()(window.columns) = inside.col(i);
      }
    };
    Eigen::VectorXd seen = Eigen::VectorXd::Zero(window.gamma2.size());
    double hidden = 0.0;
    for (Index a = 0; a < window_alphas; ++a) {
      const double p = likely(a, w);
      if (!(p > negligible_probability)) continue;
      const Eigen::VectorXd over = (window.gamma2.array() + windows.alphas(a)).inverse();
      seen += p * over;
      hidden += p / windows.alphas(a);
      const Eigen::VectorXd mean =
          window.from_components * (window.gamma2.cwiseSqrt().array() * over.array() *
                                    beta[static_cast<std::size_t>(w)].array())
                                       .matrix();
      columns.emplace_back(-f);
      columns.back()(window.columns) += mean;
      columns.back() *= std::sqrt(p);
    }
    add(window.from_components * seen.cwiseSqrt().asDiagonal());
    add(window.hidden * std::sqrt(hidden));
  }
  Matrix root{static_cast<std::size_t>(n), columns.size(), {}};
  root.values.resize(root.rows * root.columns);
  Eigen::Map<RowMajor> s(root.values.data(), n, std::ssize(columns));
  for (Index i = 0; i < s.cols(); ++i)
    s.col(i) = columns[static_cast<std::size_t>(i)] * (sigma / noise_rms);

  const auto& gamma2 = windows.all.front().gamma2.array();
  return {std::move(root), (gamma2 / (gamma2 + alpha)).sum()};
}

}  // namespace tactile_net
