#include "tactile_net/skin/data_verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "inverse/checks.hpp"
#include "inverse/data_limits.hpp"
#include "inverse/significance.hpp"
#include "inverse/single_liar.hpp"
#include "numeric/eigen.hpp"
#include "skin/cone_search.hpp"
#include "skin/rest_of_rows.hpp"
#include "tactile_net/skin/family.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t iteration_limit = 1000;
constexpr double converged = 1e-5;
/// Over the square of the largest singular value, in the order in which they are tried.
constexpr std::array smoothings = {1e-4, 1e-6, 1e-8};

/// Of a contact's readings the first hundred steps, with most smoothing, explain most. Where they
/// leave this share no contact is near, and finding the nearest one would take a thousand times
/// three.
constexpr double far_share = 0.3;
/// A search ends where twice the steps, or a hundredth of the smoothing, have gained less than this
/// share of what is still missing: it would take ten times as many again.
constexpr double least_gain = 0.1;

double largest_square(const LinearProblem& problem) {
  const SkinFamily family(problem);
  double largest = 0.0;
  for (const double gamma : family.singular_values()) largest = std::max(largest, gamma);
  return largest * largest;
}

/// True if the best contact so far leaves so much that no contact is near.
/// @param left, all  norms of what is left and of all readings
bool is_far_from_contacts(double left, double all, double enough) {
  return left > enough && left / all > far_share;
}

/// A problem's cones, each factored when it is first asked for, by any thread.
class Cones {
 public:
  Cones(std::shared_ptr<const LinearProblem> problem, const Constraints& press)
      : problem_(std::move(problem)), press_(press) {}

  [[nodiscard]] const LinearProblem& problem() const noexcept { return *problem_; }
  /// Whether a reading depends on any contact.
  [[nodiscard]] bool are_read() {
    const std::lock_guard lock(mutex_);
    return square() > 0.0;
  }
  /// @pre  a reading depends on contacts
  [[nodiscard]] const ConeSearch& cone(std::size_t smoothing) {
    const std::lock_guard lock(mutex_);
    auto& cone = cones_[smoothing];
    if (cone) return *cone;
    const double alpha = smoothings[smoothing] * square();
    for (const auto& other : cones_)
      if (other) return cone.emplace(other->with_alpha(alpha));
    return cone.emplace(*problem_, alpha, press_);
  }

 private:
  double square() {
    if (!square_) square_ = largest_square(*problem_);
    return *square_;
  }

  std::shared_ptr<const LinearProblem> problem_;
  Constraints press_;
  std::optional<double> square_{};  // smoothings are shares of it
  std::array<std::optional<ConeSearch>, smoothings.size()> cones_{};
  std::mutex mutex_{};
};

}  // namespace

double frame_strain(const LinearProblem& problem, const DataLimits& limits,
                    std::span<const double> readings, std::span<const double> tractions) {
  double largest = 0.0;
  const auto cells = static_cast<std::ptrdiff_t>(problem.grid.count());
  if (limits.largest_traction)
    largest = std::abs(std::accumulate(tractions.begin(), tractions.begin() + cells, 0.0)) /
              static_cast<double>(cells) / *limits.largest_traction;
  const std::vector<double> rows = weighted(problem, readings);
  for (std::size_t i = 0; i < limits.largest_readings.size(); ++i)
    if (problem.weights[i] > 0.0)
      largest =
          std::max(largest, std::abs(rows[i]) / problem.weights[i] / limits.largest_readings[i]);
  return largest;
}

std::vector<double> pressing_part(const LinearProblem& problem,
                                  std::optional<double> friction_limit,
                                  std::span<const double> tractions) {
  std::vector<double> contact(tractions.begin(), tractions.end());
  const std::size_t cells = problem.grid.count();
  for (std::size_t i = 0; i < cells; ++i) {
    contact[i] = std::max(contact[i], 0.0);
    if (problem.components == 1 || !friction_limit) continue;
    double& y = contact[cells + i];
    double& z = contact[2 * cells + i];
    const double drag = std::hypot(y, z);
    const double most = *friction_limit * contact[i];
    if (drag <= most) continue;
    y *= most / drag;
    z *= most / drag;
  }
  return contact;
}

struct SkinDataJudge::Parts {
  Parts(std::shared_ptr<const LinearProblem> found_for, std::function<LinearProblem()> sought,
        DataLimits given);

