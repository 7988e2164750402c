#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "inverse/cone_edges.hpp"
#include "inverse/data/contact_fit.hpp"
#include "inverse/nonnegative.hpp"
#include "inverse/significance.hpp"
#include "inverse/weighting.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

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

namespace {

constexpr std::size_t most_exchanges = 300;

enum class ArrayPart { middle, first_end, last_end };

/// What a contact is allowed besides pressing: columns without a sign.
struct Freedom {
  Eigen::MatrixXd columns{};
  bool first_end = true;  ///< loads over that end of the array
  bool last_end = true;
};

struct LineFitted : Unexplained {
  Eigen::VectorXd allowance{};  ///< of the freedom's columns
};

class LineFit final : public ContactFit {
 public:
  LineFit(const JudgedProblem& judged, const LinearProblem& contacts)
      : ContactFit(judged),
        weighting_(p.problem),
        places_(parts_of(contacts.grid)),
        found_places_(parts_of(p.problem.grid)) {
    const auto columns = [&](Friction friction) {
      const Constraints press{.nonnegative = true, .friction_limit = p.limit_of(friction)};
      Eigen::MatrixXd all = ConeEdges(contacts, press).applied(as_eigen(contacts.kernel)) / p.unit;
      for (Eigen::Index j = 0; j < all.cols(); ++j)
        if (const double norm = all.col(j).norm(); norm > 0.0) all.col(j) /= norm;
      return all;
    };
    cone_ = columns(Friction::stated);
    if (p.is_friction_limited()) wide_ = columns(Friction::likely);
    const Eigen::MatrixXd all = channel_constants(p.problem.weights, p.problem.sites);
    for (Eigen::Index c = 0; c < all.cols() && !p.problem.unknown_offsets; ++c)
      if (all.col(c).squaredNorm() > 0.0) channels_.push_back(static_cast<std::size_t>(c));
    constants_ = all(Eigen::indexing::all, channels_);
    if (!channels_.empty())
      constant_gain_ =
          chi_squared_quantile(static_cast<double>(channels_.size()), 0.1 * false_alarms);
  }

  [[nodiscard]] std::optional<Unexplained> contact(const JudgedFrame& frame, Friction friction,
                                                   double enough) const override {
    return fit(frame.seen, friction, enough);
  }
  [[nodiscard]] std::size_t steps() const noexcept override { return 1; }
  [[nodiscard]] Unexplained nearest(const JudgedFrame& frame, Unexplained found) const override {
    return fit(frame.seen, found.friction);
  }
  [[nodiscard]] std::optional<Unexplained> all_left(const JudgedFrame&, std::size_t,
                                                    const Unexplained& found) const override {
    return found;
  }
  [[nodiscard]] std::optional<Unexplained> rest_left(const JudgedFrame& frame, std::size_t,
                                                     std::size_t taxel,
                                                     const Unexplained& all) const override {
    return fit(frame.seen, all.friction, 0.0, without(taxel));
  }
  [[nodiscard]] Unexplained least_rest(const JudgedFrame& frame, std::size_t taxel,
                                       double) const override {
    return fit(frame.seen, Friction::likely, 0.0, without(taxel));
  }
  /// By contacts within the stated limit where these explain the rest too.
  [[nodiscard]] double likeness(const JudgedFrame& frame, std::size_t taxel, double enough,
                                const Unexplained& rest) const override {
    if (wide_.cols() == 0) return rest.norm;
    const double within = fit(frame.seen, Friction::stated, 0.0, without(taxel)).norm;
    return within <= enough ? within : enough + rest.norm;
  }
  [[nodiscard]] std::optional<BothSigns> both_signs(const JudgedFrame& frame,
                                                    std::span<const double>) const override {
    return BothSigns{.as_read = fit(frame.seen, Friction::likely),
                     .turned = fit(negated(frame.seen), Friction::likely)};
  }
  [[nodiscard]] std::optional<ChannelConstants> constants(const JudgedFrame& frame) const override {
    if (!p.limits.inner || channels_.empty()) return std::nullopt;
    return constants_of(with_constants(frame.seen, Friction::likely));
  }
  [[nodiscard]] bool remembers() const noexcept override { return true; }
  [[nodiscard]] std::vector<double> apart(const Unexplained& found) const override;
  [[nodiscard]] std::optional<ChannelConstants> hidden_constants(
      const JudgedFrame& frame, std::span<const double> pressing) const override;
  [[nodiscard]] std::optional<Unexplained> recalled(const JudgedFrame& frame,
                                                    KeptContacts& memory) const override;
  void remember(const Unexplained& found, KeptContacts& memory) const override;

