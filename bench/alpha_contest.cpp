#include "bench/alpha_contest.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <utility>

#include "bench/floors.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace bench {
namespace {

using namespace tactile_net;

constexpr std::size_t steps_between = 5;  // of the 200 alphas, where the best is sought first

constexpr std::size_t contacts_of_coarse = 400;

/// What the noise is added to: a contact's readings without any, and its true tractions.
struct Case {
  std::vector<double> readings{}, truth{};
};

/// The largest reading of each channel.
std::vector<double> peaks(const std::vector<double>& readings, std::size_t channels) {
  const std::size_t count = readings.size() / channels;  // every taxel reads every quantity
  std::vector<double> all(channels);
  for (std::size_t i = 0; i < readings.size(); ++i)
    all[i / count] = std::max(all[i / count], std::abs(readings[i]));
  return all;
}

/// The contacts of a setting and its problem. Where there are many, each is as strong as makes its
/// largest reading 1, which the noise of every channel is a share of; of one, each channel's.
struct Cases {
  explicit Cases(const AlphaSetting& setting) {
    const Material pad{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
    const std::size_t channels = channel_count(setting.sensor);
    const SurfaceOptions options{.basis = setting.basis};
    for (RigidContact contact : setting.contacts) {
      if (setting.contacts.size() > 1) {
        const std::vector<double> of_one =
            peaks(exact_readings(setting.sensor, pad, std::vector<Contact>{contact}), channels);
        contact.force /= *std::max_element(of_one.begin(), of_one.end());
      }
      const std::vector<Contact> contacts = {contact};
      Case one{.readings = exact_readings(setting.sensor, pad, contacts)};
      const TractionField field = sample(contacts, surface_of(setting.sensor, options));
      one.truth = field.normal;
      if (setting.unknowns == 2)
        one.truth.insert(one.truth.end(), field.tangential.begin(), field.tangential.end());
      all.push_back(std::move(one));
    }
    rms =
        all.size() > 1 ? std::vector<double>(channels, 1.0) : peaks(all.front().readings, channels);
    for (double& one : rms) one *= setting.noise;
    problem = make_problem(setting.sensor, pad,
                           {.unknowns = setting.unknowns,
                            .smoothing_length = least_depth(setting.sensor),
                            .channel_rms = rms,
                            .surface = options});
  }
  std::vector<Case> all{};
  std::vector<double> rms{};  // of each channel
  LinearProblem problem{};
};

constexpr double depth = 1.5;  // of uneven taxels on average

SensorArray uneven(const std::vector<Quantity>& reads) {
  std::mt19937_64 random(11);
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * std::ldexp(static_cast<double>(random() >> 11U), -53);
  };
  std::vector<Taxel> taxels;
  double y = 0.0;
  for (int i = 0; i < 24; ++i) {
    taxels.push_back({.y = y, .depth = depth * uniform(0.7, 1.4), .reads = reads});
    y += depth * uniform(0.3, 2.0);
  }
  const double middle = 0.5 * taxels.back().y;
  for (Taxel& taxel : taxels) taxel.y -= middle;
  return uneven_array(std::move(taxels));
}

/// Hertz strips in the middle 60 % of an array, half widths 0.4 to 2 depths.
std::vector<RigidContact> random_contacts(const SensorArray& array, bool friction) {
  std::mt19937_64 random(5);
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * std::ldexp(static_cast<double>(random() >> 11U), -53);
  };
  std::vector<RigidContact> contacts;
  for (std::size_t i = 0; i < contacts_of_coarse; ++i) {
    RigidContact contact;
    contact.center = 0.6 * uniform(-1.0, 1.0) * position(array, array.count - 1);
    contact.half_width = uniform(0.4, 2.0) * depth;
    const double dragged = uniform(-0.6, 0.6);
    if (friction) contact.friction = dragged;
    contacts.push_back(contact);
  }
  return contacts;
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
  const auto add = [&](const char* array, SurfaceBasis basis, const auto& sensor_of) {
    for (const Reads& reads : sets)
      for (const double noise : {0.001, 0.01, 0.05}) {
        const std::size_t unknowns = reads.quantities.size();
        AlphaSetting setting{.array = array,
                             .reads = reads.name,
                             .noise = noise,
                             .sensor = sensor_of(reads.quantities),
                             .unknowns = unknowns,
                             .basis = basis,
                             .contacts = {}};
        if (setting.kind() != "dense")
          setting.contacts = random_contacts(setting.sensor, unknowns == 2);
        else
          setting.contacts = {{.center = 0.7,
                               .half_width = 3.0,
                               .force = 1.0,
                               .friction = unknowns == 2 ? 0.3 : 0.0}};
        settings.push_back(std::move(setting));
      }
  };
  const auto even = [](std::size_t count, double pitch) {
    return [=](const std::vector<Quantity>& reads) {
      return SensorArray{.count = count, .pitch = pitch, .depths = {depth}, .reads = reads};
    };
  };
  add("dense, 61 taxels", SurfaceBasis::taxels, even(61, 0.5));
  add("pitch = depth, 17 taxels", SurfaceBasis::hats, even(17, 1.5));
  add("pitch = 2 depths, 9 taxels", SurfaceBasis::hats, even(9, 3.0));
  add("uneven, 24 taxels", SurfaceBasis::hats, uneven);
  return settings;
}

