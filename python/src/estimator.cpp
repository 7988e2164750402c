// The per-frame call of a controller. Its price is what a Python call costs, so its arrays go the
// short way (frame_buffer.hpp), and the GIL is kept: giving it up could cost 5 ms to get it back.
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <stdexcept>

#include "arrays.hpp"
#include "bad_frame.hpp"
#include "frame_buffer.hpp"
#include "plan.hpp"
#include "rooms.hpp"
#include "tactile_net/control/batch.hpp"
#include "tactile_net/control/fft_convolution.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net::python {
namespace {

class Estimator {
 public:
  /// @param contacts  one by one, at most so many; 0: none
  Estimator(PlanPointer plan, std::size_t contacts)
      : plan_(std::move(plan)),
        estimator_(plan_->plan, fft_convolutions()),
        readings_(estimator_.readings()),
        tractions_(estimator_.tractions()),
        rows_(contacts) {
    if (contacts > most_contact_rows)
      throw std::invalid_argument("a frame tells at most " + std::to_string(most_contact_rows) +
                                  " contacts one by one");
  }

  /// @param out  None: a new array
  nb::object update(const nb::object& frame, const nb::object& out) {
    const Turn turn(*this);
    const FrameBuffer readings(frame.ptr(), readings_.size(), "frame");
    nb::object answer = out.is_none() ? fresh() : out;
    const FrameBuffer tractions(answer.ptr(), tractions_.size(), "out", true);
    solve(in_plans_order(readings, "frame"), tractions.values());
    return answer;
  }

  void step() {
    const Turn turn(*this);
    solve(readings_, tractions_);
  }

  /// @param frames  a row each
  Array update_batch(const Rows& frames) {
    if (frames.shape(1) != readings_.size())
      throw std::invalid_argument("frames must have " + std::to_string(readings_.size()) +
                                  " readings each, got " + std::to_string(frames.shape(1)));
    const std::size_t count = frames.shape(0);
    const std::size_t width = tractions_.size();
    std::vector<double> tractions(count * width);
    {
      const Turn turn(*this);
      const nb::gil_scoped_release released;
      std::vector<ContactEstimate> estimates(count);
      for (std::size_t i = 0; i < count; ++i)
        estimates[i].tractions = std::span(tractions).subspan(i * width, width);
      const FrameStatus status =
          tactile_net::update_batch(estimator_, {frames.data(), frames.size()}, estimates);
      if (status != FrameStatus::ok) throw bad_frame_among(frames);
      if (count > 0) contact_ = estimates.back();
      found_ = 0;
    }
    contact_.tractions = {};
    return owned(std::move(tractions), {count, width});
  }

  void set_baseline(const nb::object& frame) {
    const Turn turn(*this);
    const FrameBuffer buffer(frame.ptr(), readings_.size(), "baseline");
    const std::span<const double> readings = in_plans_order(buffer, "baseline");
    const FrameStatus status = estimator_.set_baseline(readings);
    if (status != FrameStatus::ok) throw bad_frame(status, readings, 0);
    baseline_.assign(readings.begin(), readings.end());
  }

  void set_dead(std::size_t taxel) {
    const Turn turn(*this);
    if (!estimator_.set_dead(taxel))
      throw std::invalid_argument(
          "taxel " + std::to_string(taxel) +
          " cannot be left out: the plan has no diagnostics, it "
          "has no such taxel, " +
          std::to_string(ContactEstimator::most_dead_taxels) +
          " are dead already, or the others cannot tell what it reads (make a new plan)");
    if (std::find(dead_.begin(), dead_.end(), taxel) == dead_.end()) dead_.push_back(taxel);
  }

  void set_work(std::size_t steps, double enough) {
    const Turn turn(*this);
    if (!plan_->plan.cone)
      throw std::invalid_argument("this plan has no constraints, and so no steps towards them");
    if (steps > ConePlan::most_steps)
      throw std::invalid_argument("a frame takes at most " + std::to_string(ConePlan::most_steps) +
                                  " steps");
    estimator_.set_work({.steps = steps, .enough = enough});
    work_ = {steps, enough};
  }

