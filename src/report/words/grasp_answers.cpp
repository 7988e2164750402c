#include <cmath>

#include "report/words/grasp_parts.hpp"
#include "report/words/number_words.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/answers.hpp"
#include "tactile_net/report/words/grasp_words.hpp"
#include "tactile_net/report/words/space_grasp_words.hpp"

namespace tactile_net::report {
namespace {

std::string fingers(std::size_t count) {
  if (count == 1) return "The finger";
  return count == 2 ? "Both fingers" : "All " + std::to_string(count) + " fingers";
}

Answer verdict(const GraspAnswerParts& parts) {
  if (!parts.failures.empty())
    return {parts.failures.size() == 1
                ? "It fails"
                : "It fails in " + std::to_string(parts.failures.size()) + " ways",
            parts.failures.front(), true};
  return {fingers(parts.fingers) + (parts.fingers == 1 ? " holds" : " hold"), parts.load};
}

}  // namespace

std::vector<Answer> answers_of(const GraspAnswerParts& parts) {
  using Margin = GraspAnswerParts::Margin;
  std::vector<Answer> all = {verdict(parts)};
  const Margin* nearest = nullptr;
  const Margin* strained = nullptr;
  std::size_t joint = 0;
  double used = -1.0;
  for (const Margin& one : parts.margins) {
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
    const double angle = in_degrees(nearest->margins->friction->angle);
    all.push_back(
        {brief(std::abs(angle), 2) + "° " + (angle < 0.0 ? "beyond slipping" : "to slipping"),
         "the nearest: " + nearest->of, angle < 0.0});
  }
  if (strained != nullptr)
    all.push_back({brief(100.0 * used, 2) + " % of torque",
                   "largest share of a torque limit: joint " + std::to_string(joint + 1) + " of " +
                       strained->of,
                   used > 1.0});
  if (parts.balanced)
    all.push_back(
        {*parts.balanced ? "balanced" : "not balanced",
         *parts.balanced
             ? "the measured forces carry the load within their deviations"
             : "the measured forces do not carry the load, by more than their deviations explain",
         !*parts.balanced});
  else if (parts.unbalanced_share)
    all.push_back({percent(*parts.unbalanced_share) + " not balanced",
                   "of all measured forces; no deviations are known, so nobody can tell whether "
                   "that is much"});
  return all;
}

std::vector<Answer> answers(const lab::GraspResult& grasp) {
  return answers_of(answer_parts(grasp, failures_in_words(grasp), load_in_words(grasp)));
}

std::vector<Answer> answers(const lab::SpaceGraspResult& grasp) {
  return answers_of(answer_parts(grasp, failures_in_words(grasp), load_in_words(grasp)));
}

}  // namespace tactile_net::report
