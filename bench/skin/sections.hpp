/// @file
/// What bench_skin measures, a function a section. Each prints its floors.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/floors.hpp"

namespace bench {

/// One frame over summing the dense matrix once, beside dense products; of skins named as "16x3",
/// or of all where none is named.
void single_frames(Floors& floors, const std::vector<std::string>& skins);
/// What constraints cost a frame, over its own linear frame, and how many steps contacts take.
void cones(Floors& floors);
/// How much frames one after the other differ, and what a build for every machine costs.
void latency(Floors& floors);
/// 10000 frames at once over a loop.
void batches(Floors& floors);
/// `solve --plan`, from file to file, over a loop in memory.
void recordings(Floors& floors);
/// K f of 256 x 256 over the transforms that it needs.
void products(Floors& floors);
/// Of preconditioned conjugate gradients to a residual of 1e-8, for sides of powers of 2.
void steps(Floors& floors, std::size_t least, std::size_t largest);
/// `run` of 128 x 128 x 3 with a rule for alpha.
void whole_run(Floors& floors);

}  // namespace bench
