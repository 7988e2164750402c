/// @file
/// The call of a control loop for programs in C99, and for what calls C: Rust, LabVIEW, Ada.
///
///     tactile_net_estimator* estimator = tactile_net_load(TACTILE_NET_INTERFACE, "pad.plan");
///     if (estimator == NULL) fputs(tactile_net_last_error(), stderr);
///     tactile_net_estimate contact;
///     while (next_frame(readings))  // examples/11_c_controller.c
///       if (tactile_net_update(estimator, readings, count, time, tractions, &contact) ==
///               TACTILE_NET_OK && contact.contact)
///         grip(contact.normal_force, contact.friction_margin);
///     tactile_net_destroy(estimator);
///
/// It is ContactEstimator (realtime/contact_estimator.hpp) behind an opaque handle: the same plans,
/// the same bits. No exception leaves a call. A plan is made at a desk (`tactile-net plan`).
///
/// A handle is one thread's at a time; different handles are independent. Except where a call says
/// that it may be null, pointers must be valid.
#ifndef TACTILE_NET_H
#define TACTILE_NET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The names, the typedefs and the headers are those that C knows.
// NOLINTBEGIN(modernize-*,readability-identifier-naming)
#ifdef __cplusplus
extern "C" {
#endif

/// Version of this interface: it grows with every change that a compiled program would notice.
#define TACTILE_NET_INTERFACE 1

/// Outcome of one frame, as tactile_net::FrameStatus.
typedef enum tactile_net_status {
  TACTILE_NET_OK = 0,
  TACTILE_NET_WRONG_SIZE = -1,  ///< not as many readings as the plan has, or none (null)
  TACTILE_NET_NOT_FINITE = -2,  ///< a reading that counts is NaN or infinite
  TACTILE_NET_TOO_LARGE = -3    ///< finite, but its tractions might overflow: scale the readings
} tactile_net_status;

/// What a plan is for.
typedef struct tactile_net_plan {
  const char* label;      ///< what it was made for, for a controller to print
  size_t readings;        ///< of a frame
  size_t tractions;       ///< unknowns x rows x columns, in this order
  size_t unknowns;        ///< 1: normal; 2: and along y; 3: and along z
  bool is_curved;         ///< a skin whose places are those of its surface's chart
  bool is_skin;           ///< else a line: its forces are per metre
  size_t rows;            ///< places along y
  size_t columns;         ///< places along z; of a line 1
  double spacing_y_m;     ///< distance of rows [m]
  double spacing_z_m;     ///< distance of columns [m]; of a line 0
  double centre_y_m;      ///< y of the middle of the places [m]
  double centre_z_m;      ///< z of the middle of the places [m]; of a line 0
  size_t steps;           ///< of a frame towards its constraints; 0: it has none
  double friction_limit;  ///< that frames obey; NaN: none
} tactile_net_plan;

/// One frame's answer but for its tractions; NaN where it is not known. ContactEstimate says more
/// of each. Forces of a line are in N/m, those of a skin in N.
typedef struct tactile_net_estimate {
  double time_s;             ///< as given to the call [s]
  double normal_force;       ///< [N/m], of a skin [N]; > 0 presses
  double force_deviation;    ///< standard deviation of the normal force [N/m], of a skin [N]
  double tangential_force;   ///< along y [N/m]; of a skin its size [N], >= 0
  double tangential_y;       ///< of a skin [N]
  double tangential_z;       ///< of a skin [N]
  double centre_y_m;         ///< of pressure [m]
  double centre_z_m;         ///< of pressure, of a skin [m]
  double torsion_n_m;        ///< of a skin, about the centre, from y towards z [N m]
  double angle_rad;          ///< of the force from the normal [rad]
  double friction_margin;    ///< mu F_v - |F_t| [N/m], of a skin [N]; < 0: slips
  double slip_margin;        ///< of a skin, share of the friction limit that is left; < 0: slips
  double margin_centre_y_m;  ///< centre of the contact that has the margins [m]
  double margin_centre_z_m;  ///< of a skin [m]
  double force_in_space[3];  ///< of a curved skin: that acts on it, in the sensor's axes [N]
  double moment_in_space_n_m[3];  ///< of it, about the plan's point [N m]
  double centre_in_space_m[3];    ///< the mean of the places that press [m]
  double residual_rms;  ///< what is left unexplained, in the readings' unit times the weights
  size_t contacts;      ///< that lie apart; 0: no margins, or no contact
  size_t touching;      ///< cells that forces are sums over; 0: all, or none (ContactEstimate)
  /// Of a plan with constraints: how many of its own standard deviations any cell, force or moment
  /// may be off since steps towards the constraints ended; proven for this frame.
  double unfinished;
  double unfinished_share;  ///< the same as a share of the linear frame
  size_t steps;             ///< that were taken; 0: the plan has no constraints
  ptrdiff_t outlier;        ///< index of the reading that the others explain least; -1: none
  size_t age;               ///< frames refused since the one that this answers; 0: this frame
  bool contact;             ///< something presses
  bool pulls;               ///< the normal force is negative beyond noise: no contact pulls
  bool implausible;         ///< the pad would be strained by more than 1
  bool misfit;              ///< the residual is more than noise explains
  bool beyond_edge;         ///< the contact may reach beyond what is seen
  bool baseline_moved;      ///< record a new baseline while nothing touches
  bool saturated;           ///< a live reading stands at the end of its range
} tactile_net_estimate;

/// One contact of a frame where several lie apart, as ContactRow. Forces of a line are in N/m,
/// those of a skin in N; NaN where it is not known.
typedef struct tactile_net_contact {
  double normal_force;     ///< [N/m], of a skin [N]
  double force_deviation;  ///< of it [N/m], of a skin [N]
  double tangential_y;     ///< of a line its tangential force [N/m]; of a skin [N]
  double tangential_z;     ///< of a skin [N]
  double centre_y_m;       ///< of pressure [m]
  double centre_z_m;       ///< of a skin [m]
  double torsion_n_m;      ///< of a skin [N m]
  double friction_margin;  ///< mu F - |drag| [N/m], of a skin [N]
  double slip_margin;      ///< of a skin
  size_t cells;            ///< that touch
  uint32_t id;             ///< from 1 on; stays with the contact over the frames of one handle
} tactile_net_contact;

/// Contacts that a frame tells one by one, at most.
#define TACTILE_NET_MOST_CONTACTS 16

/// Numbers that readings may be, in the byte order of the machine.
typedef enum tactile_net_type {
  TACTILE_NET_FLOAT64 = 0,
  TACTILE_NET_FLOAT32 = 1,
  TACTILE_NET_INT16 = 2,
  TACTILE_NET_UINT16 = 3,
  TACTILE_NET_INT32 = 4
} tactile_net_type;

/// Readings where a driver has them. Numbers need not be aligned; what lies between is not read.
typedef struct tactile_net_readings {
  const void* first;
  size_t count;
  tactile_net_type type;
  ptrdiff_t stride;  ///< bytes from one to the next, any; 0: one after the other
  double scale;      ///< by which each is multiplied; 0: as they are
} tactile_net_readings;

/// What a loop asks for besides; all of it is off at first.
typedef struct tactile_net_options {
  bool flush_denormals;  ///< take numbers below 2.2e-308 as 0 while a frame is computed
  bool hold;             ///< a refused frame gets the last good answer, with its `age`
  size_t contacts;       ///< told one by one, at most so many (tactile_net_contacts); 0: none
} tactile_net_options;

/// Frames since the estimator was made, a copy too.
typedef struct tactile_net_counters {
  uint64_t frames;      ///< all that came
  uint64_t wrong_size;  ///< of them refused, by status
  uint64_t not_finite;
  uint64_t too_large;
} tactile_net_counters;

/// What tactile_net_prepare has achieved.
typedef struct tactile_net_preparation {
  size_t bytes;  ///< of the estimator's memory
  bool locked;   ///< all of it: the system will not take it away
} tactile_net_preparation;

typedef struct tactile_net_estimator tactile_net_estimator;

// Before the loop: these calls allocate, read files, and take long.

/// TACTILE_NET_INTERFACE of the library that is linked.
int tactile_net_interface(void);

/// Loads a plan's file, and makes it ready. Null on failure: tactile_net_last_error() says why.
/// @param version  TACTILE_NET_INTERFACE; a library of another one refuses
/// @param path     of the file that `tactile-net plan -o` or encode_plan wrote
tactile_net_estimator* tactile_net_load(int version, const char* path);

/// The same of a file's bytes. They are not needed afterwards.
tactile_net_estimator* tactile_net_decode(int version, const void* bytes, size_t size);

/// An estimator of its own for another thread or patch, with the same baseline and dead taxels. It
/// shares the plan's matrices. Null on failure. No other call may use `estimator` meanwhile.
tactile_net_estimator* tactile_net_copy(const tactile_net_estimator* estimator);

/// @param estimator  may be null
void tactile_net_destroy(tactile_net_estimator* estimator);

/// Why the last call on this thread that returned null did so: one line, without a line feed; ""
/// where none did. Valid until the next such call.
const char* tactile_net_last_error(void);

/// From the next frame on; copies have the same.
void tactile_net_set_options(tactile_net_estimator* estimator, const tactile_net_options* options);

/// In the loop's thread, last of all before it: the first frame then takes as long as any. Locks
/// memory where the system allows it, and runs frames that nobody sees (ContactEstimator::prepare).
/// @param result  may be null
void tactile_net_prepare(tactile_net_estimator* estimator, tactile_net_preparation* result);

// In the loop: no allocation, no lock, no system call; time is bounded.

/// Valid as long as the estimator is.
const tactile_net_plan* tactile_net_plan_of(const tactile_net_estimator* estimator);

/// One frame.
/// @param readings   as the plan is for: channel after channel, or raw numbers
/// @param count      how many they are
/// @param time_s     passed through [s]
/// @param tractions  [Pa], room for plan->tractions values; may be the readings' memory; null: they
///                   are not wanted
/// @param estimate   may be null. Both are untouched unless TACTILE_NET_OK is returned, or the last
///                   good answer is held (tactile_net_options).
tactile_net_status tactile_net_update(tactile_net_estimator* estimator, const double* readings,
                                      size_t count, double time_s, double* tractions,
                                      tactile_net_estimate* estimate);

/// The same of readings in a driver's own numbers, with the bits that a copy of them in doubles
/// gives. A type that there is not is a wrong size.
tactile_net_status tactile_net_update_from(tactile_net_estimator* estimator,
                                           const tactile_net_readings* readings, double time_s,
                                           double* tractions, tactile_net_estimate* estimate);

/// The contacts of the last frame that was answered, one by one: of a skin the strongest first, of
/// a line from left to right. None unless tactile_net_options asks for them.
/// @param contacts  room for `room` of them
/// @return how many were written
size_t tactile_net_contacts(const tactile_net_estimator* estimator, tactile_net_contact* contacts,
                            size_t room);

/// What the sensors read without contact, from the next frame on. Not TACTILE_NET_OK: the old
/// baseline stays.
tactile_net_status tactile_net_set_baseline(tactile_net_estimator* estimator,
                                            const double* readings, size_t count);

tactile_net_status tactile_net_set_baseline_from(tactile_net_estimator* estimator,
                                                 const tactile_net_readings* readings);

/// Leaves a taxel out, in all channels, from the next frame on.
/// @return false, and nothing changes: ContactEstimator::set_dead says when
bool tactile_net_set_dead(tactile_net_estimator* estimator, size_t taxel);

/// All taxels that tactile_net_set_dead left out count again.
void tactile_net_revive(tactile_net_estimator* estimator);

/// Of a plan with constraints: steps of a frame from now on, at most 64 (0: the plan's), and the
/// `unfinished` at which it ends before (0: it takes all of them). Without constraints nothing.
void tactile_net_set_work(tactile_net_estimator* estimator, size_t steps, double enough);

/// Of a plan with constraints: while it is set, frames end with the step that they are at, and
/// return what they have, with its `unfinished`. This call alone may come from another thread, or
/// from a signal's handler, at any time.
void tactile_net_stop(tactile_net_estimator* estimator, bool stop);

void tactile_net_get_counters(const tactile_net_estimator* estimator,
                              tactile_net_counters* counters);
void tactile_net_reset_counters(tactile_net_estimator* estimator);

/// "ok", "wrong_size", "not_finite", "too_large"; of any other number "unknown".
const char* tactile_net_status_name(int status);

#ifdef __cplusplus
}
#endif
// NOLINTEND(modernize-*,readability-identifier-naming)

#endif
