#include "tactile_net/lab/summary.hpp"

namespace tactile_net::lab {

void SolvedFrames::add(const FrameResult& result) {
  ++frames;
  ++verdicts[result.verdict];
  last = result;
}

void RecordedFrames::add(const SensorRecording& recording) {
  ++frames;
  for (const CutOffNote& note : recording.notes()) ++cut_off[std::string(note.effect)];
}

}  // namespace tactile_net::lab
