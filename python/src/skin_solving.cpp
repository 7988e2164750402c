// A skin's readings into tractions alone.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <stdexcept>

#include "arrays.hpp"
#include "bad_frame.hpp"
#include "rooms.hpp"
#include "shared_scene.hpp"
#include "watcher.hpp"

namespace tactile_net::python {
namespace {

/// One frame. @param frame  its number, for messages
/// @throw BadFrame  a reading is not finite, or the tractions overflow
lab::FrameAnswer answer_of(const lab::SkinSceneProblem& problem, std::span<const double> readings,
                           std::size_t frame) {
  check_finite(readings, frame, false);
  try {
    return lab::solve(problem, readings);
  } catch (const lab::FrameOverflow&) {
    throw bad_frame(FrameStatus::too_large, readings, frame);
  }
}

/// Tikhonov's method for any number of frames.
class SkinSolver {
 public:
  SkinSolver(SkinPointer shared, std::optional<double> alpha) : shared_(std::move(shared)) {
    const auto locked = shared_->lock();
    problem_.emplace(locked.problem);
    if (alpha) {
      SkinScene scene = locked.problem.scene();
      scene.reconstruct.alpha = *alpha;
      problem_.emplace(std::move(scene));
    }
    const auto& given = problem_->scene().reconstruct.alpha;
    if (given && !problem_->constraints())
      product_.emplace(problem_->family().reconstruction(*given));
  }

  [[nodiscard]] std::size_t tractions() const { return problem_->tractions(); }

  [[nodiscard]] View matrix(nb::handle owner) const {
    if (!product_)
      throw std::invalid_argument(
          "the answer is not one matrix here: that "
          "takes a given alpha and no constraints");
    const Matrix& transposed = product_->transposed();
    const auto row = static_cast<std::int64_t>(transposed.columns);
    return {transposed.values.data(), {transposed.columns, transposed.rows}, owner, {1, row}};
  }

  [[nodiscard]] Array solve(const Rows& readings) {
    const std::size_t frames = readings.shape(0);
    std::vector<double> tractions;
    tractions.reserve(frames * problem_->tractions());
    {
      Watcher watcher;
      const nb::gil_scoped_release released;
      const auto locked = shared_->lock();  // what follows from a scene is shared, and made once
      for (std::size_t i = 0; i < frames; ++i) {
        watcher.frame();
        const std::vector<double> answer = one(row(readings, i), i);
        tractions.insert(tractions.end(), answer.begin(), answer.end());
      }
    }
    return owned(std::move(tractions), {frames, problem_->tractions()});
  }

 private:
  /// The same tractions as `lab::solve`'s, and where alpha is given without the bands.
  [[nodiscard]] std::vector<double> one(std::span<const double> readings, std::size_t frame) const {
    if (!product_) return answer_of(*problem_, readings, frame).tractions;
    for (const double reading : readings)
      if (!std::isfinite(reading)) throw bad_frame(FrameStatus::not_finite, readings, frame);
    const TikhonovFamily& family = problem_->family();
    std::vector<double> found =
        family.solve(family.analyse(readings), *problem_->scene().reconstruct.alpha);
    if (!std::all_of(found.begin(), found.end(), [](double f) { return std::isfinite(f); }))
      throw bad_frame(FrameStatus::too_large, readings, frame);
    return found;
  }

  SkinPointer shared_;
  std::optional<lab::SkinSceneProblem> problem_{};
  std::optional<Reconstruction> product_{};
};

}  // namespace

void bind_skin_solving(nb::module_& module) {
  nb::class_<SkinSolver>(module, "SkinSolver")
      .def(
          "__init__",
          [](SkinSolver* self, const SkinPointer& scene, std::optional<double> alpha) {
            const nb::gil_scoped_release released;
            new (self) SkinSolver(scene, alpha);
          },
          nb::arg("scene"), nb::arg("alpha").none())
      .def_prop_ro("tractions", &SkinSolver::tractions)
      .def_prop_ro("matrix",
                   [](nb::handle self) { return nb::cast<const SkinSolver&>(self).matrix(self); })
      .def("solve", &SkinSolver::solve, nb::arg("readings").noconvert());
}

}  // namespace tactile_net::python