  /// Of W (K f - g) over the noise, by the best contact found with no more friction than the limit:
  /// as soon as it is enough.
  [[nodiscard]] Eigen::VectorXd left_by_contact(std::span<const double> readings, double enough,
                                                const std::optional<double>& most_friction) const;
  /// The norm of that without a taxel, and no further than there is hope of `enough`.
  [[nodiscard]] double least_left(std::span<const double> readings, double enough,
                                  std::optional<std::size_t> taxel) const;
  /// The same by one smoothing and to the end, which taxels are compared by: of two without which
  /// there is enough, `least_left` says where each search happened to end.
  [[nodiscard]] double left_in_full(std::span<const double> readings, std::size_t taxel) const;
  [[nodiscard]] Eigen::VectorXd left(const LinearProblem& of, std::span<const double> readings,
                                     std::span<const double> tractions) const;
  /// P W g over the noise.
  [[nodiscard]] Eigen::VectorXd seen(std::span<const double> readings) const {
    const std::vector<double> g = weighted(problem, readings);
    return as_eigen(std::span(g)) / unit;
  }
  [[nodiscard]] double readings_of(std::size_t taxel) const;
  /// Of readings that contacts with no more friction explain, and what such a contact leaves.
  [[nodiscard]] std::optional<std::size_t> single_liar(
      std::span<const double> readings, const Eigen::VectorXd& residual,
      const std::optional<double>& most_friction) const;
  [[nodiscard]] std::optional<std::size_t> bad_taxel(std::span<const double> readings,
                                                     const Eigen::VectorXd& residual) const;
  /// Of a residual's norm, where so many rows are taken by something else than noise.
  [[nodiscard]] double limit(double taken) const {
    return std::sqrt(chi_squared_quantile(std::max(rows - taken, 1.0), false_alarms));
  }
  /// What contacts are sought with.
  [[nodiscard]] Cones& contacts() const;

  DataLimits limits;
  std::shared_ptr<const LinearProblem> shared;  // its matrix may take most of the memory
  const LinearProblem& problem;
  std::function<LinearProblem()> make_contacts;
  std::optional<double> friction{};  // that is stated, or else usual; absent: nothing drags
  Constraints press{};               // contacts of any friction that is likely
  double unit;                       // of all that is weighted: the noise, where it is known
  double rows;
  SingleLiar liars;

  mutable std::mutex mutex{};
  mutable std::unique_ptr<Cones> made{};
};

SkinDataJudge::Parts::Parts(std::shared_ptr<const LinearProblem> found_for,
                            std::function<LinearProblem()> sought, DataLimits given)
    : limits(std::move(given)),
      shared(std::move(found_for)),
      problem(*shared),
      make_contacts(std::move(sought)),
      unit(limits.noise_rms.value_or(1.0)),
      rows(static_cast<double>(independent_readings(problem))),
      liars(rows) {
  check_limits(limits, problem.weights.size());
  if (problem.components != 3) return;
  friction = limits.friction_limit.value_or(usual_friction);
  press.friction_limit = widest_friction(limits.friction_limit);
}

Eigen::VectorXd SkinDataJudge::Parts::left(const LinearProblem& of,
                                           std::span<const double> readings,
                                           std::span<const double> tractions) const {
  const std::vector<double> g = weighted(of, readings);
  return (as_eigen(std::span(g)) - as_eigen(of.kernel) * as_eigen(tractions)) / unit;
}

Cones& SkinDataJudge::Parts::contacts() const {
  const std::lock_guard lock(mutex);
  if (!made) {
    std::shared_ptr<const LinearProblem> sought =
        make_contacts ? std::make_shared<const LinearProblem>(make_contacts()) : shared;
    if (sought->weights != problem.weights || sought->components != problem.components)
      throw std::invalid_argument("contacts need the rows and components of the problem");
    made = std::make_unique<Cones>(std::move(sought), press);
  }
  return *made;
}

Eigen::VectorXd SkinDataJudge::Parts::left_by_contact(
    std::span<const double> readings, double enough,
    const std::optional<double>& most_friction) const {
  Cones& of = contacts();
  if (!of.are_read()) return seen(readings);
  const double all = seen(readings).norm();
  Eigen::VectorXd best;
  for (std::size_t i = 0; i < smoothings.size(); ++i) {
    bool first = i == 0;
    bool in_vain = false;
    Eigen::VectorXd residual;
    const auto look = [&](std::span<const double> tractions) {
      if (!std::exchange(first, false)) return false;
      residual = left(of.problem(), readings, tractions);
      in_vain = is_far_from_contacts(residual.norm(), all, enough);
      return in_vain;
    };
    const ConeSearch& all_contacts = of.cone(i);
    const SkinConeSolution found =
        (most_friction ? all_contacts.with_friction(*most_friction) : all_contacts)
            .solve(readings, iteration_limit, converged, look);
    if (found.status != FrameStatus::ok) continue;
    if (first) (void)look(found.tractions);  // they came before a hundred steps
    if (in_vain) return residual;
    residual = left(of.problem(), readings, found.tractions);
    if (best.size() == 0 || residual.norm() < best.norm()) best = std::move(residual);
    if (best.norm() <= enough) break;
  }
  return best;
}

