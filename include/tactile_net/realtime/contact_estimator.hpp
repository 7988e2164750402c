/// @file
/// The per-frame call of a controller: readings in, tractions and the contact's resultant out.
///
///     ContactEstimator estimator(plan);            // of plan_estimator or load_plan
///     std::vector<double> tractions(estimator.tractions());
///     ContactEstimate contact{.tractions = tractions};
///     while (next_frame(readings))                 // examples/07_controller.cpp
///       if (estimator.update(readings, contact) == FrameStatus::ok && contact.contact)
///         grip(contact.normal_force, contact.friction_margin);
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

#include "tactile_net/realtime/contact_row.hpp"
#include "tactile_net/realtime/convolution.hpp"
#include "tactile_net/realtime/estimator_plan.hpp"
#include "tactile_net/realtime/frame_status.hpp"
#include "tactile_net/realtime/loop_options.hpp"
#include "tactile_net/realtime/reading_view.hpp"

namespace tactile_net {

/// What tractions on a curved skin amount to in the sensor's own axes, summed over the cells that a
/// frame's other sums are over. NaN: the skin is flat.
struct SpaceEstimate {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::array<double, 3> force{unknown, unknown, unknown};   ///< that acts on the skin [N]
  std::array<double, 3> moment{unknown, unknown, unknown};  ///< of it, about the plan's point [N m]
  /// The mean of the places that press [m], which lies below a convex surface; NaN without contact.
  std::array<double, 3> centre{unknown, unknown, unknown};
};

/// One frame's answer. The caller owns it and the memory of its tractions.
///
/// A line's forces are in N/m; a skin's are in N, its torsion in N m. A skin's are sums over the
/// cells that touch, as far as the plan can tell them from empty ones, else over all cells: so they
/// are sums over all contacts. Margins are those of the contact that is nearest to slipping: two
/// contacts that are dragged in opposite directions both slip while the sum of their drags is 0.
struct ContactEstimate {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::span<double> tractions{};  ///< [Pa], `tractions()` values: normal, then tangential
  double time = 0.0;              ///< time of the frame, as given to `update`
  double normal_force = 0.0;      ///< F_v = h sum f_v, h the spacing [N/m]
  /// Standard deviation of F_v by noise and smoothing; NaN: not known. A skin's comes from the
  /// windows' deviations, as if windows that do not overlap erred independently.
  double force_deviation = unknown;
  double tangential_force = unknown;  ///< F_t = h sum f_t [N/m]; NaN with one unknown; of a skin
                                      ///< its size, >= 0
  double tangential_y = unknown;      ///< a skin's F_t along y [N]; else NaN
  double tangential_z = unknown;      ///< a skin's F_t along z [N]; else NaN
  double centre = unknown;            ///< sum y f_v / sum f_v [m]; NaN without contact
  double centre_z = unknown;          ///< a skin's centre along z [m]; else NaN
  /// A skin's moment about x through the centre of pressure, from y towards z [N m]; else NaN.
  double torsion = unknown;
  double angle = unknown;  ///< atan2(F_t, F_v) [rad]; NaN with one unknown or without contact
  /// mu F_v - |F_t| [N/m], of a skin [N]; < 0: slips; NaN if mu or F_t is not known. Where several
  /// contacts lie apart, that of the one that needs the most friction.
  double friction_margin = unknown;
  /// A skin's 1 - sqrt((F_t / (mu F_v))^2 + (T / (mu sum p r))^2), r the distance from the centre
  /// of pressure; < 0: slips or turns (Howe and Cutkosky 1996). NaN as the friction margin.
  double slip_margin = unknown;
  double margin_centre = unknown;    ///< centre of the contact that has the margins [m]; else NaN
  double margin_centre_z = unknown;  ///< a skin's, along z [m]; else NaN
  /// Of a curved skin, whose other forces are sums over its chart: `normal_force` sums what presses
  /// along each place's own normal, and centres are places of the chart.
  SpaceEstimate space{};
  /// Number of contacts that lie apart, of which margins are the worst; 0: no margins, or no
  /// contact.
  std::size_t contacts = 0;
  /// Number of cells that forces are sums over; 0: all cells. Inside constraints, where noise can
  /// only push, 0 is none where the plan can tell: forces are then 0, or where the linear frame as
  /// a whole presses beyond noise, its.
  std::size_t touching = 0;
  /// Root mean square of W (g - K f) over the live readings: what the tractions, and where they are
  /// unknown the offsets, leave unexplained. NaN without a prediction in the plan.
  double residual_rms = unknown;
  /// True if F_v > 0 (of a skin whose noise is known: beyond noise): then centre, angle and margins
  /// have values.
  bool contact = false;
  // Plausibility flags, down to `baseline_moved`. True only if the plan holds the data for the
  // test; false also means: not tested.
  bool pulls = false;        ///< F_v is more than four deviations below 0: no contact pulls
  bool implausible = false;  ///< the mean normal traction would strain the pad by more than 1
  /// The residual exceeds what noise explains once in 1000 frames, and what alpha may add to it:
  /// half of sqrt(alpha) |L f| at most, f the true tractions; twice that of those found is allowed.
  bool misfit = false;
  /// The outermost places that are seen press nearly as hard as any: the contact may go on beyond
  /// them, and F_v is a lower bound.
  bool beyond_edge = false;
  /// A constant beyond noise is nearly all that a channel reads: the baseline may have moved, which
  /// looks like pressure everywhere. Record a new one while nothing touches.
  bool baseline_moved = false;
  bool saturated = false;  ///< a live reading lies at or beyond its channel's range
  /// Index of the reading that the others explain least; -1: none stands out by more than noise,
  /// regularisation and the plan's accuracy account for.
  std::ptrdiff_t outlier = -1;

