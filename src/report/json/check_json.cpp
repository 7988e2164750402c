#include "tactile_net/report/json/check_json.hpp"

#include <optional>
#include <utility>
#include <variant>

#include "report/json/document.hpp"
#include "report/json/finding_json.hpp"
#include "report/json/scene_json.hpp"

namespace tactile_net::report {
namespace {

Json clock_json(const lab::RecordingClock& clock) {
  if (clock.timed == 0) return nullptr;
  return {{"first", clock.first},           {"last", clock.last},
          {"in_seconds", clock.in_seconds}, {"rate", number_or_null(clock.rate())},
          {"longest_step", clock.longest},  {"backwards", clock.backwards},
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

Json units_of(const Scene& scene) { return units_json(*scene.units); }
Json units_of(const SkinScene& scene) { return skin_units_json(*scene.units); }

}  // namespace

std::string check_json(const lab::ReadingsCheck& check, const std::string& readings) {
  Json channels = Json::array();
  for (const lab::CheckedChannel& channel : check.channels)
    channels.push_back({{"name", channel.name},
                        {"least", channel.least},
                        {"largest", channel.largest},
                        {"noise", number_or_null(channel.noise)},
                        {"noise_stated", number_or_null(channel.stated)},
                        {"threshold", number_or_null(channel.threshold)}});
  const auto [file, units] = std::visit(
      [](const auto& scene) {
        return std::pair(scene.file, scene.units ? std::optional(units_of(scene)) : std::nullopt);
      },
      check.scene);
  Json json = document(kind::check);
  json.update(Json{{"scene", file},
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
                     {"never_let_go", check.never_let_go},
                     {"solved", check.solved}}},
                   {"residual", number_or_null(check.residual)},
                   {"findings", findings_json(check.findings, check.scene)}});
  if (units) json["units"] = *units;
  return text_of(json, 2);
}

}  // namespace tactile_net::report
