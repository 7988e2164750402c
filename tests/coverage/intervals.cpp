#include "tests/coverage/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/sensing/traction_field.hpp"
#include "tests/coverage/ranks.hpp"

namespace tactile_net::coverage {
namespace {

constexpr double pressed_share = 0.02;  // of the largest pressure

/// What an answer knows.
struct Known {
  Distribution normal{};
  std::optional<Distribution> tangential{}, centre{};
  std::vector<Distribution> tractions{};
};

Distribution gaussian(const Uncertain& one) {
  return Distribution(
      std::vector<Distribution::Component>{{.mean = one.value, .scale = one.deviation}});
}

/// Answers frame after frame.
class Answers {
 public:
  explicit Answers(const Setting& setting) : problem_(scene_of(setting)) {
    if (!problem_.answers_by_mixture()) solver_ = lab::make_solver(problem_, Method::tikhonov);
  }

  [[nodiscard]] const Surface& surface() const { return problem_.of_mixture().surface(); }

  [[nodiscard]] Known known(std::span<const double> readings, bool tractions) const {
    const lab::SceneFrame frame(problem_, readings);
    if (!solver_) {
      const lab::ResultantDistributions found = lab::resultant_distributions(frame);
      return {
          .normal = found.normal,
          .tangential = found.tangential,
          .centre = found.centre,
          .tractions = tractions ? frame.mixture()->of_tractions() : std::vector<Distribution>()};
    }
    std::vector<double> f(solver_->tractions());
    const lab::FrameResult result = solver_->solve(readings, f);
    const UncertainResultant found = lab::uncertainty(frame, f, result).resultant;
    Known known{.normal = gaussian(found.normal)};
    if (found.tangential) known.tangential = gaussian(*found.tangential);
    if (found.centre) known.centre = gaussian(*found.centre);
    return known;
  }

 private:
  lab::SceneProblem problem_;
  std::unique_ptr<lab::FrameSolver> solver_{};
};

/// A truth lies within where as much of the distribution reaches up to it, and from it on.
void count(Holds& holds, const Distribution& known, double truth) {
  const double up_to = known.cdf(truth);
  const double below = truth == 0.0 ? known.cdf(-std::numeric_limits<double>::denorm_min()) : up_to;
  ++holds.count;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double left_out = 0.5 * (1.0 - levels[i]);
    holds.within[i] += up_to >= left_out && below <= 1.0 - left_out ? 1 : 0;
  }
}

/// The continuous ranked probability score is the mean of what quantiles cost (Gneiting and Ranjan
/// 2011).
double quantile_score(const Distribution& known, double truth) {
  constexpr int quantiles = 20;
  double sum = 0.0;
  for (int k = 0; k < quantiles; ++k) {
    const double p = (k + 0.5) / quantiles;
    const double off = truth - known.quantile(p);
    sum += 2.0 * off * (off >= 0.0 ? p : p - 1.0);
  }
  return sum / quantiles;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return at_share(values, 0.5);
}

}  // namespace

IntervalScore interval_score(const Setting& setting, const Contacts& contacts, bool values) {
  const Answers answers(setting);
  IntervalScore score{.frames = contacts.count()};
  std::vector<double> widths, errors;
  for (std::size_t i = 0; i < contacts.count(); ++i) {
    const Contacts::Frame made = contacts.frame(i, setting);
    const Known known = answers.known(made.readings, values);
    const double drag = made.friction * made.force;
    add_bytes(score.bytes, made.readings);
    add_bytes(score.bytes, std::array{made.force, drag, made.centre});
    count(score.force, known.normal, made.force);
    if (known.tangential) count(score.tangential, *known.tangential, drag);
    if (known.centre) count(score.centre, *known.centre, made.centre);
    const CentralInterval band = known.normal.interval();
    widths.push_back((band.high - band.low) / made.force);
    errors.push_back(std::abs(known.normal.mean() - made.force) / made.force);
    score.crps +=
        quantile_score(known.normal, made.force) / made.force / static_cast<double>(score.frames);
    if (known.tractions.empty()) continue;
    const TractionField field = sample(made.contacts, answers.surface());
    std::vector<double> truth = field.normal;
    truth.insert(truth.end(), field.tangential.begin(), field.tangential.end());
    const double least = pressed_share * *std::max_element(truth.begin(), truth.end());
    for (std::size_t j = 0; j < truth.size(); ++j) {
      if (std::abs(truth[j]) > least) count(score.pressed, known.tractions[j], truth[j]);
      if (truth[j] == 0.0) count(score.unpressed, known.tractions[j], truth[j]);
    }
  }
  score.width = median(std::move(widths));
  score.error = median(std::move(errors));
  return score;
}

}  // namespace tactile_net::coverage
