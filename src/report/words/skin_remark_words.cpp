#include "report/words/skin_remark_words.hpp"

#include <cmath>

#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/summary_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::report {

std::string offsets_in_words(const SkinScene& scene, std::span<const double> offsets) {
  std::vector<std::string> each;
  for (const SkinChannel& channel : channels(scene.sensor))
    each.push_back(
        channel.name + ' ' +
        in_unit(scene.units, dimension_of(traits(channel.quantity).kind), offsets[each.size()]));
  return offsets_found(each);
}

namespace {

/// "1.2 % too narrow".
std::string off_in_words(double off) {
  return percent(std::abs(off)) + (off < 0.0 ? " too narrow" : " too wide");
}

}  // namespace

std::string without_matrix(const lab::SkinAnswer& answer) {
  const bool constrained = answer.cone.has_value();
  const std::size_t steps = constrained ? answer.cone->iterations : answer.iteration->steps;
  const auto& bands = answer.iteration->bands;
  return "more tractions than a dense matrix takes: solved by products, in " +
         std::to_string(steps) + (constrained ? " projected gradients" : " conjugate gradients") +
         "; alpha's traces are means over random probes, bands of forces one solve each with that "
         "alpha, those of single cells estimates, " +
         off_in_words(bands.least) + " to " + off_in_words(bands.most) + " at the " +
         counted(bands.tractions, "traction") + " whose band was solved for" +
         (constrained ? "; these are those without constraints, wider than need be" : "");
}

void add_missing(std::vector<Answer>& all, const lab::SkinRecordingAnswer& recording) {
  const auto add = [&](const lab::FrameRuns& runs, const char* what) {
    if (runs.count() > 0)
      all.push_back(
          {std::to_string(runs.count()) + " of " + std::to_string(recording.frames.size()),
           std::string(what) + in_words(runs), true});
  };
  add(recording.skipped(), "frames miss readings and have no answer: ");
  add(recording.estimated(), "frames miss readings and are solved without the taxels that miss: ");
}

}  // namespace tactile_net::report