 private:
  [[nodiscard]] std::vector<ArrayPart> parts_of(const SurfaceGrid& grid) const {
    std::vector<ArrayPart> all(grid.rows, ArrayPart::middle);
    for (std::size_t i = 0; i < grid.rows && p.limits.inner; ++i) {
      const double y = grid.y(i);
      if (y < p.limits.inner->first) all[i] = ArrayPart::first_end;
      if (y > p.limits.inner->second) all[i] = ArrayPart::last_end;
    }
    return all;
  }
  [[nodiscard]] ArrayPart part_of(Eigen::Index column) const {
    return places_[static_cast<std::size_t>(column) % places_.size()];
  }
  [[nodiscard]] const Eigen::MatrixXd& cone(Friction friction) const {
    return friction == Friction::likely && wide_.cols() > 0 ? wide_ : cone_;
  }
  /// @param enough  a residual that is as good as none
  [[nodiscard]] LineFitted fit(std::span<const double> seen, Friction friction, double enough = 0.0,
                               const Freedom& freedom = {}) const;
  /// A constant in each channel beside contacts over one end of the array at most: a constant and a
  /// load over everything could draw whatever pulls.
  [[nodiscard]] LineFitted with_constants(std::span<const double> seen, Friction friction) const {
    LineFitted one = fit(seen, friction, 0.0, {.columns = constants_, .last_end = false});
    LineFitted other = fit(seen, friction, 0.0, {.columns = constants_, .first_end = false});
    return one.norm < other.norm ? one : other;
  }
  [[nodiscard]] Freedom without(std::size_t taxel) const;
  [[nodiscard]] ChannelConstants constants_of(const LineFitted& fitted) const;

  Weighting weighting_;
  std::vector<ArrayPart> places_;        // of the values of contacts
  std::vector<ArrayPart> found_places_;  // of the values of tractions
  Eigen::MatrixXd cone_{};               // W K E within the limit that is stated, unit columns
  Eigen::MatrixXd wide_{};               // W K E of any friction that is likely; empty: as `cone_`
  std::vector<std::size_t> channels_{};  // with a live row; none where their offsets are free
  Eigen::MatrixXd constants_{};          // one in each of them
  // Square that a constant in each channel takes of noise.
  double constant_gain_ = std::numeric_limits<double>::infinity();
};

LineFitted LineFit::fit(std::span<const double> seen, Friction friction, double enough,
                        const Freedom& freedom) const {
  const Eigen::MatrixXd& of = cone(friction);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < of.cols(); ++j)
    if (const ArrayPart part = part_of(j); (part != ArrayPart::first_end || freedom.first_end) &&
                                           (part != ArrayPart::last_end || freedom.last_end))
      kept.push_back(j);
  const auto pressing = std::ssize(kept);
  Eigen::MatrixXd some;
  const bool whole = pressing == of.cols() && freedom.columns.cols() == 0;
  if (!whole) {
    some.resize(of.rows(), pressing + freedom.columns.cols());
    some.leftCols(pressing) = of(Eigen::indexing::all, kept);
    if (freedom.columns.cols() > 0) some.rightCols(freedom.columns.cols()) = freedom.columns;
  }
  const Eigen::MatrixXd& a = whole ? of : some;
  std::vector<bool> bounded(kept.size(), true);
  bounded.resize(static_cast<std::size_t>(a.cols()), false);

  // Columns have length 1: what is left to gain is a small part of the limit.
  const Eigen::VectorXd y = as_eigen(seen);
  const double noise = p.limits.noise_rms ? p.most / y.norm() : 1e-3;
  const double gradient = 1e-3 * std::min(noise * noise, 1.0);
  const NonnegativeSolution found = sparse_nonnegative_least_squares(
      a, y, bounded, most_exchanges, {.residual = enough, .gradient = gradient});
  const Eigen::VectorXd residual = y - a * found.z;
  LineFitted fitted;
  fitted.residual = {residual.begin(), residual.end()};
  fitted.norm = residual.norm();
  fitted.friction = friction;
  fitted.fitted = static_cast<double>(std::count(found.free.begin(), found.free.end(), true));
  fitted.allowance = found.z.tail(freedom.columns.cols());
  for (std::size_t j = 0; j < kept.size(); ++j)
    if (found.z(static_cast<Eigen::Index>(j)) > 0.0) fitted.pressed.push_back(kept[j]);
  return fitted;
}

