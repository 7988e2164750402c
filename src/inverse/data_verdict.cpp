#include "tactile_net/inverse/data_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/data_limits.hpp"
#include "inverse/data_memory.hpp"
#include "inverse/nonnegative.hpp"
#include "inverse/significance.hpp"
#include "inverse/single_liar.hpp"
#include "inverse/weighting.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/inverse/constrained.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t constraint_limit = 300;

/// What a contact is allowed besides pressing: columns without a sign.
struct Freedom {
  Eigen::MatrixXd columns{};
  bool first_end = true;  ///< loads over that end of the array
  bool last_end = true;
};

struct Fit {
  double norm = 0.0;  ///< of the residual
  double free = 0.0;  ///< columns that are
  Eigen::VectorXd residual{};
  Eigen::VectorXd allowance{};          ///< of the freedom's columns
  std::vector<Eigen::Index> pressed{};  ///< columns of the cone, without freedom
};

}  // namespace

struct DataJudge::Parts {
  Parts(const LinearProblem& problem, const LinearProblem& contacts, DataLimits given);

  enum class Side { middle, first_end, last_end };

  [[nodiscard]] std::vector<Side> sides(const SurfaceGrid& grid) const;
  [[nodiscard]] Fit fit(const Eigen::MatrixXd& of, const Eigen::VectorXd& y, double enough = 0.0,
                        const Freedom& freedom = {}) const;
  [[nodiscard]] Fit with_constants(const Eigen::MatrixXd& of, const Eigen::VectorXd& y,
                                   Freedom freedom) const;
  [[nodiscard]] Eigen::VectorXd nearest_contact(std::span<const double> f) const;
  void explain(const Eigen::VectorXd& y, std::span<const double> tractions,
               DataMemory::Kept* memory, DataVerdict& verdict) const;
  void remember(const Fit& fit, DataMemory::Kept& memory) const;
  void look_for_constant(const Eigen::VectorXd& y, const Eigen::VectorXd& contact,
                         DataVerdict& verdict) const;
  [[nodiscard]] bool is_turned_round(const Eigen::VectorXd& y, std::span<const double> tractions,
                                     DataVerdict& verdict) const;
  void take_offset(const Eigen::VectorXd& allowance, const Freedom& freedom,
                   DataVerdict& verdict) const;
  [[nodiscard]] double strain(std::span<const double> g, std::span<const double> f) const;
  [[nodiscard]] double limit(double taken) const;
  /// What makes a residual's norm the rms of a weighted reading.
  [[nodiscard]] double norm_to_rms() const { return unit / std::sqrt(rows); }
  [[nodiscard]] const Eigen::MatrixXd& widest() const { return wide.cols() > 0 ? wide : cone; }
  [[nodiscard]] Freedom without(std::size_t taxel) const;
  [[nodiscard]] static Eigen::VectorXd alone(const Eigen::MatrixXd& of, const Fit& base);
  [[nodiscard]] double likeness(const Eigen::VectorXd& y, const Freedom& freedom,
                                const Fit& rest) const;
  [[nodiscard]] std::optional<std::size_t> single_liar(const Eigen::MatrixXd& of,
                                                       const Eigen::VectorXd& y,
                                                       const Fit& base) const;

  DataLimits limits;
  double unit;  // of all that is weighted: the noise, where it is known
  std::vector<Site> sites;
  std::size_t taxels, values;
  std::ptrdiff_t components;  // normal, or the tangential one too
  Weighting weighting;
  Eigen::VectorXd weights;  // over the unit
  Eigen::MatrixXd kernel;   // W K
  Eigen::MatrixXd cone;     // W K E within the limit that is stated, unit columns
  Eigen::MatrixXd wide;     // W K E of any friction that is likely; empty: as `cone`
  double rows;              // independent ones
  SingleLiar liars;
  double most = 0.0;                    // limit(0)
  double constant_gain;                 // square that a constant in each channel takes of noise
  std::vector<Side> places{};           // of the values of contacts
  std::vector<Side> found_places{};     // of the values of tractions
  std::vector<std::size_t> channels{};  // with a live row; none where their offsets are free
  Freedom free_constants{};             // one in each of them
};

