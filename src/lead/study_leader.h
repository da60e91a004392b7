// SPDX-License-Identifier: Apache-2.0
// Leads one participant's study over a session, as an operator's program: shows each step to the
// participant, sets the conditions, and keeps each reply before the next step is shown. The
// participant may lose the connection and come back, and so may this program.
//
// Use from one thread. Time is an argument.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "client/participant.h"
#include "lead/study_messages.h"

namespace theatron::lead {

// Somebody of the room, without programs that only watch.
struct Present {
    ParticipantId id{};
    std::string name;
    bool is_operator = false;
};
std::vector<Present> present_in(const client::Participant::Room& room);

// The person who takes part: of this name or number ("#7"), or without `who` the only one that is
// no operator. nullopt: not here; `problem` is then a sentence if a person has to decide.
std::optional<Present> choose_participant(const std::vector<Present>& present,
                                          const std::string& who, std::string& problem);

class StudyLeader {
public:
    struct Events {
        // Returns when the line is on the disk.
        std::function<void(const std::string& line)> keep;
        std::function<void()> shown;                        // the current step, for the first time
        std::function<void(const std::string& id)> kept;    // the reply to this step
        std::function<void(const std::string& why)> waits;  // a sentence
        std::function<void(const Present&)> found;          // the participant, anew
    };

    // `run` and `participant` must outlive it; the latter keeps the room and knows studies.
    // `who`: as in choose_participant().
    StudyLeader(study::StudyRun& run, const study::Protocol& protocol, std::string who,
                client::Participant& participant, Events events);

    // Gives the participant back what it had before the condition, without an end of the run. Call
    // it until it returns true: the host has done so, or there is nobody to free.
    bool free_person();
    // Call it at each news of the participant, and ten times a second. Throws Error if the study
    // cannot be led in this session.
    void on_tick(TimePoint now);
    // The run has ended, and its participant has been told, if there is one.
    bool has_ended() const { return ended_; }
    // The one who takes part, while here.
    std::optional<ParticipantId> person() const { return person_; }

private:
    // The question to the host, until it has answered.
    enum class Asked { nothing, condition, step, free, end };

    bool is_here();
    bool find_person();
    void take_answers(TimePoint now);
    void take_replies(TimePoint now);
    void go_on(TimePoint now);
    void set_condition(const study::Condition& condition);
    void show(TimePoint now);
    void keep(const study::StudyRun::Answer& answer, const std::string& id);
    void lose_person();
    void note_stranger();
    void wait_for(const std::string& why);
    bool ask(Asked what, std::uint32_t number);
    Duration added_latency() const;

    study::StudyRun& run_;
    const study::Protocol& protocol_;
    std::string who_;
    client::Participant& participant_;
    const Events events_;
    int joins_ = 0;
    std::optional<ParticipantId> person_;
    std::set<ParticipantId> strangers_;  // who came under the person's name, or alone
    Asked asked_ = Asked::nothing;
    std::uint32_t number_ = 0;               // of what was asked
    std::optional<int> set_;                 // the condition that holds for this person
    std::optional<std::size_t> shown_;       // the step that this person sees
    std::optional<std::size_t> first_seen_;  // the step whose first showing is shown_at_
    TimePoint shown_at_;
    TimePoint next_try_;   // after other programs' studies
    std::string problem_;  // of the last reply
    std::string waiting_;  // the last sentence
    bool freed_ = false, ended_ = false;
};

}  // namespace theatron::lead