  void revive() {
    const Turn turn(*this);
    estimator_.revive();
    dead_.clear();
  }

  [[nodiscard]] const PlanPointer& plan() const noexcept { return plan_; }
  [[nodiscard]] const ContactEstimate& contact() const noexcept { return contact_; }
  [[nodiscard]] std::vector<double>& readings() noexcept { return readings_; }
  [[nodiscard]] std::vector<double>& tractions() noexcept { return tractions_; }
  [[nodiscard]] const std::vector<double>& baseline() const noexcept { return baseline_; }
  [[nodiscard]] const std::vector<std::size_t>& dead() const noexcept { return dead_; }
  [[nodiscard]] std::pair<std::size_t, double> work() const noexcept { return work_; }
  [[nodiscard]] std::vector<ContactRow> contacts() const {
    return {rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(found_)};
  }
  [[nodiscard]] std::size_t most_contacts() const noexcept { return rows_.size(); }
  [[nodiscard]] std::string_view instruction_set() const noexcept {
    return name(estimator_.instruction_set());
  }

 private:
  /// One thread at a time: the others are refused, for waiting is no plan in a control loop.
  class Turn {
   public:
    explicit Turn(Estimator& estimator) : busy_(estimator.busy_) {
      if (busy_.test_and_set(std::memory_order_acquire))
        throw std::runtime_error(
            "this estimator is at work in another thread: give each thread its own (copy.copy)");
    }
    ~Turn() { busy_.clear(std::memory_order_release); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    std::atomic_flag& busy_;
  };

  void solve(std::span<const double> readings, std::span<double> tractions) {
    contact_.tractions = tractions;
    contact_.rows = rows_;
    const FrameStatus status = estimator_.update(readings, contact_);
    contact_.tractions = {};
    contact_.rows = {};
    if (status != FrameStatus::ok) throw bad_frame(status, readings, 0);
    found_ = contact_.rows_found;
  }

  [[nodiscard]] nb::object fresh() const {
    const EstimatorPlan& plan = plan_->plan;
    std::vector<double> values(tractions_.size());
    if (const auto& cells = plan.cells)
      return nb::cast(owned(std::move(values), {plan.unknowns, cells->rows, cells->columns}));
    return nb::cast(owned(std::move(values), {plan.unknowns, plan.values}));
  }

  /// A line's frame as it is, whatever its shape. A skin's as it is where it is flat; where it has
  /// rows, columns and channels a copy, channel after channel.
  [[nodiscard]] std::span<const double> in_plans_order(const FrameBuffer& frame, const char* what) {
    const std::span<const double> values = frame.values();
    if (!plan_->plan.cells || frame.shape().size() == 1) return values;
    const std::size_t channels = plan_->plan.channels;
    const std::array<std::size_t, 3> wanted = {plan_->rows, plan_->columns, channels};
    const bool fits = plan_->is_lattice() &&
                      std::equal(wanted.begin(), wanted.end(), frame.shape().begin(),
                                 frame.shape().end(), [](std::size_t size, Py_ssize_t given) {
                                   return static_cast<Py_ssize_t>(size) == given;
                                 });
    if (!fits) refuse_shape(frame, wanted, what);
    ordered_.resize(values.size());
    const std::size_t taxels = plan_->plan.count;
    for (std::size_t channel = 0; channel < channels; ++channel)
      for (std::size_t taxel = 0; taxel < taxels; ++taxel)
        ordered_[channel * taxels + taxel] = values[taxel * channels + channel];
    return ordered_;
  }

  [[noreturn]] void refuse_shape(const FrameBuffer& frame, const std::array<std::size_t, 3>& wanted,
                                 const char* what) const {
    const auto listed = [](const auto& sizes) {
      std::string text;
      for (const auto size : sizes) text += (text.empty() ? "" : ", ") + std::to_string(size);
      return "(" + text + (sizes.size() == 1 ? ",)" : ")");
    };
    const std::string flat =
        listed(std::array{readings_.size()}) + ", in the order of Skin.reading_names";
    std::string text = std::string(what) + " must be of shape ";
    if (plan_->is_lattice())
      text += listed(wanted) + ", rows, columns and channels, or " + flat;
    else
      text += flat;
    text += ", got " + listed(frame.shape());
    if (!plan_->is_lattice() && plan_->plan.taxels.empty())
      text += ": the file does not say how the taxels lie, Plan.load(path, scene=skin) does";
    throw std::invalid_argument(text);
  }

