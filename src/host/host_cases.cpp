// SPDX-License-Identifier: Apache-2.0
// The cases of a host's folder on their way into its session.
#include <algorithm>

#include "base/log.h"
#include "host/host_impl.h"

namespace theatron::host {

void Host::Impl::take_cases(const CaseShelf::Offer& offer) {
    offered_cases = offer;
    session->set_cases(offer.cases, offer.patients, offer.content);
    carry_out();
    const std::string problem = lost_case();
    if (!problem.empty() && problem != said_lost_case)
        log::say(problem);
    said_lost_case = problem;
}

std::string Host::Impl::lost_case() const {
    const auto open = session->room().open_case();
    if (!open || !offered_cases ||
        std::any_of(offered_cases->cases.begin(), offered_cases->cases.end(),
                    [&](const session::CaseFacts& facts) { return facts.id == *open; }))
        return "";
    return "The open case is not in the folder of cases any more as it was opened: who has it "
           "keeps it, and who comes now does not get it. Put its folder back, or open another "
           "case.";
}

std::vector<std::string> Host::Impl::case_problems() const {
    std::vector<std::string> problems =
        offered_cases ? offered_cases->problems : std::vector<std::string>();
    if (std::string lost = lost_case(); !lost.empty())
        problems.push_back(std::move(lost));
    return problems;
}

}  // namespace theatron::host
