/// @file
/// Taxels that a recording shows to be broken, and its scene does not call dead. No single frame
/// shows them: where a patch of taxels is silent, contacts around it explain what the others read.
///
///     const lab::ReadingsCheck seen = lab::first_look(problem.scene(), next);
///     const lab::Findings said = lab::leave_out_broken(problem, seen);
///     lab::RecordingSolver solver(problem, method);
#pragma once

#include <functional>
#include <span>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/finding.hpp"
#include "tactile_net/lab/readings_check.hpp"

namespace tactile_net::lab {

/// What a recording shows before any of its frames is solved: of up to 20 000 frames.
///
/// @param next  fills a frame of readings, channels x count, NaN where one is missing; false: there
///              are no more
[[nodiscard]] ReadingsCheck first_look(const AnyScene& scene,
                                       const std::function<bool(std::span<double>)>& next);

/// Leaves taxels out of a problem that a check of 20 frames or more shows to be dead, stuck or
/// worn: its answers are then those of the scene that calls them dead, with the bands and verdicts
/// of what dead taxels hide. Nothing is left out where the others measure nothing.
///
/// @return  what shows them to be broken, and that they are left out; empty: the problem is as it
/// was
Findings leave_out_broken(SceneProblem& problem, const ReadingsCheck& check);
Findings leave_out_broken(SkinSceneProblem& problem, const ReadingsCheck& check);
Findings leave_out_broken(AnyProblem& problem, const ReadingsCheck& check);

}  // namespace tactile_net::lab