  [[nodiscard]] BadFrame bad_frame_among(const Rows& frames) {
    ContactEstimate estimate;
    estimate.tractions = tractions_;
    for (std::size_t i = 0; i < frames.shape(0); ++i)
      if (const FrameStatus status = estimator_.update(row(frames, i), estimate);
          status != FrameStatus::ok)
        return bad_frame(status, row(frames, i), i);
    return {"a frame is bad", 0};
  }

  PlanPointer plan_;
  ContactEstimator estimator_;
  std::vector<double> readings_;
  std::vector<double> tractions_;
  std::vector<double> ordered_{};  // a skin's frame, channel after channel
  ContactEstimate contact_{};
  std::vector<double> baseline_{};  // empty: the plan's
  std::vector<std::size_t> dead_{};
  std::pair<std::size_t, double> work_{};
  std::vector<ContactRow> rows_;
  std::size_t found_ = 0;
  std::atomic_flag busy_{};
};

/// The estimator's own memory, which lives as long as the array does.
nb::object own_readings(const nb::object& self) {
  auto& estimator = nb::cast<Estimator&>(self);
  const EstimatorPlan& plan = estimator.plan()->plan;
  double* const values = estimator.readings().data();
  if (estimator.plan()->is_lattice()) {
    // Channels last, though the memory has them first.
    const std::size_t rows = estimator.plan()->rows;
    const std::size_t columns = estimator.plan()->columns;
    const auto taxels = static_cast<std::int64_t>(plan.count);
    return nb::cast(Array(values, {rows, columns, plan.channels}, self,
                          {static_cast<std::int64_t>(columns), 1, taxels}));
  }
  if (!plan.taxels.empty()) return nb::cast(Array(values, {plan.readings()}, self));
  return nb::cast(Array(values, {plan.channels, plan.count}, self));
}

nb::object own_tractions(const nb::object& self) {
  auto& estimator = nb::cast<Estimator&>(self);
  const EstimatorPlan& plan = estimator.plan()->plan;
  double* const values = estimator.tractions().data();
  if (const auto& cells = plan.cells)
    return nb::cast(Array(values, {plan.unknowns, cells->rows, cells->columns}, self));
  return nb::cast(Array(values, {plan.unknowns, plan.values}, self));
}

nb::object baseline_of(const Estimator& self) {
  return self.baseline().empty() ? nb::none() : nb::cast(owned(self.baseline()));
}

std::optional<std::ptrdiff_t> outlier_of(const ContactEstimate& self) {
  return self.outlier < 0 ? std::nullopt : std::optional(self.outlier);
}

void bind_contact(nb::module_& module) {
  nb::class_<ContactEstimate>(
      module, "ContactEstimate",
      "What is known of one frame's contact. It stays as it is when the next frame comes.")
      .def_ro("normal_force", &ContactEstimate::normal_force, "F_v [N/m], of skins [N]")
      .def_ro("force_deviation", &ContactEstimate::force_deviation,
              "what noise and smoothing may have made of it, one standard deviation; nan where the "
              "plan knows no noise")
      .def_ro("tangential_force", &ContactEstimate::tangential_force,
              "F_t [N/m], of skins its size [N]; nan where only normal tractions are solved for")
      .def_ro("tangential_y", &ContactEstimate::tangential_y, "of a skin, along y [N]; else nan")
      .def_ro("tangential_z", &ContactEstimate::tangential_z, "of a skin, along z [N]; else nan")
      .def_ro("centre", &ContactEstimate::centre, "y of the force [m]; nan without contact")
      .def_ro("centre_z", &ContactEstimate::centre_z, "of a skin, z of the force [m]; else nan")
      .def_ro("torsion", &ContactEstimate::torsion,
              "of a skin, about the normal through the centre of pressure, from y towards z [N m]; "
              "else nan")
      .def_ro("angle", &ContactEstimate::angle, "atan2(F_t, F_v) [rad]; nan as the two above")
      .def_ro("friction_margin", &ContactEstimate::friction_margin,
              "mu F_v - |F_t| [N/m], of skins [N], below 0 it slips; of several contacts the one "
              "nearest to slipping; nan without a friction coefficient")
      .def_ro("slip_margin", &ContactEstimate::slip_margin,
              "of a skin, what drag and torsion together leave of friction, 1 at rest, below 0 it "
              "slips or turns; nan as above")
      .def_ro("margin_centre", &ContactEstimate::margin_centre,
              "y of the contact that the margins are of [m]; nan as above")
      .def_ro("margin_centre_z", &ContactEstimate::margin_centre_z, "its z, of a skin [m]")
      .def_prop_ro(
          "force", [](const ContactEstimate& estimate) { return estimate.space.force; },
          "of a curved skin, that acts on it, along the sensor's x, y and z [N]; else nan")
      .def_prop_ro(
          "moment", [](const ContactEstimate& estimate) { return estimate.space.moment; },
          "of a curved skin, about the scene's moment_about [N m]; else nan")
      .def_prop_ro(
          "centre_in_space", [](const ContactEstimate& estimate) { return estimate.space.centre; },
          "of a curved skin, the mean of the places that press [m]; else nan, and without contact")
      .def_ro("contacts", &ContactEstimate::contacts,
              "contacts that lie apart, of which the margins are the worst; 0: no margins")
      .def_ro("touching", &ContactEstimate::touching,
              "the cells that forces are sums over; 0: all, or inside constraints none")
      .def_ro("unfinished", &ContactEstimate::unfinished,
              "how many of its own standard deviations any force, moment or cell may be off since "
              "the steps towards the constraints ended; true of every frame; nan without "
              "constraints or noise")
      .def_ro("unfinished_share", &ContactEstimate::unfinished_share,
              "the same as a share of the linear frame; nan without constraints or diagnostics")
      .def_ro("steps", &ContactEstimate::steps,
              "that were taken towards the constraints; 0: the plan has none")
      .def_ro("residual_rms", &ContactEstimate::residual_rms,
              "what the tractions leave unexplained of a weighted reading; nan without diagnostics")
      .def_ro("contact", &ContactEstimate::contact, "F_v > 0: centre and angle mean something")
      .def_ro("pulls", &ContactEstimate::pulls, "the pad is pulled, which no contact does")
      .def_ro("implausible", &ContactEstimate::implausible, "a strain of more than 1")
      .def_ro("misfit", &ContactEstimate::misfit, "the residual is more than noise explains")
      .def_ro("beyond_edge", &ContactEstimate::beyond_edge,
              "it presses at the outermost taxels as hard as anywhere: the force is a lower bound")
      .def_ro("baseline_moved", &ContactEstimate::baseline_moved,
              "a constant is nearly all that a channel reads: record a new baseline")
      .def_ro("saturated", &ContactEstimate::saturated, "a reading is at its range's end")
      .def_prop_ro("outlier", &outlier_of,
                   "index of the reading that the others explain least, or None");
}

void bind_row(nb::module_& module) {
  nb::class_<ContactRow>(module, "ContactRow", "One contact of a frame where several lie apart.")
      .def_ro("id", &ContactRow::id, "stays with the contact over the frames of one estimator")
      .def_ro("cells", &ContactRow::cells, "that touch")
      .def_ro("normal_force", &ContactRow::normal_force, "[N/m], of skins [N]")
      .def_ro("force_deviation", &ContactRow::force_deviation,
              "of it, by noise and smoothing; nan where it is not known")
      .def_ro("tangential_y", &ContactRow::tangential_y,
              "of a line its tangential force [N/m], of a skin along y [N]; nan: not solved for")
      .def_ro("tangential_z", &ContactRow::tangential_z, "of a skin, along z [N]; else nan")
      .def_ro("centre", &ContactRow::centre, "y of the force [m]")
      .def_ro("centre_z", &ContactRow::centre_z, "of a skin, its z [m]; else nan")
      .def_ro("torsion", &ContactRow::torsion,
              "of a skin, about the centre of pressure [N m]; else nan")
      .def_ro("friction_margin", &ContactRow::friction_margin,
              "mu F - |drag| [N/m], of skins [N]; nan without a friction coefficient")
      .def_ro("slip_margin", &ContactRow::slip_margin,
              "of a skin, what drag and torsion together leave of friction; else nan");
}

}  // namespace

void bind_estimator(nb::module_& module) {
  bind_contact(module);
  bind_row(module);
  nb::class_<Estimator>(module, "Estimator",
                        "The per-frame call of a controller: readings in, tractions out.\n\n"
                        "One thread at a time: another one is refused with a RuntimeError.")
      .def(nb::init<PlanPointer, std::size_t>(), nb::arg("plan"), nb::arg("contacts") = 0)
      .def("update", &Estimator::update, nb::arg("frame").none(), nb::arg("out") = nb::none(),
           nb::sig("def update(self, frame: numpy.typing.NDArray[numpy.float64], "
                   "out: numpy.typing.NDArray[numpy.float64] | None = None) "
                   "-> numpy.typing.NDArray[numpy.float64]"),
           "One frame. C-contiguous float64 arrays, of lines whatever their shape, of skins "
           "(rows, columns, channels) or flat; out is filled and returned.\n\n"
           "Raises FrameError where a reading is not finite; out is then untouched.")
      .def("step", &Estimator::step,
           "One frame, from the estimator's own `readings` into its own `tractions`.")
      .def("update_batch", &Estimator::update_batch, nb::arg("frames").noconvert(),
           "As `update` on each row, and the same bits; other threads go on meanwhile.")
      .def("set_baseline", &Estimator::set_baseline, nb::arg("frame").none(),
           nb::sig("def set_baseline(self, frame: numpy.typing.NDArray[numpy.float64]) -> None"),
           "What the sensors read without contact; subtracted from every frame from now on.")
      .def("set_dead", &Estimator::set_dead, nb::arg("taxel"),
           "Leaves a taxel out from the next frame on.")
      .def("revive", &Estimator::revive, "All taxels count again.")
      .def(
          "set_work", &Estimator::set_work, nb::arg("steps") = 0, nb::arg("enough") = 0.0,
          "Of a plan with constraints: steps of a frame, at most 64, 0: the plan's; it ends before "
          "where `contact.unfinished` is at most enough, > 0.")
      .def_prop_ro("plan", &Estimator::plan)
      .def_prop_ro(
          "contact", [](const Estimator& self) { return self.contact(); },
          "Force, place and doubts of the last frame.")
      .def_prop_ro("contacts", &Estimator::contacts,
                   "The contacts of the last frame of `update` or `step` one by one, the strongest "
                   "first, on lines from left to right; empty where none were asked for.")
      .def_prop_ro("most_contacts", &Estimator::most_contacts, "As it was made.")
      .def_prop_ro("readings", &own_readings,
                   nb::sig("def readings(self) -> numpy.typing.NDArray[numpy.float64]"),
                   "The estimator's own memory, for `step`.")
      .def_prop_ro("tractions", &own_tractions,
                   nb::sig("def tractions(self) -> numpy.typing.NDArray[numpy.float64]"),
                   "The estimator's own memory, which `step` fills.")
      .def_prop_ro("baseline", &baseline_of,
                   nb::sig("def baseline(self) -> numpy.typing.NDArray[numpy.float64] | None"),
                   "As it was set; None: the plan's own.")
      .def_prop_ro(
          "dead", [](const Estimator& self) { return nb::tuple(nb::cast(self.dead())); },
          nb::sig("def dead(self) -> tuple[int, ...]"), "Taxels that are left out.")
      .def_prop_ro(
          "work", &Estimator::work,
          "Of a plan with constraints, as `set_work` has it: steps, and what is enough; 0: the "
          "plan's steps, all of them.")
      .def_prop_ro("instruction_set", &Estimator::instruction_set);
}

}  // namespace tactile_net::python