Freedom LineFit::without(std::size_t taxel) const {
  std::vector<Eigen::Index> at;
  for (std::size_t row = 0; row < p.problem.sites.size(); ++row)
    if (p.problem.sites[row].taxel == taxel && p.problem.weights[row] > 0.0)
      at.push_back(static_cast<Eigen::Index>(row));
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(weighting_.size(), std::ssize(at));
  for (Eigen::Index j = 0; j < std::ssize(at); ++j)
    columns(at[static_cast<std::size_t>(j)], j) = 1.0;
  return {.columns = weighting_.projected(std::move(columns))};
}

/// With the same columns pressed: a contact beneath a taxel that lies follows it, and leaves more
/// at its neighbours than there.
std::vector<double> LineFit::apart(const Unexplained& found) const {
  constexpr double least = 1e-3;  // of a reading's own say in what is left of it
  if (found.pressed.empty()) return found.residual;
  const Eigen::MatrixXd pressed = cone(found.friction)(Eigen::indexing::all, found.pressed);
  const Svd svd = singular_value_decomposition(pressed);
  const auto rank = (svd.values.array() > 1e-10 * svd.values(0)).count();
  const Eigen::VectorXd own = 1.0 - svd.u.leftCols(rank).rowwise().squaredNorm().array();
  const Eigen::VectorXd far =
      as_eigen(found.residual).cwiseQuotient(own.cwiseMax(least).cwiseSqrt());
  return {far.begin(), far.end()};
}

/// A load over the whole array explains a constant too. It is called a constant where without one
/// neither end of the array can do without a load, and with one an end can, with no more places
/// pressed.
std::optional<ChannelConstants> LineFit::hidden_constants(const JudgedFrame& frame,
                                                          std::span<const double> pressing) const {
  if (!p.limits.inner || channels_.empty()) return std::nullopt;
  std::vector<double> inner(pressing.begin(), pressing.end());
  for (std::size_t j = 0; j < inner.size(); ++j)
    if (found_places_[j % found_places_.size()] != ArrayPart::middle) inner[j] = 0.0;
  // Cheap, and rarely less than the gain itself.
  const std::vector<double> left = left_by(frame, inner).residual;
  if ((constants_.transpose() * as_eigen(left)).squaredNorm() < 0.5 * constant_gain_)
    return std::nullopt;
  const LineFitted best = with_constants(frame.seen, Friction::stated);
  const double enough = std::sqrt(best.norm * best.norm + constant_gain_);
  const auto is_explained = [&](const Freedom& by) {
    return fit(frame.seen, Friction::stated, enough, by).norm <= enough;
  };
  if (best.norm > p.limit(static_cast<double>(channels_.size())) ||
      is_explained({.first_end = false}) || is_explained({.last_end = false}) ||
      best.fitted > fit(frame.seen, Friction::stated).fitted + 1.0)
    return std::nullopt;
  return constants_of(best);
}

ChannelConstants LineFit::constants_of(const LineFitted& fitted) const {
  const std::vector<Site>& sites = p.problem.sites;
  ChannelConstants found{.norm = fitted.norm,
                         .count = static_cast<double>(channels_.size()),
                         .values = std::vector<double>(sites.back().channel + 1)};
  for (std::size_t k = 0; k < channels_.size(); ++k) {
    std::size_t live = 0;
    while (sites[live].channel != channels_[k] || p.problem.weights[live] == 0.0) ++live;
    const auto j = static_cast<Eigen::Index>(k);
    found.values[channels_[k]] = fitted.allowance(j) *
                                 constants_(static_cast<Eigen::Index>(live), j) /
                                 (p.problem.weights[live] / p.unit);
  }
  return found;
}

/// One that leaves an end of the array alone, and to which a constant would add nothing.
std::optional<Unexplained> LineFit::recalled(const JudgedFrame& frame, KeptContacts& memory) const {
  const auto known = memory.explain(as_eigen(frame.seen), p.most);
  if (!known || !known->leaves_an_end || !(known->gain < constant_gain_)) return std::nullopt;
  return Unexplained{.residual = {known->residual.begin(), known->residual.end()},
                     .norm = known->residual.norm()};
}

void LineFit::remember(const Unexplained& found, KeptContacts& memory) const {
  if (found.pressed.empty()) return;
  const auto presses = [&](ArrayPart part) {
    return std::any_of(found.pressed.begin(), found.pressed.end(),
                       [&](Eigen::Index j) { return part_of(j) == part; });
  };
  memory.keep(cone(found.friction)(Eigen::indexing::all, found.pressed), constants_,
              !p.limits.inner || !presses(ArrayPart::first_end) || !presses(ArrayPart::last_end));
}

}  // namespace

std::unique_ptr<const ContactFit> line_fit(const JudgedProblem& judged,
                                           const LinearProblem& contacts) {
  return std::make_unique<const LineFit>(judged, contacts);
}

}  // namespace tactile_net
