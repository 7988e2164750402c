#include <cmath>
#include <exception>
#include <string>
#include <variant>

#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/skin_run.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/sweep/row.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::sweep {
namespace {

std::string one_line(std::string_view text) {
  while (text.ends_with('\n')) text.remove_suffix(1);
  std::vector<std::string> lines;
  for (const std::string_view line : split(text, '\n')) lines.push_back(printable(line));
  return join(lines, "; ");
}

/// A refusal without the simulator's folders that it names, which are other ones every time. What
/// else has a slash stays, units above all: "1/s".
std::string without_paths(std::string_view text) {
  text = text.substr(0, text.find("\n  deck and log: "));
  std::vector<std::string> words;
  for (const std::string_view word : split(text, ' '))
    if (word.find("/tactile-net-") == word.npos) words.emplace_back(word);
  return join(words, " ");
}

Row row_at(const Point& point) {
  Row row{.index = point.index,
          .seed = point.seed,
          .version = std::string(version()),
          .instructions = std::string(name(widest_instruction_set()))};
  for (const AxisValue& value : point.values) row.values.push_back(printable(value.plain));
  return row;
}

/// mean |p - truth| [Pa]
double mean_error(const lab::SkinExperiment& experiment) {
  const auto found =
      lab::component(experiment.answer->tractions, experiment.grid, Traction::normal);
  double sum = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i)
    sum += std::abs(found[i] - experiment.frame.truth[i]);
  return sum / static_cast<double>(found.size());
}

/// One after the other.
std::vector<double> both(std::vector<double> normal, const std::vector<double>& tangential) {
  normal.insert(normal.end(), tangential.begin(), tangential.end());
  return normal;
}

Row row_of(const Point& point, const lab::Experiment& experiment, const lab::MethodResult& result) {
  Row row = row_at(point);
  row.readings = raw_numbers(experiment.scene, experiment.frame.readings);
  row.truth = both(experiment.frame.truth.normal, experiment.frame.truth.tangential);
  row.method = name(result.method);
  row.verdict = lab::name(result.verdict);
  row.failure = one_line(without_paths(result.refusal));
  if (result.alpha) row.alpha = result.alpha->value;
  if (!result.has_answer()) return row;
  row.error = result.normal.relative_l2;
  row.mean_error = result.normal.mean_abs;
  if (!result.tangential.traction.empty()) row.error_tangential = result.tangential.relative_l2;
  row.force = result.force;
  const Resultant sum =
      resultant_of(result.normal.traction, result.tangential.traction, surface(experiment.scene));
  if (!result.tangential.traction.empty()) row.tangential_force = sum.tangential;
  row.centre_y = sum.centre();
  row.tractions = both(result.normal.traction, result.tangential.traction);
  if (result.condition) row.condition = result.condition->value;
  row.error_bound = result.error_bound;
  return row;
}

/// Of a skin: its errors over the true pressure, its force in N.
Row row_of(const Point& point, const lab::SkinExperiment& experiment) {
  Row row = row_at(point);
  row.method = name(Method::tikhonov);
  row.failure = one_line(without_paths(experiment.refusal));
  row.readings = raw_numbers(experiment.scene, experiment.frame.readings);
  row.truth = experiment.frame.truth;
  if (!experiment.answer) return row;
  const lab::FrameAnswer& answer = *experiment.answer;
  row.verdict = lab::name(answer.verdict);
  row.alpha = answer.alpha.value;
  row.error = experiment.relative[0];
  row.error_tangential = std::hypot(experiment.relative[1], experiment.relative[2]);
  row.mean_error = mean_error(experiment);
  row.force = answer.wrench.normal.value;
  const UncertainWrench& wrench = answer.wrench;
  if (wrench.tangential_y && wrench.tangential_z)
    row.tangential_force = std::hypot(wrench.tangential_y->value, wrench.tangential_z->value);
  if (wrench.centre_y) row.centre_y = wrench.centre_y->value;
  if (wrench.centre_z) row.centre_z = wrench.centre_z->value;
  row.tractions = answer.tractions;
  row.condition = answer.condition->value;
  return row;
}

/// Keeps nothing of a failure: there may be thousands, and a row says what it was.
class Tidy final : public Simulator {
 public:
  explicit Tidy(Simulator& simulator) : simulator_(simulator) {}
  [[nodiscard]] Simulation run(const std::string& deck) override {
    try {
      return simulator_.run(deck);
    } catch (const SimulatorError& error) {
      error.discard();
      throw;
    }
  }

 private:
  Simulator& simulator_;
};

/// What is wrong, without the places in the file: the values that matter are not in it.
std::string messages(const InputError& error) {
  std::vector<std::string> all;
  for (const Diagnostic& diagnostic : error.diagnostics()) all.push_back(diagnostic.message);
  return join(all, "; ");
}

}  // namespace

Row failed_row(const Point& point, std::string_view why) {
  Row row = row_at(point);
  row.failure = one_line(why);
  return row;
}

std::vector<Row> solve(const Study& study, std::size_t index, Simulator& simulator) {
  const Point point = study.point(index);
  try {
    const AnyScene scene = study.scene(point);
    if (const auto* skin = std::get_if<SkinScene>(&scene)) return {row_of(point, lab::run(*skin))};
    std::vector<Row> rows;
    Tidy tidy(simulator);
    const lab::Experiment experiment = lab::run(std::get<Scene>(scene), tidy);
    for (const lab::MethodResult& result : experiment.results)
      rows.push_back(row_of(point, experiment, result));
    return rows;
  } catch (const InputError& error) {
    return {failed_row(point, messages(error))};
  } catch (const std::exception& error) {
    return {failed_row(point, error.what())};
  }
}

}  // namespace tactile_net::sweep
