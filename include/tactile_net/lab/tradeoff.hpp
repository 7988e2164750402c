/// @file
/// A scene's work-precision study: every method, timed on this machine, beside the exact answer.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/lab/work_precision.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net::lab {

/// How far components of some accuracy leave a realisation from the exact answer.
struct PartsFloor {
  std::string realization{};
  double relative = 0.0;           ///< accuracy of the parts
  std::optional<double> median{};  ///< |f - f*|_2 / |f*|_2; absent: not stable
};

/// What one job of the study found.
struct StudySection {
  std::string job{};
  std::vector<WorkPoint> points{};
  std::vector<PartsFloor> floors{};
};

/// What every job starts from.
struct StudyInput {
  Scene scene;  ///< with the alpha that all methods share
  TractionField truth{};
  std::vector<double> readings{};
  std::vector<double> solution{};  ///< f*, of a QR; `agreement` from the one by singular values
  double agreement = 0.0;
  double solution_error = 0.0;  ///< |f* - truth| / |truth|; NaN without a contact
  double noise_rms = 0.0;       ///< of a reading, as for `noise_floor`
  bool noise_stated = false;    ///< by the scene; else one hundredth of the largest reading
  double noise_floor = 0.0;     ///< what that noise does to f*: root mean square, over |f*|

  /// The smallest error that can be told: both references may err by more than they differ.
  [[nodiscard]] double resolution() const noexcept { return 10.0 * agreement; }
};

/// The curve of the scene's constraints, or of f_v >= 0 where it has none.
inline constexpr std::string_view constrained_curve = "f_v >= 0, active set";

struct Study {
  StudyInput input;
  std::vector<StudySection> sections{};
  double clock = 0.0;  ///< of this processor [Hz]; 0: not known
  std::string processor{};
  bool complete = true;  ///< every job was done

  [[nodiscard]] std::vector<WorkPoint> points() const;
};

struct StudyJob {
  std::string name{};
  double weight = 1.0;  ///< about how long it takes, in seconds, for the remaining time
  std::function<StudySection()> run{};
};

/// @throw std::invalid_argument  the scene cannot be studied: alpha by a rule without readings, ...
[[nodiscard]] StudyInput study_input(const Scene& scene);

/// The arithmetic: one job per family of methods. The input must outlive them.
[[nodiscard]] std::vector<StudyJob> digital_jobs(const StudyInput& input);

/// The circuits: settling in ngspice, accuracy of parts, and what ngspice itself takes. Each job
/// has a simulator of its own: they may run side by side.
[[nodiscard]] std::vector<StudyJob> circuit_jobs(const StudyInput& input,
                                                 const SimulatorChoice& choice,
                                                 const Observer& observer = silent);

/// Where circuits are compared with each other and with arithmetic: op-amps' gain-bandwidth [Hz],
/// and the error, which is also the tolerance of the parts that are shown.
inline constexpr double compared_bandwidth = 10e6;
inline constexpr double one_percent = 0.01;

/// Realisation and bandwidth [Hz] of a settling point's curve, "nic, 10 MHz"; 0: it has no op-amps.
[[nodiscard]] std::pair<std::string, double> circuit_of(const WorkPoint& point);

/// The fastest frame within one percent of the exact solution [s].
[[nodiscard]] std::optional<double> fastest_frame(const std::vector<WorkPoint>& points);

/// Cycles a second, by a chain of additions; 0 where it cannot be measured.
[[nodiscard]] double processor_clock();
[[nodiscard]] std::string processor_name();

}  // namespace tactile_net::lab
