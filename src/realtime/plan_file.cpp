#include "tactile_net/realtime/plan_file.hpp"

#include <array>
#include <bit>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace tactile_net {
namespace {

constexpr std::string_view magic = "TNETPLAN";
constexpr std::size_t header_size = 8 + 4 + 8;
constexpr std::size_t checksum_size = 8;

/// CRC-64/XZ: reflected ECMA-182, all ones before and after. Finds every burst of up to 64 bits.
std::uint64_t checksum(std::span<const std::byte> bytes) {
  static const auto table = [] {
    std::array<std::uint64_t, 256> entries{};
    for (std::size_t i = 0; i < entries.size(); ++i) {
      std::uint64_t value = i;
      for (int bit = 0; bit < 8; ++bit)
        value = (value >> 1) ^ ((value & 1) != 0 ? 0xC96C5795D7870F42U : 0U);
      entries[i] = value;
    }
    return entries;
  }();
  std::uint64_t sum = ~std::uint64_t{0};
  for (const std::byte byte : bytes)
    sum = (sum >> 8) ^ table[(sum ^ std::to_integer<std::uint64_t>(byte)) & 0xFF];
  return ~sum;
}

class Writer {
 public:
  template <class Integer>
  void integer(Integer value) {
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
      bytes_.push_back(static_cast<std::byte>(static_cast<std::uint64_t>(value) >> (8 * i)));
  }
  void size(std::size_t value) { integer<std::uint64_t>(value); }
  void flag(bool value) { integer<std::uint8_t>(value ? 1 : 0); }
  void number(double value) { integer(std::bit_cast<std::uint64_t>(value)); }
  void text(std::string_view value) {
    for (const char letter : value) bytes_.push_back(static_cast<std::byte>(letter));
  }
  void numbers(const std::vector<double>& values) {
    size(values.size());
    for (const double value : values) number(value);
  }
  void signs(const std::vector<std::int8_t>& values) {
    size(values.size());
    for (const std::int8_t value : values) integer(static_cast<std::uint8_t>(value));
  }
  void product(const ProductPlan& plan, PlanVersion version) {
    integer(static_cast<std::uint8_t>(plan.structure));
    integer(static_cast<std::uint8_t>(plan.precision));
    size(plan.rows);
    size(plan.columns);
    number(plan.scale);
    if (version < PlanVersion::lines)
      for (int side = 0; side < 2; ++side) signs({});  // of lines alone
    size(plan.factors.size());
    for (const Factor& factor : plan.factors) {
      size(factor.rows);
      size(factor.columns);
      for (const double value : factor.values)
        if (plan.precision == Precision::float64)
          number(value);
        else
          integer(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
    }
    if (plan.structure == Structure::fft) {
      size(plan.transform_size);
      numbers(plan.spectra);
    }
    if (has_reflections(plan.structure))
      for (const GridBlocks* blocks : {&plan.row_grid, &plan.column_grid}) grid(*blocks);
  }
  void grid(const GridBlocks& blocks) {
    size(blocks.rows);
    size(blocks.columns);
    signs(blocks.signs_y);
    signs(blocks.signs_z);
    indices(blocks.partners);
  }
  void indices(const std::vector<std::uint32_t>& values) {
    size(values.size());
    for (const std::uint32_t value : values) integer(value);
  }
  void cells(const PlanCells& cells) {
    size(cells.rows);
    size(cells.columns);
    for (const double value : {cells.spacing_y, cells.spacing_z, cells.centre_y, cells.centre_z})
      number(value);
    numbers(cells.deviations);
    size(cells.rim_rows);
    size(cells.rim_columns);
  }
  void windows(const PlanCells& cells) {
    numbers(cells.window_deviations);
    size(cells.window_rows);
    size(cells.window_columns);
  }
  void fill(const Factor& factor) {
    size(factor.rows);
    numbers(factor.values);
  }
  void cone(const ConePlan& cone) {
    flag(cone.friction_limit.has_value());
    if (cone.friction_limit) number(*cone.friction_limit);
    size(cone.steps);
    for (const double value : {cone.tangential_scale, cone.bound, cone.rounding,
                               cone.expected.median, cone.expected.high, cone.expected.worst})
      number(value);
    flag(cone.unknown_offsets);
    product(cone.step, PlanVersion::cone);
  }
  [[nodiscard]] std::vector<std::byte>& bytes() noexcept { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

// What versions before `PlanVersion::lines` call reflections of lines. These, and fft there, have a
// sign for each block in place of grids, and the factors of (+, +) and (+, -) alone.
constexpr std::uint8_t older_parity = 2;
constexpr std::uint8_t older_parity_low_rank = 3;

GridBlocks line_of(std::size_t size, std::vector<std::int8_t> signs) {
  if (signs.empty() || size % signs.size() != 0)
    throw std::runtime_error("the plan's blocks are not of equal length");
  const std::size_t length = size / signs.size();  // before they are moved from
  return line_blocks(length, std::move(signs));
}

/// Never reads beyond the end, never reserves more than what is left can hold.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class Integer>
  Integer integer() {
    std::uint64_t value = 0;
    const auto bytes = take(sizeof(Integer));
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
      value |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
    return static_cast<Integer>(value);
  }
  double number() { return std::bit_cast<double>(integer<std::uint64_t>()); }
  bool flag() {
    const auto value = integer<std::uint8_t>();
    if (value > 1) throw std::runtime_error("the plan holds a flag that is neither 0 nor 1");
    return value == 1;
  }
  std::size_t length(std::size_t item_size) {
    const auto value = integer<std::uint64_t>();
    if (value > rest_.size() / item_size) fail();
    return static_cast<std::size_t>(value);
  }
  std::size_t size() {
    const auto value = integer<std::uint64_t>();
    if (!std::in_range<std::size_t>(value)) fail();  // a machine of 32 bits
    return static_cast<std::size_t>(value);
  }
  std::string text() {
    std::string value;
    for (const std::byte byte : take(length(1))) value += static_cast<char>(byte);
    return value;
  }
  std::vector<double> numbers() {
    std::vector<double> values(length(sizeof(double)));
    for (double& value : values) value = number();
    return values;
  }
  std::vector<std::int8_t> signs() {
    std::vector<std::int8_t> values(length(1));
    for (std::int8_t& value : values) value = static_cast<std::int8_t>(integer<std::uint8_t>());
    return values;
  }
  ProductPlan product(PlanVersion version) {
    ProductPlan plan;
    const auto structure = integer<std::uint8_t>();
    const bool older = version < PlanVersion::lines;
    plan.structure = older && structure == older_parity ? Structure::reflections
                     : older && structure == older_parity_low_rank
                         ? Structure::reflections_low_rank
                         : static_cast<Structure>(structure);
    plan.precision = static_cast<Precision>(integer<std::uint8_t>());
    if (!is_known(plan.structure) || !is_known(plan.precision))
      throw std::runtime_error("product plan: structure or precision is unknown");
    plan.rows = size();
    plan.columns = size();
    plan.scale = number();
    std::vector<std::int8_t> row_signs;
    std::vector<std::int8_t> column_signs;
    if (older) {
      row_signs = signs();
      column_signs = signs();
    }
    const std::size_t bytes = plan.precision == Precision::float64 ? 8 : 4;
    plan.factors.resize(length(2 * sizeof(std::uint64_t)));
    for (Factor& factor : plan.factors) {
      factor.rows = size();
      factor.columns = size();
      if (factor.columns != 0 && factor.rows > rest_.size() / bytes / factor.columns) fail();
      factor.values.resize(factor.rows * factor.columns);
      for (double& value : factor.values)
        value = bytes == 8 ? number()
                           : static_cast<double>(std::bit_cast<float>(integer<std::uint32_t>()));
    }
    if (plan.structure == Structure::fft) {
      plan.transform_size = size();
      plan.spectra = numbers();
    }
    const bool signs_alone =
        older && (structure == older_parity || structure == older_parity_low_rank ||
                  plan.structure == Structure::fft);
    if (signs_alone) {
      plan.row_grid = line_of(plan.rows, std::move(row_signs));
      plan.column_grid = line_of(plan.columns, std::move(column_signs));
      plan.factors.resize(2 * plan.factors.size());  // the other two classes have no places
    } else if (has_reflections(plan.structure)) {
      for (GridBlocks* blocks : {&plan.row_grid, &plan.column_grid}) *blocks = grid();
    }
    return plan;
  }
  GridBlocks grid() {
    GridBlocks blocks;
    blocks.rows = size();
    blocks.columns = size();
    blocks.signs_y = signs();
    blocks.signs_z = signs();
    blocks.partners = indices();
    return blocks;
  }
  std::vector<std::uint32_t> indices() {
    std::vector<std::uint32_t> values(length(sizeof(std::uint32_t)));
    for (std::uint32_t& value : values) value = integer<std::uint32_t>();
    return values;
  }
  PlanCells cells() {
    PlanCells cells;
    cells.rows = size();
    cells.columns = size();
    for (double* const value :
         {&cells.spacing_y, &cells.spacing_z, &cells.centre_y, &cells.centre_z})
      *value = number();
    cells.deviations = numbers();
    cells.rim_rows = size();
    cells.rim_columns = size();
    return cells;
  }
  void windows(PlanCells& cells) {
    cells.window_deviations = numbers();
    cells.window_rows = size();
    cells.window_columns = size();
  }
  ConePlan cone() {
    ConePlan cone;
    if (flag()) cone.friction_limit = number();
    cone.steps = size();
    for (double* const value : {&cone.tangential_scale, &cone.bound, &cone.rounding,
                                &cone.expected.median, &cone.expected.high, &cone.expected.worst})
      *value = number();
    cone.unknown_offsets = flag();
    cone.step = product(PlanVersion::cone);
    return cone;
  }
  /// @param columns  the plan's readings
  Factor fill(std::size_t columns) {
    Factor factor{.rows = size(), .columns = columns};
    factor.values = numbers();
    return factor;
  }
  [[nodiscard]] bool at_end() const noexcept { return rest_.empty(); }

 private:
  [[noreturn]] static void fail() {
    throw std::runtime_error("the plan's sizes contradict its length");
  }
  std::span<const std::byte> take(std::size_t count) {
    if (count > rest_.size()) fail();
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }

  std::span<const std::byte> rest_;
};

/// The first version that has what a plan holds beside its products.
PlanVersion version_beside_products(const EstimatorPlan& plan) {
  if (plan.known_offsets || !plan.border.empty()) return PlanVersion::border;
  if (plan.cells)
    return plan.cells->window_deviations.empty() ? PlanVersion::skin : PlanVersion::windows;
  if (!plan.taxels.empty()) return PlanVersion::taxels;
  if (plan.residual_limit > 0.0 || plan.traction_limit > 0.0 || plan.force_deviation > 0.0)
    return PlanVersion::doubts;
  if (plan.values != plan.count || plan.centre != 0.0) return PlanVersion::surface;
  return plan.baseline.empty() ? PlanVersion::readings : PlanVersion::baseline;
}

PlanVersion version_of(const EstimatorPlan& plan) {
  const bool folds_lines =
      !plan.cells && (plan.fill || has_reflections(plan.reconstruction.structure) ||
                      (plan.prediction && has_reflections(plan.prediction->structure)));
  if (plan.space) return PlanVersion::space;
  if (plan.cone) return PlanVersion::cone;
  return folds_lines ? PlanVersion::lines : version_beside_products(plan);
}

EstimatorPlan read_payload(std::span<const std::byte> payload, PlanVersion version) {
  Reader in(payload);
  EstimatorPlan plan;
  plan.label = in.text();
  plan.count = in.size();
  plan.channels = in.size();
  plan.unknowns = in.size();
  plan.values = plan.count;
  plan.spacing = in.number();
  plan.alpha = in.number();
  plan.accuracy = in.number();
  plan.error_bound = in.number();
  plan.reconstruction = in.product(version);
  if (in.flag()) plan.prediction = in.product(version);
  plan.weights = in.numbers();
  plan.leverages = in.numbers();
  plan.noise_rms = in.number();
  plan.outlier_limit = in.number();
  if (in.flag()) plan.friction_coefficient = in.number();
  plan.ranges.resize(in.length(2 * sizeof(double)));
  for (ReadingRange& range : plan.ranges) {
    range.lowest = in.number();
    range.highest = in.number();
  }
  if (version >= PlanVersion::baseline) plan.baseline = in.numbers();
  if (version >= PlanVersion::surface) {
    plan.values = in.size();
    plan.centre = in.number();
  }
  if (version >= PlanVersion::doubts) {
    plan.residual_limit = in.number();
    plan.traction_limit = in.number();
    plan.force_deviation = in.number();
  }
  if (version >= PlanVersion::taxels) plan.taxels = in.indices();
  const bool of_either = version >= PlanVersion::border;  // a line or a skin
  const bool skin = version >= PlanVersion::skin && (!of_either || in.flag());
  if (skin) {
    plan.cells = in.cells();
    plan.unjudged = in.indices();
    if (in.flag()) plan.fill = in.fill(plan.readings());
  }
  if (skin && version >= PlanVersion::windows) in.windows(*plan.cells);
  if (version >= PlanVersion::border) {
    plan.border = in.indices();
    plan.known_offsets = in.flag();
  }
  if (version == PlanVersion::lines && !in.at_end()) plan.fill = in.fill(plan.readings());
  if (version >= PlanVersion::space)
    plan.space = PlanSpace{.wrench = in.numbers(), .places = in.numbers()};
  if (version == PlanVersion::cone || (version > PlanVersion::cone && in.flag())) {
    if (!skin && in.flag()) plan.fill = in.fill(plan.readings());
    if (!skin && in.flag()) in.windows(plan.line_cells.emplace(in.cells()));
    plan.cone = in.cone();
  }
  if ((version < PlanVersion::lines ? version_beside_products(plan) : version_of(plan)) != version)
    throw std::runtime_error("the plan holds nothing of what its version is for");
  if (!in.at_end()) throw std::runtime_error("the plan goes on after its end");
  check(plan);
  return plan;
}

}  // namespace

std::vector<std::byte> encode_plan(const EstimatorPlan& plan) {
  check(plan);
  const PlanVersion version = version_of(plan);
  Writer payload;
  payload.size(plan.label.size());
  payload.text(plan.label);
  payload.size(plan.count);
  payload.size(plan.channels);
  payload.size(plan.unknowns);
  payload.number(plan.spacing);
  payload.number(plan.alpha);
  payload.number(plan.accuracy);
  payload.number(plan.error_bound);
  payload.product(plan.reconstruction, version);
  payload.flag(plan.prediction.has_value());
  if (plan.prediction) payload.product(*plan.prediction, version);
  payload.numbers(plan.weights);
  payload.numbers(plan.leverages);
  payload.number(plan.noise_rms);
  payload.number(plan.outlier_limit);
  payload.flag(plan.friction_coefficient.has_value());
  if (plan.friction_coefficient) payload.number(*plan.friction_coefficient);
  payload.size(plan.ranges.size());
  for (const ReadingRange& range : plan.ranges) {
    payload.number(range.lowest);
    payload.number(range.highest);
  }

  if (version >= PlanVersion::baseline) payload.numbers(plan.baseline);
  if (version >= PlanVersion::surface) {
    payload.size(plan.values);
    payload.number(plan.centre);
  }
  if (version >= PlanVersion::doubts) {
    payload.number(plan.residual_limit);
    payload.number(plan.traction_limit);
    payload.number(plan.force_deviation);
  }
  if (version >= PlanVersion::taxels) payload.indices(plan.taxels);
  if (version >= PlanVersion::border) payload.flag(plan.cells.has_value());
  if (plan.cells) {
    payload.cells(*plan.cells);
    payload.indices(plan.unjudged);
    payload.flag(plan.fill.has_value());
    if (plan.fill) payload.fill(*plan.fill);
  }
  if (plan.cells && version >= PlanVersion::windows) payload.windows(*plan.cells);
  if (version >= PlanVersion::border) {
    payload.indices(plan.border);
    payload.flag(plan.known_offsets);
  }
  if (plan.space) {
    payload.numbers(plan.space->wrench);
    payload.numbers(plan.space->places);
    payload.flag(plan.cone.has_value());
  }
  if (!plan.cells && plan.cone) payload.flag(plan.fill.has_value());
  if (!plan.cells && plan.fill) payload.fill(*plan.fill);
  if (plan.cone) {
    if (!plan.cells) payload.flag(plan.line_cells.has_value());
    if (plan.line_cells) {
      payload.cells(*plan.line_cells);
      payload.windows(*plan.line_cells);
    }
    payload.cone(*plan.cone);
  }

  Writer file;
  file.text(magic);
  file.integer(static_cast<std::uint32_t>(version));
  file.size(payload.bytes().size());
  std::vector<std::byte>& bytes = file.bytes();
  bytes.insert(bytes.end(), payload.bytes().begin(), payload.bytes().end());
  file.integer(checksum(bytes));
  return std::move(bytes);
}

EstimatorPlan decode_plan(std::span<const std::byte> bytes) {
  for (std::size_t i = 0; i < magic.size(); ++i)
    if (i >= bytes.size() || bytes[i] != static_cast<std::byte>(magic[i]))
      throw std::runtime_error("this is not a plan: it does not begin with " + std::string(magic));
  if (bytes.size() < header_size + checksum_size)
    throw std::runtime_error("the plan is truncated: " + std::to_string(bytes.size()) + " bytes");
  Reader header(bytes.subspan(magic.size()));
  const auto version = header.integer<std::uint32_t>();
  constexpr auto newest = static_cast<std::uint32_t>(newest_plan_version);
  if (version < 1 || version > newest)
    throw std::runtime_error("the plan has version " + std::to_string(version) +
                             ", this library reads versions 1 to " + std::to_string(newest) +
                             ": make it anew");
  const auto length = header.integer<std::uint64_t>();
  const std::size_t held = bytes.size() - header_size - checksum_size;
  if (length != held)
    throw std::runtime_error(
        "the plan is " + std::string(length > held ? "truncated" : "too long") + ": " +
        std::to_string(length) + " bytes announced, " + std::to_string(held) + " there");
  const auto content = bytes.first(header_size + held);
  if (Reader(bytes.last(checksum_size)).integer<std::uint64_t>() != checksum(content))
    throw std::runtime_error("the plan is corrupted: its checksum does not match");
  try {
    return read_payload(content.subspan(header_size), static_cast<PlanVersion>(version));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace tactile_net
