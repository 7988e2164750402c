#include "commands/check.hpp"

#include <ostream>
#include <variant>
#include <vector>

#include "commands/input.hpp"
#include "commands/recording.hpp"
#include "commands/results.hpp"
#include "failure.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/lab/readings_check.hpp"
#include "tactile_net/report/json/check_json.hpp"
#include "tactile_net/report/words/check_words.hpp"
#include "terminal/printable_stream.hpp"

namespace tactile_net::tool {
namespace {

/// @param scene  of a line or a skin
lab::ReadingsCheck check_of(const auto& scene, const CheckOptions& options,
                            const Streams& streams) {
  frames::ReadingsFile file(options.readings, scene, &streams.in,
                            {.columns = options.columns, .accept_missing = true});
  frames::FrameSource& source = file.source();
  say_opening(streams.err, file.name(), source);
  lab::ReadingsChecker checker(scene);
  Progress progress(streams);
  std::vector<double> readings(source.columns().size());
  for (std::size_t frames = 0; source.next(readings); ++frames) {
    checker.add(source.seconds(), readings);
    if (progress.due()) progress.frames(frames, file.share_read());
  }
  if (!source.time_unit_known()) checker.times_without_unit();
  return checker.result(progress);
}

}  // namespace

void run(const CheckOptions& options, const Streams& streams) {
  const auto json = output_if(options.json, streams);
  check_one_standard_input(options.scene, options.readings);
  const lab::ReadingsCheck check =
      std::visit([&](const auto& scene) { return check_of(scene, options, streams); },
                 read_any_scene(options.scene, streams.in));
  if (options.json != "-") {
    PrintableStream out(streams.out);
    out << options.scene << ", " << options.readings << ": ";
    report::print_check(out, check);
  }
  if (json) write(json.get(), report::check_json(check, options.readings));
  if (options.strict && !check.findings.empty())
    throw CheckFailed(std::to_string(check.findings.size()) +
                      (check.findings.size() == 1 ? " suspicion" : " suspicions"));
}

}  // namespace tactile_net::tool
