#include "inverse/data/memory.hpp"

#include <algorithm>
#include <utility>

#include "numeric/decompositions.hpp"

namespace tactile_net {

DataMemory::DataMemory() : kept_(std::make_unique<KeptContacts>()) {}
DataMemory::~DataMemory() = default;
DataMemory::DataMemory(DataMemory&&) noexcept = default;
DataMemory& DataMemory::operator=(DataMemory&&) noexcept = default;

std::optional<KeptContacts::Explained> KeptContacts::explain(const Eigen::VectorXd& y,
                                                             double enough) {
  for (auto set = sets_.begin(); set != sets_.end(); ++set) {
    const Eigen::VectorXd z = set->inverse * y;
    if (z.minCoeff() < 0.0) continue;
    Eigen::VectorXd residual = y - set->columns * z;
    if (residual.norm() > enough) continue;
    const Explained found{std::move(residual), (set->constants.transpose() * y).squaredNorm(),
                          set->leaves_an_end};
    std::rotate(sets_.begin(), set, set + 1);
    return found;
  }
  return std::nullopt;
}

void KeptContacts::keep(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& constants,
                        bool leaves_an_end) {
  constexpr double dependent = 1e-10;
  const Svd svd = singular_value_decomposition(columns);
  if (!(svd.values.minCoeff() > dependent * svd.values(0))) return;
  Eigen::MatrixXd added = constants - svd.u * (svd.u.transpose() * constants);
  if (added.cols() > 0) {
    const Svd rest = singular_value_decomposition(added);
    added = rest.u.leftCols((rest.values.array() > dependent).count());
  }
  if (sets_.size() == most) sets_.pop_back();
  sets_.insert(sets_.begin(),
               {columns, svd.v * svd.values.cwiseInverse().asDiagonal() * svd.u.transpose(), added,
                leaves_an_end});
}

}  // namespace tactile_net