DataJudge::Parts::Parts(const LinearProblem& problem, const LinearProblem& contacts,
                        DataLimits given)
    : limits(std::move(given)),
      unit(limits.noise_rms.value_or(1.0)),
      sites(problem.sites),
      taxels(problem.taxels),
      values(problem.grid.count()),
      components(static_cast<std::ptrdiff_t>(problem.components)),
      weighting(problem),
      weights(weighting.weights()),
      kernel(as_eigen(problem.kernel)),
      rows(static_cast<double>(weighting.rows())),
      liars(rows),
      constant_gain(std::numeric_limits<double>::infinity()) {
  check_limits(limits, problem.weights.size());
  if (!(contacts.weights == problem.weights && contacts.components == problem.components &&
        contacts.unknown_offsets == problem.unknown_offsets))
    throw std::invalid_argument("contacts need the rows and unknowns of the problem");

  weights /= unit;
  kernel /= unit;
  const auto columns = [&](const Constraints& press) {
    Eigen::MatrixXd all = as_eigen(contacts.kernel) * as_eigen(edges(contacts, press)) / unit;
    for (Eigen::Index j = 0; j < all.cols(); ++j)
      if (const double norm = all.col(j).norm(); norm > 0.0) all.col(j) /= norm;
    return all;
  };
  Constraints press{.nonnegative = true};
  if (problem.components == 2)
    press.friction_limit = limits.friction_limit.value_or(usual_friction);
  cone = columns(press);
  if (problem.components == 2 && limits.friction_limit) {
    press.friction_limit = widest_friction(limits.friction_limit);
    wide = columns(press);
  }
  places = sides(contacts.grid);
  found_places = sides(problem.grid);
  const Eigen::MatrixXd all = channel_constants(problem.weights, problem.sites);
  for (Eigen::Index c = 0; c < all.cols() && !problem.unknown_offsets; ++c)
    if (all.col(c).squaredNorm() > 0.0) channels.push_back(static_cast<std::size_t>(c));
  free_constants.columns = all(Eigen::indexing::all, channels);
  most = limit(0.0);
  if (!channels.empty())
    constant_gain = chi_squared_quantile(static_cast<double>(channels.size()), 0.1 * false_alarms);
}

std::vector<DataJudge::Parts::Side> DataJudge::Parts::sides(const SurfaceGrid& grid) const {
  std::vector<Side> all(grid.rows, Side::middle);
  for (std::size_t i = 0; i < grid.rows && limits.inner; ++i) {
    const double y = grid.y(i);
    if (y < limits.inner->first) all[i] = Side::first_end;
    if (y > limits.inner->second) all[i] = Side::last_end;
  }
  return all;
}