  // Of a plan whose frames obey what contact allows (cone_plan.hpp); flags above are then of the
  // linear frame where they are of readings or of pulling, else of the tractions returned.
  /// How far the steps stopped from the minimum inside the constraints, at most: by so many of its
  /// own standard deviations, that noise alone gives it without constraints, is any cell, force or
  /// moment off. True of every frame: rounding is included, and that steps lead anywhere is not
  /// assumed. NaN: the plan has no constraints, or no noise.
  double unfinished = unknown;
  /// The same distance over the size of the linear frame, both as the readings see them. NaN: the
  /// plan has no constraints, or no prediction.
  double unfinished_share = unknown;
  std::size_t steps = 0;  ///< that were taken

  /// Room for the contacts one by one, at most `most_contact_rows`; the caller's, none: they are
  /// not asked for. Filled in from the front; a skin's by their force, the strongest first, a
  /// line's from left to right. Where there are more, the strongest. Their numbers follow the
  /// frames of one estimator in the order in which it answered them; copies of it number anew.
  std::span<ContactRow> rows{};
  std::size_t rows_found = 0;
  /// 0: this frame's answer. Else that many frames were refused since the one that it answers
  /// (`LoopOptions::hold`); its time is that frame's too.
  std::size_t age = 0;
};

struct Moments;

/// Which vector instructions the products use.
enum class InstructionSet { baseline, avx2, avx512 };
[[nodiscard]] std::string_view name(InstructionSet set) noexcept;
/// The widest instruction set that this machine and its operating system run, as the processor
/// says.
[[nodiscard]] InstructionSet widest_instruction_set() noexcept;

/// Holds a plan, made ready, and the scratch of one thread.
///
/// The constructor does all that allocates, throws or is slow. `update` and the other `noexcept`
/// members are for the control loop: no allocation, no lock, no system call, no exception, a
/// bounded number of operations. For a line it is fixed, but for the few that a contact alone
/// takes; for a skin the search for what touches follows the frame, and looks at each cell and its
/// eight neighbours twice at most. One object a thread and patch; copies share the plan's matrices.
///
/// A host may trap floating-point exceptions: no frame, NaN, infinities and too large numbers
/// included, raises that of an invalid operation, of a division by zero or of an overflow. Only a
/// signalling NaN does, and normal tractions whose sum is 1e300 times smaller than they are.
class ContactEstimator {
 public:
  static constexpr std::size_t most_dead_taxels = 8;
  static constexpr std::size_t most_dead_readings = 512;  ///< readings of dead taxels, at most
  /// Share of a dead reading's variance that must be left to the others: below, they cannot tell.
  static constexpr double least_pivot = 1e-3;
  /// Taxels at each end that are never called outliers: a load beyond the array looks just so.
  static constexpr std::size_t unjudged_ends = 3;

