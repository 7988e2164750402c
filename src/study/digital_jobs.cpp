#include "study/digital.hpp"
#include "study/points.hpp"
#include "tactile_net/study/jobs.hpp"

namespace tactile_net::study {

std::vector<StudyJob> digital_jobs(const StudyInput& input, const lab::Clock& clock) {
  using Family = StudySection (*)(const StudyInput&, const lab::Clock&);
  const auto job = [&](Job::Kind kind, double weight, Family work) {
    return StudyJob{
        .job = {kind}, .weight = weight, .timed = true, .run = [=, &input] {
          const lab::Pinned pinned;
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
  std::vector<StudyJob> jobs = {job(products, 3.0, study::products),
                                job(factorisations, 1.0, study::factorisations),
                                job(fft, 1.0, by_fft), job(constraints, 1.0, constrained),
                                job(fewer_taxels, 1.0, study::fewer_taxels)};
  if (has_coarser_surface(input.scene()))
    jobs.push_back(job(coarser_surface, 1.0, study::coarser_surface));
  jobs.push_back(job(forward_model, 2.0, forward_models));
  return jobs;
}

}  // namespace tactile_net::study
