/// @file
/// The result of a study: what every job found, beside the machine it ran on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tactile_net/study/input.hpp"
#include "tactile_net/study/job.hpp"
#include "tactile_net/study/moving_contacts.hpp"
#include "tactile_net/study/work_point.hpp"

namespace tactile_net::study {

/// How far components of some accuracy leave a realisation from the exact answer.
struct PartsFloor {
  Realization realization = Realization::nic;
  double relative = 0.0;           ///< accuracy of the parts
  std::optional<double> median{};  ///< |f - f*|_2 / |f*|_2; absent: not stable

  bool operator==(const PartsFloor&) const = default;
};

/// What one job of the study found.
struct StudySection {
  Job job{};
  std::vector<WorkPoint> points{};
  std::vector<PartsFloor> floors{};
  std::optional<MovingContacts> moving{};

  /// Nothing in it failed.
  [[nodiscard]] bool whole() const noexcept;

  bool operator==(const StudySection&) const = default;
};

struct Study {
  StudyInput input;
  std::vector<StudySection> sections{};
  double clock = 0.0;  ///< of this processor [Hz]; 0: not known
  std::string processor{};
  bool complete = true;  ///< every job was done

  /// Those of every section.
  [[nodiscard]] std::vector<WorkPoint> points() const;
};

}  // namespace tactile_net::study
