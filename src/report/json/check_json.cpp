#include "tactile_net/report/json/check_json.hpp"

#include "report/json/document.hpp"
#include "report/json/finding_json.hpp"
#include "report/json/scene_json.hpp"

namespace tactile_net::report {
namespace {

Json clock_json(const lab::RecordingClock& clock) {
  if (clock.timed == 0) return nullptr;
  return {{"first", clock.first},
          {"last", clock.last},
          {"rate", number_or_null(clock.rate())},
          {"longest_step", clock.longest},
          {"backwards", clock.backwards},
          {"repeats", clock.repeats}};
}

Json peak_json(const lab::ReadingsCheck& check) {
  if (!check.peak) return nullptr;
  return {{"frame", check.peak->frame},
          {"channel", check.channels[check.peak->channel].name},
          {"reading", check.peak->reading},
          {"traction", check.peak->traction},
          {"force", check.peak->force}};
}

}  // namespace

std::string check_json(const lab::ReadingsCheck& check, const std::string& readings) {
  Json channels = Json::array();
  for (const lab::CheckedChannel& channel : check.channels)
    channels.push_back({{"name", channel.name},
                        {"least", channel.least},
                        {"largest", channel.largest},
                        {"noise", number_or_null(channel.noise)},
                        {"noise_stated", number_or_null(channel.stated)}});
  Json json = document(kind::check);
  json.update(Json{{"scene", check.scene.file},
                   {"readings", readings},
                   {"frames", check.frames},
                   {"missing", check.missing},
                   {"time", clock_json(check.clock)},
                   {"channels", channels},
                   {"peak", peak_json(check)},
                   {"judged_by",
                    {{"groups", check.sampled},
                     {"still", check.still},
                     {"quiet", check.quiet},
                     {"solved", check.solved}}},
                   {"residual", number_or_null(check.residual)},
                   {"findings", findings_json(check.findings, check.scene)}});
  if (check.scene.units) json["units"] = units_json(*check.scene.units);
  return text_of(json, 2);
}

}  // namespace tactile_net::report
