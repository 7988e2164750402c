/// @file
/// A measured point: what was timed, how long it took, how far its answer is off.
///
/// Two errors, never to be confused: against the truth (what a user wants to know; regularisation
/// and noise set its floor, whatever the arithmetic), and against the exact solution of the same
/// regularised problem (what an algorithm or a circuit adds to that).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/lab/relaxation.hpp"
#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/realization.hpp"
#include "tactile_net/realtime/product_plan.hpp"
#include "tactile_net/study/job.hpp"

namespace tactile_net::study {

/// What a point's time is.
enum class TimeOf { frame, settling, simulator, forward };

}  // namespace tactile_net::study

template <>
struct tactile_net::Enumerators<tactile_net::study::TimeOf> {
  using TimeOf = study::TimeOf;
  static constexpr Enumerator<TimeOf> all[] = {
      {TimeOf::frame, "frame", "A frame's arithmetic, on this machine."},
      {TimeOf::settling, "settling", "A circuit's answer to a step, as simulated in ngspice."},
      {TimeOf::simulator, "simulator",
       "What ngspice itself takes for one frame: not the circuit's time."},
      {TimeOf::forward, "forward", "The forward model's arithmetic: readings of known tractions."}};
};

namespace tactile_net::study {

/// The spelling in JSON and CSV.
[[nodiscard]] std::string_view name(TimeOf time_of) noexcept;

/// A method or a circuit: its points differ in their knob.
struct WorkCurve {
  enum class Family {
    product,              ///< planned products M g, of `structure` and `precision`
    closed_form,          ///< the explicit inverse, as a dense product
    factorisation,        ///< a QR of every frame
    ring_filter,          ///< FFT, the array taken for a ring
    division,             ///< dft: division by the kernel's transform
    conjugate_gradients,  ///< with products by FFT
    active_set,           ///< tractions under the scene's constraints, f_v >= 0 where it has none
    fewer_taxels,         ///< the same aperture read at every second, third, ... taxel
    coarser_surface,      ///< the same readings on grids of steps twice, four times, ... as long
    kronecker,            ///< a sum of Kronecker products of M, rows and columns by themselves
    singular_values,      ///< by the decomposition that every alpha shares: another one each frame
    matrix_gradients,     ///< conjugate gradients, with products by the matrix itself
    friction_cone,        ///< a skin's constraints, by alternating directions
    planned_constraints,  ///< a controller's frames, after so many steps towards the constraints
    coarse_cells,         ///< `array` alone: cells as wide as the taxels' pitch
    integral,             ///< forward model: the thesis' integrals
    discrete_sum,         ///< forward model: sums over the taxels
    circuit,              ///< of `realization`, and of one `bandwidth` or `node_capacitance`
    job,                  ///< `job` as a whole, which failed before it had a curve
  };
  Family family = Family::product;
  std::optional<Structure> structure{};
  std::optional<Precision> precision{};
  std::optional<Realization> realization{};
  std::optional<double> bandwidth{};         ///< gain-bandwidth product of the op-amps [Hz]
  std::optional<double> node_capacitance{};  ///< of a circuit without op-amps [F]
  /// Nodes of a circuit of cells wider than the study's own, which would be too many: errors are
  /// against the exact solution on those.
  std::optional<std::size_t> tractions{};
  std::optional<Job> job{};

  bool operator==(const WorkCurve&) const = default;
};

/// The errors to which settling is timed, over |f*|_2.
inline constexpr std::array settling_levels = {0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4};

/// The bandwidths [Hz] at which circuits of op-amps are timed.
inline constexpr std::array bandwidths = {1e6, 10e6, 100e6};

/// Where circuits are compared with each other and with arithmetic: the op-amps' bandwidth [Hz],
/// and the error, which is also the tolerance of the parts that are shown.
inline constexpr double compared_bandwidth = 10e6;
inline constexpr double one_percent = 0.01;
inline constexpr std::size_t compared_level = 3;
static_assert(settling_levels[compared_level] == one_percent);

/// What differs between the points of one curve.
struct Knob {
  enum class Kind {
    none,             ///< the curve has one point
    ranks,            ///< `ranks` of the product's factors
    steps,            ///< `count` iterations
    exchanges,        ///< `count` exchanges of the active set, `optimal` or stopped
    taxels,           ///< `count` taxels that are read
    terms,            ///< `count` Kronecker products, of all blocks together
    array,            ///< another array, of `rows` x `columns` taxels
    surface_values,   ///< `count` values of each traction
    panel_points,     ///< `count` points of the quadrature on each panel
    halved_panels,    ///< panels halved until the integral is known to 1e-14
    settled,          ///< to `level`; `by_poles`, `scaled`
    operating_point,  ///< the circuit's end, without the way there
  };
  Kind kind = Kind::none;
  std::vector<std::size_t> ranks{};
  std::size_t count = 0;
  bool optimal = false;  ///< exchanges: the constraints' optimum was reached
  std::size_t rows = 0;  ///< array
  std::size_t columns = 0;
  std::size_t level = 0;  ///< settled: index into `settling_levels`
  bool by_poles = false;  ///< settled: by the state space; the simulator ran out of time
  bool scaled = false;    ///< settled: by the ratio of bandwidths, from `compared_bandwidth`

  bool operator==(const Knob&) const = default;
};

/// Why there is no point.
struct Failure {
  enum class Kind {
    refused,      ///< the method refused the scene: `what` says why
    no_frame,     ///< the estimator refused the frame
    dead_taxels,  ///< fewer taxels: the scene has dead ones
    no_stride,    ///< fewer taxels: no stride leaves both ends of `count` taxels in place
    not_stable,   ///< the circuit, by its certificate: `stability`
    unsettled,    ///< the circuit's poles do not bring it to an end
    no_time,      ///< the circuit has no time constant
    disagrees,    ///< the circuit's answer is not that of the direct solve: `disagreement`
  };
  Kind kind = Kind::refused;
  std::string what{};  ///< text of the exception from below
  std::size_t count = 0;
  Stability stability = Stability::stable;
  std::optional<lab::Disagreement> disagreement{};

  bool operator==(const Failure&) const = default;
};

struct WorkPoint {
  WorkCurve curve{};
  Knob knob{};
  TimeOf time_of = TimeOf::frame;
  double seconds = 0.0;      ///< median
  double seconds_low = 0.0;  ///< quartiles
  double seconds_high = 0.0;
  std::optional<double> error_to_solution{};  ///< |f - f*|_2 / |f*|_2; absent: another problem
  std::optional<double> error_to_truth{};     ///< |f - truth|_2 / |truth|_2; absent: no contact
  std::optional<Failure> failure{};           ///< absent: the point was measured

  [[nodiscard]] bool measured() const noexcept { return !failure; }
  /// A circuit that has come within one percent of its end.
  [[nodiscard]] bool settled_to_one_percent() const noexcept {
    return measured() && time_of == TimeOf::settling && knob.kind == Knob::Kind::settled &&
           knob.level == compared_level;
  }

  bool operator==(const WorkPoint&) const = default;
};

}  // namespace tactile_net::study
