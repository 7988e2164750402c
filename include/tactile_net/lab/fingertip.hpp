/// @file
/// A finger of a hand's file made ready: its contact read, or reconstructed from readings.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tactile_net/grasp/finger.hpp"
#include "tactile_net/grasp/fingertip_force.hpp"
#include "tactile_net/inverse/contact_patch.hpp"
#include "tactile_net/lab/remark.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/verdict.hpp"

namespace tactile_net::lab {

namespace remark {
/// The reconstruction has an answer, but not one to trust without a look.
struct Doubtful {
  Verdict verdict = Verdict::ok;
};
/// The sensor does not see the tangential force: it is taken for zero.
struct TangentialUnseen {};
/// Contacts lie apart on the pad: friction is judged by the one nearest to slipping.
struct SeveralContacts {};
}  // namespace remark

/// What a user should know of a fingertip's force before trusting it.
using FingertipRemark = std::variant<SceneRemark, Remark, CutOffNote, remark::Doubtful,
                                     remark::TangentialUnseen, remark::SeveralContacts>;

struct Fingertip {
  /// What the contact is known from.
  enum class Source { assumed, resultant, tractions, readings, simulated };

  Finger finger{};  ///< with its pad
  FingerPose pose{};
  ContactPlace place{};
  std::optional<FingertipForce> force{};  ///< absent: the contact is only assumed
  /// Of several contacts that lie apart on the pad, the one by which friction is judged: the force
  /// is their sum, and may be held where each of them slips. Absent: there is one.
  std::optional<FingertipForce> nearest_to_slipping{};
  Source source = Source::assumed;
  std::filesystem::path file{};  ///< of the source, as the hand's file names it; empty: none
  std::size_t frame = 0;         ///< row of that file, from 0
  /// Each contact on the pad by itself, the strongest first: where readings tell them. Forces are
  /// those of the whole breadth [N].
  std::vector<ContactPatch> patches{};
  std::vector<FingertipRemark> remarks{};
};

}  // namespace tactile_net::lab

template <>
struct tactile_net::Enumerators<tactile_net::lab::Fingertip::Source> {
  using Source = lab::Fingertip::Source;
  static constexpr Enumerator<Source> all[] = {
      {Source::assumed, "assumed", "Its place is assumed; its force is not known."},
      {Source::resultant, "resultant", "The hand's file gives its force."},
      {Source::tractions, "tractions", "A file of tractions."},
      {Source::readings, "readings", "A file of readings, reconstructed."},
      {Source::simulated, "simulated", "A scene's contacts, simulated and reconstructed."}};
};

namespace tactile_net::lab {

/// The spelling in JSON: "assumed", "resultant", "tractions", "readings", "simulated".
[[nodiscard]] std::string_view name(Fingertip::Source source) noexcept;

}  // namespace tactile_net::lab
