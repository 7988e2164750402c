/// @file
/// A plan from disk, at a controller's start-up. Inline, so that the file is touched in the
/// caller's own object code: in the loop tactile_net::rt makes no system call. With the bytes in
/// memory, call `decode_plan` (plan_file.hpp) instead.
///
///     ContactEstimator estimator(load_plan("pad.plan"));
#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "tactile_net/realtime/plan_file.hpp"

namespace tactile_net {

/// Reads a plan's file.
/// @throw std::runtime_error  as `decode_plan`, or the file cannot be read; the text names the file
[[nodiscard]] inline EstimatorPlan load_plan(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot be opened");
  std::ostringstream content;
  if (file.peek() != std::ifstream::traits_type::eof()) content << file.rdbuf();
  if (file.bad() || !content) throw std::runtime_error(path.string() + ": cannot be read");
  try {
    const std::string text = std::move(content).str();
    return decode_plan(std::as_bytes(std::span(text)));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace tactile_net
