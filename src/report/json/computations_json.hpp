/// @file
/// What a run computes, of a line or a skin, as JSON. Private.
#pragma once

#include "report/json/document.hpp"
#include "tactile_net/report/words/skin_workload_words.hpp"
#include "tactile_net/report/words/workload_words.hpp"

namespace tactile_net::report {

/// @param tasks  of a `lab::Workload` or a `lab::SkinWorkload`
template <class Tasks>
Json computations_json(const Tasks& tasks) {
  Json computations = Json::array();
  for (const auto& task : tasks)
    computations.push_back({{"computation", name(task.what)},
                            {"done", task.done},
                            {"why", why_in_words(task)},
                            {"cost", task.cost ? Json(cost_in_words(task)) : Json(nullptr)}});
  return computations;
}

}  // namespace tactile_net::report
