#include <algorithm>
#include <cmath>
#include <numbers>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/answers.hpp"
#include "tactile_net/report/words/grasp_words.hpp"

namespace tactile_net::report {
namespace {

using lab::FingerMargins;

/// The margins of both answers, with whose they are.
struct Margin {
  const FingerMargins* margins;
  std::string of;  ///< "left, as measured"
};

std::vector<Margin> all_margins(const lab::GraspResult& grasp) {
  std::vector<Margin> all;
  const auto add = [&](const std::vector<FingerMargins>& margins, const std::string& answer) {
    for (std::size_t i = 0; i < margins.size(); ++i)
      all.push_back({&margins[i], grasp.tips[i].finger.name + ", " + answer});
  };
  if (grasp.measured) add(grasp.measured->margins, "as measured");
  if (grasp.held) add(grasp.held->margins, "to hold the load");
  return all;
}

std::string fingers(std::size_t count) {
  if (count == 1) return "The finger";
  return count == 2 ? "Both fingers" : "All " + std::to_string(count) + " fingers";
}

Answer verdict(const lab::GraspResult& grasp) {
  if (!grasp.failures.empty())
    return {grasp.failures.size() == 1
                ? "It fails"
                : "It fails in " + std::to_string(grasp.failures.size()) + " ways",
            failures_in_words(grasp).front(), true};
  const std::size_t count = grasp.tips.size();
  return {fingers(count) + (count == 1 ? " holds" : " hold"), load_in_words(grasp)};
}

}  // namespace

std::vector<Answer> answers(const lab::GraspResult& grasp) {
  std::vector<Answer> all = {verdict(grasp)};
  const std::vector<Margin> margins = all_margins(grasp);
  const Margin* nearest = nullptr;
  const Margin* strained = nullptr;
  std::size_t joint = 0;
  double used = -1.0;
  for (const Margin& one : margins) {
    const auto& friction = one.margins->friction;
    if (friction && friction->verdict != ContactVerdict::idle &&
        (nearest == nullptr || friction->angle < nearest->margins->friction->angle))
      nearest = &one;
    for (std::size_t j = 0; j < one.margins->torques.size(); ++j)
      if (one.margins->torques[j].used > used) {
        used = one.margins->torques[j].used;
        strained = &one;
        joint = j;
      }
  }
  if (nearest != nullptr) {
    const double angle = nearest->margins->friction->angle * 180.0 / std::numbers::pi;
    all.push_back(
        {brief(std::abs(angle), 2) + "° " + (angle < 0.0 ? "beyond slipping" : "to slipping"),
         "the nearest: " + nearest->of, angle < 0.0});
  }
  if (strained != nullptr)
    all.push_back(
        {brief(100.0 * used, 2) + " % of torque",
         "the most of a limit: joint " + std::to_string(joint + 1) + " of " + strained->of,
         used > 1.0});
  if (grasp.measured && grasp.measured->balanced)
    all.push_back({*grasp.measured->balanced ? "balanced" : "not balanced",
                   *grasp.measured->balanced
                       ? "the measured forces carry the load within their deviations"
                       : "the measured forces do not carry the load: more than their deviations "
                         "explain",
                   !*grasp.measured->balanced});
  else if (grasp.measured && grasp.hand.load)
    all.push_back(
        {percent(grasp.measured->grasp.unbalanced_share) + " not balanced",
         "of all measured forces; without deviations nothing tells whether that is much"});
  return all;
}

}  // namespace tactile_net::report
