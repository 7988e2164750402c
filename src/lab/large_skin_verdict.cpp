#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "inverse/data_limits.hpp"
#include "inverse/significance.hpp"
#include "inverse/single_liar.hpp"
#include "lab/large_skin.hpp"
#include "tactile_net/skin/data_verdict.hpp"

namespace tactile_net::lab {
namespace {

/// Steps from nothing smooth as alpha does, and the more of them the less: one small alpha serves.
constexpr double search_smoothing = 1e-8;  // over the square of what uniform pressure reads
/// Of `sought_liar`, over that square, which is some five times the largest singular value's.
constexpr std::array liar_smoothings = {2e-5, 2e-7};
constexpr std::size_t most_search_steps = 500;

/// A contact that explains readings to noise, or the nearest that some steps lead to.
class ContactSearch {
 public:
  ContactSearch(std::shared_ptr<LargeSkinSystem> system, const DataLimits& limits)
      : system_(std::move(system)), unit_(*limits.noise_rms), square_(square_of(*system_)) {
    if (problem_of(*system_).components != 3) return;
    friction_ = limits.friction_limit.value_or(usual_friction);
    press_.friction_limit = widest_friction(limits.friction_limit);
  }

  /// Whether there is a limit that holds contacts within less friction than is likely.
  [[nodiscard]] bool is_limited() const { return friction_ != press_.friction_limit; }
  /// Of any friction that is likely.
  [[nodiscard]] const Constraints& widest() const noexcept { return press_; }
  [[nodiscard]] Constraints within_limit() const { return {.friction_limit = friction_}; }
  /// W (K f - g) over the noise of contacts that are constrained so.
  [[nodiscard]] std::vector<double> left(std::span<const double> readings, double enough,
                                         const Constraints& press) const {
    return left(readings, enough, press, search_smoothing);
  }
  /// The same where the search goes on however well readings are explained.
  /// @param smoothing  over the square of what uniform pressure reads
  [[nodiscard]] std::vector<double> least_left(std::span<const double> readings,
                                               const Constraints& press, double smoothing) const {
    return left(readings, 0.0, press, smoothing);
  }
  /// The same of tractions that are known.
  [[nodiscard]] std::vector<double> left_by(std::span<const double> readings,
                                            std::span<const double> tractions) const {
    std::vector<double> rows = weighted_product(*system_, tractions);
    const std::vector<double> given = weighted(problem_of(*system_), readings);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = (rows[i] - given[i]) / unit_;
    return rows;
  }
  /// W g over the noise.
  [[nodiscard]] std::vector<double> seen(std::span<const double> readings) const {
    std::vector<double> rows = weighted(problem_of(*system_), readings);
    for (double& row : rows) row /= unit_;
    return rows;
  }
  [[nodiscard]] std::vector<double> pressing(std::span<const double> tractions) const {
    return pressing_part(problem_of(*system_), friction_, tractions);
  }

 private:
  [[nodiscard]] std::vector<double> left(std::span<const double> readings, double enough,
                                         const Constraints& press, double smoothing) const {
    const SkinConeSolution found = LargeSkinCone(system_, smoothing * square_, press)
                                       .solve(readings, most_search_steps, 1e-5, enough * unit_);
    if (found.status != FrameStatus::ok) return seen(readings);
    return left_by(readings, found.tractions);
  }
  static double square_of(LargeSkinSystem& system) {
    const LinearProblem& problem = problem_of(system);
    std::vector<double> even(problem.components * problem.grid.count());
    std::fill_n(even.begin(), problem.grid.count(), 1.0);
    double largest = 0.0;
    for (const double reading : weighted_product(system, even))
      largest = std::max(largest, std::abs(reading));
    return largest > 0.0 ? largest * largest : 1.0;
  }

