/// @file
/// The model of load_mixture.hpp as it is written there, window by window: what is known of a load
/// before anything is read, and draws of it.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "inverse/load_tables.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/inverse/load_mixture.hpp"
#include "tactile_net/inverse/tangential_weight.hpp"

namespace tactile_net {

class LoadDraws {
 public:
  LoadDraws(const LinearProblem& problem, const LoadPriorOptions& options)
      : components_(static_cast<Eigen::Index>(problem.components)),
        count_(static_cast<Eigen::Index>(problem.grid.count())),
        power_(options.prior_power) {
    const auto levels = window_levels(problem.grid, options.narrowest * options.depth,
                                      mixture_steps(problem, options.depth), problem.is_line);
    const auto share = [&](double spacing) { return std::pow(0.5 * options.depth / spacing, 2); };
    const double y = share(problem.grid.spacing_y);
    const double z = problem.is_line ? 0.0 : share(problem.grid.spacing_z);
    for (const auto& level : levels)
      for (const WindowPlace& place : level) {
        const Eigen::Index across = place.columns.count;
        const Eigen::Index count = place.rows.count * across;
        Eigen::MatrixXd stretch = Eigen::MatrixXd::Identity(count, count) * (1.0 + 2.0 * (y + z));
        Window window{.log_prior = -std::log(static_cast<double>(level.size()))};
        for (Eigen::Index i = 0; i < count; ++i) {
          if (i + across < count) stretch(i, i + across) = stretch(i + across, i) = -y;
          if (i % across + 1 < across) stretch(i, i + 1) = stretch(i + 1, i) = -z;
          window.cells.push_back((place.rows.first + i / across) *
                                     static_cast<Eigen::Index>(problem.grid.columns) +
                                 place.columns.first + i % across);
        }
        window.root = stretch.inverse() / std::sqrt(problem.measure);
        windows_.push_back(std::move(window));
      }
    const std::vector<double> weights = problem.components == 1 ? std::vector{1.0}
                                        : problem.is_line
                                            ? std::vector{0.5, 1.0, 2.0, 4.0, 8.0, 16.0}
                                            : std::vector{0.5, 2.0, 8.0};
    for (const double weight : weights)
      weights_.push_back({weight, problem.components == 1 ? 0.0 : -negative_log_prior(weight)});
    // The whole surface is the last window.
    const Eigen::MatrixXd seen =
        as_eigen(problem.kernel) * all_of(windows_.back(), weights_.front().first);
    const double largest = Eigen::BDCSVD<Eigen::MatrixXd>(seen).singularValues()(0);
    for (int a = 0; a < 61; ++a) alphas_.push_back(64.0 * largest * largest * std::ldexp(1.0, -a));
  }

  struct Window {
    std::vector<Eigen::Index> cells{};  // of one component
    Eigen::MatrixXd root{};             // times itself: C of them
    double log_prior = 0.0;
  };
  [[nodiscard]] const std::vector<Window>& windows() const { return windows_; }
  /// Tangential weights, and the logarithm of how likely each is.
  [[nodiscard]] const std::vector<std::pair<double, double>>& weights() const { return weights_; }
  [[nodiscard]] const std::vector<double>& alphas() const { return alphas_; }
  [[nodiscard]] double log_prior_of_alpha(double alpha) const { return power_ * std::log(alpha); }

  /// A root of C of all tractions: columns are all of the window's.
  [[nodiscard]] Eigen::MatrixXd all_of(const Window& window, double weight) const {
    const Eigen::Index n = window.root.cols();
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(components_ * count_, components_ * n);
    for (Eigen::Index u = 0; u < components_; ++u)
      all.block(u * count_, u * n, count_, n)(window.cells, Eigen::indexing::all) =
          u == 0 ? window.root : Eigen::MatrixXd(window.root / weight);
    return all;
  }

  /// Tractions of a load as likely as the model has it.
  /// @param sigma    of a weighted reading
  /// @param uniform  gives numbers between 0 and 1
  /// @param white    standard normal ones
  [[nodiscard]] Eigen::VectorXd draw(double sigma, auto& uniform, auto& white) const {
    const auto one_of = [&](const auto& list, const auto& log_prior) {
      std::vector<double> up_to;
      double sum = 0.0;
      for (const auto& one : list) up_to.push_back(sum += std::exp(log_prior(one)));
      const auto at = std::upper_bound(up_to.begin(), up_to.end() - 1, sum * uniform());
      return list[static_cast<std::size_t>(at - up_to.begin())];
    };
    const Window& window = *one_of(pointers(), [](const Window* one) { return one->log_prior; });
    const double weight = one_of(weights_, [](const auto& one) { return one.second; }).first;
    const double alpha =
        one_of(alphas_, [&](double one) { return log_prior_of_alpha(one / alphas_.front()); });
    Eigen::VectorXd f = Eigen::VectorXd::Zero(components_ * count_);
    for (Eigen::Index u = 0; u < components_; ++u) {
      Eigen::VectorXd z(window.root.cols());
      for (double& one : z) one = white();
      f.segment(u * count_, count_)(window.cells) =
          sigma / std::sqrt(alpha) / (u == 0 ? 1.0 : weight) * (window.root * z);
    }
    return f;
  }

 private:
  [[nodiscard]] std::vector<const Window*> pointers() const {
    std::vector<const Window*> all;
    for (const Window& window : windows_) all.push_back(&window);
    return all;
  }

  Eigen::Index components_;
  Eigen::Index count_;  // of one component's values
  double power_;
  std::vector<Window> windows_{};  // the whole surface last
  std::vector<std::pair<double, double>> weights_{};
  std::vector<double> alphas_{};
};

}  // namespace tactile_net
