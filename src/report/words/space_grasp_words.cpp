#include "tactile_net/report/words/space_grasp_words.hpp"

#include <cmath>
#include <ostream>
#include <utility>

#include "report/words/grasp_parts.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/table.hpp"

namespace tactile_net::report {
namespace {

Uncertain value_of(const SpaceAction& action, double value, std::size_t i) {
  return {value, action.deviation(i)};
}

/// "turn about the line through (...) along (...)"
std::string motion_in_words(const GraspNames& names, const ObjectMotion& motion, double size) {
  const Screw screw = screw_of(motion, size);
  const Numbers bare(false, "");
  if (std::isinf(screw.pitch)) return "slide along " + bare(screw.direction);
  std::string words = "turn about the line through " + names.lengths()(screw.point) + " along " +
                      bare(screw.direction);
  if (std::abs(screw.pitch) > 1e-6 * size)
    words += ", and slide along it by " + names.lengths()(screw.pitch) + " a radian";
  return words;
}

std::string torsion_in_words(const GraspNames& names, const SpaceAction& action) {
  return action.torsion_radius ? names.torques()(value_of(action, action.torsion, 3)) : "-";
}

}  // namespace

Cells contact_cells(const lab::SpaceGraspResult& grasp, const std::vector<SpaceAction>& actions,
                    const std::vector<lab::FingerMargins>& margins) {
  Cells rows = {{"finger", "contact at", "force on object", "normal", "along y", "along z",
                 "torsion", "to cone's edge", "angle left", "verdict"}};
  const GraspNames names = names_of(grasp);
  const Numbers force = names.forces();
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const SpaceAction& action = actions[i];
    rows.push_back(
        {names.fingers[i], names.lengths()(action.point), force(action.force),
         force(value_of(action, action.normal, 0)), force(value_of(action, action.tangential_y, 1)),
         force(value_of(action, action.tangential_z, 2)), torsion_in_words(names, action)});
    for (std::string& cell : margin_cells(names, margins[i], is_idle(action), action.normal))
      rows.back().push_back(std::move(cell));
  }
  return rows;
}

Cells torque_cells(const lab::SpaceGraspResult& grasp, const std::vector<SpaceAction>& actions,
                   const std::vector<lab::FingerMargins>& margins) {
  return torque_rows(names_of(grasp), actions, margins, [&](std::size_t i, std::size_t j) {
    const std::vector<SpaceJoint>& joints = grasp.tips[i].finger.joints;
    return j < joints.size() && joints[j].slides;
  });
}

std::string load_in_words(const lab::SpaceGraspResult& grasp) {
  if (!grasp.hand.load) return "no load";
  const SpaceLoad& load = *grasp.hand.load;
  const GraspNames names = names_of(grasp);
  std::string words = "load " + names.forces()(load.force) + " at " + names.lengths()(load.point);
  if (!(load.torque == Vector3{})) words += ", torque " + names.torques()(load.torque);
  return words;
}

std::vector<std::string> sources_in_words(const lab::SpaceGraspResult& grasp) {
  const GraspNames names = names_of(grasp);
  std::vector<std::string> lines;
  for (const lab::SpaceFingertip& tip : grasp.tips) {
    std::string line =
        tip.finger.name + ": " + source_in_words(tip.source, tip.file.string(), tip.frame) + ": ";
    const auto at = [&](double value, double variance) {
      return names.lengths()(Uncertain{value, std::sqrt(std::fmax(variance, 0.0))});
    };
    line += "centre " + at(tip.place.y, tip.place.covariance[0]) + ", " +
            at(tip.place.z, tip.place.covariance[3]);
    line += tip.place.torsion_radius
                ? "; soft, its torsion acts at " + names.lengths()(*tip.place.torsion_radius)
                : "; hard";
    lines.push_back(line);
  }
  return lines;
}

std::vector<PadContacts> pad_contacts(const lab::SpaceGraspResult& grasp) {
  return pad_contacts_of(grasp);
}

std::vector<std::string> balance_in_words(const lab::SpaceGraspResult& grasp) {
  const MeasuredSpaceGrasp& measured = grasp.measured->grasp;
  const GraspNames names = names_of(grasp);
  std::vector<std::string> words[2];
  for (std::size_t i = 0; i < 6; ++i)
    words[i / 3].push_back((i < 3 ? names.forces() : names.torques())(measured.unbalanced[i]));
  const std::string sums =
      "force (" + join(words[0], ", ") + "), moment (" + join(words[1], ", ") + ")";
  std::vector<std::string> lines;
  if (!grasp.hand.load) {
    lines.push_back("they add up to " + sums +
                    " about the hand's origin: they hold a load that is the opposite of this");
  } else {
    lines.push_back("not balanced: " + sums + " about the load's point; " +
                    percent(measured.unbalanced_share) + " of all forces");
    lines.push_back(chi_squared_in_words(measured.chi_squared, grasp.measured->balanced, 6,
                                         balanced_space_limit));
  }
  if (measured.squeeze) lines.push_back("squeeze " + names.forces()(*measured.squeeze));
  return lines;
}

