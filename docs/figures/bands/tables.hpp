/// @file
/// The parts of docs/bands.md. Each works on its cells with several threads; what it writes does
/// not depend on how many.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/coverage/intervals.hpp"

namespace tactile_net::sbc {

struct Options {
  std::uint64_t seed = 1;
  std::size_t draws = 4000;    ///< of the model, on each array
  std::size_t contacts = 400;  ///< of each kind, on each array
  std::size_t threads = 1;
};

/// Part of a page.
struct Section {
  std::string text{};
  std::string drawn{};  ///< what names its draws and truths: hashes or bytes
};

/// @param picture  an SVG of the ranks
[[nodiscard]] Section ranks_section(const Options& options, std::string& picture);
[[nodiscard]] Section contacts_section(const Options& options);
[[nodiscard]] Section broken_section(const Options& options);

/// Lines of a scene's [reconstruct].
inline constexpr const char* by_mixture = "answer = \"mixture\"\n";
inline constexpr const char* by_alpha = "answer = \"alpha\"\n";

std::string text(const char* format, auto... values) {
  std::string all(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, values...)), ' ');
  std::snprintf(all.data(), all.size() + 1, format, values...);
  return all;
}

/// "51 / 80 / 96"; empty: nothing was counted.
inline std::string percents(const coverage::Holds& holds) {
  if (holds.count == 0) return {};
  return text("%.0f / %.0f / %.0f", holds.percent(0), holds.percent(1), holds.percent(2));
}

/// Calls work(0) ... work(count - 1), each once, on any thread. @throw  what the first one threw
void in_parallel(std::size_t threads, std::size_t count, const char* name, const auto& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex reporting;
  std::exception_ptr failure;
  {
    std::vector<std::jthread> workers;
    for (std::size_t t = 0; t < threads; ++t)
      workers.emplace_back([&] {
        for (std::size_t i = next++; i < count; i = next++) {
          std::exception_ptr own;
          try {
            work(i);
          } catch (...) {
            own = std::current_exception();
            next = count;
          }
          const std::scoped_lock lock(reporting);
          if (own && !failure) failure = own;
          std::cerr << text("%s: %zu of %zu\n", name, i + 1, count);
        }
      });
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace tactile_net::sbc
