#include <algorithm>
#include <utility>

#include "inverse/data/frame_judge.hpp"
#include "numeric/named.hpp"
#include "tactile_net/inverse/data_verdict.hpp"

namespace tactile_net {
namespace {

constexpr Named<DataDoubt> doubts[] = {
    {DataDoubt::implausible, "implausible"}, {DataDoubt::pulls, "pulls"},
    {DataDoubt::bad_taxel, "bad_taxel"},     {DataDoubt::offset, "offset"},
    {DataDoubt::misfit, "misfit"},           {DataDoubt::friction_limit, "friction_limit"}};

using Shared = std::shared_ptr<const LinearProblem>;

/// @param contacts  called at once where the problem is a line's
std::unique_ptr<const ContactFit> fit_of(const JudgedProblem& judged,
                                         std::function<Shared()> contacts) {
  if (!judged.problem.is_line) return cone_fit(judged, std::move(contacts));
  const Shared made = contacts();
  check_contacts(judged.problem, *made);
  return line_fit(judged, *made);
}

}  // namespace

std::string_view name(DataDoubt doubt) noexcept { return name_in<doubts>(doubt); }

bool DataVerdict::has(DataDoubt doubt) const noexcept {
  return std::find(doubts.begin(), doubts.end(), doubt) != doubts.end();
}

struct DataJudge::Parts {
  Parts(Shared of, std::function<Shared()> contacts, DataLimits limits)
      : problem(std::move(of)),
        judged(*problem, std::move(limits)),
        flow(judged),
        fit(fit_of(judged, std::move(contacts))) {}

  Shared problem;
  JudgedProblem judged;
  FrameJudge flow;
  std::unique_ptr<const ContactFit> fit;
};

DataJudge::DataJudge(const LinearProblem& problem, DataLimits limits)
    : DataJudge(std::make_shared<const LinearProblem>(problem), {}, std::move(limits)) {}

DataJudge::DataJudge(const LinearProblem& problem, const LinearProblem& contacts,
                     DataLimits limits) {
  check_contacts(problem, contacts);
  auto sought = std::make_shared<const LinearProblem>(contacts);
  parts_ = std::make_unique<const Parts>(
      std::make_shared<const LinearProblem>(problem), [kept = std::move(sought)] { return kept; },
      std::move(limits));
}

DataJudge::DataJudge(std::shared_ptr<const LinearProblem> problem,
                     std::function<LinearProblem()> contacts, DataLimits limits) {
  std::function<Shared()> sought = [problem] { return problem; };
  if (contacts)
    sought = [make = std::move(contacts)] { return std::make_shared<const LinearProblem>(make()); };
  parts_ = std::make_unique<const Parts>(std::move(problem), std::move(sought), std::move(limits));
}

DataJudge::~DataJudge() = default;
DataJudge::DataJudge(DataJudge&&) noexcept = default;
DataJudge& DataJudge::operator=(DataJudge&&) noexcept = default;

DataVerdict DataJudge::judge(std::span<const double> readings, std::span<const double> tractions,
                             DataMemory* memory) const {
  const bool remembers = memory != nullptr && parts_->fit->remembers();
  return parts_->flow.judge(*parts_->fit, readings, tractions,
                            remembers ? memory->kept_.get() : nullptr);
}

}  // namespace tactile_net
