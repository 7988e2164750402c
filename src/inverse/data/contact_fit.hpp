/// @file
/// What the judge of readings (frame_judge.hpp) asks of a fit: contacts whose readings come near a
/// frame. Private.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

class KeptContacts;

/// How much friction contacts may have.
enum class Friction {
  stated,  ///< up to the stated limit; where none is stated, up to `usual_friction`
  likely,  ///< up to more than the stated limit: the limit itself may be what is wrong
};

/// A problem, and what its frames are compared with.
struct JudgedProblem {
  /// @param of  kept by reference
  /// @throw std::invalid_argument  a limit is not > 0, or there is not one for each row
  JudgedProblem(const LinearProblem& of, DataLimits given);

  /// Up to which limit; absent: there are no tangential tractions.
  [[nodiscard]] std::optional<double> limit_of(Friction friction) const noexcept;
  /// Whether contacts of likely friction are more than those of the stated one.
  [[nodiscard]] bool is_friction_limited() const noexcept {
    return limits.friction_limit && problem.components > 1;
  }
  /// The part of tractions that a contact allows, place by place: pulls become 0, and drags beyond
  /// the limit are cut to it.
  [[nodiscard]] std::vector<double> pressing(Friction friction,
                                             std::span<const double> tractions) const;
  /// What the norm of a residual over the noise exceeds in one honest frame of a thousand.
  /// @param taken  rows by something else than noise
  [[nodiscard]] double limit(double taken) const;

  const LinearProblem& problem;
  DataLimits limits;
  double unit;  ///< of all that is weighted: the noise, where it is known
  double rows;  ///< independent ones
  double most;  ///< `limit(0)`
};

/// @throw std::invalid_argument  contacts are sought on other rows, components or offsets than
///                               those of the problem
void check_contacts(const LinearProblem& problem, const LinearProblem& contacts);

/// A frame as fits take it.
struct JudgedFrame {
  std::span<const double> readings{};  ///< g
  std::vector<double> rows{};          ///< P W g
  std::vector<double> seen{};          ///< the same over the noise
};

/// @param unit  of all that is weighted
[[nodiscard]] JudgedFrame judged_frame(const LinearProblem& of, double unit,
                                       std::span<const double> readings);

[[nodiscard]] std::vector<double> negated(std::span<const double> values);

/// The same frame with its sign turned round.
struct TurnedFrame : JudgedFrame {
  explicit TurnedFrame(const JudgedFrame& of)
      : JudgedFrame{{}, negated(of.rows), negated(of.seen)}, values(negated(of.readings)) {
    readings = values;
  }
  TurnedFrame(const TurnedFrame&) = delete;
  TurnedFrame& operator=(const TurnedFrame&) = delete;

  std::vector<double> values;
};

/// What a contact leaves of a frame.
struct Unexplained {
  std::vector<double> residual{};                         ///< P W (g - K f) over the noise
  double norm = std::numeric_limits<double>::infinity();  ///< of the residual
  Friction friction = Friction::stated;                   ///< that the contact was allowed
  double fitted = 0.0;  ///< how many numbers the contact took; 0: the fit does not count them
  std::vector<std::ptrdiff_t> pressed{};  ///< places that press, as the fit numbers them
  std::vector<double> tractions{};        ///< the contact's [Pa], where the fit hands them on
  std::optional<std::size_t> step{};      ///< the one whose search found the contact to its end
};

/// Of one frame, and of the same with its sign turned round.
struct BothSigns {
  Unexplained as_read{}, turned{};
};

/// One constant in each channel beside a contact.
struct ChannelConstants {
  double norm = 0.0;             ///< of what both leave
  double count = 0.0;            ///< of the constants
  std::vector<double> values{};  ///< of each channel [its unit]
};

/// P W (g - K f) over the noise, by a problem's kernel.
[[nodiscard]] Unexplained left_by_tractions(const LinearProblem& of, double unit,
                                            const JudgedFrame& frame,
                                            std::span<const double> tractions);

/// What a contact that presses nowhere leaves: all of a frame.
[[nodiscard]] Unexplained nothing_explained(const JudgedFrame& frame, Friction friction);

/// Contacts of one problem. What has a default is of one kind of fit alone.
class ContactFit {
 public:
  explicit ContactFit(const JudgedProblem& judged) : p(judged) {}
  ContactFit(const ContactFit&) = delete;
  ContactFit& operator=(const ContactFit&) = delete;
  virtual ~ContactFit() = default;

  /// What these tractions leave.
  [[nodiscard]] virtual Unexplained left_by(const JudgedFrame& frame,
                                            std::span<const double> tractions) const {
    return left_by_tractions(p.problem, p.unit, frame, tractions);
  }
  /// What the best contact leaves; the search ends where that is `enough`. Absent: none is found.
  [[nodiscard]] virtual std::optional<Unexplained> contact(const JudgedFrame& frame,
                                                           Friction friction,
                                                           double enough) const = 0;

