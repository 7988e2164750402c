// How circuits and loops follow contacts that move.
#include <algorithm>
#include <cmath>
#include <optional>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/unit_text.hpp"
#include "tactile_net/report/words/opamp_words.hpp"
#include "tactile_net/report/words/tradeoff_words.hpp"
#include "tactile_net/report/words/work_point_words.hpp"

namespace tactile_net::report {
namespace {

const study::MovingContacts* moving_contacts_of(const study::Study& study) {
  for (const study::StudySection& section : study.sections)
    if (section.moving) return &*section.moving;
  return nullptr;
}

/// Off the exact answer with parts of 1 %, median; absent: not drawn, or unstable.
std::optional<double> parts_error(const study::Study& study, Realization realization) {
  for (const study::StudySection& section : study.sections)
    for (const study::PartsFloor& floor : section.floors)
      if (floor.realization == realization && floor.relative == study::one_percent)
        return floor.median;
  return std::nullopt;
}

std::vector<study::Follower> loops_of(const study::MovingContacts& moving) {
  std::vector<study::Follower> loops;
  for (const study::Follower& one : moving.followers)
    if (!one.realization) loops.push_back(one);
  return loops;
}

std::string speed_or_dash(const std::optional<double>& speed, const study::Study& study) {
  return speed ? speed_in_words(*speed, study.input.units()) : "-";
}

}  // namespace

std::string in_words(const study::Follower& follower) {
  return follower.realization ? std::string(name(*follower.realization))
                              : "a loop of " + with_unit(follower.sampling_hertz, "Hz");
}

std::vector<std::vector<std::string>> moving_cells(const study::Study& study) {
  std::vector<std::vector<std::string>> rows = {{"follower", "behind", "1 % of the answer at"}};
  const study::MovingContacts* const moving = moving_contacts_of(study);
  if (moving == nullptr) return rows;
  const std::vector<study::Follower> loops = loops_of(*moving);
  for (const study::Follower& loop : loops)
    rows[0].push_back("nearer than " + in_words(loop) + " from");
  for (const study::Follower& one : moving->followers) {
    rows.push_back({in_words(one), duration(one.delay),
                    speed_or_dash(speed_at_error(*moving, one, study::one_percent), study)});
    const auto parts = one.realization ? parts_error(study, *one.realization) : std::nullopt;
    for (const study::Follower& loop : loops)
      rows.back().push_back(
          parts ? speed_or_dash(crossover_speed(*moving, one, *parts, loop), study) : "-");
  }
  return rows;
}

std::string moving_in_words(const study::Study& study) {
  const study::MovingContacts* const moving = moving_contacts_of(study);
  if (moving == nullptr) return {};
  const study::Follower* best = nullptr;
  double least = HUGE_VAL;
  for (const study::Follower& one : moving->followers) {
    if (!one.realization) continue;
    const double parts = parts_error(study, *one.realization).value_or(HUGE_VAL);
    if (best != nullptr && !(parts < least)) continue;
    best = &one;
    least = parts;
  }
  if (best == nullptr) return {};
  std::string text = "contacts that move: " + in_words(*best) + " with op-amps of 10 MHz is " +
                     duration(best->delay) + " behind, 1 % of the answer at " +
                     speed_or_dash(speed_at_error(*moving, *best, study::one_percent), study);
  for (const study::Follower& loop : loops_of(*moving)) {
    text += "; " + in_words(loop) + " errs as much at " +
            speed_or_dash(speed_at_error(*moving, loop, study::one_percent), study);
    if (!std::isfinite(least)) continue;
    if (const auto speed = crossover_speed(*moving, *best, least, loop))
      text += ", and more than the circuit of 1 % parts (" + percent(least) + ") from " +
              speed_or_dash(speed, study) + " on";
  }
  return text;
}

}  // namespace tactile_net::report
