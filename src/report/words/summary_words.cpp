#include "tactile_net/report/words/summary_words.hpp"

#include <map>

namespace tactile_net::report {
namespace {

std::string of(std::size_t count, std::size_t frames) {
  return std::to_string(count) + " of " + std::to_string(frames) + " frames";
}

}  // namespace

std::vector<std::string> in_words(const lab::SolvedFrames& solved) {
  std::map<std::string, std::size_t> verdicts;  // sorted by name
  for (const auto& [verdict, count] : solved.verdicts)
    if (verdict != lab::Verdict::ok) verdicts.emplace(lab::name(verdict), count);
  std::vector<std::string> sentences;
  for (const auto& [verdict, count] : verdicts)
    sentences.push_back(of(count, solved.frames) + " have the verdict " + verdict);
  return sentences;
}

std::vector<std::string> in_words(const lab::RecordedFrames& recorded) {
  std::vector<std::string> sentences;
  for (const auto& [effect, count] : recorded.cut_off)
    sentences.push_back(effect + " cuts readings off in " + of(count, recorded.frames));
  return sentences;
}

}  // namespace tactile_net::report