/// @param of      columns of a cone
/// @param enough  a residual that is as good as none
Fit DataJudge::Parts::fit(const Eigen::MatrixXd& of, const Eigen::VectorXd& y, double enough,
                          const Freedom& freedom) const {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < of.cols(); ++j)
    if (const Side side = places[static_cast<std::size_t>(j) % places.size()];
        (side != Side::first_end || freedom.first_end) &&
        (side != Side::last_end || freedom.last_end))
      kept.push_back(j);
  const auto pressing = static_cast<Eigen::Index>(kept.size());
  Eigen::MatrixXd part;
  const bool whole = pressing == of.cols() && freedom.columns.cols() == 0;
  if (!whole) {
    part.resize(of.rows(), pressing + freedom.columns.cols());
    part.leftCols(pressing) = of(Eigen::indexing::all, kept);
    if (freedom.columns.cols() > 0) part.rightCols(freedom.columns.cols()) = freedom.columns;
  }
  const Eigen::MatrixXd& a = whole ? of : part;
  std::vector<bool> bounded(kept.size(), true);
  bounded.resize(static_cast<std::size_t>(a.cols()), false);

  // Columns have length 1: what is left to gain is a small part of the limit.
  const double noise = limits.noise_rms ? most / y.norm() : 1e-3;
  const double gradient = 1e-3 * std::min(noise * noise, 1.0);
  const NonnegativeSolution found = sparse_nonnegative_least_squares(
      a, y, bounded, constraint_limit, {.residual = enough, .gradient = gradient});
  Fit fit{.residual = y - a * found.z, .allowance = found.z.tail(freedom.columns.cols())};
  fit.norm = fit.residual.norm();
  for (std::size_t j = 0; j < kept.size(); ++j)
    if (found.z(static_cast<Eigen::Index>(j)) > 0.0) fit.pressed.push_back(kept[j]);
  fit.free = static_cast<double>(std::count(found.free.begin(), found.free.end(), true));
  return fit;
}

/// Of the tractions found, what presses: with no more friction than the cone allows.
Eigen::VectorXd DataJudge::Parts::nearest_contact(std::span<const double> f) const {
  Eigen::VectorXd contact = as_eigen(f);
  const auto n = static_cast<Eigen::Index>(values);
  contact.head(n) = contact.head(n).cwiseMax(0.0);
  if (contact.size() == n) return contact;
  const Eigen::VectorXd drag = limits.friction_limit.value_or(usual_friction) * contact.head(n);
  contact.tail(n) = contact.tail(n).cwiseMin(drag).cwiseMax(-drag);
  return contact;
}

/// Of readings without their offsets, where these are free.
double DataJudge::Parts::strain(std::span<const double> g, std::span<const double> f) const {
  double largest = 0.0;
  if (limits.largest_traction) {
    const double sum = std::accumulate(f.begin(), f.begin() + std::ssize(f) / components, 0.0);
    largest = std::abs(sum) / static_cast<double>(values) / *limits.largest_traction;
  }
  const Eigen::VectorXd left = weighting(g);
  for (std::size_t i = 0; i < limits.largest_readings.size(); ++i)
    if (const auto row = static_cast<Eigen::Index>(i); weights(row) > 0.0)
      largest = std::max(
          largest, std::abs(left(row)) / weighting.weights()(row) / limits.largest_readings[i]);
  return largest;
}

/// Of a residual's norm, where so many rows are taken by something else than noise.
double DataJudge::Parts::limit(double taken) const {
  return std::sqrt(chi_squared_quantile(std::max(rows - taken, 1.0), false_alarms));
}

Freedom DataJudge::Parts::without(std::size_t taxel) const {
  std::vector<Eigen::Index> at;
  for (Eigen::Index row = 0; row < weights.size(); ++row)
    if (sites[static_cast<std::size_t>(row)].taxel == taxel && weights(row) > 0.0)
      at.push_back(row);
  Freedom freedom{.columns = Eigen::MatrixXd::Zero(weights.size(), std::ssize(at))};
  for (Eigen::Index j = 0; j < std::ssize(at); ++j)
    freedom.columns(at[static_cast<std::size_t>(j)], j) = 1.0;
  freedom.columns = weighting.projected(freedom.columns);
  return freedom;
}

/// How far each reading is from what all others say of it, with the same columns pressed: a contact
/// beneath a taxel that lies follows it, and leaves more at its neighbours than there.
Eigen::VectorXd DataJudge::Parts::alone(const Eigen::MatrixXd& of, const Fit& base) {
  constexpr double least = 1e-3;  // of a reading's own say in what is left of it
  if (base.pressed.empty()) return base.residual;
  const Eigen::MatrixXd pressed = of(Eigen::indexing::all, base.pressed);
  const Svd svd = singular_value_decomposition(pressed);
  const auto rank = (svd.values.array() > 1e-10 * svd.values(0)).count();
  const Eigen::VectorXd own = 1.0 - svd.u.leftCols(rank).rowwise().squaredNorm().array();
  return base.residual.cwiseQuotient(own.cwiseMax(least).cwiseSqrt());
}

