#include "tactile_net/report/words/grasp_words.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string_view>
#include <variant>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/unit_text.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/table.hpp"

namespace tactile_net::report {
namespace {

/// Numbers of one dimension: with its unit where the hand states SI, bare where it does not.
class Numbers {
 public:
  Numbers(const lab::GraspResult& grasp, std::string_view unit)
      : unit_(grasp.hand.si ? unit : "") {}

  [[nodiscard]] std::string operator()(double value) const {
    return unit_.empty() ? brief(value) : with_unit(value, unit_);
  }
  [[nodiscard]] std::string operator()(Vector2 v) const {
    const ScaledUnit scaled = scaled_unit(std::max(std::abs(v.x), std::abs(v.y)), unit_);
    return "(" + brief(scaled.factor * v.x) + ", " + brief(scaled.factor * v.y) + ")" +
           (unit_.empty() ? "" : " " + scaled.label);
  }
  /// The deviation where one is known.
  [[nodiscard]] std::string operator()(const Uncertain& value) const {
    if (!(value.deviation > 0.0)) return (*this)(value.value);
    return unit_.empty() ? brief(value.value) + " +- " + brief(value.deviation)
                         : with_unit(value.value, value.deviation, unit_);
  }

 private:
  std::string_view unit_;
};

Numbers lengths(const lab::GraspResult& grasp) { return {grasp, "m"}; }
Numbers forces(const lab::GraspResult& grasp) { return {grasp, "N"}; }
Numbers torques(const lab::GraspResult& grasp) { return {grasp, "N m"}; }

std::string degrees(double angle) { return brief(angle * 180.0 / std::numbers::pi) + " deg"; }

/// Where a finger's contact comes from.
std::string source_in_words(const lab::Fingertip& tip) {
  using Source = lab::Fingertip::Source;
  const std::string frame = ", frame " + std::to_string(tip.frame);
  switch (tip.source) {
    case Source::assumed:
      return "contact assumed";
    case Source::resultant:
      return "resultant given";
    case Source::tractions:
      return "tractions of " + tip.file.string() + frame;
    case Source::readings:
      return "readings of " + tip.file.string() + frame;
    case Source::simulated:
      return "contacts of " + tip.file.string();
  }
  return {};
}

std::string say(const lab::SceneRemark& remark) { return in_words(remark); }
std::string say(const lab::Remark& remark) { return in_words(remark); }
std::string say(const CutOffNote& note) { return in_words(note); }
std::string say(const lab::remark::Doubtful& doubtful) {
  return "the reconstruction's verdict is " + std::string(name(doubtful.verdict));
}
std::string say(const lab::remark::TangentialUnseen&) {
  return "the tangential force is not measured: it is taken for zero";
}

std::string answer_in_words(lab::GraspAnswer answer) {
  return answer == lab::GraspAnswer::measured ? "as measured: " : "to hold: ";
}

/// "to hold: finger 'left' ", of a remark or a failure.
std::string subject_of(const lab::GraspResult& grasp, const auto& what) {
  return answer_in_words(what.answer) + "finger '" + grasp.tips[what.finger].finger.name + "' ";
}

std::string in_words(const lab::GraspResult& grasp, const lab::GraspRemark& remark) {
  using Kind = lab::GraspRemark::Kind;
  const std::string finger = subject_of(grasp, remark);
  switch (remark.kind) {
    case Kind::idle:
      return finger + "is not needed: it carries nothing";
    case Kind::near_slipping:
      return finger + "is less than two standard deviations from slipping";
  }
  return {};
}

std::string in_words(const lab::GraspResult& grasp, const lab::GraspFailure& failure) {
  using Kind = lab::GraspFailure::Kind;
  const std::string answer = answer_in_words(failure.answer);
  const std::string finger = subject_of(grasp, failure);
  switch (failure.kind) {
    case Kind::pulls:
      return finger + "would have to pull with " + forces(grasp)(failure.number);
    case Kind::slips:
      return finger + "slips: its force is " + forces(grasp)(failure.number) +
             " outside the friction cone";
    case Kind::beyond_limit:
      return finger + "exceeds the torque limit of joint " + std::to_string(failure.joint + 1) +
             " by " + torques(grasp)(failure.number);
    case Kind::unbalanced:
      return answer + "the forces do not carry the load: chi squared " + brief(failure.number) +
             ", beyond the " + brief(balanced_limit) + " that 99 % of balanced grasps stay below";
    case Kind::cannot_hold:
      return answer + rule(failure.reason);
    case Kind::disagreement:
      return answer + "the thesis' equations give other torques, by " + brief(failure.number);
  }
  return {};
}

}  // namespace

Cells contact_cells(const lab::GraspResult& grasp, const std::vector<FingerAction>& actions,
                    const std::vector<lab::FingerMargins>& margins) {
  Cells rows = {{"finger", "contact at", "force on object", "normal", "tangential",
                 "to cone's edge", "angle left", "verdict"}};
  const Numbers force = forces(grasp);
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const FingerAction& action = actions[i];
    const auto& friction = margins[i].friction;
    rows.push_back({grasp.tips[i].finger.name, lengths(grasp)(action.point), force(action.force),
                    force(normal_of(action)), force(tangential_of(action)),
                    friction ? force(friction->distance) : "-",
                    friction ? degrees(friction->angle) : "-",
                    friction              ? name(friction->verdict)
                    : is_idle(action)     ? "idle"
                    : action.normal > 0.0 ? "pushes"
                                          : "pulls"});
  }
  return rows;
}

