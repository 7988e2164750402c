/// @file
/// The elastic pad: linear, isotropic, homogeneous, in plane strain; as deep as a half plane, or a
/// layer on a rigid base.
#pragma once

#include <optional>
#include <string_view>

namespace tactile_net {

/// What a layer's lower face does on the rigid base.
enum class Base {
  bonded,        ///< no displacement
  frictionless,  ///< no normal displacement, no shear stress
};

/// The name as scenes and JSON spell it: "bonded", "frictionless".
[[nodiscard]] std::string_view name(Base base) noexcept;

struct Layer {
  double thickness = 1.0;  ///< h [m], > 0
  Base base = Base::bonded;
};

struct Material {
  double youngs_modulus = 1.0;   ///< E [Pa], > 0
  double poisson_ratio = 0.45;   ///< nu, [0, 0.5]
  std::optional<Layer> layer{};  ///< absent: half plane
};

/// @throw std::invalid_argument  a value is out of its range or not finite
void check(const Material& material);

/// @throw std::invalid_argument  the depth [m] is not > 0, or lies below the layer's base
void check_depth(const Material& material, double depth);

}  // namespace tactile_net
