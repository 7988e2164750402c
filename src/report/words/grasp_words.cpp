#include "tactile_net/report/words/grasp_words.hpp"

#include <ostream>
#include <utility>
#include <variant>

#include "report/words/grasp_parts.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/table.hpp"

namespace tactile_net::report {
namespace {

std::string fingertip_remark_in_words(const lab::SceneRemark& remark) { return in_words(remark); }
std::string fingertip_remark_in_words(const lab::Remark& remark) { return in_words(remark); }
std::string fingertip_remark_in_words(const CutOffNote& note) { return in_words(note); }
std::string fingertip_remark_in_words(const lab::remark::Doubtful& doubtful) {
  return "the reconstruction's verdict is " + std::string(name(doubtful.verdict));
}
std::string fingertip_remark_in_words(const lab::remark::TangentialUnseen&) {
  return "the tangential force is not measured: it is taken for zero";
}
std::string fingertip_remark_in_words(const lab::remark::SeveralContacts&) {
  return "several contacts lie apart on its pad: its forces are their sums, and its distance from "
         "the cone's edge is that of the one nearest to slipping";
}

}  // namespace

Cells contact_cells(const lab::GraspResult& grasp, const std::vector<FingerAction>& actions,
                    const std::vector<lab::FingerMargins>& margins) {
  Cells rows = {{"finger", "contact at", "force on object", "normal", "tangential",
                 "to cone's edge", "angle left", "verdict"}};
  const GraspNames names = names_of(grasp);
  const Numbers force = names.forces();
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const FingerAction& action = actions[i];
    rows.push_back({names.fingers[i], names.lengths()(action.point), force(action.force),
                    force(normal_of(action)), force(tangential_of(action))});
    for (std::string& cell : margin_cells(names, margins[i], is_idle(action), action.normal))
      rows.back().push_back(std::move(cell));
  }
  return rows;
}

Cells torque_cells(const lab::GraspResult& grasp, const std::vector<FingerAction>& actions,
                   const std::vector<lab::FingerMargins>& margins) {
  return torque_rows(names_of(grasp), actions, margins,
                     [](std::size_t, std::size_t) { return false; });
}

std::string load_in_words(const lab::GraspResult& grasp) {
  if (!grasp.hand.load) return "no load";
  const ExternalLoad& load = *grasp.hand.load;
  return "load " + names_of(grasp).forces()(load.force) + " at " +
         names_of(grasp).lengths()(load.point) + ", torque " +
         names_of(grasp).torques()(load.torque);
}

std::vector<std::string> sources_in_words(const lab::GraspResult& grasp) {
  std::vector<std::string> lines;
  for (const lab::Fingertip& tip : grasp.tips) {
    std::string line =
        tip.finger.name + ": " + source_in_words(tip.source, tip.file.string(), tip.frame) + ": ";
    if (tip.force)
      line += "normal " + names_of(grasp).forces()(normal_of(*tip.force)) + ", tangential " +
              names_of(grasp).forces()(tangential_of(*tip.force)) + ", ";
    line += "centre " + names_of(grasp).lengths()(Uncertain{tip.place.centre, tip.place.deviation});
    lines.push_back(line);
  }
  return lines;
}

std::vector<PadContacts> pad_contacts(const lab::GraspResult& grasp) {
  return pad_contacts_of(grasp);
}

std::vector<std::string> balance_in_words(const lab::GraspResult& grasp) {
  const MeasuredGrasp& measured = grasp.measured->grasp;
  const auto& [x, y, moment] = measured.unbalanced;
  const Numbers force = names_of(grasp).forces();
  std::vector<std::string> lines;
  if (!grasp.hand.load) {
    lines.push_back("they add up to (" + force(x) + ", " + force(y) + ") and the moment " +
                    names_of(grasp).torques()(moment) +
                    " about the palm's origin: they hold a load that is the opposite of this");
  } else {
    lines.push_back("not balanced: force (" + force(x) + ", " + force(y) + "), moment " +
                    names_of(grasp).torques()(moment) + " about the load's point; " +
                    percent(measured.unbalanced_share) + " of all forces");
    lines.push_back(
        chi_squared_in_words(measured.chi_squared, grasp.measured->balanced, 3, balanced_limit));
  }
  if (measured.squeeze)
    lines.push_back(
        "squeeze " + force(*measured.squeeze) +
        (measured.grasping_force ? ", grasping force " + force(*measured.grasping_force) : ""));
  return lines;
}

std::vector<std::string> hold_in_words(const lab::GraspResult& grasp) {
  const HoldOptions& options = grasp.hand.squeeze;
  const Numbers force = names_of(grasp).forces();
  std::vector<std::string> lines;
  if (options.grasping_force)
    lines.push_back("with the grasping force " + force(*options.grasping_force) +
                    ", which determines all forces; squeeze " + force(grasp.held->grasp.squeeze));
  else if (options.squeeze)
    lines.push_back("with the squeeze " + force(*options.squeeze) +
                    (grasp.tips.size() > 2 ? ", and of such forces those of the least torques"
                                           : ", which determines all forces"));
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
  return std::visit([](const auto& one) { return fingertip_remark_in_words(one); }, remark);
}

Sentences remarks_in_words(const lab::GraspResult& grasp) { return remarks_of_any(grasp); }

std::vector<std::string> failures_in_words(const lab::GraspResult& grasp) {
  std::vector<std::string> lines;
  const GraspNames names = names_of(grasp);
  for (const lab::GraspFailure& failure : grasp.failures) lines.push_back(in_words(names, failure));
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
  print_pad_contacts(out, pad_contacts(grasp));
  if (grasp.measured)
    section("what the measured forces mean:", grasp.measured->grasp.fingers,
            grasp.measured->margins, balance_in_words(grasp));
  if (grasp.held)
    section("what would hold the load:", grasp.held->grasp.fingers, grasp.held->margins,
            hold_in_words(grasp));
  print_remarks(out, "", remarks_in_words(grasp));
  for (const std::string& failure : failures_in_words(grasp)) out << "FAILS: " << failure << '\n';
}

}  // namespace tactile_net::report
