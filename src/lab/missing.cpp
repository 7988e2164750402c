#include "tactile_net/lab/missing.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lab/pattern_cache.hpp"
#include "numeric/named.hpp"

namespace tactile_net::lab {
namespace {

constexpr Named<Missing> policies[] = {
    {Missing::fail, "fail"}, {Missing::skip, "skip"}, {Missing::estimate, "estimate"}};

/// What a pattern takes, about: K, its decomposition, the method's matrix, a covariance.
std::size_t bytes_of_pattern(const SceneProblem& problem) {
  constexpr std::size_t matrices = 8;
  constexpr std::size_t numbers_of_rules = 1000;  // AlphaTables, per traction
  const std::size_t n = problem.tractions();
  return sizeof(double) * (matrices * (problem.readings() + n) + numbers_of_rules) * n;
}

}  // namespace

std::string_view name(Missing missing) noexcept { return name_in<policies>(missing); }

std::optional<Missing> missing_named(std::string_view text) noexcept {
  return named_in<policies>(text);
}

bool can_leave_out(const SceneProblem& problem, Method method) {
  return traits(method).has_bands && !problem.is_large();
}

struct IncompleteFrames::Pattern {
  Pattern(SceneProblem given, Method method)
      : problem(std::move(given)), solver(make_solver(problem, method)) {}

  SceneProblem problem;
  std::unique_ptr<FrameSolver> solver;
};

struct IncompleteFrames::Patterns : PatternCache<Pattern> {
  using PatternCache::PatternCache;
};

IncompleteFrames::IncompleteFrames(SceneProblem problem, Method method)
    : problem_(std::move(problem)),
      method_(method),
      patterns_(std::make_unique<Patterns>(bytes_of_pattern(problem_))) {
  if (!traits(method).has_bands)
    throw std::invalid_argument(
        "readings that are missing cannot be estimated by dft, which takes a dead taxel for a "
        "living one that reads 0: use tikhonov or closed_form");
}

IncompleteFrames::~IncompleteFrames() = default;

const SceneProblem& IncompleteFrames::problem() const noexcept {
  return last_ == nullptr ? problem_ : last_->problem;
}

std::size_t IncompleteFrames::kept() const noexcept { return patterns_->kept(); }
std::size_t IncompleteFrames::most_kept() const noexcept { return patterns_->most_kept(); }

std::optional<IncompleteFrames::Rest> IncompleteFrames::rest(std::span<double> readings) {
  const std::vector<Site>& sites = problem_.problem().sites;
  const std::vector<std::size_t> dead =
      dead_with_missing(problem_.scene().dead_taxels, sites, readings);
  LineProblemOptions options = problem_.options();
  options.dead_taxels = dead;
  if (!is_measured(problem_.scene().sensor, options)) return std::nullopt;
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (std::binary_search(dead.begin(), dead.end(), sites[i].taxel)) readings[i] = 0.0;
  Pattern& of_frame = (*patterns_)(
      dead, [&] { return std::make_unique<Pattern>(problem_.without(dead), method_); });
  last_ = &of_frame;
  return Rest{of_frame.problem, *of_frame.solver};
}

std::optional<FrameResult> IncompleteFrames::solve(std::span<double> readings,
                                                   std::span<double> tractions) {
  const std::optional<Rest> left = rest(readings);
  if (!left) return std::nullopt;
  return left->solver.solve(readings, tractions);
}

}  // namespace tactile_net::lab
