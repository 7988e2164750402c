#include "commands/gen.hpp"

#include "commands/input.hpp"
#include "tactile_net/decks/deck_file.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/report/words/deck_words.hpp"

namespace tactile_net::tool {

void run(const GenOptions& options, const Streams& streams) {
  decks::refuse_deck(options.scene);
  const AnyScene scene = read_circuit_scene(options.scene, options.network, streams);
  frames::OutputFile output(options.output, &streams.out);
  output.stream() << report::deck_text(lab::simulated_circuit(scene), Answer::printed);
  output.commit();
}

}  // namespace tactile_net::tool
