#include "study/digital.hpp"
#include "study/points.hpp"
#include "tactile_net/study/jobs.hpp"

namespace tactile_net::study {

std::vector<StudyJob> digital_jobs(const StudyInput& input, const lab::Clock& clock) {
  using Family = StudySection (*)(const StudyInput&, const lab::Clock&);
  std::vector<StudyJob> jobs;
  const auto add = [&](Job::Kind kind, double weight, Family work) {
    jobs.push_back({.job = {kind}, .weight = weight, .timed = true, .run = [=, &input] {
                      const lab::Pinned pinned;
                      StudySection section;
                      try {
                        section = work(input, clock);
                      } catch (const std::exception&) {
                        section.points.push_back(
                            failed({.family = WorkCurve::Family::job, .job = Job{kind}}, {},
                                   TimeOf::frame, caught()));
                      }
                      section.job = {kind};
                      return section;
                    }});
  };
  using enum Job::Kind;
  add(products, 3.0, study::products);
  if (input.is_skin()) {
    const lab::SkinSceneProblem& skin = input.skin();
    add(factorisations, 1.0, skin_factorisations);
    if (is_even(skin.scene().sensor)) add(kronecker, 3.0, kronecker_sums);
    add(gradients, 3.0, skin_gradients);
    add(constraints, 1.0, skin_constrained);
    if (has_coarser_cells(skin)) add(coarser_surface, 1.0, coarser_cells);
    if (is_even(skin.scene().sensor)) add(array_sizes, 3.0, study::array_sizes);
    return jobs;
  }
  add(factorisations, 1.0, study::factorisations);
  add(fft, 1.0, by_fft);
  add(constraints, 1.0, constrained);
  add(fewer_taxels, 1.0, study::fewer_taxels);
  if (has_coarser_surface(input.line().scene())) add(coarser_surface, 1.0, study::coarser_surface);
  add(forward_model, 2.0, forward_models);
  return jobs;
}

}  // namespace tactile_net::study
