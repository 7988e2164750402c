/// @file
/// A method of a scene for any number of frames.
#pragma once

#include <memory>
#include <optional>

#include "arrays.hpp"
#include "shared_scene.hpp"
#include "tactile_net/lab/method.hpp"

namespace tactile_net::python {

class Solver {
 public:
  /// @pre    the GIL is not held
  /// @throw  as `lab::make_solver`
  Solver(ScenePointer shared, Method method, std::optional<double> alpha)
      : shared_(std::move(shared)) {
    const auto locked = shared_->lock();
    solver_ = lab::make_solver(locked.problem, method, alpha);
    tractions_ = solver_->tractions();
  }

  [[nodiscard]] std::size_t tractions() const noexcept { return tractions_; }

  /// M, traction by reading, where one product is the answer: the solver's own memory, which
  /// `owner`, its Python object, keeps. @throw std::invalid_argument  it is not one product
  [[nodiscard]] View matrix(nb::handle owner) const;

  /// A row of tractions for each row of readings. @throw BadFrame
  [[nodiscard]] Array solve(const Rows& readings);

 private:
  ScenePointer shared_;  // whose lock holds for the solver too: it asks the problem for its parts
  std::unique_ptr<lab::FrameSolver> solver_;
  std::size_t tractions_ = 0;
};

}  // namespace tactile_net::python