double SkinDataJudge::Parts::least_left(std::span<const double> readings, double enough,
                                        std::optional<std::size_t> taxel) const {
  Cones& of = contacts();
  const RestOfRows of_rest(
      {of.problem().weights, of.problem().sites, of.problem().unknown_offsets},
      taxel ? std::span<const std::size_t>(&*taxel, 1) : std::span<const std::size_t>());
  const auto norm = [&](std::span<const double> tractions) {
    return of_rest(left(of.problem(), readings, tractions)).norm();
  };
  const double all = of_rest(seen(readings)).norm();
  if (!of.are_read()) return all;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < smoothings.size(); ++i) {
    std::optional<double> before;
    const auto is_vain = [&](std::span<const double> tractions) {
      const double now = norm(tractions);
      const bool vain = before ? now > enough && *before - now < least_gain * (now - enough)
                               : i == 0 && is_far_from_contacts(now, all, enough);
      before = now;
      return vain;
    };
    const ConeSearch& whole = of.cone(i);
    const SkinConeSolution found = (taxel ? whole.without(std::span(&*taxel, 1)) : whole)
                                       .solve(readings, iteration_limit, converged, is_vain);
    if (found.status != FrameStatus::ok) continue;
    const double now = norm(found.tractions);
    const bool stuck = best - now < least_gain * (now - enough);
    best = std::min(best, now);
    if (best <= enough || stuck) break;
  }
  return best;
}

double SkinDataJudge::Parts::left_in_full(std::span<const double> readings,
                                          std::size_t taxel) const {
  constexpr std::size_t smoothing = 1;
  Cones& of = contacts();
  const std::span<const std::size_t> only(&taxel, 1);
  const RestOfRows of_rest({of.problem().weights, of.problem().sites, of.problem().unknown_offsets},
                           only);
  if (!of.are_read()) return of_rest(seen(readings)).norm();
  const SkinConeSolution found =
      of.cone(smoothing).without(only).solve(readings, iteration_limit, converged);
  if (found.status != FrameStatus::ok) return std::numeric_limits<double>::infinity();
  return of_rest(left(of.problem(), readings, found.tractions)).norm();
}

double SkinDataJudge::Parts::readings_of(std::size_t taxel) const {
  double count = 0.0;
  for (std::size_t row = 0; row < problem.sites.size(); ++row)
    if (problem.sites[row].taxel == taxel && problem.weights[row] > 0.0) count += 1.0;
  return count;
}

std::optional<std::size_t> SkinDataJudge::Parts::single_liar(
    std::span<const double> readings, const Eigen::VectorXd& residual,
    const std::optional<double>& most_friction) const {
  if (!liars.may_be_in(residual) || !contacts().are_read()) return std::nullopt;
  Cones& of = contacts();
  const auto cone = [&](std::size_t smoothing) {
    const ConeSearch& whole = of.cone(smoothing);
    return most_friction ? whole.with_friction(*most_friction) : whole;
  };
  std::vector<double> nearest;  // of all readings, from which that of the rest is not far
  const auto all_left = [&](std::size_t smoothing) -> std::optional<Eigen::VectorXd> {
    SkinConeSolution found = cone(smoothing).solve(readings, iteration_limit, converged);
    if (found.status != FrameStatus::ok) return std::nullopt;
    nearest = std::move(found.tractions);
    return left(of.problem(), readings, nearest);
  };
  const auto rest_left = [&](std::size_t smoothing,
                             std::size_t taxel) -> std::optional<Eigen::VectorXd> {
    const std::span<const std::size_t> only(&taxel, 1);
    const SkinConeSolution found =
        cone(smoothing).without(only).solve(readings, iteration_limit, converged, {}, nearest);
    if (found.status != FrameStatus::ok) return std::nullopt;
    const RestOfRows of_rest(
        {of.problem().weights, of.problem().sites, of.problem().unknown_offsets}, only);
    return of_rest(left(of.problem(), readings, found.tractions));
  };
  return sought_liar(
      liars, seen(readings), problem.sites, problem.taxels,
      [&](std::size_t taxel) { return readings_of(taxel); }, all_left, rest_left);
}

