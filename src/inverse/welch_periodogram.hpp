/// @file
/// The periodogram of an array in sections, for the rule NCP. Private.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/inverse/filter_frame.hpp"

namespace tactile_net {

/// Welch's: the sum over sections of their tapered residuals' periodograms.
class WelchPeriodogram final : public ResidualPeriodogram {
 public:
  struct Part {
    const Eigen::MatrixXd* spectra;
    Eigen::MatrixXd beta;     // a column per section
    Eigen::MatrixXd outside;  // likewise: what no component explains, as a spectrum
  };

  WelchPeriodogram(std::shared_ptr<const void> owner, std::vector<Part> parts, std::size_t bins)
      : owner_(std::move(owner)), parts_(std::move(parts)), bins_(bins) {
    for (const Part& part : parts_) {
      const Eigen::VectorXd norms = part.beta.rowwise().norm();
      norms_.insert(norms_.end(), norms.begin(), norms.end());
    }
  }

  [[nodiscard]] std::size_t size() const noexcept override { return bins_; }

  void power(std::span<const double> left, std::span<const double> change, std::span<double> values,
             std::span<double> slopes) const override {
    std::fill(values.begin(), values.end(), 0.0);
    std::fill(slopes.begin(), slopes.end(), 0.0);
    Eigen::Index first = 0;
    for (const Part& part : parts_) {
      const Eigen::MatrixXd residual = spectrum(part, left, first) + part.outside;
      const Eigen::MatrixXd rate = spectrum(part, change, first);
      for (Eigen::Index i = 0; i < residual.rows(); ++i) {
        const auto bin = static_cast<std::size_t>(i) % bins_;
        values[bin] += residual.row(i).squaredNorm();
        slopes[bin] += 2.0 * residual.row(i).dot(rate.row(i));
      }
      first += part.beta.rows();
    }
  }

  void powers(std::span<const double> left, std::size_t components,
              std::span<double> values) const override {
    std::fill(values.begin(), values.end(), 0.0);
    for (std::size_t step = 0; step * components < left.size(); ++step) {
      Eigen::Index first = 0;
      for (const Part& part : parts_) {
        const Eigen::MatrixXd residual =
            spectrum(part, left.subspan(step * components, components), first) + part.outside;
        for (Eigen::Index i = 0; i < residual.rows(); ++i)
          values[step * bins_ + static_cast<std::size_t>(i) % bins_] +=
              residual.row(i).squaredNorm();
        first += part.beta.rows();
      }
    }
  }

 private:
  /// Of what is left of every section's components, `first` the part's first one among all.
  [[nodiscard]] Eigen::MatrixXd spectrum(const Part& part, std::span<const double> left,
                                         Eigen::Index first) const {
    return *part.spectra * (filters(left, first, part).asDiagonal() * part.beta);
  }

  /// The share of each component that is left, from the length of all sections' together.
  [[nodiscard]] Eigen::VectorXd filters(std::span<const double> left, Eigen::Index first,
                                        const Part& part) const {
    Eigen::VectorXd shares = Eigen::VectorXd::Zero(part.beta.rows());
    for (Eigen::Index i = 0; i < shares.size(); ++i) {
      const auto at = static_cast<std::size_t>(first + i);
      if (norms_[at] > 0.0) shares(i) = left[at] / norms_[at];
    }
    return shares;
  }

  std::shared_ptr<const void> owner_;  // of the spectra
  std::vector<Part> parts_;
  std::size_t bins_;
  std::vector<double> norms_;
};

}  // namespace tactile_net
