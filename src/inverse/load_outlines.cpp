// Windows of many readings by bidiagonal matrices, and what a frame makes of any window by what
// it was decomposed to.
#include <algorithm>
#include <cmath>
#include <utility>

#include "inverse/load_tables.hpp"

namespace tactile_net {

using Eigen::Index;

namespace {

/// Of a class, of any weight: with fewer values than readings a triangle stands for the readings,
/// which are Q times it; what a weight changes are its columns.
struct ClassRows {
  Eigen::MatrixXd readings;  // a row a reading or a row of the triangle, a column a value
  std::optional<HouseholderQr> within{};
  Index normal = 0;  // values

  ClassRows(const Eigen::MatrixXd& of_normal, const Eigen::MatrixXd& of_tangential)
      : normal(of_normal.rows()) {
    readings.resize(of_normal.cols(), normal + of_tangential.rows());
    readings << of_normal.transpose(), of_tangential.transpose();
    if (readings.cols() >= readings.rows()) return;
    within.emplace(readings);
    readings = within->triangle();
  }

  [[nodiscard]] Eigen::MatrixXd weighted(double tangential_weight) const {
    Eigen::MatrixXd all = readings;
    all.rightCols(all.cols() - normal) /= tangential_weight;
    return all;
  }
};

}  // namespace

LoadWork LoadPrior::Tables::work() const {
  constexpr double likely_alphas = 12.0;  // of each window in a frame of noise
  constexpr double alphas_of_variances = 20.0;
  const auto weights = static_cast<double>(tangential_weights.size());
  const auto rows = static_cast<double>(weighting.size());
  LoadWork work;
  for (const Shape& shape : shapes) {
    const auto by = static_cast<double>(classifying(shape).size());  // 0, 1 or 2: so many halvings
    const double classes = std::exp2(by);
    const auto values = static_cast<double>(shape.columns.size());
    const double shown = std::min(values, rows);
    const double longer = std::max(values, rows);
    // A QR of each class, and for each weight a bidiagonal matrix.
    work.set_up += (2.0 * longer * shown * shown + weights * 8.0 / 3.0 * shown * shown * shown) /
                   (classes * classes);
    if (values > rows) work.set_up += weights * 4.0 * shown * shown * shown / (classes * classes);
    work.frame +=
        static_cast<double>(shape.windows.size()) * weights * likely_alphas * 2.0 * values * shown;
    work.kept += weights * values * (shown + alphas_of_variances);
  }
  if (is_long_)
    work.frame *= std::min(
        1.0, static_cast<double>(most_windows) / (static_cast<double>(windows.size()) * weights));
  return work;
}

Eigen::MatrixXd LoadPrior::Tables::Rows::back(const Eigen::MatrixXd& x, Index all) const {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(all, x.cols());
  if (!qr) {
    rows(kept, Eigen::indexing::all) = x;
    return rows;
  }
  Eigen::MatrixXd longer = Eigen::MatrixXd::Zero(qr->rows(), x.cols());
  longer.topRows(x.rows()) = x;
  rows(kept, Eigen::indexing::all) = qr->rotate_back(longer);
  return rows;
}

void LoadPrior::Tables::outline_all(std::size_t of) {
  Shape& shape = shapes[of];
  const Shown shown = this->shown(shape);
  Range range{.classes = classifying(shape).empty() ? decltype(shown.classes){} : shown.classes};
  std::vector<ClassRows> classes;
  for (std::size_t c = 0; c < shown.classes.size(); ++c) {
    ClassRows& one = classes.emplace_back(shown.normal[c].seen, shown.tangential[c].seen);
    range.within.emplace_back();
    if (one.within)
      range.within.back() = one.within->rotate_back(
          Eigen::MatrixXd::Identity(one.within->rows(), one.within->columns()));
  }
  shape.range = std::make_shared<const Range>(std::move(range));
  for (std::size_t i = 0; i < tangential_weights.size(); ++i) {
    Entry& entry = entries_[shape.first + i];
    entry.shape = of;
    entry.tangential_weight = tangential_weights[i];
    Outline& outline = outlines_[shape.first + i];
    Index count = 0;
    for (const ClassRows& one : classes) {
      Eigen::MatrixXd weighted = one.weighted(entry.tangential_weight);
      if (weighted.rows() < weighted.cols())
        weighted = HouseholderQr(weighted.transpose()).triangle().transpose();
      const Index size = outline.classes.emplace_back(weighted).diagonal().size();
      if (i == 0)
        outline.u.emplace_back(
            outline.classes.back().rotate(Eigen::MatrixXd::Identity(size, size)).transpose());
      count += size;
    }
    outline.diagonal.resize(count);
    outline.above = Eigen::VectorXd::Zero(std::max<Index>(count - 1, 0));
    Index first = 0;
    for (const Bidiagonalisation& one : outline.classes) {
      const Index size = one.diagonal().size();
      outline.diagonal.segment(first, size) = shown.size * one.diagonal();
      if (size > 0) outline.above.segment(first, size - 1) = shown.size * one.above();
      first += size;
    }
    if (alphas.size() == 0) size_alphas(largest_singular_value(outline.diagonal, outline.above));
    const DampedBidiagonal all = outline.damped(alphas);
    entry.log_prior = 0.5 * all.log_determinants();
    for (Index a = 0; a < alphas.size(); ++a)
      entry.log_prior(a) += log_prior(shape, entry.tangential_weight, a);
    entry.used = all.traces();
    if (i == 0) outline.looks = outline.damped(looked_at());
  }
}

LoadPrior::Tables::Range::Coordinates LoadPrior::Tables::Range::coordinates(
    const Eigen::MatrixXd& readings) const {
  std::vector<Eigen::MatrixXd> all;
  Coordinates made{.outside = Eigen::RowVectorXd::Zero(readings.cols())};
  Index count = 0;
  for (std::size_t c = 0; c < within.size(); ++c) {
    Eigen::MatrixXd own =
        classes.empty() ? readings : Eigen::MatrixXd(classes[c].transpose() * readings);
    if (within[c].size() > 0) {
      Eigen::MatrixXd inside = within[c].transpose() * own;
      made.outside += (own - within[c] * inside).colwise().squaredNorm();
      own = std::move(inside);
    }
    count += all.emplace_back(std::move(own)).rows();
  }
  made.within.resize(count, readings.cols());
  Index first = 0;
  for (const Eigen::MatrixXd& one : all) {
    made.within.middleRows(first, one.rows()) = one;
    first += one.rows();
  }
  return made;
}

Eigen::MatrixXd LoadPrior::Tables::Outline::rotated(const Eigen::MatrixXd& x) const {
  Eigen::MatrixXd all(x.rows(), x.cols());
  Index first = 0;
  for (std::size_t c = 0; c < classes.size(); ++c) {
    const Index size = classes[c].diagonal().size();
    const auto own = x.middleRows(first, size);
    all.middleRows(first, size) = u.empty() ? classes[c].rotate(own) : u[c].transpose() * own;
    first += size;
  }
  return all;
}

/// The shape's values are made into rows again, as it takes less than to keep what made them.
Eigen::MatrixXd LoadPrior::Tables::outlined_vectors(std::size_t at) const {
  const Shape& shape = shapes[entries_[at].shape];
  const Outline& outline = outlines_[at];
  const Index own = shape.coordinates.count();
  const Shown shown = this->shown(shape);
  Eigen::MatrixXd v(components * own, outline.diagonal.size());
  Index first = 0;
  for (std::size_t c = 0; c < shown.classes.size(); ++c) {
    const Eigen::MatrixXd& normal = shown.normal[c].seen;
    const Eigen::MatrixXd& tangential = shown.tangential[c].seen;
    Eigen::MatrixXd values = outline.classes[c].right_vectors();
    const Index size = values.cols();
    if (normal.cols() < normal.rows() + tangential.rows()) {
      const ClassRows rows(normal, tangential);
      Eigen::MatrixXd longer = Eigen::MatrixXd::Zero(rows.readings.cols(), size);
      longer.topRows(size) = values;
      values = HouseholderQr(rows.weighted(entries_[at].tangential_weight).transpose())
                   .rotate_back(longer);
    }
    auto columns = v.middleCols(first, size);
    columns.topRows(own) = shown.normal[c].back(values.topRows(normal.rows()), own);
    columns.bottomRows(v.rows() - own) =
        shown.tangential[c].back(values.bottomRows(tangential.rows()), v.rows() - own);
    first += size;
  }
  const std::vector<const Reflection*> by = classifying(shape);
  if (!by.empty() && by.front()->exchanged) shape.coordinates.part_exchanged(v);  // undoes itself
  return v;
}

Eigen::MatrixXd LoadPrior::Tables::filtered(const Part& part) const {
  if (is_long_) return part.damped->filtered(part.beta);
  const Entry& entry = *part.entry;
  Eigen::MatrixXd all(part.beta.size(), std::ssize(part.sizes));
  for (Index i = 0; i < all.cols(); ++i)
    all.col(i) = entry.gamma.array() /
                 (entry.gamma2.array() + part.sizes[static_cast<std::size_t>(i)].alpha) *
                 part.beta.array();
  return all;
}

Eigen::MatrixXd LoadPrior::Tables::spreads(const Part& part, const Eigen::MatrixXd& sums) const {
  if (is_long_) return part.damped->spreads(sums);
  return sums.cwiseAbs2() * over(part);
}

Eigen::RowVectorXd LoadPrior::Tables::products(const Part& part, const Eigen::RowVectorXd& a,
                                               const Eigen::RowVectorXd& b) const {
  if (is_long_) return part.damped->products(a, b);
  return a.cwiseProduct(b) * over(part);
}

Eigen::MatrixXd LoadPrior::Tables::over(const Part& part) {
  Eigen::MatrixXd all(part.beta.size(), std::ssize(part.sizes));
  for (Index i = 0; i < all.cols(); ++i)
    all.col(i) =
        (part.entry->gamma2.array() + part.sizes[static_cast<std::size_t>(i)].alpha).inverse();
  return all;
}

Eigen::MatrixXd LoadPrior::Tables::spreads(const Part& part, const Details& details) const {
  if (!is_long_) return spreads(part, details.roots);
  const std::lock_guard lock(details.mutex);
  Part missing{.entry = part.entry};
  for (const Part::Size& size : part.sizes)
    if (details.spreads[static_cast<std::size_t>(size.at)].size() == 0)
      missing.sizes.push_back(size);
  if (!missing.sizes.empty()) {
    missing.damped = outlines_[index_of(*part.entry)].damped(missing.alphas());
    const Eigen::MatrixXd made = spreads(missing, details.roots);
    for (Index i = 0; i < made.cols(); ++i)
      details.spreads[static_cast<std::size_t>(missing.sizes[static_cast<std::size_t>(i)].at)] =
          made.col(i);
  }
  Eigen::MatrixXd all(details.roots.rows(), std::ssize(part.sizes));
  for (Index i = 0; i < all.cols(); ++i)
    all.col(i) =
        details.spreads[static_cast<std::size_t>(part.sizes[static_cast<std::size_t>(i)].at)];
  return all;
}

}  // namespace tactile_net