  std::shared_ptr<LargeSkinSystem> system_;
  double unit_;
  double square_;                     // of what uniform pressure reads
  std::optional<double> friction_{};  // that is stated, or else usual; absent: nothing drags
  Constraints press_{};               // contacts of any friction that is likely
};

double norm(const std::vector<double>& left) { return std::sqrt(SingleLiar::squares(left)); }

/// Whether readings away from a taxel are explained about as noise allows. A broken taxel bends the
/// contact beside it and nowhere else: where they are not, no contact without it explains the rest.
bool is_explained_elsewhere(const LinearProblem& problem, const SkinArray& skin, std::size_t taxel,
                            const std::vector<double>& left) {
  constexpr std::size_t reach = 6;  // taxels
  constexpr double slack = 2.0;     // of a norm: a search ends early
  const auto apart = [](std::size_t a, std::size_t b) { return a > b ? a - b : b - a; };
  double sum = 0.0;
  double rows = 0.0;
  for (std::size_t i = 0; i < problem.sites.size(); ++i) {
    const std::size_t other = problem.sites[i].taxel;
    if (problem.weights[i] == 0.0 || (apart(other / skin.columns, taxel / skin.columns) <= reach &&
                                      apart(other % skin.columns, taxel % skin.columns) <= reach))
      continue;
    sum += std::pow(left[i], 2);
    rows += 1.0;
  }
  return rows == 0.0 || sum <= slack * slack * chi_squared_quantile(rows, false_alarms);
}

}  // namespace

DataVerdict LargeSkin::judge(std::span<const double> readings, std::span<const double> tractions) {
  DataVerdict verdict{.noise_known = limits_.noise_rms.has_value()};
  verdict.strain = frame_strain(problem(), limits_, readings, tractions);
  if (verdict.strain > 1.0) {  // in which unit the rest would be judged nobody knows
    verdict.doubts.push_back(DataDoubt::implausible);
    return verdict;
  }
  double size = 0.0;  // without tractions
  for (const double reading : weighted(problem(), readings)) size = std::hypot(size, reading);
  verdict.noise_alone = size == 0.0;
  if (!verdict.noise_known) return verdict;

  const auto rows = static_cast<double>(independent_readings(problem()));
  const double rms = *limits_.noise_rms / std::sqrt(rows);  // of a norm
  const double most = std::sqrt(chi_squared_quantile(rows, false_alarms));
  verdict.residual_limit = most * rms;
  size /= *limits_.noise_rms;
  verdict.noise_alone = size <= most;
  const ContactSearch search(system_, limits_);
  const SingleLiar liars(rows);
  const auto rows_of = [&](std::size_t taxel) {
    double count = 0.0;
    for (std::size_t i = 0; i < problem().sites.size(); ++i)
      if (problem().sites[i].taxel == taxel && problem().weights[i] > 0.0) count += 1.0;
    return count;
  };
  // Of readings that contacts constrained so explain, and what such a contact leaves.
  const auto single_liar = [&](const std::vector<double>& explained,
                               const Constraints& press) -> std::optional<std::size_t> {
    if (!liars.may_be_in(explained)) return std::nullopt;
    const auto all_left = [&](std::size_t smoothing) -> std::optional<std::vector<double>> {
      return search.least_left(readings, press, liar_smoothings[smoothing]);
    };
    const auto rest_left = [&](std::size_t smoothing,
                               std::size_t taxel) -> std::optional<std::vector<double>> {
      return ContactSearch(without_taxels(*system_, {taxel}), limits_)
          .least_left(readings, press, liar_smoothings[smoothing]);
    };
    return sought_liar(liars, search.seen(readings), problem().sites, problem().taxels, rows_of,
                       all_left, rest_left);
  };
  std::vector<double> left = search.left_by(readings, search.pressing(tractions));
  if (!(norm(left) <= most)) {
    std::vector<double> best = search.left(readings, most, search.within_limit());
    if (!(norm(left) <= norm(best))) left = std::move(best);
  }
  verdict.residual_rms = norm(left) * rms;
  if (norm(left) <= most) {
    verdict.taxel = single_liar(left, search.within_limit());
    if (verdict.taxel) verdict.doubts.push_back(DataDoubt::bad_taxel);
    return verdict;
  }

  if (search.is_limited()) {  // as where nobody states a limit
    std::vector<double> best = search.left(readings, most, search.widest());
    if (norm(best) <= most) {
      verdict.taxel = single_liar(best, search.widest());
      verdict.doubts.push_back(verdict.taxel ? DataDoubt::bad_taxel : DataDoubt::friction_limit);
      return verdict;
    }
    if (norm(best) <= norm(left)) left = std::move(best);
  }
  if (!std::isfinite(norm(left))) {  // of no noise that a number can say
    verdict.doubts.push_back(DataDoubt::misfit);
    return verdict;
  }

  const std::size_t worst = suspects(left, problem().sites, problem().taxels).front();
  const double taken = rows_of(worst);
  if (is_explained_elsewhere(problem(), skin_, worst, left)) {
    const double without = norm(ContactSearch(without_taxels(*system_, {worst}), limits_)
                                    .left(readings, most, search.widest()));
    const double chance = taxel_gain(taken, problem().taxels);
    const double gain = SingleLiar::squares(left) - without * without;
    if (without <= std::sqrt(chi_squared_quantile(std::max(rows - taken, 1.0), false_alarms)) &&
        gain >= chance) {
      verdict.taxel = worst;
      verdict.doubts.push_back(DataDoubt::bad_taxel);
      return verdict;
    }
  }
  const auto pulls = [&] {
    if (norm(search.left_by(readings, tractions)) <= most) return true;
    // Contacts c and c' that explain g and -g would press twice and read next to nothing.
    if (size > most + 2.0 * norm(left)) return false;
    std::vector<double> turned(readings.begin(), readings.end());
    for (double& reading : turned) reading = -reading;
    return norm(search.left(turned, most, search.widest())) <= most;
  };
  verdict.doubts.push_back(pulls() ? DataDoubt::pulls : DataDoubt::misfit);
  return verdict;
}

}  // namespace tactile_net::lab
