#include "tactile_net/calibration/press_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "calibration/pad_readings.hpp"
#include "numeric/require.hpp"
#include "skin/curved_kernel.hpp"
#include "tactile_net/calibration/ball_contact.hpp"
#include "tactile_net/elasticity/space/skin_kernel.hpp"
#include "tactile_net/skin/signal_layout.hpp"

namespace tactile_net {
namespace {

/// Crosstalk between neighbours of a channel, in place; `leaked` gets its derivative by fraction.
void apply_crosstalk(const SignalLayout& layout, double fraction, Matrix& rows, Matrix* leaked) {
  if (fraction == 0.0 && leaked == nullptr) return;
  const std::size_t n = layout.readings.size();
  std::vector<double> flow(n);
  for (std::size_t p = 0; p < rows.rows; ++p) {
    std::fill(flow.begin(), flow.end(), 0.0);
    for (const auto& [first, second] : layout.neighbours) {
      const double difference = rows(p, second) - rows(p, first);
      flow[first] += difference;
      flow[second] -= difference;
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (leaked != nullptr) (*leaked)(p, i) = flow[i];
      rows(p, i) += fraction * flow[i];
    }
  }
}

bool is_dragged(const PressState& press) {
  return press.friction != 0.0 || press.friction_z != 0.0;
}

Matrix zeros(std::size_t rows, std::size_t columns) {
  return {rows, columns, std::vector<double>(rows * columns)};
}

}  // namespace

PressModel::PressModel(const SensorArray& array, const Material& material, double crosstalk)
    : material_(material),
      is_skin_(false),
      layout_(array),
      pitch_(array.pitch),
      crosstalk_(crosstalk) {
  check(array);
  for (const Site& site : sites())
    if (site.width > 0.0)
      throw std::invalid_argument("calibration takes taxels as points; these have a width");
  check_and_finish(crosstalk);
}

PressModel::PressModel(const SkinArray& skin, const Material& material, double crosstalk)
    : material_(material),
      is_skin_(true),
      layout_(signal_layout(skin)),
      pitch_(std::max(skin.pitch_y, skin.pitch_z)),
      crosstalk_(crosstalk) {
  check(skin);
  if (skin.curved) {
    check_curved(skin, material);
    if (skin.curved->given)
      throw std::invalid_argument(
          "the kernel is given by a file, which knows one depth, one thickness and one pad: "
          "calibrate under kernel = \"ball\"");
    curved_ = skin.curved;
  }
  for (const Site& site : sites()) check_quantity(site.quantity, Traction::normal, material);
  check_and_finish(crosstalk);
}

void PressModel::check_and_finish(double crosstalk) {
  const double most = 1.0 / static_cast<double>(layout_.most_neighbours);
  require(crosstalk >= 0.0 && crosstalk < most, "crosstalk", "be >= 0 and < " + shortest(most),
          crosstalk);
  check(material_);
  depth_ = sites().front().depth;
  for (const Site& site : sites()) {
    check_depth(material_, site.depth);
    depth_ = std::min(depth_, site.depth);
  }
}

double PressModel::most_crosstalk() const noexcept {
  return 0.98 / static_cast<double>(layout_.most_neighbours);
}

bool PressModel::holds_drags() const {
  if (!is_skin_ || !material_.layer || material_.layer->base == Base::bonded) return true;
  return std::none_of(channels().begin(), channels().end(), [](const Channel& channel) {
    return channel.quantity == Quantity::displacement_y ||
           channel.quantity == Quantity::displacement_z;
  });
}

PadState PressModel::nominal() const noexcept {
  PadState pad;
  pad.poisson_ratio = material_.poisson_ratio;
  pad.crosstalk = crosstalk_;
  return pad;
}

double PressModel::most_thickness() const noexcept {
  constexpr double most = 0.9;  // of the radius
  double curvature = 0.0;
  if (curved_)
    for (const SurfacePlace& place : curved_->above)
      curvature = std::max(curvature, place.mean_curvature);
  return curvature > 0.0 ? most / curvature : std::numeric_limits<double>::infinity();
}

double PressModel::curvature_at(double y, double z) const {
  return curved_ ? curved_->surface.at(y, z).mean_curvature : 0.0;
}

double PressModel::relative_radius(double radius, double y, double z) const {
  const double curvature = curvature_at(y, z);
  require(1.0 / radius + curvature > 0.0, "radius",
          "be less than that of the hole it is pressed into, " + shortest(-1.0 / curvature),
          radius);
  return 1.0 / (1.0 / radius + curvature);
}

double PressModel::radius_of_relative(double relative, double y, double z) const {
  const double left = 1.0 / relative - curvature_at(y, z);
  return left > 0.0 ? 1.0 / left : std::numeric_limits<double>::infinity();
}

ContactForce PressModel::contact_force(const Material& material, double half_width,
                                       double radius) const {
  return is_skin_ ? ball_force(material, half_width, radius)
                  : rod_force(material, half_width, radius);
}

double PressModel::contact_half_width(const Material& material, double force, double radius) const {
  return is_skin_ ? ball_contact_radius(material, force, radius)
                  : rod_half_width(material, force, radius);
}

double PressModel::indenter_radius(const Material& material, double half_width,
                                   double force) const {
  return std::exp(contact_force(material, half_width, 1.0).log_force) / force;
}

PressReadings PressModel::readings(const PadState& pad, std::span<const PressState> presses,
                                   bool with_derivatives, bool tied_to_base,
                                   bool by_friction) const {
  const std::size_t n = sites().size();
  PressReadings out;
  out.value = zeros(presses.size(), n);
  if (with_derivatives) {
    for (Matrix& column : out.by_pad) column = zeros(presses.size(), n);
    out.by_center = out.by_log_half_width = out.by_friction = out.by_center_z = out.by_friction_z =
        out.value;
  }
  std::vector<double> y;
  std::vector<double> z;
  for (const Site& site : sites()) {
    y.push_back(site.y * std::exp(pad.log_pitch) + pad.shift);
    z.push_back(site.z * std::exp(pad.log_pitch) + pad.shift_z);
  }
  PadTaxels taxels{.sites = sites(),
                   .y = y,
                   .z = z,
                   .depth_factor = std::exp(pad.log_depth),
                   .material = material_,
                   .tied_to_base = tied_to_base,
                   .by_friction = by_friction,
                   .curved = curved_.get(),
                   .nominal_thickness = material_.layer ? material_.layer->thickness : 0.0,
                   .shift_y = pad.shift,
                   .shift_z = pad.shift_z};
  taxels.material.poisson_ratio = pad.poisson_ratio;
  taxels.material.youngs_modulus *= std::exp(pad.log_modulus);
  if (taxels.material.layer) taxels.material.layer->thickness *= std::exp(pad.log_thickness);
  if (is_skin_ && (by_friction || std::any_of(presses.begin(), presses.end(), is_dragged)) &&
      !holds_drags())
    throw std::invalid_argument(
        "a layer that slips on its base holds no drag: under one its displacements along the skin "
        "are infinite; press straight down");
  const auto add = is_curved() ? add_curved_readings
                   : is_skin_  ? add_skin_readings
                               : add_line_readings;
  add(taxels, presses, with_derivatives, out);
  if (!with_derivatives) {
    apply_crosstalk(layout_, pad.crosstalk, out.value, nullptr);
    return out;
  }
  const auto at = [&](PadParameter parameter) -> Matrix& {
    return out.by_pad[static_cast<std::size_t>(parameter)];
  };
  for (std::size_t p = 0; p < presses.size(); ++p)
    for (std::size_t j = 0; j < n; ++j) {
      at(PadParameter::shift)(p, j) = -out.by_center(p, j);
      if (!is_curved())
        at(PadParameter::pitch)(p, j) = -out.by_center(p, j) * (y[j] - pad.shift) -
                                        out.by_center_z(p, j) * (z[j] - pad.shift_z);
      at(PadParameter::shift_z)(p, j) = -out.by_center_z(p, j);
      if (traits(sites()[j].quantity).kind != QuantityKind::stress)
        at(PadParameter::youngs_modulus)(p, j) = -out.value(p, j);
    }
  apply_crosstalk(layout_, pad.crosstalk, out.value, &at(PadParameter::crosstalk));
  for (const PadParameter parameter :
       {PadParameter::depth, PadParameter::thickness, PadParameter::poisson_ratio,
        PadParameter::youngs_modulus, PadParameter::shift, PadParameter::pitch,
        PadParameter::shift_z})
    apply_crosstalk(layout_, pad.crosstalk, at(parameter), nullptr);
  for (Matrix* column : {&out.by_center, &out.by_log_half_width, &out.by_friction, &out.by_center_z,
                         &out.by_friction_z})
    apply_crosstalk(layout_, pad.crosstalk, *column, nullptr);
  out.by_log_force = out.value;
  return out;
}

}  // namespace tactile_net
