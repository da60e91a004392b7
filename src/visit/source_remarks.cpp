// SPDX-License-Identifier: Apache-2.0
#include "visit/source_remarks.h"

#include "base/log.h"

namespace theatron::visit {
namespace {

using wire::CameraCondition;

std::string sentence_of(const SourceRemarks::Source& source) {
    const std::string name = "\"" + source.name + "\"";
    const std::string reason = source.problem.empty() ? "" : " " + source.problem;
    switch (source.condition) {
        case CameraCondition::ended:
            return name + " has ended; the others see its last picture." + reason;
        case CameraCondition::failed:
            return name + " has failed and is not tried again." + reason;
        default:
            return name + " stands still and is tried again by itself." + reason;
    }
}

}  // namespace

std::vector<std::string> SourceRemarks::take(const std::vector<Source>& sources, TimePoint now) {
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const Source& source = sources[i];
        Known& known = known_[i];
        if (source.condition == CameraCondition::live) {
            if (known.said > 0)
                sentences.push_back("\"" + source.name + "\" goes on.");
            known = {};
            continue;
        }
        if (!known.stands)
            known = {true, now, 0, ""};
        std::string sentence = sentence_of(source);
        if (now - known.since < patience || known.said > 1 || sentence == known.last)
            continue;
        sentences.push_back(sentence);
        known.last = std::move(sentence);
        ++known.said;
    }
    return sentences;
}

std::vector<std::string> SourceRemarks::take(const publish::CameraPublisher& publisher,
                                             TimePoint now) {
    if (now < next_look_)
        return {};
    next_look_ = now + 200ms;
    std::vector<Source> sources;
    for (const auto& camera : publisher.figures()) {
        const auto& state = camera.lane.camera;
        const auto condition = camera.has_ended ? CameraCondition::live : state.condition;
        sources.push_back({camera.lane.name, condition, wire::english(state.problem)});
    }
    return take(sources, now);
}

void say(const std::vector<std::string>& remarks) {
    for (const std::string& remark : remarks)
        log::say(remark);
}

}  // namespace theatron::visit
