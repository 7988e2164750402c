#include "bench/alpha_contest.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/floors.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace bench {
namespace {

using namespace tactile_net;

constexpr std::size_t steps_between = 5;  // of the 200 alphas, where the best is sought first

/// What the noise is added to: the contact's readings without any, and the true tractions.
struct Case {
  InverseProblem problem{};
  std::vector<double> readings{}, truth{}, rms{};
};

Case case_of(const AlphaSetting& setting) {
  const Material pad{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
  const std::vector<Contact> contacts = {setting.contact};
  Case one;
  one.readings = exact_readings(setting.sensor, pad, contacts);
  const std::size_t count = setting.sensor.count;
  for (std::size_t c = 0; c < channel_count(setting.sensor); ++c) {
    double peak = 0.0;
    for (std::size_t i = 0; i < count; ++i)
      peak = std::max(peak, std::abs(one.readings[c * count + i]));
    one.rms.push_back(setting.noise * peak);
  }
  const TractionField field = sample(contacts, setting.sensor);
  one.truth = field.normal;
  if (setting.unknowns == 2)
    one.truth.insert(one.truth.end(), field.tangential.begin(), field.tangential.end());
  one.problem = make_problem(setting.sensor, pad,
                             {.unknowns = setting.unknowns,
                              .smoothing_length = setting.sensor.depths.front(),
                              .channel_rms = one.rms});
  return one;
}

void add(AlphaScore& score, double ratio, AlphaVerdict verdict) {
  score.ratios.push_back(ratio);
  if (verdict != AlphaVerdict::ok) return;
  ++score.ok;
  score.worst_ok = std::max(score.worst_ok, ratio);
}

}  // namespace

double AlphaScore::percentile(double p) const {
  return ratios[static_cast<std::size_t>(p * static_cast<double>(ratios.size() - 1))];
}

std::size_t AlphaScore::above(double limit) const {
  return static_cast<std::size_t>(ratios.end() -
                                  std::upper_bound(ratios.begin(), ratios.end(), limit));
}

std::vector<AlphaSetting> alpha_settings() {
  using enum Quantity;
  struct Reads {
    const char* name;
    std::vector<Quantity> quantities;
  };
  const std::vector<Reads> sets = {{"stress_x", {stress_x}},
                                   {"strain_x", {strain_x}},
                                   {"stress_x, shear_xy", {stress_x, shear_xy}},
                                   {"stress_x, stress_y", {stress_x, stress_y}}};
  std::vector<AlphaSetting> settings;
  for (const Reads& reads : sets)
    for (const double noise : {0.001, 0.01, 0.05}) {
      const std::size_t unknowns = reads.quantities.size();
      settings.push_back({.array = "dense, 61 taxels",
                          .reads = reads.name,
                          .noise = noise,
                          .sensor = {61, 0.5, {1.5}, reads.quantities},
                          .unknowns = unknowns,
                          .contact = {.center = 0.7,
                                      .half_width = 3.0,
                                      .force = 1.0,
                                      .friction = unknowns == 2 ? 0.3 : 0.0}});
    }
  return settings;
}

std::vector<AlphaScore> contest(const AlphaSetting& setting, std::size_t frames) {
  const Case one = case_of(setting);
  const TikhonovFamily family(one.problem);
  const std::size_t count = setting.sensor.count;
  std::vector<AlphaScore> scores;
  for (const AlphaRule rule : alpha_rules) scores.push_back({.rule = std::string(name(rule))});
  scores.push_back({.rule = "default, noise known"});
  scores.push_back({.rule = "default, not known"});
  std::optional<AlphaTables> tables;
  for (std::size_t k = 0; k < frames; ++k) {
    std::vector<double> readings = one.readings;
    for (std::size_t c = 0; c < one.rms.size(); ++c)
      add_noise(std::span(readings).subspan(c * count, count), one.rms[c], k, c);
    const FilterFrame frame = family.analyse(readings);
    if (!tables) tables.emplace(frame.gamma, frame.rows);
    const auto error = [&](double alpha) {
      return relative_l2_error(family.solve(frame, alpha), one.truth);
    };
    const AlphaSweep sweep = sweep_alpha(frame, *tables, 1.0);  // weighted: the noise is 1
    std::size_t near = 0;
    double best = error(sweep.alphas.front());
    const auto try_at = [&](std::size_t i) {
      const double here = error(sweep.alphas[i]);
      if (here >= best) return;
      best = here;
      near = i;
    };
    for (std::size_t i = steps_between; i < sweep.alphas.size(); i += steps_between) try_at(i);
    const std::size_t from = near < steps_between ? 0 : near - steps_between;
    const std::size_t to = std::min(near + steps_between, sweep.alphas.size() - 1);
    for (std::size_t i = from; i <= to; ++i) try_at(i);

    for (std::size_t r = 0; r < alpha_rules.size(); ++r) {
      const AlphaChoice& choice = sweep.choice(alpha_rules[r]);
      const double ratio = error(choice.alpha) / best;
      add(scores[r], ratio, choice.verdict);
      for (const bool known : {true, false})
        if (default_rule(*tables, known) == choice.rule)
          add(scores[alpha_rules.size() + (known ? 0 : 1)], ratio, choice.verdict);
    }
  }
  for (AlphaScore& score : scores) std::sort(score.ratios.begin(), score.ratios.end());
  return scores;
}

bool write_contest(std::size_t frames, bool page) {
  const std::vector<AlphaSetting> settings = alpha_settings();
  std::vector<std::vector<AlphaScore>> all;
  for (const AlphaSetting& setting : settings) {
    all.push_back(contest(setting, frames));
    if (page) continue;
    const AlphaScore& own = all.back()[alpha_rules.size()];
    progress(text("%s, %s, noise %g: default p95 %.3f, worst %.2f", setting.array.c_str(),
                  setting.reads.c_str(), setting.noise, own.percentile(0.95), own.ratios.back()));
  }
  if (page)
    std::printf(R"(# The rules for alpha, side by side

Written by `bench_alpha page %zu` (`bench/alpha_contest.cpp`). One Hertz contact on a half plane, its readings integrated exactly, %zu
frames of white noise in each setting. Every number is the error of the tractions with the rule's alpha over that with the best alpha
for that very frame. *Over 3*: frames more than three times as wrong. *ok*: frames with that verdict, and the largest ratio among
them: what nobody was told of. *Default*: `default_rule` (`inverse/alpha_tables.hpp`).

)",
                frames, frames);
  std::printf("| rule | over 3 of %zu | p95, best to worst setting | worst | ok | worst ok |\n",
              frames * settings.size());
  std::printf("|---|---|---|---|---|---|\n");
  std::vector<AlphaScore> pooled;
  for (std::size_t r = 0; r < all.front().size(); ++r) {
    AlphaScore sum{.rule = all.front()[r].rule};
    double low = INFINITY;
    double high = 0.0;
    for (const auto& scores : all) {
      const AlphaScore& one = scores[r];
      sum.ratios.insert(sum.ratios.end(), one.ratios.begin(), one.ratios.end());
      sum.ok += one.ok;
      sum.worst_ok = std::max(sum.worst_ok, one.worst_ok);
      low = std::min(low, one.percentile(0.95));
      high = std::max(high, one.percentile(0.95));
    }
    std::sort(sum.ratios.begin(), sum.ratios.end());
    std::printf("| %s | %zu | %.2f to %.4g | %.4g | %.0f %% | %.3g |\n", sum.rule.c_str(),
                sum.above(3.0), low, high, sum.ratios.back(),
                100.0 * static_cast<double>(sum.ok) / static_cast<double>(sum.ratios.size()),
                sum.worst_ok);
    pooled.push_back(std::move(sum));
  }
  std::printf("\n## The default, setting by setting\n\n| array | reads | noise | p95 | worst |\n");
  std::printf("|---|---|---|---|---|\n");
  for (std::size_t s = 0; s < settings.size(); ++s) {
    const AlphaScore& own = all[s][alpha_rules.size()];
    std::printf("| %s | %s | %g %% | %.2f | %.2f |\n", settings[s].array.c_str(),
                settings[s].reads.c_str(), 100.0 * settings[s].noise, own.percentile(0.95),
                own.ratios.back());
  }
  if (page) return true;
  Floors floors;
  for (std::size_t r = alpha_rules.size(); r < pooled.size(); ++r) {
    const AlphaScore& score = pooled[r];
    floors.at_most(score.rule + ": frames over 3 times the best",
                   static_cast<double>(score.above(3.0)), 0.0);
    floors.at_most(score.rule + ": p95", score.percentile(0.95), 1.2);
    floors.at_most(score.rule + ": worst", score.ratios.back(), 2.5);
  }
  return floors.all_hold();
}

}  // namespace bench
