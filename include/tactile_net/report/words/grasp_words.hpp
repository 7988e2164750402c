/// @file
/// A grasp as text: cells and sentences that the terminal and the report share.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tactile_net/lab/grasp.hpp"
#include "tactile_net/report/words/remark_words.hpp"

namespace tactile_net::report {

using Cells = std::vector<std::vector<std::string>>;

/// One row per finger: the force at its contact, its friction, and whether it holds.
[[nodiscard]] Cells contact_cells(const lab::GraspResult& grasp,
                                  const std::vector<FingerAction>& actions,
                                  const std::vector<lab::FingerMargins>& margins);

/// One row per joint: its torque, and what is left to its limit.
[[nodiscard]] Cells torque_cells(const lab::GraspResult& grasp,
                                 const std::vector<FingerAction>& actions,
                                 const std::vector<lab::FingerMargins>& margins);

/// "load (0, -10) at (0, 0.08), torque 0"; "no load".
[[nodiscard]] std::string load_in_words(const lab::GraspResult& grasp);

/// Where each finger's contact comes from.
[[nodiscard]] std::vector<std::string> sources_in_words(const lab::GraspResult& grasp);

/// A pad with several contacts: "contacts on the pad of finger 'left':", and a row a contact.
struct PadContacts {
  std::string title{};
  Cells rows{};
};
/// Those with more than one; their forces are those of the whole breadth.
[[nodiscard]] std::vector<PadContacts> pad_contacts(const lab::GraspResult& grasp);

/// A contact's forces with their deviations, of a `FingertipForce` and of a `FingerAction`.
[[nodiscard]] Uncertain normal_of(const auto& force) {
  return {force.normal, force.covariance.deviation(ContactValue::normal)};
}
[[nodiscard]] Uncertain tangential_of(const auto& force) {
  return {force.tangential, force.covariance.deviation(ContactValue::tangential)};
}

/// How well the measured forces carry the load, and how they squeeze.
[[nodiscard]] std::vector<std::string> balance_in_words(const lab::GraspResult& grasp);

/// What was held: by which squeeze, and what is least.
[[nodiscard]] std::vector<std::string> hold_in_words(const lab::GraspResult& grasp);

/// "the tangential force is not measured: it is taken for zero"
[[nodiscard]] std::string in_words(const lab::FingertipRemark& remark);

/// What is to be said of the grasp: of each finger, then of the answers.
[[nodiscard]] Sentences remarks_in_words(const lab::GraspResult& grasp);

/// What cannot hold, one sentence each.
[[nodiscard]] std::vector<std::string> failures_in_words(const lab::GraspResult& grasp);

void print_grasp(std::ostream& out, const lab::GraspResult& grasp);

}  // namespace tactile_net::report
