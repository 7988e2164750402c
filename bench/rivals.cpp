#include "bench/rivals.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <new>
#ifdef OPENBLAS
#include <cblas.h>
#endif

namespace bench {
namespace {

using Vector = Eigen::Map<Eigen::VectorXd>;
using ConstVector = Eigen::Map<const Eigen::VectorXd>;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

typedef double Widest __attribute__((vector_size(__BIGGEST_ALIGNMENT__), may_alias));
constexpr std::size_t lanes = sizeof(Widest) / sizeof(double);
constexpr std::size_t sums = 8;  // two additions a cycle, each four cycles long

template <std::size_t ahead>
double sum_of(const double* values, std::size_t count) noexcept {
  Widest sum[sums] = {};
  std::size_t i = 0;
  for (; i + sums * lanes <= count; i += sums * lanes) {
    if constexpr (ahead > 0)
      for (std::size_t k = 0; k < sums * lanes; k += 8)
        __builtin_prefetch(values + i + k + ahead / sizeof(double));
#pragma GCC unroll 8
    for (std::size_t k = 0; k < sums; ++k)
      sum[k] += *reinterpret_cast<const Widest*>(values + i + k * lanes);
  }
  for (std::size_t k = 0; i < count; ++k, i += lanes)
    sum[k] += *reinterpret_cast<const Widest*>(values + i);
  for (std::size_t k = 1; k < sums; ++k) sum[0] += sum[k];
  double total = 0.0;
  for (std::size_t k = 0; k < lanes; ++k) total += sum[0][k];
  return total;
}

}  // namespace

struct Rivals::Parts {
  Eigen::MatrixXd kernel;
  Eigen::MatrixXd normal;
  Eigen::LDLT<Eigen::MatrixXd> factors;
  Eigen::LDLT<Eigen::MatrixXd> again;
  std::size_t padded;  // doubles of M, to whole cache lines
  struct Free {
    void operator()(double* values) const noexcept {
      ::operator delete (values, std::align_val_t{64});
    }
  };
  std::unique_ptr<double[], Free> matrix;
  mutable Eigen::VectorXd right;

