#include "tactile_net/lab/summary.hpp"

namespace tactile_net::lab {

void SolvedFrames::add(const FrameResult& result) {
  ++frames;
  ++verdicts[result.verdict];
  last = result;
}

void RecordedFrames::add(const SensorRecording& recording) {
  ++frames;
  for (const std::string& note : recording.notes()) ++cut_off[note.substr(0, note.find(':'))];
}

}  // namespace tactile_net::lab
