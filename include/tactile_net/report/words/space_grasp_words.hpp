/// @file
/// A grasp in space as text, and the cells and sentences that the terminal and the report share.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tactile_net/lab/space_grasp.hpp"
#include "tactile_net/report/words/answers.hpp"
#include "tactile_net/report/words/grasp_words.hpp"
#include "tactile_net/report/words/remark_words.hpp"

namespace tactile_net::report {

/// One row per finger: the forces at its contact, its friction, and whether it holds.
[[nodiscard]] Cells contact_cells(const lab::SpaceGraspResult& grasp,
                                  const std::vector<SpaceAction>& actions,
                                  const std::vector<lab::FingerMargins>& margins);

/// One row per joint: its torque, and what is left to its limit. Only the head where no finger's
/// joints are known.
[[nodiscard]] Cells torque_cells(const lab::SpaceGraspResult& grasp,
                                 const std::vector<SpaceAction>& actions,
                                 const std::vector<lab::FingerMargins>& margins);

/// "load (0, 0, -2) N at (0, 0, 80) mm, torque (0, 0, 0) N m"; "no load".
[[nodiscard]] std::string load_in_words(const lab::SpaceGraspResult& grasp);

/// Where each finger's contact comes from.
[[nodiscard]] std::vector<std::string> sources_in_words(const lab::SpaceGraspResult& grasp);

/// The pads with several contacts.
[[nodiscard]] std::vector<PadContacts> pad_contacts(const lab::SpaceGraspResult& grasp);

/// How well the measured forces carry the load.
[[nodiscard]] std::vector<std::string> balance_in_words(const lab::SpaceGraspResult& grasp);

/// Which forces carry the load, and which press the fingers against each other alone.
[[nodiscard]] std::vector<std::string> internal_in_words(const lab::SpaceGraspResult& grasp,
                                                         const InternalForces& internal);

/// What is least, and how exactly it was found.
[[nodiscard]] std::vector<std::string> hold_in_words(const lab::SpaceGraspResult& grasp);

/// Why nothing holds the load, so that one can check it; empty where something does.
[[nodiscard]] std::string proof_in_words(const lab::SpaceGraspResult& grasp);

[[nodiscard]] Sentences remarks_in_words(const lab::SpaceGraspResult& grasp);
[[nodiscard]] std::vector<std::string> failures_in_words(const lab::SpaceGraspResult& grasp);

/// The boxes of its page.
[[nodiscard]] std::vector<Answer> answers(const lab::SpaceGraspResult& grasp);

void print_grasp(std::ostream& out, const lab::SpaceGraspResult& grasp);

}  // namespace tactile_net::report