std::vector<std::string> internal_in_words(const lab::SpaceGraspResult& grasp,
                                           const InternalForces& internal) {
  const GraspNames names = names_of(grasp);
  std::vector<std::string> lines = {
      std::to_string(internal.forces) + " contact forces: " + std::to_string(internal.rank) +
      " can carry a load, " + std::to_string(internal.count()) +
      (internal.count() == 1 ? " presses" : " press") + " the fingers against each other"};
  if (internal.without_torque && *internal.without_torque > 0)
    lines.push_back(
        "of these " + std::to_string(*internal.without_torque) +
        " cost no torque: the structure of the hand carries them, and torque sensors in the joints "
        "cannot see them");
  double size = 0.0;
  for (const lab::SpaceFingertip& tip : grasp.tips)
    size = std::max(size, length(tip.pad.origin - grasp.tips.front().pad.origin));
  for (const ObjectMotion& motion : internal.free)
    lines.push_back("no contact stops this motion of the object: to " +
                    motion_in_words(names, motion, size));
  double largest = internal.rest;
  for (const InternalForces::Pair& pair : internal.pairs)
    largest = std::max(largest, std::abs(pair.push));
  for (const InternalForces::Pair& pair : internal.pairs)
    if (std::abs(pair.push) > 1e-9 * largest)
      lines.push_back(names.fingers[pair.first] + " and " + names.fingers[pair.second] +
                      (pair.push < 0.0 ? " pull at" : " press against") + " each other with " +
                      names.forces()(std::abs(pair.push)));
  if (internal.rest > 1e-9 * largest && internal.rest > 0.0)
    lines.push_back("torsions against each other: " + names.forces()(internal.rest) +
                    " over their radii");
  return lines;
}

std::vector<std::string> hold_in_words(const lab::SpaceGraspResult& grasp) {
  const GraspNames names = names_of(grasp);
  const HeldSpaceGrasp& held = grasp.held->grasp;
  const std::string least = std::string("the least ") +
                            (grasp.hand.least == Least::torques ? "torques" : "contact forces") +
                            " (least sum of squares)";
  std::vector<std::string> lines = {
      grasp.hand.squeeze ? "with the squeeze " + names.forces()(*grasp.hand.squeeze) +
                               ", and of such forces " + least
                         : "by " + least + "; squeeze " + names.forces()(held.squeeze)};
  if (grasp.hand.friction_used)
    lines.push_back("every force within " + percent(*grasp.hand.friction_used) +
                    " of its friction");
  lines.push_back("equilibrium to " + brief(held.residual) + ", the conditions for a minimum to " +
                  brief(held.optimality) +
                  (held.iterations > 0
                       ? ", " + std::to_string(held.iterations) + " steps inside the cones"
                       : ""));
  return lines;
}

std::string proof_in_words(const lab::SpaceGraspResult& grasp) {
  if (!grasp.refusal) return {};
  const lab::SpaceRefusal& refusal = *grasp.refusal;
  const GraspNames names = names_of(grasp);
  if (refusal.least_squeeze)
    return "the load asks for a squeeze of at least " + names.forces()(*refusal.least_squeeze);
  if (!refusal.motion) return {};
  return "the object can " + motion_in_words(names, *refusal.motion, refusal.size) +
         ": the load drives that motion, and no force at the contacts can work against it";
}

Sentences remarks_in_words(const lab::SpaceGraspResult& grasp) {
  Sentences said = remarks_of_any(grasp);
  const GraspNames names = names_of(grasp);
  for (const lab::SpaceFingertip& tip : grasp.tips)
    if (tip.torsion_left_out)
      said.warnings.push_back("finger '" + tip.finger.name + "': its skin feels the torsion " +
                              names.torques()(tip.torsion_left_out->torsion) +
                              ", which a hard finger cannot give: soft = true includes it");
  return said;
}

std::vector<std::string> failures_in_words(const lab::SpaceGraspResult& grasp) {
  std::vector<std::string> lines;
  GraspNames names = names_of(grasp);
  names.balanced_limit = balanced_space_limit;
  for (const lab::GraspFailure& failure : grasp.failures) {
    lines.push_back(in_words(names, failure));
    if (failure.kind != lab::GraspFailure::Kind::cannot_hold) continue;
    if (const std::string proof = proof_in_words(grasp); !proof.empty())
      lines.back() += "; " + proof;
  }
  return lines;
}

void print_grasp(std::ostream& out, const lab::SpaceGraspResult& grasp) {
  const auto section = [&](const std::string& title, const auto& answer,
                           const std::vector<std::string>& words) {
    out << '\n' << title << '\n';
    print_cells(out, contact_cells(grasp, answer.grasp.fingers, answer.margins));
    const Cells torques = torque_cells(grasp, answer.grasp.fingers, answer.margins);
    if (torques.size() > 1) {
      out << '\n';
      print_cells(out, torques);
    }
    for (const std::string& line : words) out << "  " << line << '\n';
    for (const std::string& line : internal_in_words(grasp, answer.internal))
      out << "  " << line << '\n';
  };
  out << grasp.hand.file << (grasp.hand.title.empty() ? "" : ": " + grasp.hand.title) << "\n  "
      << grasp.tips.size() << (grasp.tips.size() == 1 ? " finger; " : " fingers; ")
      << load_in_words(grasp) << '\n';
  for (const std::string& line : sources_in_words(grasp)) out << "  " << line << '\n';
  print_pad_contacts(out, pad_contacts(grasp));
  if (grasp.measured)
    section("what the measured forces mean:", *grasp.measured, balance_in_words(grasp));
  if (grasp.held) section("what would hold the load:", *grasp.held, hold_in_words(grasp));
  print_remarks(out, "", remarks_in_words(grasp));
  for (const std::string& failure : failures_in_words(grasp)) out << "FAILS: " << failure << '\n';
}

}  // namespace tactile_net::report
