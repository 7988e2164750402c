#include "tactile_net/control/fft_convolution.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "numeric/real_fft.hpp"

namespace tactile_net {
namespace {

class FftConvolution final : public Convolution {
 public:
  FftConvolution(const ProductPlan& plan, FftEffort effort)
      : count_(plan.row_grid.columns),
        in_(plan.transform_size, effort),
        out_(plan.row_grid.signs_z.size(), in_),
        columns_(plan.column_grid.signs_z.size()),
        spectra_(std::make_shared<const std::vector<double>>(scaled(plan))) {
    for (const std::int8_t row : plan.row_grid.signs_z)
      for (const std::int8_t column : plan.column_grid.signs_z) turns_.push_back(row != column);
  }

  void add(const double* x, double* y) noexcept override {
    for (std::size_t c = 0; c < columns_; ++c) {
      std::copy_n(x + c * count_, count_, in_.samples().begin());  // beyond them: zeros for ever
      in_.forward();
      for (std::size_t u = 0; u < out_.size(); ++u) filter(c, u);
    }
    for (std::size_t u = 0; u < out_.size(); ++u) {
      out_[u].backward();
      const double* const samples = out_[u].samples().data();
      for (std::size_t i = 0; i < count_; ++i) y[u * count_ + i] += samples[i];
    }
  }

  [[nodiscard]] std::unique_ptr<Convolution> clone() const override {
    return std::make_unique<FftConvolution>(*this);
  }

 private:
  /// A transform and its inverse multiply by the size.
  static std::vector<double> scaled(const ProductPlan& plan) {
    std::vector<double> spectra = plan.spectra;
    for (double& value : spectra) value /= static_cast<double>(plan.transform_size);
    return spectra;
  }

  /// out = H in for the first column, out += H in for the others; H is real, or i times real.
  void filter(std::size_t c, std::size_t u) noexcept {
    const std::size_t bins = in_.bins().size();
    const std::size_t block = u * columns_ + c;
    const double* const h = spectra_->data() + block * bins;
    const auto* const in = reinterpret_cast<const double*>(in_.bins().data());
    auto* const out = reinterpret_cast<double*>(out_[u].bins().data());
    const auto each = [&](auto turn, auto first) {
      for (std::size_t k = 0; k < bins; ++k) {
        const double real = turn ? -h[k] * in[2 * k + 1] : h[k] * in[2 * k];
        const double imaginary = turn ? h[k] * in[2 * k] : h[k] * in[2 * k + 1];
        out[2 * k] = first ? real : out[2 * k] + real;
        out[2 * k + 1] = first ? imaginary : out[2 * k + 1] + imaginary;
      }
    };
    if (turns_[block] && c == 0)
      each(std::true_type{}, std::true_type{});
    else if (turns_[block])
      each(std::true_type{}, std::false_type{});
    else if (c == 0)
      each(std::false_type{}, std::true_type{});
    else
      each(std::false_type{}, std::false_type{});
  }

  std::size_t count_;
  RealFft in_;
  std::vector<RealFft> out_;  // one per row block
  std::size_t columns_;
  std::shared_ptr<const std::vector<double>> spectra_;
  std::vector<char> turns_;  // of each block: i times real
};

}  // namespace

ConvolutionMaker fft_convolutions(FftEffort effort) {
  return [effort](const ProductPlan& plan) -> std::unique_ptr<Convolution> {
    check(plan);
    if (plan.structure != Structure::fft)
      throw std::invalid_argument("a convolution needs a plan of structure fft");
    return std::make_unique<FftConvolution>(plan, effort);
  };
}

}  // namespace tactile_net
