/// @file
/// A scene as Python holds it.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::python {

/// A scene's text, and what follows from it, made once for all that Python asks of it.
class SharedScene {
 public:
  /// @param file  its name in messages; what the scene refers to is beside it
  /// @throw InputError
  SharedScene(std::string text, std::string file)
      : text_(std::move(text)), file_(std::move(file)), problem_(parse_scene(text_, file_)) {}

  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  [[nodiscard]] const Scene& scene() const noexcept { return problem_.scene(); }

  /// With the lock under which alone it may be used: its parts are made on first use.
  struct Locked {
    std::unique_lock<std::mutex> lock;
    const lab::SceneProblem& problem;
  };
  /// Waits for other threads. @pre  the GIL is not held
  [[nodiscard]] Locked lock() { return {std::unique_lock(mutex_), problem_}; }

 private:
  std::string text_;
  std::string file_;
  lab::SceneProblem problem_;
  std::mutex mutex_;
};

using ScenePointer = std::shared_ptr<SharedScene>;

}  // namespace tactile_net::python
