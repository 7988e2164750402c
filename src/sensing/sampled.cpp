#include "tactile_net/sensing/sampled.hpp"

#include <cassert>

#include "sensing/superpose.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/sensing/aperture.hpp"

namespace tactile_net {

std::vector<double> sampled_kernel(const Channel& channel, Traction component,
                                   const Material& material, std::size_t count, double pitch) {
  const PadKernel response(channel.quantity, component, material, channel.depth);
  const Aperture aperture(channel.width, channel.depth);
  std::vector<double> kernel(2 * count - 1);
  const auto centre = static_cast<double>(count - 1);
  for (std::size_t i = 0; i < kernel.size(); ++i) {
    const double y = (static_cast<double>(i) - centre) * pitch;
    kernel[i] = aperture.mean(response, y) * pitch;
  }
  return kernel;
}

void add_convolution(std::span<const double> kernel, std::span<const double> in,
                     std::span<double> out) noexcept {
  const std::size_t count = in.size();
  assert(out.size() == count && kernel.size() + 1 == 2 * count);
  // Cause by cause rather than effect by effect: the inner loop then has no sum in it, so that a
  // compiler can use vector instructions without changing the order of any sum.
  for (std::size_t i = 0; i < count; ++i) {
    const auto column = kernel.subspan(count - 1 - i, count);
    for (std::size_t n = 0; n < count; ++n) out[n] += column[n] * in[i];
  }
}

std::vector<double> sampled_readings(const SensorArray& array, const Material& material,
                                     const TractionField& field) {
  check(array);
  check(material);
  const std::vector<Channel> all = channels(array);
  return superpose(
      array, field,
      [&](std::size_t channel, Traction component, std::span<const double> in,
          std::span<double> out) {
        add_convolution(sampled_kernel(all[channel], component, material, array.count, array.pitch),
                        in, out);
      });
}

}  // namespace tactile_net
