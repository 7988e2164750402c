#include "calibration/fit_rows.hpp"

#include <cmath>

namespace tactile_net {

std::size_t moved_column(const FitProblem& problem, std::size_t parameter,
                         const SystemParts& parts) {
  auto which = static_cast<PadParameter>(parameter);
  if (which == PadParameter::thickness && parts.thickness_follows) which = PadParameter::depth;
  return parts.frozen[static_cast<std::size_t>(which)] ? no_column : problem.pad_column(which);
}

void FitRows::put_reading(std::size_t p, std::size_t j, const RowPlaces& at, Eigen::MatrixXd& rows,
                          Eigen::Index row) const {
  const std::size_t n = problem_.model().sites().size();
  const double root = std::sqrt(problem_.weights[p * n + j]);
  const double scale = root * problem_.gain(state_, j) / problem_.noise(j);
  const Matrix* const by_press[] = {&readings_.by_log_force,      &readings_.by_center,
                                    &readings_.by_log_half_width, &readings_.by_friction,
                                    &readings_.by_center_z,       &readings_.by_friction_z};
  for (std::size_t i = 0; i < press_unknowns; ++i)
    if (const std::size_t column = problem_.press_rows[p].column[i]; column != no_column)
      rows(row, eigen_index(at.press + column)) = scale * (*by_press[i])(p, j);
  for (std::size_t i = 0; i < pad_parameter_count; ++i)
    if (const std::size_t column = moved_column(problem_, i, parts_); column != no_column)
      rows(row, eigen_index(at.pad + column)) += scale * readings_.by_pad[i](p, j);
  if (at.gain != no_column) rows(row, eigen_index(at.gain)) = scale * readings_.value(p, j);
  rows(row, eigen_index(at.offset)) = root;
  rows(row, rows.cols() - 1) = -root * problem_.residual(state_, readings_, p, j);
}

void FitRows::put_prior(std::size_t p, const PressPrior& prior, const RowPlaces& at,
                        Eigen::MatrixXd& rows, Eigen::Index row) const {
  for (std::size_t i = 0; i < press_unknowns; ++i)
    if (const std::size_t column = problem_.press_rows[p].column[i]; column != no_column)
      rows(row, eigen_index(at.press + column)) = prior.by_press[i];
  for (std::size_t i = 0; i < pad_parameter_count; ++i)
    if (const std::size_t column = moved_column(problem_, i, parts_); column != no_column)
      rows(row, eigen_index(at.pad + column)) += prior.by_pad[i];
  rows(row, rows.cols() - 1) = -prior.residual;
}

void FitRows::add_pad_columns(const Eigen::MatrixXd& from, std::size_t pad,
                              Eigen::MatrixXd& rows) const {
  for (std::size_t i = 0; i < pad_parameter_count; ++i) {
    const std::size_t own = problem_.pad_column(static_cast<PadParameter>(i));
    const std::size_t to = moved_column(problem_, i, parts_);
    if (own != no_column && to != no_column)
      rows.col(eigen_index(pad + to)) += from.col(eigen_index(own));
  }
}

}  // namespace tactile_net