/// Of the taxels with the largest residuals the one without which a contact explains the rest best.
std::optional<std::size_t> SkinDataJudge::Parts::bad_taxel(std::span<const double> readings,
                                                           const Eigen::VectorXd& residual) const {
  std::vector<std::size_t> alone;  // without each of which a contact explains the rest
  for (const std::size_t taxel : suspects(residual, problem.sites, problem.taxels)) {
    const double taken = readings_of(taxel);
    if (taken == 0.0 || taken >= rows) continue;
    const double most = limit(taken);
    const double norm = least_left(readings, most, taxel);
    const double gain = residual.squaredNorm() - norm * norm;
    if (norm <= most && gain >= taxel_gain(taken, problem.taxels)) alone.push_back(taxel);
  }
  if (alone.empty()) return std::nullopt;
  std::size_t worst = alone.front();
  double best = std::numeric_limits<double>::infinity();
  for (const std::size_t taxel : alone) {
    const double norm = alone.size() > 1 ? left_in_full(readings, taxel) : 0.0;
    if (norm >= best) continue;
    best = norm;
    worst = taxel;
  }
  return worst;
}

SkinDataJudge::SkinDataJudge(const LinearProblem& problem, DataLimits limits)
    : SkinDataJudge(std::make_shared<const LinearProblem>(problem),
                    std::function<LinearProblem()>{}, std::move(limits)) {}
SkinDataJudge::SkinDataJudge(const LinearProblem& problem, const LinearProblem& contacts,
                             DataLimits limits)
    : SkinDataJudge(
          std::make_shared<const LinearProblem>(problem), [contacts] { return contacts; },
          std::move(limits)) {
  (void)parts_->contacts();
}
SkinDataJudge::SkinDataJudge(std::shared_ptr<const LinearProblem> problem,
                             std::function<LinearProblem()> contacts, DataLimits limits)
    : parts_(std::make_unique<const Parts>(std::move(problem), std::move(contacts),
                                           std::move(limits))) {}
SkinDataJudge::~SkinDataJudge() = default;
SkinDataJudge::SkinDataJudge(SkinDataJudge&&) noexcept = default;
SkinDataJudge& SkinDataJudge::operator=(SkinDataJudge&&) noexcept = default;

DataVerdict SkinDataJudge::judge(std::span<const double> readings,
                                 std::span<const double> tractions) const {
  const Parts& p = *parts_;
  check_size(readings, p.problem.weights.size());
  check_tractions(tractions, p.problem.kernel.columns);
  DataVerdict verdict{.noise_known = p.limits.noise_rms.has_value()};
  const double rms = p.unit / std::sqrt(p.rows);  // of a norm
  const double most = p.limit(0.0);
  if (verdict.noise_known) verdict.residual_limit = most * rms;
  verdict.strain = frame_strain(p.problem, p.limits, readings, tractions);
  if (verdict.strain > 1.0) {  // in which unit the rest would be judged nobody knows
    verdict.doubts.push_back(DataDoubt::implausible);
    return verdict;
  }
  const double size = p.seen(readings).norm();
  verdict.noise_alone = size == 0.0 || (verdict.noise_known && size <= most);
  if (!verdict.noise_known) return verdict;

  Eigen::VectorXd residual =
      p.left(p.problem, readings, pressing_part(p.problem, p.friction, tractions));
  if (!(residual.norm() <= most)) {
    const Eigen::VectorXd best = p.left_by_contact(readings, most, p.friction);
    if (best.size() > 0 && !(residual.norm() <= best.norm())) residual = best;
  }
  verdict.residual_rms = residual.norm() * rms;
  if (residual.norm() <= most) {
    verdict.taxel = p.single_liar(readings, residual, p.friction);
    if (verdict.taxel) verdict.doubts.push_back(DataDoubt::bad_taxel);
    return verdict;
  }
  if (!residual.allFinite()) {  // of no noise that a number can say
    verdict.doubts.push_back(DataDoubt::misfit);
    return verdict;
  }

  if (p.friction != p.press.friction_limit) {  // as where nobody states a limit
    Eigen::VectorXd best = p.left_by_contact(readings, most, p.press.friction_limit);
    if (best.size() > 0 && best.norm() <= most) {
      verdict.taxel = p.single_liar(readings, best, p.press.friction_limit);
      verdict.doubts.push_back(verdict.taxel ? DataDoubt::bad_taxel : DataDoubt::friction_limit);
      return verdict;
    }
    if (best.size() > 0 && best.norm() <= residual.norm()) residual = std::move(best);
  }

  std::vector<double> turned(readings.begin(), readings.end());
  for (double& reading : turned) reading = -reading;
  verdict.taxel = p.bad_taxel(readings, residual);
  if (verdict.taxel)
    verdict.doubts.push_back(DataDoubt::bad_taxel);
  else if (p.left(p.problem, readings, tractions).norm() <= most ||
           p.least_left(turned, most, {}) <= most)
    verdict.doubts.push_back(DataDoubt::pulls);
  else
    verdict.doubts.push_back(DataDoubt::misfit);
  return verdict;
}

}  // namespace tactile_net
