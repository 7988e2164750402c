/// @file
/// Contacts that explained the last frames. Private.
#pragma once

#include <optional>
#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/inverse/data_verdict.hpp"

namespace tactile_net {

/// Sets of a cone's columns, the last one that helped first.
class KeptContacts {
 public:
  struct Explained {
    Eigen::VectorXd residual{};
    double gain = 0.0;  ///< what constants would take from its square
    bool leaves_an_end = false;
  };

  /// By one of them, none of whose columns pulls, up to a residual of `enough`.
  [[nodiscard]] std::optional<Explained> explain(const Eigen::VectorXd& y, double enough);

  /// @param constants  what a constant in each channel is, a column each
  void keep(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& constants, bool leaves_an_end);

 private:
  struct Set {
    Eigen::MatrixXd columns;
    Eigen::MatrixXd inverse;    // from y to what each column takes, by least squares
    Eigen::MatrixXd constants;  // orthonormal: what a constant in each channel adds to the columns
    bool leaves_an_end = false;
  };
  static constexpr std::size_t most = 4;

  std::vector<Set> sets_{};
};

}  // namespace tactile_net
