/// @file
/// What a command asks on a terminal.
#pragma once

#include <functional>
#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "failure.hpp"
#include "streams.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::tool {

/// Asks until it understands; without anybody there, remembers what it would have asked.
class Questions {
 public:
  explicit Questions(const Streams& streams) : streams_(streams) {}

  /// @param option   that would have answered
  /// @param take     whether the answer was understood
  void ask(const std::string& option, const std::string& question,
           const std::function<bool(std::string_view)>& take) {
    if (!streams_.somebody) {
      open_.push_back(option);
      return;
    }
    std::string answer;
    do {
      streams_.err << question << ": " << std::flush;
      if (!std::getline(streams_.in, answer)) throw WrongUsage(option, "was not answered");
    } while (!take(answer));
  }
  /// With something that will do where the answer is empty, and where nobody is there.
  void offer(const std::string& question, const std::function<bool(std::string_view)>& take) {
    if (!streams_.somebody) return;
    ask("", question, [&](std::string_view answer) { return answer.empty() || take(answer); });
  }
  /// @throw WrongUsage  something is not given, and nobody is there: names all of it
  void require_all(const std::string& what_is_known = "") const {
    if (open_.empty()) return;
    std::string all;
    for (const std::string& one : open_) all += (all.empty() ? "" : ", ") + one;
    throw WrongUsage("not known, and there is no terminal to ask on: " + all + what_is_known);
  }

 private:
  const Streams& streams_;
  std::vector<std::string> open_;
};

/// Nothing: the answer is no number.
[[nodiscard]] inline std::optional<double> number_in(std::string_view text) {
  double value = 0.0;
  return read_number(text, value) ? std::optional(value) : std::nullopt;
}

/// Takes a number above 0; of any other answer `into` is 0.
[[nodiscard]] inline std::function<bool(std::string_view)> positive_into(double& into) {
  return [&into](std::string_view answer) {
    into = number_in(answer).value_or(0.0);
    return into > 0.0;
  };
}

}  // namespace tactile_net::tool
