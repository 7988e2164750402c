#include "inverse/data/frame_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/significance.hpp"

namespace tactile_net {

struct FrameJudge::Frame : JudgedFrame {
  const ContactFit& fit;
  std::span<const double> tractions;
};

FrameJudge::FrameJudge(const JudgedProblem& judged)
    : p_(judged),
      readings_of_(judged.problem.taxels),
      liars_(judged.rows),
      to_rms_(judged.unit / std::sqrt(judged.rows)) {
  for (std::size_t row = 0; row < p_.problem.sites.size(); ++row)
    if (p_.problem.weights[row] > 0.0) readings_of_[p_.problem.sites[row].taxel] += 1.0;
}

DataVerdict FrameJudge::judge(const ContactFit& fit, std::span<const double> readings,
                              std::span<const double> tractions, KeptContacts* memory) const {
  check_size(readings, p_.problem.weights.size());
  check_tractions(tractions, p_.problem.components * p_.problem.grid.count());
  DataVerdict verdict{.noise_known = p_.limits.noise_rms.has_value()};
  if (verdict.noise_known) verdict.residual_limit = p_.most * to_rms_;
  const Frame frame{judged_frame(p_.problem, p_.unit, readings), fit, tractions};
  verdict.strain = strain(frame.rows, tractions);
  if (verdict.strain > 1.0) {  // in which unit the rest would be judged nobody knows
    verdict.doubts.push_back(DataDoubt::implausible);
    return verdict;
  }
  const double size = std::sqrt(sum_of_squares(frame.seen));
  verdict.noise_alone = size == 0.0 || (verdict.noise_known && size <= p_.most);
  if (size == 0.0) return verdict;
  if (!std::isfinite(size)) {  // of no noise that a number can say
    verdict.residual_rms = std::numeric_limits<double>::infinity();
    if (verdict.noise_known) verdict.doubts.push_back(DataDoubt::misfit);
    return verdict;
  }
  if (is_turned_round(frame, verdict))
    verdict.doubts.push_back(DataDoubt::pulls);
  else if (verdict.noise_known)
    explain(frame, memory, verdict);
  return verdict;
}

/// The largest reading, or the mean normal traction, over its limit.
/// @param rows  P W g: without offsets, where these are unknown
double FrameJudge::strain(std::span<const double> rows, std::span<const double> tractions) const {
  double largest = 0.0;
  if (p_.limits.largest_traction) {
    const auto places = static_cast<std::ptrdiff_t>(p_.problem.grid.count());
    const double sum = std::accumulate(tractions.begin(), tractions.begin() + places, 0.0);
    largest = std::abs(sum) / static_cast<double>(places) / *p_.limits.largest_traction;
  }
  for (std::size_t i = 0; i < p_.limits.largest_readings.size(); ++i)
    if (p_.problem.weights[i] > 0.0)
      largest = std::max(largest,
                         std::abs(rows[i]) / p_.problem.weights[i] / p_.limits.largest_readings[i]);
  return largest;
}

/// Whether the same readings with the other sign are those of a contact, and these are less so.
/// What the nearest contact leaves of them is then the verdict's residual.
bool FrameJudge::is_turned_round(const Frame& frame, DataVerdict& verdict) const {
  const auto normal = frame.tractions.first(p_.problem.grid.count());
  if (std::accumulate(normal.begin(), normal.end(), 0.0) >= 0.0) return false;
  const std::optional<BothSigns> signs = frame.fit.both_signs(frame, frame.tractions);
  if (!signs) return false;
  const auto& [as_read, turned] = *signs;
  verdict.residual_rms = as_read.norm * to_rms_;
  const double squares = as_read.norm * as_read.norm;
  const double turned_squares = turned.norm * turned.norm;
  if (!verdict.noise_known) {
    const double left = p_.rows - turned.fitted;
    return left >= 1.0 &&
           squares / p_.rows >
               turned_squares / left * variance_ratio_quantile(p_.rows, left, 0.1 * false_alarms);
  }
  constexpr double margin = 20.0;  // of log-likelihoods, doubled: noise alone differs by less
  return turned.norm <= p_.most &&
         squares - turned_squares + 2.0 * (as_read.fitted - turned.fitted) > margin;
}

void FrameJudge::explain(const Frame& frame, KeptContacts* memory, DataVerdict& verdict) const {
  const ContactFit& fit = frame.fit;
  if (memory != nullptr) {
    const std::optional<Unexplained> known = fit.recalled(frame, *memory);
    if (known && !liars_.may_be_in(known->residual)) {
      verdict.residual_rms = known->norm * to_rms_;
      return;
    }
  }
  const std::vector<double> pressing = p_.pressing(Friction::stated, frame.tractions);
  Unexplained left = fit.left_by(frame, pressing);
  if (!(left.norm <= p_.most) || liars_.may_be_in(left.residual))
    if (std::optional<Unexplained> settled = fit.settled_near(frame, pressing))
      left = *std::move(settled);
  if (memory != nullptr || !(left.norm <= p_.most)) {  // the memory keeps what the fit finds
    std::optional<Unexplained> best = fit.contact(frame, Friction::stated, p_.most);
    if (best && (memory != nullptr || !(left.norm <= best->norm))) left = *std::move(best);
  }
  if (left.norm <= p_.most) {
    const bool odd = is_odd(frame, left);
    if (memory != nullptr) fit.remember(left, *memory);
    verdict.residual_rms = left.norm * to_rms_;
    if (std::optional<ChannelConstants> hidden = fit.hidden_constants(frame, pressing)) {
      verdict.doubts.push_back(DataDoubt::offset);
      verdict.offset = std::move(hidden->values);
    } else if (odd) {
      verdict.taxel = liar_beside(frame, left);
      if (verdict.taxel) verdict.doubts.push_back(DataDoubt::bad_taxel);
    }
    return;
  }
  verdict.residual_rms = left.norm * to_rms_;
  if (!std::isfinite(left.norm)) {  // tractions that no number can say, and no contact found
    verdict.doubts.push_back(DataDoubt::misfit);
    return;
  }

  // By contacts that the limit does not hold, as where nobody states one.
  if (p_.is_friction_limited()) {
    std::optional<Unexplained> best = fit.contact(frame, Friction::likely, p_.most);
    if (best && best->norm <= p_.most) {
      if (is_odd(frame, *best)) verdict.taxel = liar_beside(frame, *best);
      verdict.doubts.push_back(verdict.taxel ? DataDoubt::bad_taxel : DataDoubt::friction_limit);
      return;
    }
    if (best && best->norm <= left.norm) left = *std::move(best);
  }
  find_cause(frame, left, verdict);
}

/// Of a frame that no contact explains: one taxel, one constant a channel, or either of them; else
/// the sign.
void FrameJudge::find_cause(const Frame& frame, const Unexplained& left,
                            DataVerdict& verdict) const {
  const std::optional<Liar> liar = liar_against(frame, left);
  double by_taxel = std::numeric_limits<double>::infinity();
  if (liar) {
    verdict.taxel = liar->taxel;
    by_taxel = liar->norm;
  }
  std::optional<ChannelConstants> constants = frame.fit.constants(frame);
  double by_constants = std::numeric_limits<double>::infinity();
  double far = 0.0;
  if (constants) {
    far = chi_squared_quantile(constants->count, false_alarms);
    if (explains(constants->norm, constants->count, far, left)) by_constants = constants->norm;
  }
  if (by_constants * by_constants + far < by_taxel * by_taxel) verdict.taxel.reset();
  if (verdict.taxel) verdict.doubts.push_back(DataDoubt::bad_taxel);
  if (by_constants * by_constants <= by_taxel * by_taxel + far && std::isfinite(by_constants)) {
    verdict.doubts.push_back(DataDoubt::offset);
    verdict.offset = std::move(constants->values);
  }
  if (!verdict.consistent()) return;
  const bool pulls = frame.fit.left_by(frame, frame.tractions).norm <= p_.most ||
                     frame.fit.explains_turned(frame, left);
  verdict.doubts.push_back(pulls ? DataDoubt::pulls : DataDoubt::misfit);
}

/// Whether `rest` is as small as noise, and smaller than `left` by more than chance.
bool FrameJudge::explains(double rest, double taken, double gain, const Unexplained& left) const {
  return rest <= p_.limit(taken) && left.norm * left.norm - rest * rest >= gain;
}

/// The first contact that is near enough may well leave more than the nearest one.
bool FrameJudge::is_odd(const Frame& frame, Unexplained& found) const {
  if (!liars_.may_be_in(found.residual)) return false;
  found = frame.fit.nearest(frame, std::move(found));
  return liars_.may_be_in(frame.fit.apart(found));
}

/// The taxel that lies in a frame that contacts explain.
std::optional<std::size_t> FrameJudge::liar_beside(const Frame& frame,
                                                   const Unexplained& found) const {
  const double least_chance =
      taxel_gain(1.0, p_.problem.taxels);  // of as few readings as there are
  std::vector<std::size_t> taxels;
  std::optional<Liar> liar;
  for (std::size_t step = 0; step < frame.fit.steps(); ++step) {
    const std::optional<Unexplained> all = frame.fit.all_left(frame, step, found);
    if (!all) return std::nullopt;
    const std::vector<double> apart = frame.fit.apart(*all);
    if (!liars_.may_be_in(apart) || !SingleLiar::may_gain(all->residual, least_chance, frame.seen))
      return std::nullopt;
    if (step == 0) taxels = suspects(apart, p_.problem.sites, p_.problem.taxels);
    liar = sought_liar(frame, taxels, [&](std::size_t taxel, double taken) {
      std::optional<Unexplained> rest = frame.fit.rest_left(frame, step, taxel, *all);
      const double chance = taxel_gain(taken, p_.problem.taxels);
      if (rest && !liars_.is_found(all->residual, rest->residual, chance, frame.seen)) rest.reset();
      return rest;
    });
    if (!liar) return std::nullopt;
  }
  return liar->taxel;
}

/// The taxel without which contacts explain a frame that none explains as a whole.
std::optional<FrameJudge::Liar> FrameJudge::liar_against(const Frame& frame,
                                                         const Unexplained& left) const {
  std::vector<std::size_t> taxels = frame.fit.worth_leaving_out(
      suspects(frame.fit.apart(left), p_.problem.sites, p_.problem.taxels), left);
  return sought_liar(frame, taxels, [&](std::size_t taxel, double taken) {
    std::optional<Unexplained> rest = frame.fit.least_rest(frame, taxel, p_.limit(taken));
    if (!explains(rest->norm, taken, taxel_gain(taken, p_.problem.taxels), left)) rest.reset();
    return rest;
  });
}

/// @param taxels   those that may lie, the likeliest first; afterwards those that are shown to
/// @param rest_of  of a taxel and its readings' number, what the best contact leaves of the rest;
///                 absent: it does not show that the taxel lies
std::optional<FrameJudge::Liar> FrameJudge::sought_liar(
    const Frame& frame, std::vector<std::size_t>& taxels,
    const std::function<std::optional<Unexplained>(std::size_t, double)>& rest_of) const {
  std::vector<Unexplained> rests;
  for (const std::size_t taxel : std::exchange(taxels, {})) {
    const double taken = readings_of_[taxel];
    if (taken == 0.0 || taken >= p_.rows) continue;
    std::optional<Unexplained> rest = rest_of(taxel, taken);
    if (!rest) continue;
    taxels.push_back(taxel);
    rests.push_back(*std::move(rest));
  }
  if (taxels.empty()) return std::nullopt;
  std::size_t worst = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < taxels.size() && taxels.size() > 1; ++i) {
    const double enough = p_.limit(readings_of_[taxels[i]]);
    const double like = frame.fit.likeness(frame, taxels[i], enough, rests[i]);
    if (like >= least) continue;
    least = like;
    worst = i;
  }
  return Liar{taxels[worst], rests[worst].norm};
}

}  // namespace tactile_net