Cells torque_cells(const lab::GraspResult& grasp, const std::vector<FingerAction>& actions,
                   const std::vector<lab::FingerMargins>& margins) {
  Cells rows = {{"finger", "joint", "torque", "left to limit", "used"}};
  for (std::size_t i = 0; i < actions.size(); ++i)
    for (std::size_t j = 0; j < actions[i].torques.size(); ++j) {
      const auto& limits = margins[i].torques;
      rows.push_back({j == 0 ? grasp.tips[i].finger.name : "", std::to_string(j + 1),
                      torques(grasp)(actions[i].torques[j]),
                      limits.empty() ? "-" : torques(grasp)(limits[j].left),
                      limits.empty() ? "-" : percent(limits[j].used)});
    }
  return rows;
}

std::string load_in_words(const lab::GraspResult& grasp) {
  if (!grasp.hand.load) return "no load";
  const ExternalLoad& load = *grasp.hand.load;
  return "load " + forces(grasp)(load.force) + " at " + lengths(grasp)(load.point) + ", torque " +
         torques(grasp)(load.torque);
}

std::vector<std::string> sources_in_words(const lab::GraspResult& grasp) {
  std::vector<std::string> lines;
  for (const lab::Fingertip& tip : grasp.tips) {
    std::string line = tip.finger.name + ": " + source_in_words(tip) + ": ";
    if (tip.force)
      line += "normal " + forces(grasp)(normal_of(*tip.force)) + ", tangential " +
              forces(grasp)(tangential_of(*tip.force)) + ", ";
    line += "centre " + lengths(grasp)(Uncertain{tip.place.centre, tip.place.deviation});
    lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> balance_in_words(const lab::GraspResult& grasp) {
  const MeasuredGrasp& measured = grasp.measured->grasp;
  const auto& [x, y, moment] = measured.unbalanced;
  const Numbers force = forces(grasp);
  std::vector<std::string> lines;
  if (!grasp.hand.load) {
    lines.push_back("they add up to (" + force(x) + ", " + force(y) + ") and the moment " +
                    torques(grasp)(moment) +
                    " about the palm's origin: a load that they hold is the opposite");
  } else {
    lines.push_back("not balanced: force (" + force(x) + ", " + force(y) + "), moment " +
                    torques(grasp)(moment) + " about the load's point; " +
                    percent(measured.unbalanced_share) + " of all forces");
    if (grasp.measured->balanced)
      lines.push_back("chi squared " + brief(*measured.chi_squared) + " of 3 degrees of freedom: " +
                      (*grasp.measured->balanced ? "the deviations explain it"
                                                 : "MORE THAN THE DEVIATIONS EXPLAIN") +
                      " (99 % stay below " + brief(balanced_limit) + ")");
    else
      lines.emplace_back("without deviations of all forces, nothing tells whether that is much");
  }
  if (measured.squeeze)
    lines.push_back(
        "squeeze " + force(*measured.squeeze) +
        (measured.grasping_force ? ", grasping force " + force(*measured.grasping_force) : ""));
  return lines;
}

std::vector<std::string> hold_in_words(const lab::GraspResult& grasp) {
  const HoldOptions& options = grasp.hand.squeeze;
  const Numbers force = forces(grasp);
  std::vector<std::string> lines;
  if (options.grasping_force)
    lines.push_back("with the grasping force " + force(*options.grasping_force) +
                    ": nothing is left to choose; squeeze " + force(grasp.held->grasp.squeeze));
  else if (options.squeeze)
    lines.push_back("with the squeeze " + force(*options.squeeze) +
                    (grasp.tips.size() > 2 ? ", and of such forces those of the least torques"
                                           : ": nothing is left to choose"));
  else
    lines.push_back("by the least torques (least sum of squares); squeeze " +
                    force(grasp.held->grasp.squeeze));
  if (grasp.hand.friction_used)
    lines.push_back("every force within " + percent(*grasp.hand.friction_used) +
                    " of its friction");
  if (const auto& thesis = grasp.held->thesis)
    lines.push_back("the thesis' four equations (6.23) give the same torques to " +
                    brief(thesis->difference) + "; condition number " +
                    brief(thesis->torques.condition));
  else
    lines.push_back("condition number " + brief(grasp.held->grasp.condition));
  return lines;
}

std::string in_words(const lab::FingertipRemark& remark) {
  return std::visit([](const auto& one) { return say(one); }, remark);
}

std::vector<std::string> warnings_in_words(const lab::GraspResult& grasp) {
  std::vector<std::string> lines;
  for (const lab::Fingertip& tip : grasp.tips)
    for (const lab::FingertipRemark& remark : tip.remarks)
      lines.push_back("finger '" + tip.finger.name + "': " + in_words(remark));
  for (const lab::GraspRemark& remark : grasp.remarks) lines.push_back(in_words(grasp, remark));
  return lines;
}

std::vector<std::string> failures_in_words(const lab::GraspResult& grasp) {
  std::vector<std::string> lines;
  for (const lab::GraspFailure& failure : grasp.failures) lines.push_back(in_words(grasp, failure));
  return lines;
}

void print_grasp(std::ostream& out, const lab::GraspResult& grasp) {
  const auto section = [&](const std::string& title, const std::vector<FingerAction>& actions,
                           const std::vector<lab::FingerMargins>& margins,
                           const std::vector<std::string>& words) {
    out << '\n' << title << '\n';
    print_cells(out, contact_cells(grasp, actions, margins));
    out << '\n';
    print_cells(out, torque_cells(grasp, actions, margins));
    for (const std::string& line : words) out << "  " << line << '\n';
  };
  out << grasp.hand.file << (grasp.hand.title.empty() ? "" : ": " + grasp.hand.title) << "\n  "
      << grasp.tips.size() << (grasp.tips.size() == 1 ? " finger; " : " fingers; ")
      << load_in_words(grasp) << '\n';
  for (const std::string& line : sources_in_words(grasp)) out << "  " << line << '\n';
  if (grasp.measured)
    section("what the measured forces mean:", grasp.measured->grasp.fingers,
            grasp.measured->margins, balance_in_words(grasp));
  if (grasp.held)
    section("what would hold the load:", grasp.held->grasp.fingers, grasp.held->margins,
            hold_in_words(grasp));
  for (const std::string& warning : warnings_in_words(grasp)) out << "warning: " << warning << '\n';
  for (const std::string& failure : failures_in_words(grasp)) out << "FAILS: " << failure << '\n';
}

}  // namespace tactile_net::report
