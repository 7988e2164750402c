#include "skin/wave_symbol.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "numeric/eigen.hpp"
#include "tactile_net/elasticity/space/skin_transform.hpp"

namespace tactile_net {

using Eigen::Index;

WaveSymbol::WaveSymbol(const SkinArray& skin, const Material& material,
                       const SkinProblemOptions& options)
    : material_(material), components_(static_cast<Index>(options.components)) {
  check(skin, material, options);
  const auto weight = [&](std::size_t channel) {
    return options.channel_rms.empty() ? 1.0 : 1.0 / options.channel_rms[channel];
  };
  if (is_even(skin)) {
    for (const Channel& channel : channels(skin))
      rows_.push_back({channel.quantity, channel.depth, weight(rows_.size())});
    return;
  }
  std::map<std::tuple<Quantity, double, double>, double> readings;  // how many alike
  for (const Site& site : sites(skin))
    readings[{site.quantity, site.depth, weight(site.channel)}] += 1.0;
  const auto taxels = static_cast<double>(taxel_count(skin));
  for (const auto& [row, count] : readings)
    rows_.push_back(
        {std::get<0>(row), std::get<1>(row), std::get<2>(row) * std::sqrt(count / taxels)});
}

Eigen::MatrixXcd WaveSymbol::operator()(double k_y, double k_z, bool at_nyquist_y,
                                        bool at_nyquist_z) const {
  Eigen::MatrixXcd matrix(std::ssize(rows_), components_);
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index u = 0; u < components_; ++u) {
      const auto& [quantity, depth, weight] = rows_[static_cast<std::size_t>(i)];
      const Traction component = skin_tractions[static_cast<std::size_t>(u)];
      const bool vanishes = (at_nyquist_y && is_odd(quantity, component, Axis::y)) ||
                            (at_nyquist_z && is_odd(quantity, component, Axis::z));
      matrix(i, u) =
          vanishes ? 0.0 : weight * skin_transform(quantity, component, material_, depth, k_y, k_z);
    }
  // A displacement of the mean is without bound: all that counts is that it shows.
  for (Index i = 0; i < matrix.rows(); ++i) {
    if (matrix.row(i).allFinite()) continue;
    for (Index u = 0; u < components_; ++u)
      matrix(i, u) = std::isfinite(std::abs(matrix(i, u))) ? 0.0 : 1.0;
  }
  return matrix;
}

ComplexSvd full_decomposition(const Eigen::MatrixXcd& matrix) {
  Eigen::MatrixXcd tall =
      Eigen::MatrixXcd::Zero(std::max(matrix.rows(), matrix.cols()), matrix.cols());
  tall.topRows(matrix.rows()) = matrix;
  return singular_value_decomposition(tall);
}

Index rank_of(const Eigen::VectorXd& values) {
  return values(0) > 0.0 ? (values.array() > hidden_below * values(0)).count() : 0;
}

Eigen::MatrixXcd along_wave(const Eigen::MatrixXcd& matrix, double angle) {
  if (matrix.cols() < 3) return matrix;
  Eigen::MatrixXcd turned = matrix;
  turned.col(1) = std::cos(angle) * matrix.col(1) + std::sin(angle) * matrix.col(2);
  turned.col(2) = std::cos(angle) * matrix.col(2) - std::sin(angle) * matrix.col(1);
  return turned;
}

LatticeLine lattice_line(const SkinArray& skin, bool along_z) {
  if (is_even(skin)) {
    const std::size_t count = along_z ? skin.columns : skin.rows;
    return {count, static_cast<double>(count) * (along_z ? skin.pitch_z : skin.pitch_y)};
  }
  const SurfaceGrid grid = grid_of(skin, {.spacing = skin.pitch_y, .margin = 0.0});
  const std::size_t count = along_z ? grid.columns : grid.rows;
  return {count, static_cast<double>(count) * (along_z ? grid.spacing_z : grid.spacing_y)};
}

}  // namespace tactile_net