/// What taxels are compared by, smaller for the one that is likelier to lie: by contacts within the
/// stated limit where these explain the rest too.
double DataJudge::Parts::likeness(const Eigen::VectorXd& y, const Freedom& freedom,
                                  const Fit& rest) const {
  if (wide.cols() == 0) return rest.norm;
  const double enough = limit(static_cast<double>(freedom.columns.cols()));
  const double within = fit(cone, y, 0.0, freedom).norm;
  return within <= enough ? within : enough + rest.norm;
}

/// @param of    columns of a cone that explains the frame
/// @param base  what it leaves at least
std::optional<std::size_t> DataJudge::Parts::single_liar(const Eigen::MatrixXd& of,
                                                         const Eigen::VectorXd& y,
                                                         const Fit& base) const {
  std::optional<std::size_t> liar;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t taxel : suspects(alone(of, base), sites, taxels)) {
    const Freedom freedom = without(taxel);
    const auto taken = static_cast<double>(freedom.columns.cols());
    if (taken == 0.0) continue;
    const Fit rest = fit(of, y, 0.0, freedom);
    if (!liars.is_found(base.residual, rest.residual, taxel_gain(taken, taxels), y)) continue;
    const double like = likeness(y, freedom, rest);
    if (like >= least) continue;
    least = like;
    liar = taxel;
  }
  return liar;
}

void DataJudge::Parts::take_offset(const Eigen::VectorXd& allowance, const Freedom& freedom,
                                   DataVerdict& verdict) const {
  verdict.doubts.push_back(DataDoubt::offset);
  verdict.offset.assign(sites.back().channel + 1, 0.0);
  for (std::size_t k = 0; k < channels.size(); ++k) {
    Eigen::Index live = 0;
    while (sites[static_cast<std::size_t>(live)].channel != channels[k] || weights(live) == 0.0)
      ++live;
    const auto j = static_cast<Eigen::Index>(k);
    verdict.offset[channels[k]] = allowance(j) * freedom.columns(live, j) / weights(live);
  }
}

/// With loads over one end of the array at most: a constant and a load over everything could draw
/// whatever pulls.
Fit DataJudge::Parts::with_constants(const Eigen::MatrixXd& of, const Eigen::VectorXd& y,
                                     Freedom freedom) const {
  freedom.last_end = false;
  Fit one = fit(of, y, 0.0, freedom);
  std::swap(freedom.first_end, freedom.last_end);
  Fit other = fit(of, y, 0.0, freedom);
  return one.norm < other.norm ? one : other;
}

/// A load over the whole array explains a constant too. It is called a constant where without one
/// neither end of the array can do without a load, and with one an end can, with no more places
/// pressed.
void DataJudge::Parts::look_for_constant(const Eigen::VectorXd& y, const Eigen::VectorXd& contact,
                                         DataVerdict& verdict) const {
  if (!limits.inner || channels.empty()) return;
  const auto constants = static_cast<double>(channels.size());
  const Freedom& freedom = free_constants;
  Eigen::VectorXd inner = contact;
  for (Eigen::Index j = 0; j < inner.size(); ++j)
    if (found_places[static_cast<std::size_t>(j) % values] != Side::middle) inner(j) = 0.0;
  // Cheap, and rarely less than the gain itself.
  if ((freedom.columns.transpose() * (y - kernel * inner)).squaredNorm() < 0.5 * constant_gain)
    return;
  const Fit best = with_constants(cone, y, freedom);
  const double enough = std::sqrt(best.norm * best.norm + constant_gain);
  if (best.norm > limit(constants) || fit(cone, y, enough, {.first_end = false}).norm <= enough ||
      fit(cone, y, enough, {.last_end = false}).norm <= enough ||
      best.free > fit(cone, y).free + 1.0)
    return;
  take_offset(best.allowance, freedom, verdict);
}

