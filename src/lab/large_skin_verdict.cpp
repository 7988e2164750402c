#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "inverse/data/frame_judge.hpp"
#include "inverse/significance.hpp"
#include "lab/large_skin.hpp"

namespace tactile_net::lab {
namespace {

/// Steps from nothing smooth as alpha does, and the more of them the less: one small alpha serves.
constexpr double search_smoothing = 1e-8;  // over the square of what uniform pressure reads
/// Of the two steps to a taxel that lies, over that square, which is some five times the largest
/// singular value's.
constexpr std::array liar_smoothings = {2e-5, 2e-7};
constexpr std::size_t most_search_steps = 500;

/// A contact that explains readings to noise, or the nearest that some steps lead to, on the
/// tractions' own cells. Of one thread, as the system's buffers are.
class LargeSkinFit final : public ContactFit {
 public:
  /// @param system  the judged problem's, or without some taxels of it
  LargeSkinFit(const JudgedProblem& judged, std::shared_ptr<LargeSkinSystem> system,
               const SkinArray& skin)
      : ContactFit(judged), system_(std::move(system)), skin_(skin) {}

  Unexplained left_by(const JudgedFrame& frame, std::span<const double> tractions) const override;
  std::optional<Unexplained> contact(const JudgedFrame& frame, Friction friction,
                                     double enough) const override {
    return search(frame, friction, search_smoothing, enough);
  }
  std::size_t steps() const noexcept override { return liar_smoothings.size(); }
  std::optional<Unexplained> all_left(const JudgedFrame& frame, std::size_t step,
                                      const Unexplained& found) const override {
    return search(frame, found.friction, liar_smoothings[step], 0.0);
  }
  std::optional<Unexplained> rest_left(const JudgedFrame& frame, std::size_t step,
                                       std::size_t taxel, const Unexplained& all) const override {
    return search_without(taxel, frame, all.friction, liar_smoothings[step], 0.0);
  }
  std::vector<std::size_t> worth_leaving_out(std::vector<std::size_t> suspects,
                                             const Unexplained& left) const override;
  Unexplained least_rest(const JudgedFrame& frame, std::size_t taxel,
                         double enough) const override {
    return search_without(taxel, frame, Friction::likely, search_smoothing, enough);
  }
  double likeness(const JudgedFrame&, std::size_t, double, const Unexplained& rest) const override {
    return rest.norm;
  }
  /// Without the noise a search would have no end.
  std::optional<BothSigns> both_signs(const JudgedFrame&, std::span<const double>) const override {
    return std::nullopt;
  }
  bool explains_turned(const JudgedFrame& frame, const Unexplained& left) const override;

 private:
  [[nodiscard]] Unexplained search(const JudgedFrame& frame, Friction friction, double smoothing,
                                   double enough) const;
  [[nodiscard]] Unexplained search_without(std::size_t taxel, const JudgedFrame& frame,
                                           Friction friction, double smoothing,
                                           double enough) const;
  [[nodiscard]] const LinearProblem& problem() const { return problem_of(*system_); }
  [[nodiscard]] bool is_explained_elsewhere(std::size_t taxel, std::span<const double> left) const;

  /// Of what uniform pressure reads.
  [[nodiscard]] double square() const {
    if (square_) return *square_;
    std::vector<double> even(problem().components * problem().grid.count());
    std::fill_n(even.begin(), problem().grid.count(), 1.0);
    double largest = 0.0;
    for (const double reading : weighted_product(*system_, even))
      largest = std::max(largest, std::abs(reading));
    square_ = largest > 0.0 ? largest * largest : 1.0;
    return *square_;
  }

  std::shared_ptr<LargeSkinSystem> system_;
  const SkinArray& skin_;
  mutable std::optional<double> square_{};
};

Unexplained LargeSkinFit::left_by(const JudgedFrame& frame,
                                  std::span<const double> tractions) const {
  std::vector<double> rows = weighted_product(*system_, tractions);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = (frame.rows[i] - rows[i]) / p.unit;
  const double norm = std::sqrt(sum_of_squares(rows));
  return {.residual = std::move(rows), .norm = norm};
}

Unexplained LargeSkinFit::search(const JudgedFrame& frame, Friction friction, double smoothing,
                                 double enough) const {
  const Constraints press{.friction_limit = p.limit_of(friction)};
  const ConeSolution found = LargeSkinCone(system_, smoothing * square(), press)
                                 .solve(frame.readings, most_search_steps, 1e-5, enough * p.unit);
  if (found.status != FrameStatus::ok) return nothing_explained(frame, friction);
  Unexplained left = left_by(frame, found.tractions);
  left.friction = friction;
  return left;
}

Unexplained LargeSkinFit::search_without(std::size_t taxel, const JudgedFrame& frame,
                                         Friction friction, double smoothing, double enough) const {
  const LargeSkinFit rest(p, without_taxels(*system_, {taxel}), skin_);
  return rest.search(judged_frame(rest.problem(), p.unit, frame.readings), friction, smoothing,
                     enough);
}

/// The worst one alone, each search takes long: and that only where contacts can be explained
/// without it.
std::vector<std::size_t> LargeSkinFit::worth_leaving_out(std::vector<std::size_t> suspects,
                                                         const Unexplained& left) const {
  suspects.resize(std::min<std::size_t>(suspects.size(), 1));
  if (!suspects.empty() && !is_explained_elsewhere(suspects.front(), left.residual))
    suspects.clear();
  return suspects;
}

/// Contacts c and c' that explain g and -g would press twice and read next to nothing.
bool LargeSkinFit::explains_turned(const JudgedFrame& frame, const Unexplained& left) const {
  return std::sqrt(sum_of_squares(frame.seen)) <= p.most + 2.0 * left.norm &&
         search(TurnedFrame(frame), Friction::likely, search_smoothing, p.most).norm <= p.most;
}

/// Whether readings away from a taxel are explained about as noise allows. A broken taxel bends the
/// contact beside it and nowhere else: where they are not, no contact without it explains the rest.
bool LargeSkinFit::is_explained_elsewhere(std::size_t taxel, std::span<const double> left) const {
  constexpr std::size_t reach = 6;  // taxels
  constexpr double slack = 2.0;     // of a norm: a search ends early
  const auto apart = [](std::size_t a, std::size_t b) { return a > b ? a - b : b - a; };
  double sum = 0.0;
  double rows = 0.0;
  for (std::size_t i = 0; i < problem().sites.size(); ++i) {
    const std::size_t other = problem().sites[i].taxel;
    if (problem().weights[i] == 0.0 ||
        (apart(other / skin_.columns, taxel / skin_.columns) <= reach &&
         apart(other % skin_.columns, taxel % skin_.columns) <= reach))
      continue;
    sum += std::pow(left[i], 2);
    rows += 1.0;
  }
  return rows == 0.0 || sum <= slack * slack * chi_squared_quantile(rows, false_alarms);
}

}  // namespace

DataVerdict LargeSkin::judge(std::span<const double> readings, std::span<const double> tractions) {
  const JudgedProblem judged(problem(), limits_);
  return FrameJudge(judged).judge(LargeSkinFit(judged, system_, skin_), readings, tractions);
}

}  // namespace tactile_net::lab
