#include "report/words/hidden_words.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "report/words/number_words.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/identify_words.hpp"
#include "tactile_net/report/words/mode_words.hpp"

namespace tactile_net::report {
namespace {

namespace reason = lab::hidden_reason;

std::string uniform(Traction component) {
  return "a uniform " + std::string(line_name(component)) + " traction (k = 0)";
}

std::string say(const reason::OneStrain&, const std::optional<Units>&) {
  return "Because strain_y is -strain_x at nu = 0.5: two strains at one depth are one quantity.";
}
std::string say(const reason::Proportional&, const std::optional<Units>&) {
  return "Because the quantities read answer to both tractions in the same proportion.";
}
std::string say(const reason::OddKernels& r, const std::optional<Units>&) {
  return "Because every kernel of a " + std::string(line_name(r.component)) +
         " traction read here is odd, what acts left and right of a taxel cancels: for " +
         uniform(r.component) +
         ", which shows only where it stops, and for one that alternates from taxel to taxel "
         "(Nyquist).";
}
std::string say(const reason::MeanUnread& r, const std::optional<Units>&) {
  return "Because none of the quantities read answers to " + uniform(r.component) +
         ", it shows only where it stops.";
}
std::string say(const reason::UnknownOffsets&, const std::optional<Units>&) {
  return "Because the offset of each channel is not known, what all of its taxels read alike says "
         "nothing: " +
         uniform(Traction::normal) + " shows only where it stops.";
}
std::string say(const reason::Symmetry& r, const std::optional<Units>&) {
  return "An odd number of taxels (" + std::to_string(r.taxels) + ") leaves " +
         (r.lost == 1 ? "one combination" : "some combinations") +
         " of tractions unmeasured, because of symmetry. An even number of taxels, or a second "
         "depth, would measure " +
         (r.lost == 1 ? "it." : "them.");
}
std::string say(const reason::FewReadings& r, const std::optional<Units>&) {
  return "The array has " + std::to_string(r.readings) + " readings, and " +
         std::to_string(r.tractions) + " tractions would be as many as its taxels can have.";
}
std::string say(const reason::DeadTaxels&, const std::optional<Units>&) {
  return "Dead taxels read nothing: what only they would show is lost.";
}
std::string say(const reason::Smoothing& r, const std::optional<Units>& units) {
  return "Because the pad smooths: of a ripple of wavelength " +
         length_in_words(units, r.wavelength) +
         ", about exp(-2 pi depth / wavelength) = " + brief(r.left) + " arrives at depth " +
         length_in_words(units, r.depth) + ".";
}

std::string waves(WaveDirection direction) {
  switch (direction) {
    case WaveDirection::along_y:
      return "waves along y";
    case WaveDirection::along_z:
      return "waves along z";
    case WaveDirection::diagonal:
      return "waves along the diagonals";
    default:
      return "any wave";
  }
}

/// What waves hide, in a column of a table: "curl", "curl along y", "mean of q".
std::string waves_in_short(const HiddenWaves& hidden) {
  if (hidden.direction == WaveDirection::mean) {
    std::vector<std::string> means;
    if (hidden.normal) means.emplace_back("p");
    if (hidden.divergence && hidden.curl)
      means.emplace_back("q");
    else if (hidden.divergence || hidden.curl)
      means.emplace_back(hidden.curl ? "q_z" : "q_y");
    if (hidden.mixed > 0) means.emplace_back("a mixture");
    return "mean of " + join(means, ", ");
  }
  std::vector<std::string> parts;
  if (hidden.normal) parts.emplace_back("p");
  if (hidden.divergence) parts.emplace_back("drag along");
  if (hidden.curl) parts.emplace_back("curl");
  if (hidden.mixed > 0) parts.push_back(counted(hidden.mixed, "mixture"));
  return join(parts, ", ");
}

/// Without what one kind of wave hides because all of them do.
HiddenWaves besides(HiddenWaves one, const HiddenWaves* any) {
  if (!any || one.direction == WaveDirection::any || one.direction == WaveDirection::mean)
    return one;
  one.normal = one.normal && !any->normal;
  one.divergence = one.divergence && !any->divergence;
  one.curl = one.curl && !any->curl;
  one.mixed -= std::min(one.mixed, any->mixed);
  return one;
}

std::vector<HiddenWaves> hidden_of(const lab::SensorChoice& choice) {
  const auto& all = choice.hidden;
  const bool for_all = !all.empty() && all.front().direction == WaveDirection::any;
  std::vector<HiddenWaves> some;
  for (const HiddenWaves& one : all)
    if (const HiddenWaves rest = besides(one, for_all ? &all.front() : nullptr); rest.count() > 0)
      some.push_back(rest);
  return some;
}

std::string mean_in_words(const HiddenWaves& hidden, const std::string& reads) {
  std::vector<std::string> means;
  if (hidden.normal) means.emplace_back("the pressure p");
  if (hidden.divergence) means.emplace_back("the drag q_y");
  if (hidden.curl) means.emplace_back("the drag q_z");
  if (hidden.mixed > 0) means.emplace_back("a mixture of pressure and drag");
  return "What is uniform of " + listed(means) + " shows in " + reads +
         " only where it stops, at the ends of the skin.";
}

/// Where nothing else has a word for it: p with drags.
std::string mixture_in_words(const HiddenWaves& hidden, const std::string& reads) {
  return counted(hidden.mixed, "mixture") + " of pressure and drags in " + waves(hidden.direction) +
         (hidden.mixed == 1 ? " is" : " are") + " not shown by " + reads +
         ": what one of them adds to the readings another takes away.";
}

/// Of waves, whatever their length.
std::vector<std::string> waves_hidden(const lab::SensorChoice& choice) {
  std::vector<std::string> names;
  for (const Quantity quantity : choice.reads) names.emplace_back(name(quantity));
  const std::string reads = listed(std::move(names));
  std::vector<std::string> text;
  for (const HiddenWaves& one : hidden_of(choice)) {
    if (one.direction == WaveDirection::mean) {
      text.push_back(mean_in_words(one, reads));
      continue;
    }
    const std::string of = one.direction == WaveDirection::any ? "" : " of " + waves(one.direction);
    const std::string none = " is seen by no depth of " + reads;
    if (one.curl)
      text.push_back(
          "The curl of q" + of + none +
          ": drags that run around a point, or across a wave, do not change these readings.");
    if (one.normal) text.push_back("The pressure p" + of + none + ".");
    if (one.divergence) text.push_back("The drag along the wave" + of + none + ".");
    if (one.mixed > 0) text.push_back(mixture_in_words(one, reads));
  }
  return text;
}

}  // namespace

std::string listed(std::vector<std::string> parts) {
  if (parts.size() < 2) return join(parts, "");
  const std::string last = std::move(parts.back());
  parts.pop_back();
  return join(parts, ", ") + " and " + last;
}

std::string hidden_in_short(const lab::SensorChoice& choice) {
  std::vector<std::pair<std::string, std::string>> all;  // what, and along which axes
  for (const HiddenWaves& one : hidden_of(choice)) {
    const std::string what = waves_in_short(one);
    std::string along;
    if (one.direction == WaveDirection::along_y) along = "y";
    if (one.direction == WaveDirection::along_z) along = "z";
    if (one.direction == WaveDirection::diagonal) along = "diagonals";
    if (!along.empty() && !all.empty() && all.back().first == what && !all.back().second.empty())
      all.back().second += ", " + along;
    else
      all.emplace_back(what, along);
  }
  std::vector<std::string> parts;
  for (const auto& [what, along] : all)
    parts.push_back(along.empty() ? what : what + " along " + along);
  return join(parts, "; ");
}

std::string in_words(const lab::HiddenReason& reason, const std::optional<Units>& units) {
  return std::visit([&](const auto& one) { return say(one, units); }, reason);
}

std::vector<std::string> hidden_in_words(const lab::Survey& survey,
                                         const std::optional<Units>& units) {
  const lab::SensorChoice& own = survey.own;
  if (survey.is_skin()) return waves_hidden(own);
  if (own.array->hidden == 0) return {};
  return {"Cannot tell: " + in_words(own.identifiability->null_space, units) + "."};
}

}  // namespace tactile_net::report
