/// @file
/// A scene as Python holds it.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <variant>

#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/lab/skin_problem.hpp"

namespace tactile_net::python {

/// A scene's text, and what follows from it, made once for all that Python asks of it.
///
/// @tparam Problem  `lab::SceneProblem`, or of a skin `lab::SkinSceneProblem`
template <class Problem>
class Shared {
 public:
  /// @param text  that `problem`'s scene was read from
  /// @param file  its name in messages; what the scene refers to is beside it
  Shared(std::string text, std::string file, Problem problem)
      : text_(std::move(text)), file_(std::move(file)), problem_(std::move(problem)) {}

  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  [[nodiscard]] const auto& scene() const noexcept { return problem_.scene(); }

  /// With the lock under which alone it may be used: its parts are made on first use.
  struct Locked {
    std::unique_lock<std::mutex> lock;
    const Problem& problem;
  };
  /// Waits for other threads. @pre  the GIL is not held
  [[nodiscard]] Locked lock() { return {std::unique_lock(mutex_), problem_}; }

 private:
  std::string text_;
  std::string file_;
  Problem problem_;
  std::mutex mutex_;
};

using SharedScene = Shared<lab::SceneProblem>;
using ScenePointer = std::shared_ptr<SharedScene>;

using SharedSkin = Shared<lab::SkinSceneProblem>;
using SkinPointer = std::shared_ptr<SharedSkin>;

/// A line's or a skin's.
using AnyPointer = std::variant<ScenePointer, SkinPointer>;

/// The lock under which alone its problem, and copies of it, may be used.
/// @pre  the GIL is not held
[[nodiscard]] inline std::unique_lock<std::mutex> lock_of(const AnyPointer& shared) {
  return std::visit([](const auto& one) { return one->lock().lock; }, shared);
}

}  // namespace tactile_net::python