/// Whether the same readings with the other sign are those of a contact, and these are less so.
/// What the nearest contact leaves of them is then the verdict's residual.
bool DataJudge::Parts::is_turned_round(const Eigen::VectorXd& y, std::span<const double> tractions,
                                       DataVerdict& verdict) const {
  const auto normal = tractions.first(values);
  if (std::accumulate(normal.begin(), normal.end(), 0.0) >= 0.0) return false;
  const Fit turned = fit(widest(), -y);
  const Fit base = fit(widest(), y);
  verdict.residual_rms = base.norm * norm_to_rms();
  const double squares = base.norm * base.norm;
  const double turned_squares = turned.norm * turned.norm;
  if (!limits.noise_rms) {
    const double left = rows - turned.free;
    return left >= 1.0 &&
           squares / rows >
               turned_squares / left * variance_ratio_quantile(rows, left, 0.1 * false_alarms);
  }
  constexpr double margin = 20.0;  // of log-likelihoods, doubled: noise alone differs by less
  return turned.norm <= most && squares - turned_squares + 2.0 * (base.free - turned.free) > margin;
}

void DataJudge::Parts::remember(const Fit& fit, DataMemory::Kept& memory) const {
  const auto presses = [&](Side side) {
    return std::any_of(fit.pressed.begin(), fit.pressed.end(), [&](Eigen::Index j) {
      return places[static_cast<std::size_t>(j) % places.size()] == side;
    });
  };
  memory.keep(cone(Eigen::indexing::all, fit.pressed), free_constants.columns,
              !limits.inner || !presses(Side::first_end) || !presses(Side::last_end));
}

void DataJudge::Parts::explain(const Eigen::VectorXd& y, std::span<const double> tractions,
                               DataMemory::Kept* memory, DataVerdict& verdict) const {
  const double rms = norm_to_rms();
  if (memory != nullptr) {
    const auto known = memory->explain(y, most);
    // A contact that leaves an end alone explains the frame, and a constant would gain nothing.
    if (known && known->leaves_an_end && known->gain < constant_gain &&
        !liars.may_be_in(known->residual)) {
      verdict.residual_rms = known->residual.norm() * rms;
      return;
    }
  }
  const Eigen::VectorXd contact = nearest_contact(tractions);
  Fit base{.residual = y - kernel * contact};
  base.norm = base.residual.norm();
  if (base.norm > most || memory != nullptr) base = fit(cone, y, most);
  // The first contact that is near enough may well leave more than the nearest one.
  const auto is_odd = [&](const Eigen::MatrixXd& of) {
    if (!liars.may_be_in(base.residual)) return false;
    base = fit(of, y);
    return liars.may_be_in(alone(of, base));
  };
  if (base.norm <= most) {
    const bool odd = is_odd(cone);
    if (memory != nullptr && !base.pressed.empty()) remember(base, *memory);
    verdict.residual_rms = base.norm * rms;
    look_for_constant(y, contact, verdict);
    if (odd && verdict.consistent()) verdict.taxel = single_liar(cone, y, base);
    if (verdict.taxel) verdict.doubts.push_back(DataDoubt::bad_taxel);
    return;
  }
  verdict.residual_rms = base.norm * rms;

  // By contacts that the limit does not hold, as where nobody states one.
  if (wide.cols() > 0) base = fit(wide, y, most);
  if (base.norm <= most) {
    if (is_odd(wide)) verdict.taxel = single_liar(wide, y, base);
    verdict.doubts.push_back(verdict.taxel ? DataDoubt::bad_taxel : DataDoubt::friction_limit);
    return;
  }

  // One taxel, one constant a channel, or either of them.
  const auto gains = [&](const Fit& fit, double taken, double alarms) {
    return fit.norm <= limit(taken) &&
           base.norm * base.norm - fit.norm * fit.norm >= chi_squared_quantile(taken, alarms);
  };
  double by_taxel = std::numeric_limits<double>::infinity();
  double least = by_taxel;
  for (const std::size_t taxel : suspects(alone(widest(), base), sites, taxels)) {
    const Freedom freedom = without(taxel);
    const auto taken = static_cast<double>(freedom.columns.cols());
    if (taken == 0.0) continue;
    const Fit rest = fit(widest(), y, 0.0, freedom);
    if (!gains(rest, taken, false_alarms / static_cast<double>(taxels))) continue;
    const double like = likeness(y, freedom, rest);
    if (like >= least) continue;
    least = like;
    by_taxel = rest.norm;
    verdict.taxel = taxel;
  }
  Fit constant;
  double by_constant = std::numeric_limits<double>::infinity();
  double far = 0.0;
  if (limits.inner && !channels.empty()) {
    const auto constants = static_cast<double>(channels.size());
    constant = with_constants(widest(), y, free_constants);
    far = chi_squared_quantile(constants, false_alarms);
    if (gains(constant, constants, false_alarms)) by_constant = constant.norm;
  }
  if (by_constant * by_constant + far < by_taxel * by_taxel) verdict.taxel.reset();
  if (verdict.taxel) verdict.doubts.push_back(DataDoubt::bad_taxel);
  if (by_constant * by_constant <= by_taxel * by_taxel + far && std::isfinite(by_constant))
    take_offset(constant.allowance, free_constants, verdict);
  if (!verdict.consistent()) return;
  const double found = (y - kernel * as_eigen(tractions)).norm();
  verdict.doubts.push_back(found <= most ? DataDoubt::pulls : DataDoubt::misfit);
}

