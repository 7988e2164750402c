#include "report/words/grasp_parts.hpp"

#include "report/words/number_words.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/numeric/unit_text.hpp"

namespace tactile_net::report {
namespace {

std::string answer_in_words(lab::GraspAnswer answer) {
  return answer == lab::GraspAnswer::measured ? "as measured: " : "to hold: ";
}

/// "to hold: finger 'left' ", of a remark or a failure.
std::string subject_of(const GraspNames& names, const auto& what) {
  return answer_in_words(what.answer) + "finger '" + names.fingers[what.finger] + "' ";
}

}  // namespace

std::string Numbers::operator()(double value) const {
  return unit_.empty() ? brief(value) : with_unit(value, unit_);
}

std::string Numbers::list(const std::vector<std::string>& values, const std::string& label) const {
  return "(" + join(values, ", ") + ")" + (unit_.empty() ? "" : " " + label);
}

std::string Numbers::operator()(Vector2 v) const {
  const ScaledUnit scaled = scaled_unit(std::max(std::abs(v.x), std::abs(v.y)), unit_);
  return list({brief(scaled.factor * v.x), brief(scaled.factor * v.y)}, scaled.label);
}

std::string Numbers::operator()(Vector3 v) const {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const ScaledUnit scaled = scaled_unit(largest, unit_);
  std::vector<std::string> words;
  // What is small beside the largest is as good as zero to a reader.
  for (const double value : {v.x, v.y, v.z})
    words.push_back(brief(std::abs(value) < 1e-3 * largest ? 0.0 : scaled.factor * value));
  return list(words, scaled.label);
}

std::string Numbers::operator()(const Uncertain& value) const {
  if (!(value.deviation > 0.0)) return (*this)(value.value);
  return unit_.empty() ? brief(value.value) + " +- " + brief(value.deviation)
                       : with_unit(value.value, value.deviation, unit_);
}

std::string source_in_words(lab::Fingertip::Source source, const std::string& file,
                            std::size_t number) {
  using Source = lab::Fingertip::Source;
  const std::string frame = ", frame " + std::to_string(number);
  switch (source) {
    case Source::assumed:
      return "contact assumed";
    case Source::resultant:
      return "resultant given";
    case Source::tractions:
      return "tractions of " + file + frame;
    case Source::readings:
      return "readings of " + file + frame;
    case Source::simulated:
      return "contacts of " + file;
  }
  return {};
}

std::string in_words(const GraspNames& names, const lab::GraspRemark& remark) {
  using Kind = lab::GraspRemark::Kind;
  const std::string finger = subject_of(names, remark);
  switch (remark.kind) {
    case Kind::idle:
      return finger + "is not needed: it carries nothing";
    case Kind::near_slipping:
      return finger + "is less than two standard deviations from slipping";
  }
  return {};
}

std::string in_words(const GraspNames& names, const lab::GraspFailure& failure) {
  using Kind = lab::GraspFailure::Kind;
  const std::string answer = answer_in_words(failure.answer);
  const std::string finger = subject_of(names, failure);
  switch (failure.kind) {
    case Kind::pulls:
      return finger + "would have to pull with " + names.forces()(failure.number);
    case Kind::slips:
      return finger + "slips: its force is " + names.forces()(failure.number) +
             " outside the friction cone";
    case Kind::beyond_limit:
      return finger + "exceeds the torque limit of joint " + std::to_string(failure.joint + 1) +
             " by " + names.torques()(failure.number);
    case Kind::unbalanced:
      return answer + "the forces do not carry the load: chi squared " + brief(failure.number) +
             ", beyond the " + brief(names.balanced_limit) +
             ", which 99 % of balanced grasps do not reach";
    case Kind::cannot_hold:
      return answer + rule(failure.reason);
    case Kind::disagreement:
      return answer + "the thesis' equations give other torques, by " + brief(failure.number);
  }
  return {};
}

std::vector<std::string> margin_cells(const GraspNames& names, const lab::FingerMargins& margins,
                                      bool idle, double normal) {
  const auto& friction = margins.friction;
  return {friction ? names.forces()(friction->distance) : "-",
          friction ? degrees_in_words(friction->angle) : "-",
          friction       ? name(friction->verdict)
          : idle         ? "idle"
          : normal > 0.0 ? "pushes"
                         : "pulls"};
}

std::string chi_squared_in_words(const std::optional<double>& chi_squared,
                                 const std::optional<bool>& balanced, int freedom, double limit) {
  if (!balanced)
    return "not all deviations of the forces are known, so nobody can tell whether that is much";
  return "chi squared " + brief(*chi_squared) + " of " + std::to_string(freedom) +
         " degrees of freedom: " +
         (*balanced ? "the deviations explain it" : "MORE THAN THE DEVIATIONS EXPLAIN") +
         " (99 % stay below " + brief(limit) + ")";
}

}  // namespace tactile_net::report
