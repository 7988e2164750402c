/// @file
/// What a grasp of the plane and one in space say alike. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tactile_net/grasp/space/vector3.hpp"
#include "tactile_net/grasp/vector2.hpp"
#include "tactile_net/lab/grasp.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/answers.hpp"
#include "tactile_net/report/words/contact_words.hpp"
#include "tactile_net/report/words/grasp_words.hpp"
#include "tactile_net/report/words/table.hpp"

namespace tactile_net::report {

/// Numbers of one dimension: with its unit where the hand states SI, bare where it does not.
class Numbers {
 public:
  Numbers(bool si, std::string_view unit) : unit_(si ? unit : "") {}

  [[nodiscard]] std::string operator()(double value) const;
  [[nodiscard]] std::string operator()(Vector2 v) const;
  [[nodiscard]] std::string operator()(Vector3 v) const;
  /// The deviation where one is known.
  [[nodiscard]] std::string operator()(const Uncertain& value) const;

 private:
  [[nodiscard]] std::string list(const std::vector<std::string>& values,
                                 const std::string& label) const;
  std::string_view unit_;
};

/// What sentences ask of a grasp.
struct GraspNames {
  bool si = false;
  std::vector<std::string> fingers{};
  double balanced_limit = tactile_net::balanced_limit;  ///< of chi squared

  [[nodiscard]] Numbers lengths() const { return {si, "m"}; }
  [[nodiscard]] Numbers forces() const { return {si, "N"}; }
  [[nodiscard]] Numbers torques() const { return {si, "N m"}; }
};

/// Of a `GraspResult` or a `SpaceGraspResult`.
[[nodiscard]] GraspNames names_of(const auto& grasp) {
  GraspNames names{.si = grasp.hand.si};
  for (const auto& tip : grasp.tips) names.fingers.push_back(tip.finger.name);
  return names;
}

/// Where a contact comes from: "readings of left.csv, frame 3".
[[nodiscard]] std::string source_in_words(lab::Fingertip::Source source, const std::string& file,
                                          std::size_t frame);

[[nodiscard]] std::string in_words(const GraspNames& names, const lab::GraspRemark& remark);
[[nodiscard]] std::string in_words(const GraspNames& names, const lab::GraspFailure& failure);

/// Everything that is to be said: of the fingertips, then of the answers.
[[nodiscard]] Sentences remarks_of_any(const auto& grasp) {
  Sentences said;
  for (const auto& tip : grasp.tips)
    for (const lab::FingertipRemark& remark : tip.remarks) {
      const auto* found = std::get_if<lab::Remark>(&remark);
      (found != nullptr && is_note(*found) ? said.notes : said.warnings)
          .push_back("finger '" + tip.finger.name + "': " + in_words(remark));
    }
  const GraspNames names = names_of(grasp);
  for (const lab::GraspRemark& remark : grasp.remarks)
    said.warnings.push_back(in_words(names, remark));
  return said;
}

[[nodiscard]] std::vector<PadContacts> pad_contacts_of(const auto& grasp) {
  const std::optional<Units> units = grasp.hand.si ? std::optional(Units{}) : std::nullopt;
  std::vector<PadContacts> all;
  for (const auto& tip : grasp.tips)
    if (Cells rows = patch_cells(units, tip.patches, Dimension::point_force); !rows.empty())
      all.push_back({"contacts on the pad of finger '" + tip.finger.name + "':", std::move(rows)});
  return all;
}

inline void print_pad_contacts(std::ostream& out, const std::vector<PadContacts>& pads) {
  for (const PadContacts& pad : pads) {
    out << '\n' << pad.title << '\n';
    print_cells(out, pad.rows);
  }
}

/// The last columns of a contact's row: to the cone's edge, angle left, verdict.
[[nodiscard]] std::vector<std::string> margin_cells(const GraspNames& names,
                                                    const lab::FingerMargins& margins, bool idle,
                                                    double normal);

/// @param slides  of (finger, joint): whether its torque is a force
[[nodiscard]] Cells torque_rows(const GraspNames& names, const auto& actions,
                                const std::vector<lab::FingerMargins>& margins,
                                const auto& slides) {
  Cells rows = {{"finger", "joint", "torque", "left to limit", "used"}};
  for (std::size_t i = 0; i < actions.size(); ++i)
    for (std::size_t j = 0; j < actions[i].torques.size(); ++j) {
      const auto& limits = margins[i].torques;
      const Numbers torque = slides(i, j) ? names.forces() : names.torques();
      rows.push_back({j == 0 ? names.fingers[i] : "", std::to_string(j + 1),
                      torque(actions[i].torques[j]), limits.empty() ? "-" : torque(limits[j].left),
                      limits.empty() ? "-" : percent(limits[j].used)});
    }
  return rows;
}

/// "chi squared 5.1 of 3 degrees of freedom: the deviations explain it (...)"
[[nodiscard]] std::string chi_squared_in_words(const std::optional<double>& chi_squared,
                                               const std::optional<bool>& balanced, int freedom,
                                               double limit);

/// The boxes of a page: does it hold, how near to slipping, to the motors' limits, is it balanced.
struct GraspAnswerParts {
  struct Margin {
    const lab::FingerMargins* margins;
    std::string of;  ///< "left, as measured"
  };
  std::vector<std::string> failures{};
  std::size_t fingers = 0;
  std::string load{};
  std::vector<Margin> margins{};
  std::optional<bool> balanced{};
  std::optional<double> unbalanced_share{};  ///< of a load that was measured against
};
/// @param failures, load  in words
[[nodiscard]] GraspAnswerParts answer_parts(const auto& grasp, std::vector<std::string> failures,
                                            std::string load) {
  GraspAnswerParts parts{
      .failures = std::move(failures), .fingers = grasp.tips.size(), .load = std::move(load)};
  const auto add = [&](const auto& answer, const std::string& words) {
    for (std::size_t i = 0; answer && i < answer->margins.size(); ++i)
      parts.margins.push_back({&answer->margins[i], grasp.tips[i].finger.name + ", " + words});
  };
  add(grasp.measured, "as measured");
  add(grasp.held, "to hold the load");
  if (grasp.measured) parts.balanced = grasp.measured->balanced;
  if (grasp.measured && grasp.hand.load)
    parts.unbalanced_share = grasp.measured->grasp.unbalanced_share;
  return parts;
}
[[nodiscard]] std::vector<Answer> answers_of(const GraspAnswerParts& parts);

}  // namespace tactile_net::report
