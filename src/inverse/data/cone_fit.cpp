#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "inverse/cone/cone_search.hpp"
#include "inverse/cone/rest_of_rows.hpp"
#include "inverse/data/contact_fit.hpp"
#include "inverse/data/single_liar.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t most_steps = 1000;
constexpr double near_enough = 1e-5;
/// Over the square of the largest singular value, in the order in which they are tried.
constexpr std::array smoothings = {1e-4, 1e-6, 1e-8};

/// Of a contact's readings the first hundred steps, with most smoothing, explain most. Where they
/// leave this share no contact is near, and finding the nearest one would take a thousand times
/// three.
constexpr double far_share = 0.3;
constexpr std::size_t steps_to_far = 100;
/// Steps of a search on the tractions' own grid, each a fraction of one on a finer grid: from
/// tractions that are nearly a contact's, all that honest frames need.
constexpr std::size_t steps_near = 50;
/// A search ends where twice the steps, or a hundredth of the smoothing, have gained less than this
/// share of what is still missing: it would take ten times as many again.
constexpr double least_progress = 0.1;

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
  /// Numbers that tractions of any sign take with most smoothing.
  [[nodiscard]] double fitted() {
    const std::lock_guard lock(mutex_);
    (void)square();
    return fitted_;
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
    if (square_) return *square_;
    const TikhonovFamily family(*problem_);
    double largest = 0.0;
    for (const double gamma : family.singular_values()) largest = std::max(largest, gamma);
    square_ = largest * largest;
    if (*square_ > 0.0) fitted_ = family.degrees_of_freedom(smoothings[0] * *square_);
    return *square_;
  }

  std::shared_ptr<const LinearProblem> problem_;
  Constraints press_;
  std::optional<double> square_{};  // smoothings are shares of it
  double fitted_ = 0.0;
  std::array<std::optional<ConeSearch>, smoothings.size()> cones_{};
  std::mutex mutex_{};
};

class ConeFit final : public ContactFit {
 public:
  ConeFit(const JudgedProblem& judged,
          std::function<std::shared_ptr<const LinearProblem>()> contacts)
      : ContactFit(judged), make_contacts_(std::move(contacts)), liars_(judged.rows) {}

  std::optional<Unexplained> settled_near(const JudgedFrame& frame,
                                          std::span<const double> pressing) const override;
  std::optional<Unexplained> contact(const JudgedFrame& frame, Friction friction,
                                     double enough) const override;
  std::size_t steps() const noexcept override { return 2; }
  std::optional<Unexplained> all_left(const JudgedFrame& frame, std::size_t step,
                                      const Unexplained& found) const override;
  std::optional<Unexplained> rest_left(const JudgedFrame& frame, std::size_t step,
                                       std::size_t taxel, const Unexplained& all) const override;
  Unexplained least_rest(const JudgedFrame& frame, std::size_t taxel,
                         double enough) const override {
    return {.norm = least_left(frame, enough, taxel)};
  }
  /// Of a search that ended early, by one smoothing and to the end: of two taxels without which
  /// there is enough, its norm says where each search happened to end.
  double likeness(const JudgedFrame& frame, std::size_t taxel, double,
                  const Unexplained& rest) const override {
    constexpr std::size_t smoothing = 1;
    if (!rest.residual.empty() || !contacts().are_read()) return rest.norm;
    const auto left = rest_left(frame, smoothing, taxel, {.friction = Friction::likely});
    return left ? left->norm : std::numeric_limits<double>::infinity();
  }
  std::optional<BothSigns> both_signs(const JudgedFrame& frame,
                                      std::span<const double> tractions) const override;
  bool explains_turned(const JudgedFrame& frame, const Unexplained&) const override {
    return least_left(TurnedFrame(frame), p.most, {}) <= p.most;
  }