DataJudge::DataJudge(const LinearProblem& problem, DataLimits limits)
    : DataJudge(problem, problem, std::move(limits)) {}
DataJudge::DataJudge(const LinearProblem& problem, const LinearProblem& contacts, DataLimits limits)
    : parts_(std::make_unique<const Parts>(problem, contacts, std::move(limits))) {}
DataJudge::~DataJudge() = default;
DataJudge::DataJudge(DataJudge&&) noexcept = default;
DataJudge& DataJudge::operator=(DataJudge&&) noexcept = default;

DataVerdict DataJudge::judge(std::span<const double> readings, std::span<const double> tractions,
                             DataMemory* memory) const {
  const Parts& p = *parts_;
  check_size(readings, static_cast<std::size_t>(p.weights.size()));
  check_tractions(tractions, static_cast<std::size_t>(p.kernel.cols()));
  DataVerdict verdict{.noise_known = p.limits.noise_rms.has_value()};
  if (verdict.noise_known) verdict.residual_limit = p.most * p.norm_to_rms();
  verdict.strain = p.strain(readings, tractions);
  if (verdict.strain > 1.0) {  // in which unit the rest would be judged nobody knows
    verdict.doubts.push_back(DataDoubt::implausible);
    return verdict;
  }
  const Eigen::VectorXd y = p.weighting(readings) / p.unit;
  const double size = y.norm();
  verdict.noise_alone = size == 0.0 || (verdict.noise_known && size <= p.most);
  if (size == 0.0) return verdict;
  if (!std::isfinite(size)) {  // of no noise that a number can say
    verdict.residual_rms = std::numeric_limits<double>::infinity();
    if (verdict.noise_known) verdict.doubts.push_back(DataDoubt::misfit);
  } else if (p.is_turned_round(y, tractions, verdict)) {
    verdict.doubts.push_back(DataDoubt::pulls);
  } else if (verdict.noise_known) {
    p.explain(y, tractions, memory != nullptr ? memory->kept_.get() : nullptr, verdict);
  }
  return verdict;
}

}  // namespace tactile_net
