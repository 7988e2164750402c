/// @file
/// What is suspicious about a recording, and what to do about it, in plain words.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tactile_net/lab/readings_check.hpp"

namespace tactile_net::report {

/// "taxel 7 reads zero in every frame": what was seen, with its numbers; no full stop.
[[nodiscard]] std::string in_words(const lab::Finding& finding, const AnyScene& scene);

/// What to write in the scene, or to do: "[dead_taxels] indices = [7]".
[[nodiscard]] std::string advice(const lab::Finding& finding, const AnyScene& scene);

/// What was understood, a fact each: frames and their times, the range of each
/// quantity and its noise, what the largest reading means, and what could not be judged.
[[nodiscard]] std::vector<std::string> understood_in_words(const lab::ReadingsCheck& check);

/// All of it: what was understood, then the suspicions, each with its advice.
void print_check(std::ostream& out, const lab::ReadingsCheck& check);

}  // namespace tactile_net::report
