#include "tactile_net/report/words/remark_words.hpp"

#include <algorithm>
#include <ostream>
#include <variant>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/report/words/mode_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::report {
namespace {

namespace remark = lab::remark;

std::string say(const remark::NoiseAmplified& r) {
  return "errors of the readings reach the traction multiplied by up to " + brief(r.gain);
}
std::string say(const remark::SignChanges& r) {
  return "the kernel's DFT changes sign at " + std::to_string(r.frequencies) +
         " frequencies: what lies between is not measured";
}
std::string say(const remark::DeadTaxelsRead&) {
  return "dft takes a dead taxel's zero for a reading";
}
std::string say(const remark::CutOff&) {
  return "the readings have not died away at the array's ends: dft takes the array for a ring, and "
         "what is cut off comes back amplified";
}
std::string say(const remark::LowerBound&) {
  return "the outermost taxels, or places beside dead ones, are pressed as hard as any: the "
         "contact "
         "may reach where no taxel sees, and the force found is a lower bound; move the contact "
         "under live taxels";
}
std::string say(const remark::NotOneContact&) {
  return "contact_friction assumes one contact in the middle of the array, and these are not the "
         "readings of one";
}
std::string say(const remark::DragInNoise&) {
  return "noise could hide a tenth of what contact_friction adds to the readings: the tangential "
         "traction is more an assumption than a measurement";
}

std::string say(const remark::NullMode& r) {
  return "the sensors cannot see " + in_words(r.mode) + ": it is set to zero, not measured";
}

std::string say(const remark::NotConverged& r) {
  return "conjugate gradients stopped after " + std::to_string(r.steps) + " steps, about " +
         brief(r.estimate) + " from the minimiser; raise alpha";
}
std::string say(const remark::IterationLimit& r) {
  return "stopped after " + std::to_string(r.iterations) +
         " active sets: the constraints hold, but the fit is not the best";
}
std::string say(const remark::NoBands&) {
  return "no uncertainty is given for an array as large as this";
}
std::string say(const remark::Unexplained& r) {
  return "the answer leaves " + percent(r.share) +
         " of the readings unexplained: alpha is far too large, or they are noise";
}
std::string say(const remark::Rounding& r) {
  return "rounding alone may have moved the answer by " + brief(r.bound) +
         " of its size; raise alpha";
}
std::string say(const remark::EstimatedWeight& r) {
  return "tangential_weight = " + brief(r.value) +
         ", estimated from the readings: the tangential traction is expected to be about 1/" +
         brief(r.value) + " = " + brief(1.0 / r.value) + " times the normal one";
}
std::string say(const remark::OffsetsFound& r) {
  return "each channel's readings have an offset that is not known, found with the tractions: " +
         in_words(r);
}
std::string say(const remark::ModelError& r) {
  return "the residual is larger than the noise stated explains: the model is off by about " +
         brief(r.times) + " times the noise; the bands " +
         (r.held ? "include that, as if it were noise" : "do not include that");
}
std::string say(const remark::FlatKernel& r) {
  return "the skin is curved and kernel = \"flat\" takes it for flat: the force is about " +
         percent(r.share) + " off; leave kernel out";
}
std::string say(const remark::MixtureLeftOut&) {
  return "the answer is that of one alpha: all that the readings leave possible has narrower "
         "bands, "
         "and takes long on this skin; answer = \"mixture\" under [reconstruct] asks for it";
}
std::string say(const remark::Clipped& r) {
  constexpr std::size_t most = 12;
  const std::size_t shown = std::min(r.names.size(), most);
  std::string which = (r.names.size() == 1 ? "taxel " : "taxels ") +
                      join({r.names.begin(), r.names.begin() + std::ptrdiff_t(shown)}, ", ");
  if (r.names.size() > most) which += " and " + std::to_string(r.names.size() - most) + " more";
  if (r.left_out)
    return which +
           " read the end of the range and are left out, as if dead: what presses there is "
           "guessed from the others, and may be more";
  if (r.range_known) return which + " read the end of the range: the force found is too small";
  return which +
         " hold one largest value, as at the end of a range: the force found is too small; state "
         "the range under [saturation] to leave them out";
}
std::string say(const remark::DataDoubted& r) { return in_words(r); }
std::string say(const remark::Hidden& r) {
  return "the sensors cannot see this: " + in_words(r.modes) +
         "; there the answer is a guess by smoothness (see identify)";
}
std::string say(const remark::ConstraintsIgnored&) {
  return "only the method tikhonov obeys the constraints";
}
std::string say(const remark::VoltagesUnresolved& r) {
  return "P has condition number " + brief(r.condition) +
         ": rounding alone may change the voltages by " + brief(r.limit) + "; raise alpha";
}

std::string say(const remark::FrictionUnseen&) {
  return "the scene has friction, but only the normal traction is solved for: what the tangential "
         "traction adds to the readings is counted as pressure; read a second quantity, such as "
         "shear_xy";
}
std::string say(const remark::ForceBeyondEnds& r) {
  return percent(r.share) + " of the normal force lies beyond the ends of the array";
}

std::string say(const remark::NoContact&) {
  return "the scene has no contact: its readings are noise, and so is an alpha that a rule chooses "
         "on them";
}

}  // namespace

std::string in_words(const lab::SceneRemark& remark) {
  return std::visit([](const auto& one) { return say(one); }, remark);
}

std::vector<std::string> in_words(const lab::SimulatedFrame& frame) {
  std::vector<std::string> sentences;
  for (const lab::SceneRemark& one : frame.remarks) sentences.push_back(in_words(one));
  for (const CutOffNote& note : frame.notes) sentences.push_back(in_words(note));
  return sentences;
}

std::string in_words(const lab::remark::OffsetsFound& offsets) {
  std::vector<std::string> each;
  for (const lab::remark::ChannelOffset& one : offsets.channels)
    each.push_back(one.channel + ' ' + in_unit(offsets.units, one.dimension, one.value));
  return join(each, ", ");
}

std::string in_words(const lab::Remark& remark) {
  return std::visit([](const auto& one) { return say(one); }, remark);
}

bool is_note(const lab::Remark& remark) {
  return std::holds_alternative<lab::remark::EstimatedWeight>(remark) ||
         std::holds_alternative<lab::remark::OffsetsFound>(remark);
}

std::vector<std::string> in_words(const lab::Remarks& remarks) {
  std::vector<std::string> sentences;
  for (const lab::Remark& one : remarks) sentences.push_back(in_words(one));
  return sentences;
}

Sentences warnings_and_notes(const lab::Remarks& remarks) {
  Sentences said;
  for (const lab::Remark& one : remarks)
    (is_note(one) ? said.notes : said.warnings).push_back(in_words(one));
  return said;
}

std::vector<std::string> Sentences::all() const {
  std::vector<std::string> sentences = warnings;
  sentences.insert(sentences.end(), notes.begin(), notes.end());
  return sentences;
}

void print_remarks(std::ostream& out, std::string_view before, const Sentences& said) {
  for (const std::string& warning : said.warnings) out << before << "warning: " << warning << '\n';
  for (const std::string& note : said.notes) out << before << "note: " << note << '\n';
}

}  // namespace tactile_net::report
