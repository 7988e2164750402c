/// @file
/// Long computations say what they are doing, and ask whether to go on.
///
///     struct Steps : lab::Observer {
///       void step(const lab::Step& step) override { std::puts(report::in_words(step).c_str()); }
///     } steps;
///     lab::run(scene, simulator, {}, steps);
#pragma once

#include <cstddef>

#include "tactile_net/scene/scene.hpp"

namespace tactile_net::lab {

/// What begins now.
struct Step {
  enum class Kind {
    readings,         ///< the scene's readings are simulated
    rules,            ///< rules for alpha are compared
    method,           ///< `method` solves the frame
    operating_point,  ///< the simulator's
    certificate,
    transient,     ///< the simulator's, of `count` states
    draws,         ///< of components
    realizations,  ///< other realisations are compared
    frame,         ///< of a recording: number `count`, from 0
    sensors,       ///< the scene's own are surveyed
    alternative,   ///< sensor choice number `count`, from 1
    finger,        ///< of a hand: number `count`, from 1
    board,         ///< what its copper does to a circuit
  };
  Kind kind = Kind::readings;
  std::size_t count = 0;
  Method method = Method::tikhonov;
};

class Observer {
 public:
  virtual ~Observer() = default;
  /// Called before each step, on the thread that computes; frames come thousands a second.
  virtual void step(const Step& /*step*/) {}
  /// Asked between steps: true ends the work with what there is.
  [[nodiscard]] virtual bool stop() const { return false; }
};

/// Watches nothing: the default of every function.
inline Observer silent;

}  // namespace tactile_net::lab
