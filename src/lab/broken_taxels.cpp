#include "tactile_net/lab/broken_taxels.hpp"

#include <cstddef>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "lab/lines_and_skins.hpp"

namespace tactile_net::lab {
namespace {

constexpr std::size_t most_frames = 20'000;
constexpr std::size_t least_frames = 20;  // fewer may have pressed elsewhere alone

/// Null: the finding is of something else.
const std::vector<std::size_t>* broken_taxels(const Finding& one) {
  if (const auto* dead = std::get_if<finding::DeadTaxels>(&one)) return &dead->taxels;
  if (const auto* stuck = std::get_if<finding::StuckTaxels>(&one)) return &stuck->taxels;
  if (const auto* worn = std::get_if<finding::WornTaxels>(&one)) return &worn->taxels;
  return nullptr;
}

template <typename Problem>
Findings left_without(Problem& problem, const ReadingsCheck& check) {
  Findings said;
  finding::TaxelsLeftOut left_out;
  if (check.frames < least_frames) return said;
  for (const Finding& one : check.findings)
    if (const std::vector<std::size_t>* taxels = broken_taxels(one)) {
      said.push_back(one);
      left_out.taxels = rising(std::move(left_out.taxels), *taxels);
    }
  if (said.empty()) return said;
  const std::vector<std::size_t> dead = rising(problem.scene().dead_taxels, left_out.taxels);
  if (!measures_without(problem, dead)) return {};
  problem = problem.without(dead);
  said.emplace_back(std::move(left_out));
  return said;
}

}  // namespace

ReadingsCheck first_look(const AnyScene& scene,
                         const std::function<bool(std::span<double>)>& next) {
  ReadingsChecker checker(scene);
  std::vector<double> readings(
      std::visit([](const auto& one) { return sites(one.sensor).size(); }, scene));
  for (std::size_t k = 0; k < most_frames && next(readings); ++k)
    checker.add(std::nullopt, readings);
  return checker.result_without_loads();
}

Findings leave_out_broken(SceneProblem& problem, const ReadingsCheck& check) {
  return left_without(problem, check);
}

Findings leave_out_broken(SkinSceneProblem& problem, const ReadingsCheck& check) {
  return left_without(problem, check);
}

Findings leave_out_broken(AnyProblem& problem, const ReadingsCheck& check) {
  return std::visit([&](auto& one) { return left_without(one, check); }, problem);
}

}  // namespace tactile_net::lab
