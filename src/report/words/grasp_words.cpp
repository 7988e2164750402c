#include "tactile_net/report/words/grasp_words.hpp"

#include <cmath>
#include <numbers>
#include <ostream>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/table.hpp"

namespace tactile_net::report {
namespace {

std::string pair(Vector2 v) { return "(" + brief(v.x) + ", " + brief(v.y) + ")"; }

/// The deviation where one is known.
std::string uncertain(const Uncertain& value) {
  return brief(value.value) + (value.deviation > 0.0 ? " +- " + brief(value.deviation) : "");
}

std::string degrees(double angle) { return brief(angle * 180.0 / std::numbers::pi) + " deg"; }

std::string percent(double share) {
  return std::isfinite(share) ? brief(100.0 * share) + " %" : "-";
}

}  // namespace

Cells contact_cells(const lab::GraspStudy& study, const std::vector<FingerAction>& actions,
                    const std::vector<lab::FingerMargins>& margins) {
  Cells rows = {{"finger", "contact at", "force on object", "normal", "tangential",
                 "to cone's edge", "angle left", "verdict"}};
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const FingerAction& action = actions[i];
    const auto& c = action.covariance;
    const auto& friction = margins[i].friction;
    rows.push_back({study.tips[i].finger.name, pair(action.point), pair(action.force),
                    uncertain({action.normal, c.deviation(ContactValue::normal)}),
                    uncertain({action.tangential, c.deviation(ContactValue::tangential)}),
                    friction ? uncertain(friction->distance) : "-",
                    friction ? degrees(friction->angle) : "-",
                    friction              ? name(friction->verdict)
                    : is_idle(action)     ? "idle"
                    : action.normal > 0.0 ? "pushes"
                                          : "pulls"});
  }
  return rows;
}

Cells torque_cells(const lab::GraspStudy& study, const std::vector<FingerAction>& actions,
                   const std::vector<lab::FingerMargins>& margins) {
  Cells rows = {{"finger", "joint", "torque", "left to limit", "used"}};
  for (std::size_t i = 0; i < actions.size(); ++i)
    for (std::size_t j = 0; j < actions[i].torques.size(); ++j) {
      const auto& limits = margins[i].torques;
      rows.push_back({j == 0 ? study.tips[i].finger.name : "", std::to_string(j + 1),
                      uncertain(actions[i].torques[j]),
                      limits.empty() ? "-" : brief(limits[j].left),
                      limits.empty() ? "-" : percent(limits[j].used)});
    }
  return rows;
}

std::string load_in_words(const lab::GraspStudy& study) {
  if (!study.hand.load) return "no load";
  const ExternalLoad& load = *study.hand.load;
  return "load " + pair(load.force) + " at " + pair(load.point) + ", torque " + brief(load.torque);
}

std::vector<std::string> sources_in_words(const lab::GraspStudy& study) {
  std::vector<std::string> lines;
  for (const lab::Fingertip& tip : study.tips) {
    std::string line = tip.finger.name + ": " + tip.words + ": ";
    if (tip.force) {
      const auto& c = tip.force->covariance;
      line += "normal " + uncertain({tip.force->normal, c.deviation(ContactValue::normal)}) +
              ", tangential " +
              uncertain({tip.force->tangential, c.deviation(ContactValue::tangential)}) + ", ";
    }
    line += "centre " + uncertain({tip.place.centre, tip.place.deviation});
    lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> balance_in_words(const lab::GraspStudy& study) {
  const MeasuredGrasp& measured = *study.measured;
  const auto& [x, y, moment] = measured.unbalanced;
  std::vector<std::string> lines;
  if (!study.hand.load) {
    lines.push_back("they add up to (" + uncertain(x) + ", " + uncertain(y) + ") and the moment " +
                    uncertain(moment) +
                    " about the palm's origin: a load that they hold is the opposite");
  } else {
    lines.push_back("not balanced: force (" + uncertain(x) + ", " + uncertain(y) + "), moment " +
                    uncertain(moment) + " about the load's point; " +
                    percent(measured.unbalanced_share) + " of all forces");
    if (study.balanced)
      lines.push_back(
          "chi squared " + brief(*measured.chi_squared) + " of 3 degrees of freedom: " +
          (*study.balanced ? "the deviations explain it" : "MORE THAN THE DEVIATIONS EXPLAIN") +
          " (99 % stay below " + brief(balanced_limit) + ")");
    else
      lines.emplace_back("without deviations of all forces, nothing tells whether that is much");
  }
  if (measured.squeeze)
    lines.push_back(
        "squeeze " + uncertain(*measured.squeeze) +
        (measured.grasping_force ? ", grasping force " + uncertain(*measured.grasping_force) : ""));
  return lines;
}

std::vector<std::string> hold_in_words(const lab::GraspStudy& study) {
  const HoldOptions& options = study.hand.squeeze;
  std::vector<std::string> lines;
  if (options.grasping_force)
    lines.push_back("with the grasping force " + brief(*options.grasping_force) +
                    ": nothing is left to choose; squeeze " + brief(study.held->squeeze));
  else if (options.squeeze)
    lines.push_back("with the squeeze " + brief(*options.squeeze) +
                    (study.tips.size() > 2 ? ", and of such forces those of the least torques"
                                           : ": nothing is left to choose"));
  else
    lines.push_back("by the least torques (least sum of squares); squeeze " +
                    brief(study.held->squeeze));
  if (study.hand.friction_used)
    lines.push_back("every force within " + percent(*study.hand.friction_used) +
                    " of its friction");
  if (study.thesis)
    lines.push_back("the thesis' four equations (6.23) give the same torques to " +
                    brief(study.thesis_difference) + "; condition number " +
                    brief(study.thesis->condition));
  else
    lines.push_back("condition number " + brief(study.held->condition));
  return lines;
}

void print_grasp(std::ostream& out, const lab::GraspStudy& study) {
  const auto section = [&](const std::string& title, const std::vector<FingerAction>& actions,
                           const std::vector<lab::FingerMargins>& margins,
                           const std::vector<std::string>& words) {
    out << '\n' << title << '\n';
    print_cells(out, contact_cells(study, actions, margins));
    out << '\n';
    print_cells(out, torque_cells(study, actions, margins));
    for (const std::string& line : words) out << "  " << line << '\n';
  };
  out << study.hand.file << (study.hand.title.empty() ? "" : ": " + study.hand.title) << "\n  "
      << study.tips.size() << (study.tips.size() == 1 ? " finger; " : " fingers; ")
      << load_in_words(study) << '\n';
  for (const std::string& line : sources_in_words(study)) out << "  " << line << '\n';
  if (study.measured)
    section("what the measured forces mean:", study.measured->fingers, study.measured_margins,
            balance_in_words(study));
  if (study.held)
    section("what would hold the load:", study.held->fingers, study.held_margins,
            hold_in_words(study));
  for (const std::string& warning : study.warnings) out << "warning: " << warning << '\n';
  for (const std::string& failure : study.failures) out << "FAILS: " << failure << '\n';
}

}  // namespace tactile_net::report
