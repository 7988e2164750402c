/// @file
/// What a page says first: the answer, in at most five boxes. That of a recording stands with its
/// words.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tactile_net/lab/certification.hpp"
#include "tactile_net/lab/grasp.hpp"
#include "tactile_net/lab/identify.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/scene/units.hpp"
#include "tactile_net/study/study.hpp"

namespace tactile_net::report {

struct Answer {
  std::string value{};  ///< "20.2 ± 0.2"
  std::string meaning{};
  bool doubtful = false;  ///< it is not to be trusted, or it is bad news
};

/// How hard, where, how far from the truth, and whether the methods and the circuit agree.
[[nodiscard]] std::vector<Answer> answers(const lab::Experiment& experiment);

/// From which wavelength on ripples are told, what is hidden, and what would tell more; of a line
/// or a skin.
[[nodiscard]] std::vector<Answer> answers(const lab::Survey& survey,
                                          const std::optional<Units>& units);

/// Whether the circuit settles, how fast, what it takes, and what real parts leave of it.
[[nodiscard]] std::vector<Answer> answers(const lab::Certification& certification);

/// What a frame costs, how far its answer is from the truth anyway, and what a circuit would do.
[[nodiscard]] std::vector<Answer> answers(const study::Study& study);

/// Whether the fingers hold, how far they are from slipping and from their motors' limits.
[[nodiscard]] std::vector<Answer> answers(const lab::GraspResult& grasp);

}  // namespace tactile_net::report
