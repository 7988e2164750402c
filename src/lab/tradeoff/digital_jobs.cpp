#include "lab/tradeoff/digital.hpp"
#include "lab/tradeoff/points.hpp"
#include "tactile_net/lab/tradeoff/jobs.hpp"

namespace tactile_net::lab {

std::vector<StudyJob> digital_jobs(const StudyInput& input, const Clock& clock) {
  using Family = StudySection (*)(const StudyInput&, const Clock&);
  const auto job = [&](Job::Kind kind, double weight, Family work) {
    return StudyJob{
        .job = {kind}, .weight = weight, .timed = true, .run = [=, &input] {
          const Pinned pinned;
          StudySection section;
          try {
            section = work(input, clock);
          } catch (const std::exception&) {
            section.points.push_back(failed({.family = WorkCurve::Family::job, .job = Job{kind}},
                                            {}, TimeOf::frame, caught()));
          }
          section.job = {kind};
          return section;
        }};
  };
  using enum Job::Kind;
  return {job(products, 3.0, lab::products),
          job(factorisations, 1.0, lab::factorisations),
          job(fft, 1.0, by_fft),
          job(constraints, 1.0, constrained),
          job(fewer_taxels, 1.0, lab::fewer_taxels),
          job(forward_model, 2.0, forward_models)};
}

}  // namespace tactile_net::lab
