#include "tactile_net/lab/method.hpp"

#include <array>
#include <stdexcept>

#include "lab/methods/methods.hpp"

namespace tactile_net::lab {
namespace {

std::unique_ptr<FrameSolver> refuse(const SceneProblem&, std::optional<double>) {
  throw std::invalid_argument("the network is relaxed by ngspice, not solved frame by frame");
}

constexpr std::array methods_in_order = {
    MethodTraits{.method = Method::dft, .needs_alpha = false, .has_bands = false, .make = make_dft},
    MethodTraits{.method = Method::tikhonov, .takes_constraints = true, .make = make_tikhonov},
    MethodTraits{.method = Method::closed_form, .make = make_closed_form},
    MethodTraits{
        .method = Method::network, .solves_frames = false, .has_bands = false, .make = refuse}};

static_assert([] {
  for (std::size_t i = 0; i < methods_in_order.size(); ++i)
    if (methods_in_order[i].method != static_cast<Method>(i)) return false;
  return methods_in_order.size() == static_cast<std::size_t>(Method::network) + 1;
}());

}  // namespace

std::span<const MethodTraits> methods() noexcept { return methods_in_order; }

const MethodTraits& traits(Method method) {
  return methods_in_order.at(static_cast<std::size_t>(method));
}

std::unique_ptr<FrameSolver> make_solver(const SceneProblem& problem, Method method,
                                         std::optional<double> alpha) {
  return traits(method).make(problem, alpha ? alpha : problem.scene().reconstruct.alpha);
}

std::unique_ptr<FrameSolver> make_solver(const Scene& scene, Method method) {
  return make_solver(SceneProblem(scene), method);
}

}  // namespace tactile_net::lab