 private:
  /// What contacts are sought with.
  [[nodiscard]] Cones& contacts() const {
    const std::lock_guard lock(mutex_);
    if (!made_) {
      std::shared_ptr<const LinearProblem> sought = make_contacts_();
      check_contacts(p.problem, *sought);
      made_ = cones_of(std::move(sought));
    }
    return *made_;
  }
  /// The same on the grid of the tractions that are judged. Null: it saves too little to be worth
  /// factors of its own.
  [[nodiscard]] Cones* own() const {
    Cones& sought = contacts();
    if (&sought.problem() == &p.problem) return &sought;
    if (2 * p.problem.grid.count() > sought.problem().grid.count()) return nullptr;
    const std::lock_guard lock(mutex_);
    if (!own_) own_ = cones_of({std::shared_ptr<void>(), &p.problem});  // kept by the judge
    return own_.get();
  }
  [[nodiscard]] std::unique_ptr<Cones> cones_of(
      std::shared_ptr<const LinearProblem> problem) const {
    return std::make_unique<Cones>(std::move(problem),
                                   Constraints{.friction_limit = p.limit_of(Friction::likely)});
  }
  [[nodiscard]] ConeSearch cone(Cones& of, std::size_t smoothing, Friction friction) const {
    const ConeSearch& all = of.cone(smoothing);
    const std::optional<double> limit = p.limit_of(friction);
    return limit ? all.with_friction(*limit) : all;
  }
  /// Whether a contact that leaves this ends every search: noise explains the frame, and no
  /// reading is odd. Tractions on the way obey the cones as those at the end do, so one that leaves
  /// this is a contact as good as any: more steps would change what is left, and no doubt.
  [[nodiscard]] bool settles(const Unexplained& left) const {
    return p.limits.noise_rms && left.norm <= p.most && !liars_.may_be_in(left.residual);
  }
  [[nodiscard]] Unexplained left_by_contact(const JudgedFrame& frame, Friction friction,
                                            std::span<const double> tractions) const {
    Unexplained left = left_by_tractions(contacts().problem(), p.unit, frame, tractions);
    left.friction = friction;
    return left;
  }
  [[nodiscard]] RestOfRows rest_of(std::span<const std::size_t> taxels) const {
    return {{p.problem.weights, p.problem.sites, p.problem.unknown_offsets}, taxels};
  }
  [[nodiscard]] double least_left(const JudgedFrame& frame, double enough,
                                  std::optional<std::size_t> taxel) const;

  std::function<std::shared_ptr<const LinearProblem>()> make_contacts_;
  mutable std::mutex mutex_{};
  mutable std::unique_ptr<Cones> made_{}, own_{};
  SingleLiar liars_;
};

std::optional<Unexplained> ConeFit::settled_near(const JudgedFrame& frame,
                                                 std::span<const double> pressing) const {
  Cones* const on = own();
  if (on == nullptr || !on->are_read()) return std::nullopt;
  Unexplained left;
  bool settled = false;
  const auto look = [&](std::span<const double> tractions, std::size_t) {
    left = left_by(frame, tractions);
    settled = settles(left);
    return settled;
  };
  const ConeSolution found =
      cone(*on, 0, Friction::stated).solve(frame.readings, steps_near, near_enough, look, pressing);
  if (!settled && found.status == FrameStatus::ok) (void)look(found.tractions, found.iterations);
  if (!settled) return std::nullopt;
  return left;
}

std::optional<Unexplained> ConeFit::contact(const JudgedFrame& frame, Friction friction,
                                            double enough) const {
  const Unexplained nothing = nothing_explained(frame, friction);
  if (!contacts().are_read()) return nothing;
  const double all = nothing.norm;
  std::optional<Unexplained> best;
  for (std::size_t i = 0; i < smoothings.size(); ++i) {
    bool asked = i != 0;  // whether a contact is near
    bool ended = false;
    Unexplained left;
    const auto look = [&](std::span<const double> tractions, std::size_t steps) {
      left = left_by_contact(frame, friction, tractions);
      ended = settles(left);
      if (steps < steps_to_far || std::exchange(asked, true)) return ended;
      ended = ended || is_far_from_contacts(left.norm, all, enough);
      return ended;
    };
    ConeSolution found =
        cone(contacts(), i, friction).solve(frame.readings, most_steps, near_enough, look);
    if (found.status != FrameStatus::ok) continue;
    if (!asked && !ended) (void)look(found.tractions, steps_to_far);  // they came before
    if (ended) return left;
    left = left_by_contact(frame, friction, found.tractions);
    left.tractions = std::move(found.tractions);
    left.step = i;
    if (!best || left.norm < best->norm) best = std::move(left);
    if (best->norm <= enough) break;
  }
  return best;
}

