#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "inverse/data_limits.hpp"
#include "lab/large_skin.hpp"
#include "tactile_net/skin/data_verdict.hpp"

namespace tactile_net::lab {
namespace {

/// Steps from nothing smooth as alpha does, and the more of them the less: one small alpha serves.
constexpr double search_smoothing = 1e-8;  // over the square of what even pressure reads
constexpr std::size_t most_search_steps = 500;

/// A contact that explains readings to noise, or the nearest that some steps lead to.
class ContactSearch {
 public:
  ContactSearch(std::shared_ptr<LargeSkinSystem> system, const DataLimits& limits)
      : system_(std::move(system)), unit_(*limits.noise_rms), alpha_(alpha_of(*system_)) {
    if (problem_of(*system_).components != 3) return;
    friction_ = limits.friction_limit.value_or(usual_friction);
    press_.friction_limit = widest_friction(limits.friction_limit);
  }

  /// Whether there is a limit that holds contacts within less friction than is likely.
  [[nodiscard]] bool is_limited() const { return friction_ != press_.friction_limit; }
  /// Squares of W (K f - g) over the noise, by reading; of any friction that is likely.
  [[nodiscard]] std::vector<double> left(std::span<const double> readings, double enough) const {
    return left(readings, enough, press_);
  }
  [[nodiscard]] std::vector<double> left_within_limit(std::span<const double> readings,
                                                      double enough) const {
    return left(readings, enough, {.friction_limit = friction_});
  }
  /// The same of tractions that are known.
  [[nodiscard]] std::vector<double> left_by(std::span<const double> readings,
                                            std::span<const double> tractions) const {
    return squares(weighted(problem_of(*system_), readings), weighted_product(*system_, tractions));
  }
  [[nodiscard]] std::vector<double> pressing(std::span<const double> tractions) const {
    return pressing_part(problem_of(*system_), friction_, tractions);
  }

 private:
  [[nodiscard]] std::vector<double> left(std::span<const double> readings, double enough,
                                         const Constraints& press) const {
    const SkinConeSolution found = LargeSkinCone(system_, alpha_, press)
                                       .solve(readings, most_search_steps, 1e-5, enough * unit_);
    const std::vector<double> given = weighted(problem_of(*system_), readings);
    if (found.status != FrameStatus::ok) return squares(given, {});
    return squares(given, weighted_product(*system_, found.tractions));
  }
  static double alpha_of(LargeSkinSystem& system) {
    const SkinProblem& problem = problem_of(system);
    std::vector<double> even(problem.components * problem.grid.count());
    std::fill_n(even.begin(), problem.grid.count(), 1.0);
    double largest = 0.0;
    for (const double reading : weighted_product(system, even))
      largest = std::max(largest, std::abs(reading));
    return largest > 0.0 ? search_smoothing * largest * largest : search_smoothing;
  }

  [[nodiscard]] std::vector<double> squares(const std::vector<double>& given,
                                            const std::vector<double>& found) const {
    std::vector<double> all(given.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = std::pow((given[i] - (found.empty() ? 0.0 : found[i])) / unit_, 2);
    return all;
  }

  std::shared_ptr<LargeSkinSystem> system_;
  double unit_;
  double alpha_;
  std::optional<double> friction_{};  // that is stated, or else usual; absent: nothing drags
  Constraints press_{};               // contacts of any friction that is likely
};

double norm(const std::vector<double>& squares) {
  double sum = 0.0;
  for (const double square : squares) sum += square;
  return std::sqrt(sum);
}

/// Whether readings away from a taxel are explained about as noise allows. A broken taxel bends the
/// contact beside it and nowhere else: where they are not, no contact without it explains the rest.
bool is_explained_elsewhere(const SkinProblem& problem, const SkinArray& skin, std::size_t taxel,
                            const std::vector<double>& squares) {
  constexpr std::size_t reach = 6;  // taxels
  constexpr double slack = 2.0;     // of a norm: a search ends early
  const auto apart = [](std::size_t a, std::size_t b) { return a > b ? a - b : b - a; };
  double sum = 0.0;
  double rows = 0.0;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const std::size_t other = problem.sites[i].taxel;
    if (problem.weights[i] == 0.0 || (apart(other / skin.columns, taxel / skin.columns) <= reach &&
                                      apart(other % skin.columns, taxel % skin.columns) <= reach))
      continue;
    sum += squares[i];
    rows += 1.0;
  }
  return rows == 0.0 || sum <= slack * slack * noise_square_limit(rows, false_alarms);
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
  const double most = std::sqrt(noise_square_limit(rows, false_alarms));
  verdict.residual_limit = most * rms;
  size /= *limits_.noise_rms;
  verdict.noise_alone = size <= most;
  const ContactSearch search(system_, limits_);
  std::vector<double> left = search.left_by(readings, search.pressing(tractions));
  if (!(norm(left) <= most)) {
    std::vector<double> best = search.left_within_limit(readings, most);
    if (!(norm(left) <= norm(best))) left = std::move(best);
  }
  verdict.residual_rms = norm(left) * rms;
  if (norm(left) <= most) return verdict;

  if (search.is_limited()) {  // as where nobody states a limit
    std::vector<double> best = search.left(readings, most);
    if (norm(best) <= most) {
      verdict.doubts.push_back(DataDoubt::friction_limit);
      return verdict;
    }
    if (norm(best) <= norm(left)) left = std::move(best);
  }

  std::vector<double> of_taxels(problem().taxels);
  for (std::size_t i = 0; i < left.size(); ++i) of_taxels[problem().sites[i].taxel] += left[i];
  const auto worst = static_cast<std::size_t>(std::max_element(of_taxels.begin(), of_taxels.end()) -
                                              of_taxels.begin());
  double taken = 0.0;
  for (const SkinSite& site : problem().sites) taken += site.taxel == worst ? 1.0 : 0.0;
  if (is_explained_elsewhere(problem(), skin_, worst, left)) {
    const double without =
        norm(ContactSearch(without_taxels(*system_, {worst}), limits_).left(readings, most));
    const double chance =
        noise_square_limit(taken, false_alarms / static_cast<double>(problem().taxels));
    const double gain = std::pow(norm(left), 2) - without * without;
    if (without <= std::sqrt(noise_square_limit(std::max(rows - taken, 1.0), false_alarms)) &&
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
    return norm(search.left(turned, most)) <= most;
  };
  verdict.doubts.push_back(pulls() ? DataDoubt::pulls : DataDoubt::misfit);
  return verdict;
}

}  // namespace tactile_net::lab