  /// Makes a plan ready. O(size of the plan).
  /// @param set  for tests and benchmarks; one that the machine lacks is replaced by the widest
  /// @throw std::invalid_argument  `check(plan)` does, or a structure is fft
  explicit ContactEstimator(const EstimatorPlan& plan,
                            InstructionSet set = widest_instruction_set());
  /// Makes a plan with fft ready: `ContactEstimator estimator(plan, fft_convolutions());`
  /// @param make  called for each product that is fft; copies clone what it made
  ContactEstimator(const EstimatorPlan& plan, const ConvolutionMaker& make,
                   InstructionSet set = widest_instruction_set());
  ContactEstimator(const ContactEstimator& other);
  /// Afterwards the source may only be assigned to or destroyed.
  ContactEstimator(ContactEstimator&&) noexcept;
  ContactEstimator& operator=(const ContactEstimator& other);
  ContactEstimator& operator=(ContactEstimator&&) noexcept;
  ~ContactEstimator();

  /// One frame. Streams `streamed_bytes(plan.reconstruction)`, and those of the prediction if the
  /// plan has one. Equal frames give equal bits on one instruction set; sums are taken in a fixed
  /// order.
  ///
  /// @param readings  g, channels x count, or the raw numbers that the plan is for; those of dead
  ///                  taxels may be anything
  /// @param estimate  untouched unless the status is `ok`; its tractions may be the same memory as
  ///                  the readings
  /// @param time      passed through
  FrameStatus update(std::span<const double> readings, ContactEstimate& estimate,
                     double time = 0.0) noexcept;
  /// The same of readings in a driver's own numbers, with the bits that a copy of them in doubles
  /// gives. O(readings) more.
  FrameStatus update(const ReadingView& readings, ContactEstimate& estimate,
                     double time = 0.0) noexcept;

  /// Recorded frames: `update` on each, with the same bits; the time of an estimate stays as it is.
  /// Except for fft, the matrix is read once for a block of frames, and each number of it
  /// multiplied by those of eight frames while it is in a register: for a skin a frame takes about
  /// half the time of an `update`. No allocation either. On several cores: control/batch.hpp.
  ///
  /// @param readings   frames x channels x count
  /// @param estimates  one a frame; tractions may be the memory of their own frame's readings, of
  ///                   no other's
  /// @return `ok` if every frame is; else the first other status, whose frame keeps its estimate
  ///         while the ones after it are still computed; `wrong_size`: nothing was
  FrameStatus update_batch(std::span<const double> readings,
                           std::span<ContactEstimate> estimates) noexcept;

  /// Sets what the sensors read without contact. It is subtracted from every frame from now on, in
  /// place of the plan's own baseline (zero unless the plan is for raw numbers): such a frame then
  /// means no load, whatever offset the calibration had. The value of a dead taxel is kept, if
  /// finite, for when the taxel lives again.
  /// @return not `ok`: the old baseline stays; `too_large`: a value is beyond 2^969, and a reading
  ///         less it might overflow
  FrameStatus set_baseline(std::span<const double> readings) noexcept;
  FrameStatus set_baseline(const ReadingView& readings) noexcept;