  [[nodiscard]] Eigen::Map<const Eigen::MatrixXd, Eigen::AlignedMax> m() const noexcept {
    return {matrix.get(), kernel.cols(), kernel.rows()};
  }
};

Rivals::Rivals(const double* kernel, const double* normal, std::size_t rows, std::size_t columns)
    : parts_(std::make_unique<Parts>()) {
  const auto m = static_cast<Eigen::Index>(rows);
  const auto n = static_cast<Eigen::Index>(columns);
  parts_->kernel = Eigen::Map<const RowMajor>(kernel, m, n);
  parts_->normal = Eigen::Map<const RowMajor>(normal, n, n);
  parts_->factors.compute(parts_->normal);
  parts_->right.resize(n);
  parts_->padded = (rows * columns + 7) / 8 * 8;
  parts_->matrix.reset(
      static_cast<double*>(::operator new (parts_->padded * sizeof(double), std::align_val_t{64})));
  std::fill_n(parts_->matrix.get(), parts_->padded, 0.0);
  Eigen::Map<Eigen::MatrixXd>(parts_->matrix.get(), n, m) =
      parts_->factors.solve(parts_->kernel.transpose());
#ifdef OPENBLAS
  openblas_set_num_threads(1);
#endif
}

Rivals::~Rivals() = default;

const double* Rivals::matrix() const noexcept { return parts_->matrix.get(); }

void Rivals::eigen_product(const double* g, double* f) const noexcept {
  const auto m = parts_->m();
  Vector(f, m.rows()).noalias() = m * ConstVector(g, m.cols());
}

void Rivals::openblas_product([[maybe_unused]] const double* g,
                              [[maybe_unused]] double* f) const noexcept {
#ifdef OPENBLAS
  bench::openblas_product(parts_->matrix.get(), static_cast<std::size_t>(parts_->kernel.rows()),
                          static_cast<std::size_t>(parts_->kernel.cols()), g, f);
#endif
}

void Rivals::ldlt(const double* g, double* f) const noexcept {
  parts_->right.noalias() = parts_->kernel.transpose() * ConstVector(g, parts_->kernel.rows());
  Vector(f, parts_->right.size()) = parts_->factors.solve(parts_->right);
}

void Rivals::ldlt_solve(const double* b, double* f) const noexcept {
  const Eigen::Index n = parts_->normal.rows();
  Vector(f, n) = parts_->factors.solve(ConstVector(b, n));
}

void Rivals::factor_and_solve(const double* g, double* f) {
  parts_->again.compute(parts_->normal);
  parts_->right.noalias() = parts_->kernel.transpose() * ConstVector(g, parts_->kernel.rows());
  Vector(f, parts_->right.size()) = parts_->again.solve(parts_->right);
}

double Rivals::stream() const noexcept { return sum_of<0>(parts_->matrix.get(), parts_->padded); }
double Rivals::stream_with_prefetch() const noexcept {
  return sum_of<4096>(parts_->matrix.get(), parts_->padded);
}

double sum(const double* values, std::size_t count) noexcept { return sum_of<0>(values, count); }

void eigen_product(const double* matrix, std::size_t rows, std::size_t columns, const double* g,
                   double* f) noexcept {
  const auto m = static_cast<Eigen::Index>(rows);
  const auto n = static_cast<Eigen::Index>(columns);
  Vector(f, n).noalias() = Eigen::Map<const Eigen::MatrixXd>(matrix, n, m) * ConstVector(g, m);
}

void eigen_batch(const double* matrix, std::size_t rows, std::size_t columns, std::size_t frames,
                 const double* g, double* f) noexcept {
  const auto m = static_cast<Eigen::Index>(rows);
  const auto n = static_cast<Eigen::Index>(columns);
  const auto count = static_cast<Eigen::Index>(frames);
  Eigen::Map<Eigen::MatrixXd>(f, n, count).noalias() =
      Eigen::Map<const Eigen::MatrixXd>(matrix, n, m) *
      Eigen::Map<const Eigen::MatrixXd>(g, m, count);
}

namespace {
using Packet = Eigen::internal::packet_traits<double>::type;
constexpr std::size_t products = 12;  // more than a processor has under way at a time
}  // namespace

const std::size_t products_of_a_round = products * sizeof(Packet) / sizeof(double);

double multiply_in_registers(std::size_t rounds) noexcept {
  Packet sum[products];
  for (std::size_t i = 0; i < products; ++i)
    sum[i] = Eigen::internal::pset1<Packet>(static_cast<double>(i));
  Packet x = Eigen::internal::pset1<Packet>(0.5);
  for (std::size_t round = 0; round < rounds; ++round) {
    asm volatile("" : "+x"(x));  // not to be known
    for (Packet& one : sum) one = Eigen::internal::pmadd(one, x, x);
  }
  for (std::size_t i = 1; i < products; ++i) sum[0] = Eigen::internal::padd(sum[0], sum[i]);
  double lanes[sizeof(Packet) / sizeof(double)];
  Eigen::internal::pstoreu(lanes, sum[0]);
  return lanes[0];
}

void openblas_product([[maybe_unused]] const double* matrix, [[maybe_unused]] std::size_t rows,
                      [[maybe_unused]] std::size_t columns, [[maybe_unused]] const double* g,
                      [[maybe_unused]] double* f) noexcept {
#ifdef OPENBLAS
  openblas_set_num_threads(1);
  const auto m = static_cast<int>(columns);
  cblas_dgemv(CblasColMajor, CblasNoTrans, m, static_cast<int>(rows), 1.0, matrix, m, g, 1, 0.0, f,
              1);
#endif
}

std::string openblas() {
#ifdef OPENBLAS
  return std::string(openblas_get_config()) + ", kernels for " + openblas_get_corename();
#else
  return {};
#endif
}

}  // namespace bench
