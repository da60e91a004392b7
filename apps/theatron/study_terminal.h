// SPDX-License-Identifier: Apache-2.0
// The output of 'theatron study run': for the person in charge, or as lines of JSON for a script.
#pragma once

#include <cstdint>
#include <string>

#include "study_folder.h"

namespace theatron::app {

// The line of a host's standard input that sets and locks what a host can set.
std::string host_line(const study::Condition& condition);

class StudyTerminal {
public:
    // `study` must outlive it.
    StudyTerminal(const Study& study, bool json) : study_(study), json_(json) {}

    void begin(const study::StudyRun& run, const std::string& participant, bool is_resumed) const;
    // The values of the condition in whose midst a run goes on.
    void remind(const study::Condition& condition) const;
    // The current step. `asks`: the reply is typed here.
    void show(const study::StudyRun& run, bool asks = true) const;
    void refuse(const std::string& problem) const;
    void saved(const std::string& step) const;
    // The time to watch is over.
    void over() const;
    // The participant of a session: has come, or why the run waits.
    void found(const std::string& name, std::uint32_t number, bool goes_on) const;
    void wait(const std::string& why) const;
    void end(const study::StudyRun& run) const;

private:
    const Study& study_;
    const bool json_;
};

}  // namespace theatron::app
