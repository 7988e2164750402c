#include "skin_fields.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "tactile_net/report/csv/skin_csv.hpp"
#include "tactile_net/report/words/data_words.hpp"

namespace tactile_net::python {
namespace {

/// `size` values of every answer, one answer a row; what is not known is NaN.
template <class Of>
Array rows_of(Answers answers, std::size_t size, Of of) {
  std::vector<double> all;
  all.reserve(answers.size() * size);
  for (const auto& answer : answers) {
    const std::size_t end = all.size() + size;
    if (answer) {
      const auto& values = of(*answer);
      all.insert(all.end(), values.begin(), values.end());
    }
    all.resize(end, unknown);
  }
  return owned(std::move(all), {answers.size(), size});
}

/// Components x cells, as `deviations` too.
Array tractions_of(Answers answers, std::size_t width) {
  return rows_of(
      answers, width, [](const auto& one) -> const auto& { return one.tractions; });
}

Array deviations_of(Answers answers, std::size_t width) {
  return rows_of(answers, width, [&](const lab::FrameAnswer& one) {
    return one.deviations.empty() ? std::vector<double>(width, unknown) : one.deviations;
  });
}

/// 1 for a cell that touches, else 0.
Array touching_of(Answers answers, const SurfaceGrid& grid) {
  std::vector<double> all(answers.size() * grid.count());
  for (std::size_t i = 0; i < answers.size(); ++i)
    if (answers[i])
      for (const std::size_t cell : answers[i]->cells) all[i * grid.count() + cell] = 1.0;
  return owned(std::move(all), {answers.size(), grid.count()});
}

/// Of each name the value and its deviation.
Array wrenches_of(Answers answers, const std::vector<std::string>& names) {
  const std::vector<std::string> columns = report::resultant_columns();
  std::vector<std::size_t> places;
  for (const std::string& name : names)
    places.push_back(static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) -
                                              columns.begin()));
  return rows_of(answers, 2 * names.size(), [&](const lab::FrameAnswer& one) {
    const std::vector<double> all = report::resultant_values(one);
    std::vector<double> values;
    for (const std::size_t place : places) {
      values.push_back(all.at(place));
      values.push_back(all.at(place + 1));
    }
    return values;
  });
}

Array covariances_of(Answers answers) {
  return rows_of(
      answers, 36, [](const auto& one) -> const auto& { return one.wrench.covariance; });
}

/// Of a curved skin force, moment and centre in the sensor's axes, each with its deviation.
Array spaces_of(Answers answers) {
  return rows_of(answers, 18, [](const lab::FrameAnswer& one) {
    std::vector<double> values;
    if (!one.wrench.space) return std::vector<double>(18, unknown);
    const SpaceWrench& space = *one.wrench.space;
    const std::array<Uncertain, 3> none = {
        {{unknown, unknown}, {unknown, unknown}, {unknown, unknown}}};
    for (const auto& three : {space.force, space.moment, space.centre.value_or(none)})
      for (const Uncertain& number : three) {
        values.push_back(number.value);
        values.push_back(number.deviation);
      }
    return values;
  });
}

/// Radius, second radius and angle of the strongest contact, each with its deviation.
Array ellipses_of(Answers answers) {
  return rows_of(answers, 6, [](const lab::FrameAnswer& one) {
    if (!one.ellipse) return std::vector<double>(6, unknown);
    const ContactEllipse& found = *one.ellipse;
    return std::vector{found.radius.value,        found.radius.deviation,
                       found.second_radius.value, found.second_radius.deviation,
                       found.angle.value,         found.angle.deviation};
  });
}

}  // namespace

nb::typed<nb::dict, nb::str, nb::any> fields_of(Answers answers, const SkinScene& scene,
                                                const SurfaceGrid& grid, std::size_t width,
                                                const std::vector<std::string>& wrench) {
  nb::typed<nb::dict, nb::str, nb::any> found;
  std::vector<std::string> verdicts;
  std::vector<std::string> data;
  std::vector<std::string> sources;
  std::vector<double> alphas;
  std::vector<std::size_t> contacts;
  for (const auto& answer : answers) {
    verdicts.emplace_back(answer ? lab::name(answer->verdict) : "missing");
    data.emplace_back(answer ? report::data_word(*answer->data, scene) : "missing");
    sources.emplace_back(answer ? lab::source(answer->alpha) : "");
    alphas.push_back(answer ? answer->alpha.value : unknown);
    contacts.push_back(answer ? answer->patches.size() : 0);
  }
  found["tractions"] = tractions_of(answers, width);
  found["deviation"] = deviations_of(answers, width);
  found["touching"] = touching_of(answers, grid);
  found["wrench"] = wrenches_of(answers, wrench);
  found["covariance"] = covariances_of(answers);
  if (scene.sensor.curved) found["space"] = spaces_of(answers);
  found["ellipse"] = ellipses_of(answers);
  found["verdict"] = verdicts;
  found["data"] = data;
  found["alpha"] = owned(std::move(alphas));
  found["alpha_source"] = sources;
  found["contacts"] = contacts;
  return found;
}

nb::typed<nb::tuple, nb::typed<nb::list, nb::any>, nb::any> uncertainty_of(Answers answers,
                                                                           const SkinScene& scene) {
  const lab::SkinSceneProblem problem(scene);
  std::vector<std::string> names = report::uncertainty_columns(problem);
  names.pop_back();
  const Array values = rows_of(answers, names.size(), [&](const lab::FrameAnswer& one) {
    return report::uncertainty_values(problem, one);
  });
  return nb::make_tuple(nb::cast(names), values);
}

}  // namespace tactile_net::python
