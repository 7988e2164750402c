#include "lab/fingertip_maker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "lab/referred_file.hpp"
#include "numeric/named.hpp"
#include "realtime/line_contacts.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/sensing/resultant.hpp"

namespace tactile_net::lab {
namespace {

/// Half as wide as what belongs to the taxels.
double half_width(std::size_t count, double pitch) {
  return 0.5 * static_cast<double>(count) * pitch;
}
double half_width(const SensorArray& array) {
  if (is_even(array)) return half_width(array.count, array.pitch);
  return std::max(std::abs(array.taxels.front().y), std::abs(array.taxels.back().y)) +
         0.5 * array.pitch;
}

/// A resultant whose deviations are not known.
UncertainResultant certain(const Resultant& sum, bool has_tangential) {
  UncertainResultant result;
  result.normal = {sum.normal, 0.0};
  if (has_tangential) result.tangential = Uncertain{sum.tangential, 0.0};
  if (const auto centre = sum.centre()) result.centre = Uncertain{*centre, 0.0};
  return result;
}

UncertainResultant certain(std::span<const double> normal, std::span<const double> tangential,
                           const Surface& surface) {
  return certain(resultant_of(normal, tangential, surface), !tangential.empty());
}

/// Of the contact that needs the most friction; absent: there is one.
std::optional<UncertainResultant> certain_nearest_to_slipping(std::span<const double> normal,
                                                              std::span<const double> tangential,
                                                              const Surface& surface) {
  if (tangential.empty()) return std::nullopt;
  const LineContact worst =
      nearest_to_slipping(normal.data(), tangential.data(), normal.size(), 0.0);
  if (worst.contacts < 2) return std::nullopt;
  return certain(resultant_between(worst.first, worst.last, normal, tangential, surface), true);
}

/// Takes a resultant for the fingertip's force, and of several contacts the one nearest to
/// slipping.
void press(Fingertip& tip, const UncertainResultant& resultant,
           const std::optional<UncertainResultant>& worst, double breadth) {
  if (!resultant.centre)
    fail_fingertip(tip, "the normal force is " + brief(resultant.normal.value) +
                            ", and must be > 0: nothing presses on the pad");
  tip.force = fingertip_force(resultant, breadth);
  if (worst) {
    tip.nearest_to_slipping = fingertip_force(*worst, breadth);
    tip.remarks.emplace_back(remark::SeveralContacts{});
  }
  if (!resultant.tangential) tip.remarks.emplace_back(remark::TangentialUnseen{});
  const double end = tip.finger.pad.half_width;
  if (std::abs(tip.force->centre) > end)
    fail_fingertip(tip, "the centre of pressure is at " + brief(tip.force->centre) +
                            ", outside the fingertip, which ends at " + brief(end));
}

constexpr const char* explain_tractions = "docs/hand.md says what it should hold";

constexpr Named<Fingertip::Source> sources[] = {{Fingertip::Source::assumed, "assumed"},
                                                {Fingertip::Source::resultant, "resultant"},
                                                {Fingertip::Source::tractions, "tractions"},
                                                {Fingertip::Source::readings, "readings"},
                                                {Fingertip::Source::simulated, "simulated"}};

}  // namespace

FingertipMaker::ReadyScene::ReadyScene(const std::filesystem::path& path)
    : problem(unquoted(explain_scene, [&] { return read_scene(path); })),
      solver(make_solver(problem, Method::tikhonov)) {}

FingertipMaker::FingertipMaker(std::filesystem::path folder, const FrameOf& frame_of)
    : folder_(std::move(folder)), frame_of_(frame_of) {}

FingertipMaker::ReadyScene& FingertipMaker::ready(const std::filesystem::path& scene) {
  const std::filesystem::path path = folder_ / scene;
  return scenes_.try_emplace(path, path).first->second;
}

void FingertipMaker::press(Fingertip& tip, const HandFinger& finger,
                           const TractionFile& source) const {
  if (!frame_of_.tractions)
    throw std::invalid_argument("the hand names a file of tractions, and FrameOf reads none");
  require_regular(folder_ / source.file);
  const TractionField f = unquoted(
      explain_tractions, [&] { return frame_of_.tractions(folder_ / source.file, source.frame); });
  tip.finger = finger.with_pad(half_width(f.normal.size(), source.pitch));
  const Surface surface{.count = f.normal.size(), .spacing = source.pitch};
  lab::press(tip, certain(f.normal, f.tangential, surface),
             certain_nearest_to_slipping(f.normal, f.tangential, surface), finger.breadth);
}

std::vector<double> FingertipMaker::readings_of(Fingertip& tip, const FingertipScene& source,
                                                const Scene& scene) const {
  if (source.readings) {
    if (!frame_of_.readings)
      throw std::invalid_argument("the hand names a file of readings, and FrameOf reads none");
    require_regular(folder_ / *source.readings);
    return unquoted(explain_readings, [&] {
      return frame_of_.readings(folder_ / *source.readings, scene, source.frame);
    });
  }
  if (scene.contacts.empty()) throw nothing_presses(folder_ / source.scene);
  SimulatedFrame simulated = simulate(scene);
  tip.remarks.insert(tip.remarks.end(), simulated.remarks.begin(), simulated.remarks.end());
  tip.remarks.insert(tip.remarks.end(), simulated.notes.begin(), simulated.notes.end());
  return std::move(simulated.readings);
}

void FingertipMaker::press(Fingertip& tip, const HandFinger& finger, const FingertipScene& source) {
  const ReadyScene& scene = ready(source.scene);
  const SensorArray& array = scene.problem.scene().sensor;
  tip.finger = finger.with_pad(half_width(array));
  const SceneFrame frame(scene.problem, readings_of(tip, source, scene.problem.scene()));
  std::vector<double> f(scene.solver->tractions());
  const FrameResult result = scene.solver->solve(frame.readings(), f);
  if (result.status != FrameStatus::ok)
    fail_fingertip(tip, "the frame's tractions overflow a double");
  tip.remarks.insert(tip.remarks.end(), result.remarks.begin(), result.remarks.end());
  if (!is_faultless(result.verdict)) tip.remarks.emplace_back(remark::Doubtful{result.verdict});
  if (!scene.problem.has_bands()) {
    tip.remarks.emplace_back(remark::NoBands{});
    const Surface& surface = scene.problem.surface();
    const auto normal = std::span<const double>(f).first(surface.count);
    const auto tangential = std::span<const double>(f).subspan(surface.count);
    lab::press(tip, certain(normal, tangential, surface),
               certain_nearest_to_slipping(normal, tangential, surface), finger.breadth);
    return;
  }
  const FrameUncertainty bands = uncertainty(frame, f, result);
  const std::array<double, 9>& covariance = bands.resultant.covariance;
  if (!std::all_of(covariance.begin(), covariance.end(),
                   [](double value) { return std::isfinite(value); }))
    fail_fingertip(tip, "the frame's tractions overflow a double");
  if (const auto off = model_error(bands.noise, bands.holds_model_error))
    tip.remarks.emplace_back(*off);
  lab::press(tip, bands.resultant, bands.nearest_to_slipping, finger.breadth);
}

Fingertip FingertipMaker::make(const HandFinger& finger) {
  Fingertip tip{.finger = finger.with_pad(0.0)};
  if (const auto* place = std::get_if<ContactPlace>(&finger.contact)) {
    tip.place = *place;
  } else if (const auto* force = std::get_if<FingertipForce>(&finger.contact)) {
    tip.source = Fingertip::Source::resultant;
    tip.force = *force;
  } else if (const auto* tractions = std::get_if<TractionFile>(&finger.contact)) {
    tip.source = Fingertip::Source::tractions;
    tip.file = tractions->file;
    tip.frame = tractions->frame;
    press(tip, finger, *tractions);
  } else if (const auto* scene = std::get_if<FingertipScene>(&finger.contact)) {
    tip.source = scene->readings ? Fingertip::Source::readings : Fingertip::Source::simulated;
    tip.file = scene->readings.value_or(scene->scene);
    tip.frame = scene->frame;
    press(tip, finger, *scene);
  }
  if (tip.force) tip.place = place_of(*tip.force);
  tip.pose = pose_of(tip.finger);
  check_bent(tip.finger, tip.pose, contact_point(tip.pose, tip.place.centre));
  return tip;
}

std::string_view name(Fingertip::Source source) noexcept { return name_in<sources>(source); }

}  // namespace tactile_net::lab