std::optional<Unexplained> ConeFit::all_left(const JudgedFrame& frame, std::size_t step,
                                             const Unexplained& found) const {
  if (found.step == step) return found;
  if (!contacts().are_read()) return std::nullopt;
  Unexplained left;
  bool settled = false;
  const auto look = [&](std::span<const double> tractions, std::size_t) {
    left = left_by_contact(frame, found.friction, tractions);
    settled = settles(left);
    return settled;
  };
  ConeSolution nearest = cone(contacts(), step, found.friction)
                             .solve(frame.readings, most_steps, near_enough,
                                    p.limits.noise_rms ? look : ConeSearch::EarlyStop{});
  if (nearest.status != FrameStatus::ok) return std::nullopt;
  if (settled) return left;
  left = left_by_contact(frame, found.friction, nearest.tractions);
  left.tractions = std::move(nearest.tractions);
  return left;
}

/// From the nearest contact of all readings, from which that of the rest is not far.
std::optional<Unexplained> ConeFit::rest_left(const JudgedFrame& frame, std::size_t step,
                                              std::size_t taxel, const Unexplained& all) const {
  const std::span<const std::size_t> only(&taxel, 1);
  const ConeSolution found = cone(contacts(), step, all.friction)
                                 .without(only)
                                 .solve(frame.readings, most_steps, near_enough, {}, all.tractions);
  if (found.status != FrameStatus::ok) return std::nullopt;
  Unexplained left = left_by_contact(frame, all.friction, found.tractions);
  const Eigen::VectorXd rest = rest_of(only)(as_eigen(left.residual));
  left.residual = {rest.begin(), rest.end()};
  left.norm = rest.norm();
  return left;
}

/// Of the rest without a taxel, and no further than there is hope of `enough`.
double ConeFit::least_left(const JudgedFrame& frame, double enough,
                           std::optional<std::size_t> taxel) const {
  Cones& of = contacts();
  const RestOfRows rest =
      rest_of(taxel ? std::span<const std::size_t>(&*taxel, 1) : std::span<const std::size_t>());
  const auto norm = [&](std::span<const double> tractions) {
    return rest(as_eigen(left_by_contact(frame, Friction::likely, tractions).residual)).norm();
  };
  const double all = rest(as_eigen(frame.seen)).norm();
  if (!of.are_read()) return all;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < smoothings.size(); ++i) {
    std::optional<double> before;
    const auto is_vain = [&](std::span<const double> tractions, std::size_t steps) {
      if (steps < steps_to_far) return false;
      const double now = norm(tractions);
      const bool vain = before ? now > enough && *before - now < least_progress * (now - enough)
                               : i == 0 && is_far_from_contacts(now, all, enough);
      before = now;
      return vain;
    };
    const ConeSearch& whole = of.cone(i);
    const ConeSolution found = (taxel ? whole.without(std::span(&*taxel, 1)) : whole)
                                   .solve(frame.readings, most_steps, near_enough, is_vain);
    if (found.status != FrameStatus::ok) continue;
    const double now = norm(found.tractions);
    const bool stuck = best - now < least_progress * (now - enough);
    best = std::min(best, now);
    if (best <= enough || stuck) break;
  }
  return best;
}

/// Where the noise is known, `explains_turned` tells in the end. Else a product shows first whether
/// the tractions found come nearer with the other sign: idle frames take no search.
std::optional<BothSigns> ConeFit::both_signs(const JudgedFrame& frame,
                                             std::span<const double> tractions) const {
  constexpr double hope = 0.5;  // of what the contact leaves, to be left with the sign turned round
  if (p.limits.noise_rms) return std::nullopt;
  const TurnedFrame turned(frame);
  const auto norm_left = [&](const JudgedFrame& of, std::span<const double> by) {
    return left_by(of, p.pressing(Friction::likely, by)).norm;
  };
  if (!(norm_left(turned, negated(tractions)) < hope * norm_left(frame, tractions)))
    return std::nullopt;
  const Unexplained any{.friction = Friction::likely};
  std::optional<Unexplained> one = all_left(frame, 0, any);
  std::optional<Unexplained> other = all_left(turned, 0, any);
  if (!one || !other) return std::nullopt;
  one->fitted = other->fitted = contacts().fitted();
  return BothSigns{.as_read = *std::move(one), .turned = *std::move(other)};
}

}  // namespace

std::unique_ptr<const ContactFit> cone_fit(
    const JudgedProblem& judged, std::function<std::shared_ptr<const LinearProblem>()> contacts) {
  return std::make_unique<const ConeFit>(judged, std::move(contacts));
}

}  // namespace tactile_net
