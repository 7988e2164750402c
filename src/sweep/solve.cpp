#include <cmath>
#include <exception>
#include <string>
#include <variant>

#include "tactile_net/lab/run.hpp"
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

/// What both have.
Row row_of_result(const Point& point, const lab::Experiment& experiment,
                  const lab::MethodResult& result) {
  Row row = row_at(point);
  row.readings =
      std::visit([&](const auto& scene) { return raw_numbers(scene, experiment.frame.readings); },
                 experiment.scene);
  row.truth = experiment.frame.truth;
  row.method = name(result.method);
  row.verdict = lab::name(result.answer.verdict);
  row.failure = one_line(without_paths(result.refusal));
  const lab::FrameAnswer& answer = result.answer;
  if (answer.alpha.known()) row.alpha = answer.alpha.value;
  if (!result.has_answer()) return row;
  row.error = result.errors.front().relative;
  row.mean_error = result.errors.front().mean_abs;
  row.tractions = answer.tractions;
  if (answer.condition) row.condition = answer.condition->value;
  return row;
}

Row row_of_line(const Point& point, const lab::Experiment& experiment,
                const lab::MethodResult& result) {
  Row row = row_of_result(point, experiment, result);
  if (!result.has_answer()) return row;
  const bool drags = result.errors.size() > 1;
  const auto component = [&](std::size_t which) {
    return lab::component(result.answer.tractions, experiment.places(), which);
  };
  const Resultant sum = resultant_of(component(0), component(1), surface(experiment.line()));
  if (drags) row.error_tangential = result.errors[1].relative;
  if (drags) row.tangential_force = sum.tangential;
  row.force = result.force;
  row.centre_y = sum.centre();
  row.error_bound = result.answer.error_bound;
  return row;
}

/// Of a skin: its errors over the true pressure, its force in N.
Row row_of_skin(const Point& point, const lab::Experiment& experiment) {
  const lab::MethodResult& result = experiment.results.front();
  Row row = row_of_result(point, experiment, result);
  if (!result.has_answer()) return row;
  if (result.errors.size() > 2)
    row.error_tangential = std::hypot(result.errors[1].relative, result.errors[2].relative);
  const UncertainWrench& wrench = result.answer.wrench;
  row.force = wrench.normal.value;
  if (wrench.tangential_y && wrench.tangential_z)
    row.tangential_force = std::hypot(wrench.tangential_y->value, wrench.tangential_z->value);
  if (wrench.centre_y) row.centre_y = wrench.centre_y->value;
  if (wrench.centre_z) row.centre_z = wrench.centre_z->value;
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

Row failed_row(const Point& point, std::string_view why) {
  Row row = row_at(point);
  row.failure = one_line(why);
  return row;
}

}  // namespace

std::vector<Row> solve(const Study& study, std::size_t index, Simulator& simulator,
                       lab::Observer& observer) {
  const Point point = study.point(index);
  try {
    const AnyScene scene = study.scene(point);
    if (const auto* skin = std::get_if<SkinScene>(&scene))
      return {row_of_skin(point, lab::run(*skin, {}, observer))};
    std::vector<Row> rows;
    Tidy tidy(simulator);
    const lab::Experiment experiment = lab::run(std::get<Scene>(scene), tidy, {}, observer);
    for (const lab::MethodResult& result : experiment.results)
      rows.push_back(row_of_line(point, experiment, result));
    return rows;
  } catch (const InputError& error) {
    return {failed_row(point, messages(error))};
  } catch (const std::exception& error) {
    return {failed_row(point, error.what())};
  }
}

}  // namespace tactile_net::sweep