  /// What a contact near these tractions leaves, if it explains the frame and leaves no reading
  /// odd: the frame is a contact's then, whatever a longer search finds. Absent: none is found
  /// soon.
  /// @param pressing  tractions that a contact may have
  [[nodiscard]] virtual std::optional<Unexplained> settled_near(
      const JudgedFrame&, std::span<const double> /*pressing*/) const {
    return std::nullopt;
  }

  // One taxel of a frame that contacts explain. A search takes steps, each of which comes nearer.

  [[nodiscard]] virtual std::size_t steps() const noexcept = 0;
  /// What the nearest contact leaves where `found` is near enough, if that takes no steps.
  [[nodiscard]] virtual Unexplained nearest(const JudgedFrame&, Unexplained found) const {
    return found;
  }
  /// How far each reading is from what all others say of it.
  [[nodiscard]] virtual std::vector<double> apart(const Unexplained& found) const {
    return found.residual;
  }
  /// What the best contact of a step leaves. Absent: none is found.
  [[nodiscard]] virtual std::optional<Unexplained> all_left(const JudgedFrame& frame,
                                                            std::size_t step,
                                                            const Unexplained& found) const = 0;
  /// The same of the rest without a taxel, 0 at the taxel.
  /// @param all  what that step leaves of all
  [[nodiscard]] virtual std::optional<Unexplained> rest_left(const JudgedFrame& frame,
                                                             std::size_t step, std::size_t taxel,
                                                             const Unexplained& all) const = 0;

  // One taxel of a frame that no contact explains.

  /// Those of the suspects without which a contact may explain the rest.
  [[nodiscard]] virtual std::vector<std::size_t> worth_leaving_out(
      std::vector<std::size_t> suspects, const Unexplained&) const {
    return suspects;
  }
  /// What the best contact of any likely friction leaves without a taxel; the search ends where
  /// that is `enough`, or far from it. The residual may be missing.
  [[nodiscard]] virtual Unexplained least_rest(const JudgedFrame& frame, std::size_t taxel,
                                               double enough) const = 0;
  /// What taxels that may lie are compared by, smaller for the one that is likelier to.
  /// @param enough  norm of a residual of the rest that noise explains
  /// @param rest    what was found without the taxel
  [[nodiscard]] virtual double likeness(const JudgedFrame& frame, std::size_t taxel, double enough,
                                        const Unexplained& rest) const = 0;

  // The sign.

  /// By contacts of likely friction whose fitted numbers are counted. Absent: the fit does not
  /// tell, or sees from the tractions that the sign is right.
  [[nodiscard]] virtual std::optional<BothSigns> both_signs(
      const JudgedFrame& frame, std::span<const double> tractions) const = 0;
  /// Whether contacts explain with the other sign what none explains as it is.
  /// @param left  what the best contact leaves as it is
  [[nodiscard]] virtual bool explains_turned(const JudgedFrame&,
                                             const Unexplained& /*left*/) const {
    return false;
  }

  // Constants added to a channel.

  /// Of a frame that contacts explain, those without which only a contact larger than the array
  /// does.
  /// @param pressing  tractions that a contact may have, of those that were found
  [[nodiscard]] virtual std::optional<ChannelConstants> hidden_constants(
      const JudgedFrame&, std::span<const double> /*pressing*/) const {
    return std::nullopt;
  }
  /// Of a frame that no contact explains, those that leave least.
  [[nodiscard]] virtual std::optional<ChannelConstants> constants(const JudgedFrame&) const {
    return std::nullopt;
  }

  // Contacts of the frames before.

  [[nodiscard]] virtual bool remembers() const noexcept { return false; }
  /// What a kept contact leaves that is enough, and to which constants would add nothing.
  [[nodiscard]] virtual std::optional<Unexplained> recalled(const JudgedFrame&,
                                                            KeptContacts&) const {
    return std::nullopt;
  }
  virtual void remember(const Unexplained&, KeptContacts&) const {}

 protected:
  const JudgedProblem& p;
};

/// Contacts on a line, the nearest of which a non-negative least squares finds: all friction that a
/// place may have lies between two columns. O(rows x columns).
/// @param contacts  checked by `check_contacts`; not kept
[[nodiscard]] std::unique_ptr<const ContactFit> line_fit(const JudgedProblem& judged,
                                                         const LinearProblem& contacts);

/// Contacts on a skin, sought inside friction's cones with less and less smoothing, which takes
/// long, and so ends as soon as it can. O(1): cones are factored once, when a frame first needs
/// them.
/// @param contacts  called when a frame first needs one, and checked by `check_contacts`
[[nodiscard]] std::unique_ptr<const ContactFit> cone_fit(
    const JudgedProblem& judged, std::function<std::shared_ptr<const LinearProblem>()> contacts);

}  // namespace tactile_net