  /// Leaves a taxel out, in all channels, from the next frame on. The answer is the minimiser
  /// without those rows, exactly (a row left out is a row that reads what the others predict of it:
  /// Allen 1974, Cook and Weisberg 1982), to `accuracy` / `least_pivot` at worst.
  /// O(readings) more per frame and dead reading.
  ///
  /// @return false, and nothing changes: the plan has no prediction, `taxel` is not < count, more
  ///         than `most_dead_taxels` or `most_dead_readings`, the last one that lives, or the
  ///         others cannot predict it (make a new plan, without it)
  bool set_dead(std::size_t taxel) noexcept;
  /// All taxels that `set_dead` left out count again.
  void revive() noexcept;

  /// Of a plan with constraints: how much frames may do from now on. More steps than
  /// `ConePlan::most_steps` are that many. Not by another thread while it updates.
  void set_work(ConeWork work) noexcept;
  /// Of a plan with constraints: a frame ends with the step that finds this flag set, and returns
  /// what it has, with its bound. Another thread, a signal or a timer may set it at any time. It
  /// must outlive the updates; null: none. Copies of the estimator do not have it.
  void stop_at(const std::atomic<bool>* flag) noexcept;
  /// Of a plan with constraints, after an update: the linear tractions of that frame [Pa], which
  /// its steps began with; of a batch those of its last. Empty without constraints.
  [[nodiscard]] std::span<const double> free_tractions() const noexcept;

  /// From the next frame on; copies have the same.
  void set_options(const LoopOptions& options) noexcept;
  [[nodiscard]] const LoopOptions& options() const noexcept;
  /// Frames of `update` and `update_batch`. A batch of a wrong size counts as one.
  [[nodiscard]] const FrameCounters& counters() const noexcept;
  void reset_counters() noexcept;

  /// Call before the loop, in its thread: the first frame then takes as long as any. Locks the
  /// estimator's memory where the system allows it (`mlock`: RLIMIT_MEMLOCK, or CAP_IPC_LOCK), and
  /// runs frames of its own, one of zeros, one that presses, so that code and memory are there.
  /// They are not counted, and change no later answer, but an answer that is held is forgotten.
  /// Pages stay locked until the process gives them back. What the caller owns, and a
  /// `Convolution`, are not locked: `mlockall` does that.
  Preparation prepare() noexcept;

  [[nodiscard]] std::size_t readings() const noexcept;
  [[nodiscard]] std::size_t tractions() const noexcept;
  /// The plan's label.
  [[nodiscard]] std::string_view label() const noexcept;
  [[nodiscard]] InstructionSet instruction_set() const noexcept;

 private:
  struct Ready;
  struct Scratch;
  struct FrameBlock;
  struct Input;
  FrameStatus update_frame(std::span<const double> readings, ContactEstimate& estimate,
                           double time) noexcept;
  std::span<const double> converted(const ReadingView& readings) noexcept;
  void run_frames() noexcept;
  void add_memory(auto& lock) const noexcept;
  FrameStatus make_input(std::span<const double> readings, bool stored, Input& input) noexcept;
  FrameStatus admit(std::span<const double> readings, double* x, bool& saturated) noexcept;
  void finish(ContactEstimate& estimate, std::span<Moments> moments, const double* x,
              const double* explained) noexcept;
  FrameStatus refused(std::span<const double> readings) const noexcept;
  void predict(const double* x, double* explained) noexcept;
  void judge(ContactEstimate& estimate, const double* x, const double* explained) noexcept;
  [[nodiscard]] bool is_baseline_moved(const double* x, double all_squares) const noexcept;
  void fill_dead(double* x) noexcept;
  void fill_planned(double* x) noexcept;
  void constrain(ContactEstimate& estimate, std::span<Moments> moments) noexcept;
  std::span<const Moments> sum_touching(ContactEstimate& estimate, bool presses) noexcept;
  void add_resultant(ContactEstimate& estimate, std::span<const Moments> moments) noexcept;
  void add_rows(ContactEstimate& estimate) noexcept;
  void add_worst_margin(ContactEstimate& estimate) const noexcept;
  void solve_block() noexcept;
  bool eliminate(std::size_t reading) noexcept;

  std::shared_ptr<const Ready> ready_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace tactile_net
