#include "report/json/finding_json.hpp"

#include "tactile_net/report/words/check_words.hpp"

namespace tactile_net::report {
namespace {

namespace finding = lab::finding;

// The numbers of each kind.
Json numbers(const finding::NoFrames&) { return Json::object(); }
Json numbers(const finding::TimeBackwards& f) {
  return {{"count", f.count}, {"first", f.first}, {"rollovers", f.rollovers}};
}
Json numbers(const finding::TimeRepeats& f) { return {{"count", f.count}, {"first", f.first}}; }
Json numbers(const finding::FramesRepeat& f) { return {{"frames", runs_json(f.frames)}}; }
Json numbers(const finding::ValuesMissing& f) {
  return {{"values", f.values}, {"frames", runs_json(f.frames)}, {"taxels", f.taxels}};
}
Json numbers(const finding::CodesForMissing& f) {
  Json codes = Json::array();
  for (const finding::CodesForMissing::Code& code : f.codes)
    codes.push_back({{"number", code.number}, {"fields", code.fields}, {"frames", code.frames}});
  return {{"codes", codes}};
}
Json numbers(const finding::SignsLost& f) {
  return {{"channels", f.channels}, {"codes", f.codes}, {"jumps", f.jumps}};
}
Json numbers(const finding::FramesNormalised& f) {
  return {{"number", f.number}, {"frames", f.frames}};
}
Json numbers(const finding::SlowChannels& f) {
  return {{"channels", f.channels}, {"every", f.every}, {"last", f.last}, {"all", f.all}};
}
Json numbers(const finding::DeadTaxels& f) { return {{"taxels", f.taxels}}; }
Json numbers(const finding::StuckTaxels& f) {
  return {{"taxels", f.taxels}, {"worst", f.worst}, {"first", f.first}, {"frames", f.frames}};
}
Json numbers(const finding::NoisyTaxels& f) {
  return {{"taxels", f.taxels}, {"worst", f.worst}, {"times", f.times}};
}
Json numbers(const finding::SingleFrameSpikes& f) {
  return {{"taxels", f.taxels},
          {"worst", f.worst},
          {"frame", f.frame},
          {"frames", f.frames},
          {"times", f.times}};
}
Json numbers(const finding::EqualReadings& f) {
  return {{"groups", f.groups}, {"taxels", f.taxels}, {"frames", f.frames}};
}
Json numbers(const finding::SaturatedTaxels& f) {
  return {{"taxels", f.taxels}, {"limit", f.limit}, {"frames", f.frames}};
}
Json numbers(const finding::WornTaxels& f) {
  return {{"taxels", f.taxels}, {"worst", f.worst}, {"share", f.share}};
}
Json numbers(const finding::TaxelsLeftOut& f) { return {{"taxels", f.taxels}}; }
Json numbers(const finding::Baseline& f) {
  return {{"values", f.values},
          {"frames", f.frames},
          {"largest", f.largest},
          {"times", f.times},
          {"loaded", f.loaded}};
}
Json numbers(const finding::ZeroUnderLoad& f) {
  return {{"force", f.force}, {"first", f.first}, {"last", f.last}};
}
Json numbers(const finding::Drift& f) {
  return {{"largest", f.largest},
          {"times", f.times},
          {"from", f.from},
          {"to", f.to},
          {"loaded", f.loaded}};
}
Json numbers(const finding::NoiseTaken& f) { return {{"of_channel", f.of_channel}}; }
Json numbers(const finding::NoiseDiffers& f) {
  return {{"channel", f.channel}, {"estimated", f.estimated}, {"stated", f.stated}};
}
Json numbers(const finding::NoiseColoured& f) { return {{"correlation", f.correlation}}; }
Json numbers(const finding::ResidualDiffers& f) { return {{"times", f.times}}; }
Json numbers(const finding::ScaleBy1000& f) { return {{"times", f.times}}; }
Json numbers(const finding::GainsChanged& f) {
  return {{"readings", f.readings}, {"changes", f.changes}, {"sds", f.sds}};
}
Json numbers(const finding::WholePadPulled& f) {
  return {{"pulled", f.pulled}, {"loaded", f.loaded}};
}
Json numbers(const finding::OrderMirrored& f) {
  return {{"along_y", f.along_y},
          {"along_z", f.along_z},
          {"exchanged", f.exchanged},
          {"frames", f.frames},
          {"of", f.of}};
}
Json numbers(const finding::OrderSerpentine& f) {
  return {{"columns", f.columns}, {"first", f.first}, {"frames", f.frames}, {"of", f.of}};
}
Json numbers(const finding::StrainTooLarge& f) { return {{"strain", f.strain}}; }
Json numbers(const finding::TractionExceedsModulus& f) { return {{"times", f.times}}; }
Json numbers(const finding::DeformationTiny& f) { return {{"times", f.times}}; }
Json numbers(const finding::MixedUnits& f) {
  return {{"modulus", f.modulus}, {"length", f.length}};
}
Json numbers(const finding::DepthBeyondArray& f) {
  return {{"depth", f.depth}, {"length", f.length}};
}
Json numbers(const finding::PitchCoarse& f) { return {{"pitch", f.pitch}, {"depth", f.depth}}; }

Json finding_json(const lab::Finding& one, const AnyScene& scene) {
  Json json = {
      {"kind", lab::name(one)}, {"text", in_words(one, scene)}, {"advice", advice(one, scene)}};
  json.update(std::visit([](const auto& found) { return numbers(found); }, one));
  return json;
}

}  // namespace

Json findings_json(const lab::Findings& findings, const AnyScene& scene) {
  Json list = Json::array();
  for (const lab::Finding& one : findings) list.push_back(finding_json(one, scene));
  return list;
}

}  // namespace tactile_net::report
