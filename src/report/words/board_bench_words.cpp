#include "tactile_net/report/words/board_bench_words.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>

#include "tactile_net/frames/board_file.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/table.hpp"

namespace tactile_net::report {
namespace {

constexpr std::size_t most_parts_told = 8;

std::string evidence_in_words(double evidence) {
  return evidence < 10.0 ? brief(evidence) : shortest(std::round(evidence));
}

std::string odds_in_words(double evidence) {
  return "10^" + evidence_in_words(evidence) + " times as likely as no fault";
}

}  // namespace

std::string in_words(const lab::BoardBench& bench, const BoardFault& fault) {
  const std::string& part = bench.parts[fault.part];
  switch (fault.kind) {
    case PartFault::open:
      return part + " is open";
    case PartFault::shorted:
      return part + " is bridged";
    case PartFault::ten_times:
      return part + " has ten times its resistance";
    case PartFault::tenth:
      return part + " has a tenth of its resistance";
    case PartFault::other_value:
      return part + " has " + brief(1.0 / fault.factor) + " times its resistance";
    case PartFault::swapped:
      return part + " and " + bench.parts[fault.other] + " are swapped";
  }
  return part;
}

std::vector<std::string> in_words(const lab::BoardBench& bench) {
  const BoardDiagnosis& d = bench.diagnosis;
  std::vector<std::string> lines;
  const std::string misfit = "misfit " + brief(d.misfit) + ", 1 where they explain them";
  switch (bench.verdict()) {
    case lab::BenchVerdict::healthy:
      lines.push_back("healthy: tolerances and noise explain the responses (" + misfit + ")");
      break;
    case lab::BenchVerdict::faulty:
    case lab::BenchVerdict::not_told_apart: {
      lines.push_back("FAULT: " + in_words(bench, d.candidates.front().fault) + " (" +
                      odds_in_words(d.candidates.front().evidence) + "; misfit " + brief(d.misfit) +
                      " without it, " + brief(d.misfit_with_fault) + " with it)");
      std::string others;
      for (std::size_t k = 1; k < d.named; ++k)
        others += (others.empty() ? "" : "; or ") + in_words(bench, d.candidates[k].fault);
      if (!others.empty()) lines.push_back("not told apart from it: " + others);
      break;
    }
    case lab::BenchVerdict::not_explained:
      lines.push_back(
          "NOT EXPLAINED by one fault: several, another circuit, other patterns, or another noise "
          "(" +
          misfit +
          (d.named > 0 ? "; " + brief(d.misfit_with_fault) + " if " +
                             in_words(bench, d.candidates.front().fault)
                       : "") +
          ")");
      break;
  }
  lines.push_back("the board errs by " + percent(d.error) + " over these patterns, by " +
                  percent(d.remaining) +
                  " behind the correction as fitted, which makes noise at most " +
                  brief(d.noise_gain) + " times as large");
  if (bench.self_test.limit > 0.0)
    lines.push_back("self-test: reject a board whose step of refinement is more than " +
                    percent(bench.self_test.limit) +
                    " of its answer, as 5 of 100 of these tolerances have it; it is within " +
                    percent(bench.self_test.apart) + " of the board's own error");
  return lines;
}

std::vector<std::vector<std::string>> candidate_cells(const lab::BoardBench& bench) {
  const BoardDiagnosis& d = bench.diagnosis;
  std::vector<std::vector<std::string>> rows = {{"fault", "log10 of its likelihood", "named"}};
  const double least = d.named > 0 ? 0.0 : 0.5 * d.needed;
  for (std::size_t k = 0; k < d.candidates.size(); ++k)
    if (d.candidates[k].evidence > least)
      rows.push_back({in_words(bench, d.candidates[k].fault),
                      evidence_in_words(d.candidates[k].evidence), k < d.named ? "yes" : "no"});
  if (rows.size() == 1) return {};
  return rows;
}

std::vector<std::vector<std::string>> part_cells(const lab::BoardBench& bench) {
  const BoardDiagnosis& d = bench.diagnosis;
  std::vector<std::size_t> order(bench.parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(d.part_errors[a]) > std::abs(d.part_errors[b]);
  });
  if (order.size() > most_parts_told) order.resize(most_parts_told);
  std::vector<std::vector<std::string>> rows = {{"part", "conductance off by", "deviation"}};
  for (const std::size_t r : order)
    rows.push_back({bench.parts[r], percent(d.part_errors[r]), percent(d.part_deviations[r])});
  return rows;
}

std::string correction_csv(const lab::BoardBench& bench) {
  return frames::matrix_csv(bench.outputs, bench.diagnosis.correction);
}

void print_bench(std::ostream& out, const lab::BoardBench& bench) {
  out << "board: " << bench.parts.size() << " resistors, " << bench.patterns << " patterns of "
      << bench.inputs.size() << " inputs, " << bench.outputs.size() << " outputs, noise "
      << brief(bench.noise) << " V\n";
  for (const std::string& line : in_words(bench)) out << "  " << line << '\n';
  const auto candidates = candidate_cells(bench);
  if (!candidates.empty()) {
    out << '\n';
    print_cells(out, candidates);
  }
}

}  // namespace tactile_net::report
