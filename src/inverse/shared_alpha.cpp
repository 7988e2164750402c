#include "tactile_net/inverse/shared_alpha.hpp"

#include <algorithm>
#include <deque>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "inverse/alpha_search.hpp"

namespace tactile_net {
namespace {

/// A frame that stays where it is: its criteria refer to it. One whose components are nodes of a
/// quadrature has others than the frames before, at the same alphas.
struct Member {
  Member(FilterFrame given, const AlphaTables::Parts& tables, AlphaRule rule,
         std::optional<double> noise_rms)
      : frame(std::move(given)),
        own(own_tables(frame, tables)),
        criteria(frame, own ? *own : tables, noise_rms) {
    if (!criteria.silent()) values = criteria.values(rule);
    if (!own) return;
    own->lost.resize(0, 0);  // by far the most of it, and no more asked for
    own->weights.resize(0, 0);
  }
  Member(const Member&) = delete;
  Member& operator=(const Member&) = delete;
  ~Member() = default;

  static std::optional<AlphaTables::Parts> own_tables(const FilterFrame& frame,
                                                      const AlphaTables::Parts& tables) {
    const bool is_quadrature = !frame.shares.empty() && !tables.shares.empty();
    if (!is_quadrature || frame.rows != tables.rows || frame.gamma == tables.gamma)
      return std::nullopt;
    return AlphaTables::Parts(frame.gamma, frame.rows, frame.shares, &tables);
  }

  FilterFrame frame;
  std::optional<AlphaTables::Parts> own;
  Criteria criteria;
  std::vector<double> values{};  ///< none where nothing was read
};

}  // namespace

struct SharedAlpha::Window {
  AlphaTables tables;
  AlphaRule rule;
  std::size_t frames;
  std::optional<double> noise_rms;
  std::deque<Member> members{};
};

SharedAlpha::SharedAlpha(AlphaTables tables, AlphaRule rule, std::size_t frames,
                         std::optional<double> noise_rms) {
  require_noise(rule, noise_rms);
  if (noise_rms && !(*noise_rms >= 0.0)) throw std::invalid_argument("noise_rms must be >= 0");
  if (frames == 0) throw std::invalid_argument("an alpha is shared by at least one frame");
  window_ = std::make_unique<Window>(Window{std::move(tables), rule, frames, noise_rms});
}

SharedAlpha::~SharedAlpha() = default;
SharedAlpha::SharedAlpha(SharedAlpha&&) noexcept = default;
SharedAlpha& SharedAlpha::operator=(SharedAlpha&&) noexcept = default;

AlphaChoice SharedAlpha::push(FilterFrame frame) {
  Window& window = *window_;
  const AlphaTables::Parts& tables = window.tables.parts();
  const AlphaRule rule = window.rule;
  require_periodogram(rule, frame);
  window.members.emplace_back(std::move(frame), tables, rule, window.noise_rms);
  if (window.members.size() > window.frames) window.members.pop_front();

  std::vector<Member*> heard;
  for (Member& one : window.members)
    if (!one.criteria.silent()) heard.push_back(&one);
  FoundAlpha best = nothing_to_choose(tables);
  if (!heard.empty()) {
    std::vector<double> values(alpha_steps);
    for (const Member* one : heard)
      std::transform(values.begin(), values.end(), one->values.begin(), values.begin(),
                     std::plus<>());
    best = search(tables, rule, values, [&](double log_alpha) {
      double sum = 0.0;
      for (Member* one : heard) sum += one->criteria.zero(rule, log_alpha);
      return sum;
    });
  }
  return {rule, tables.alpha(best.log_alpha),
          judge(window.members.back().criteria, tables, rule, best, {})};
}

}  // namespace tactile_net