std::vector<AlphaScore> contest(const AlphaSetting& setting, std::size_t frames) {
  const Cases cases(setting);
  const TikhonovFamily family(cases.problem);
  const std::size_t count = setting.sensor.count;
  std::vector<AlphaScore> scores;
  for (const AlphaRule rule : alpha_rules) scores.push_back({.rule = std::string(name(rule))});
  scores.push_back({.rule = "default, noise known"});
  scores.push_back({.rule = "default, not known"});
  std::optional<AlphaTables> tables;
  for (std::size_t k = 0; k < frames; ++k) {
    const Case& one = cases.all[k % cases.all.size()];
    std::vector<double> readings = one.readings;
    for (std::size_t c = 0; c < cases.rms.size(); ++c)
      add_noise(std::span(readings).subspan(c * count, count), cases.rms[c], k, c);
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

namespace {

/// The scores of the settings, rule by rule.
struct Pool {
  std::vector<AlphaScore> rules{};
  std::vector<std::pair<double, double>> p95{};  // of the best setting and of the worst
};

Pool pooled(const std::vector<std::vector<AlphaScore>>& settings) {
  Pool pool;
  for (std::size_t r = 0; r < settings.front().size(); ++r) {
    AlphaScore sum{.rule = settings.front()[r].rule};
    std::pair<double, double> p95{INFINITY, 0.0};
    for (const auto& scores : settings) {
      const AlphaScore& one = scores[r];
      sum.ratios.insert(sum.ratios.end(), one.ratios.begin(), one.ratios.end());
      sum.ok += one.ok;
      sum.worst_ok = std::max(sum.worst_ok, one.worst_ok);
      p95 = {std::min(p95.first, one.percentile(0.95)), std::max(p95.second, one.percentile(0.95))};
    }
    std::sort(sum.ratios.begin(), sum.ratios.end());
    pool.rules.push_back(std::move(sum));
    pool.p95.push_back(p95);
  }
  return pool;
}

void print(const Pool& pool) {
  std::printf("| rule | over 3 of %zu | p95, best to worst setting | worst | ok | worst ok |\n",
              pool.rules.front().ratios.size());
  std::printf("|---|---|---|---|---|---|\n");
  for (std::size_t r = 0; r < pool.rules.size(); ++r) {
    const AlphaScore& sum = pool.rules[r];
    std::printf("| %s | %zu | %.2f to %.4g | %.4g | %.0f %% | %.3g |\n", sum.rule.c_str(),
                sum.above(3.0), pool.p95[r].first, pool.p95[r].second, sum.ratios.back(),
                100.0 * static_cast<double>(sum.ok) / static_cast<double>(sum.ratios.size()),
                sum.worst_ok);
  }
}

constexpr const char* introduction = R"(# The rules for alpha, side by side

Written by `bench_alpha page %zu` (`bench/alpha_contest.cpp`), %zu frames of white noise in each setting, on a half plane. The dense array
has one Hertz contact; each coarse one, its tractions on a grid, 400 of them drawn at random, with half widths of 0.4 to 2 depths in
the middle 60 %% of the array. Readings are integrated exactly. Every number is the error of the tractions with the rule's alpha over that
with the best alpha for that very frame. *Over 3*: frames more than three times as wrong. *ok*: frames with that verdict, and the
largest ratio among them: what nobody was told of. *Default*: `default_rule` (`inverse/alpha_tables.hpp`).
)";

}  // namespace

bool write_contest(std::size_t frames, bool page, std::string_view kind) {
  std::vector<AlphaSetting> settings = alpha_settings();
  std::erase_if(settings, [&](const AlphaSetting& setting) {
    return !kind.empty() && setting.kind() != kind;
  });
  std::vector<std::vector<AlphaScore>> all;
  for (const AlphaSetting& setting : settings) {
    all.push_back(contest(setting, frames));
    if (page) continue;
    const AlphaScore& own = all.back()[alpha_rules.size()];
    progress(text("%s, %s, noise %g: default p95 %.3f, worst %.2f", setting.array.c_str(),
                  setting.reads.c_str(), setting.noise, own.percentile(0.95), own.ratios.back()));
  }
  std::vector<std::pair<std::string_view, Pool>> pools;
  if (page && kind.empty()) std::printf(introduction, frames, frames);
  for (const auto& [one, title] :
       {std::pair{"dense", "A dense array"}, std::pair{"coarse", "Coarse arrays"},
        std::pair{"uneven", "An uneven array"}}) {
    std::vector<std::vector<AlphaScore>> some;
    for (std::size_t s = 0; s < settings.size(); ++s)
      if (settings[s].kind() == one) some.push_back(all[s]);
    if (some.empty()) continue;
    pools.emplace_back(one, pooled(some));
    std::printf("\n## %s\n\n", title);
    print(pools.back().second);
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
  const auto hold = [&](const char* arrays, const AlphaScore& score) {
    const std::string what = std::string(arrays) + ", " + score.rule;
    floors.at_most(what + ": frames over 3 times the best", static_cast<double>(score.above(3.0)),
                   0.0);
    floors.at_most(what + ": p95", score.percentile(0.95), 1.2);
    floors.at_most(what + ": worst", score.ratios.back(), 2.5);
  };
  for (const auto& [arrays, pool] : pools)
    for (std::size_t r = alpha_rules.size(); r < pool.rules.size(); ++r)
      if (arrays == "dense" || r == alpha_rules.size())  // the others need the noise
        hold(arrays.data(), pool.rules[r]);
  return floors.all_hold();
}

}  // namespace bench
