// SPDX-License-Identifier: Apache-2.0
#include "lead/study_leader.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "session/permissions.h"
#include "session/room_bytes.h"
#include "wire/manage_text.h"

namespace theatron::lead {

using study::Step;
using study::StudyRun;
using wire::ManageRefusal;

namespace {

constexpr Duration retry_after = std::chrono::seconds(1);

}  // namespace

std::vector<Present> present_in(const client::Participant::Room& room) {
    std::vector<Present> present;
    for (const auto& [id, object] : room.objects) {
        if (object.kind != session::ObjectKind::person || session::is_recorded(id))
            continue;
        const auto facts = session::decode_person(object.properties);
        if (facts && !facts->records)
            present.push_back({object.creator, facts->name, facts->role == wire::Role::operator_});
    }
    return present;
}

std::optional<Present> choose_participant(const std::vector<Present>& present,
                                          const std::string& who, std::string& problem) {
    problem.clear();
    std::vector<Present> fitting;
    for (const Present& one : present)
        if (who.empty() ? !one.is_operator
                        : one.name == who || who == "#" + std::to_string(std::uint32_t(one.id)))
            fitting.push_back(one);
    if (fitting.size() == 1)
        return fitting.front();
    if (fitting.empty())
        return std::nullopt;
    problem = "Several people are here. Name the participant with --person:";
    for (const Present& one : fitting)
        problem += " #" + std::to_string(std::uint32_t(one.id));
    problem += ".";
    return std::nullopt;
}

StudyLeader::StudyLeader(StudyRun& run, const study::Protocol& protocol, std::string who,
                         client::Participant& participant, Events events)
    : run_(run),
      protocol_(protocol),
      who_(std::move(who)),
      participant_(participant),
      events_(std::move(events)) {}

void StudyLeader::on_tick(TimePoint now) {
    if (ended_ || !is_here())
        return;
    take_answers(now);
    if (!find_person())
        return;
    take_replies(now);
    if (now >= next_try_)
        go_on(now);
}

bool StudyLeader::is_here() {
    using Phase = client::Participant::Phase;
    const client::Participant::Status status = participant_.status();
    if (status.phase == Phase::refused || status.phase == Phase::ended) {
        // Nobody is there who could be told of the end.
        if (run_.state() == StudyRun::State::running)
            throw Error(status.problem + " The same command goes on at this step.");
        ended_ = true;
        return false;
    }
    if (status.phase != Phase::joined) {
        joins_ = 0;
        lose_person();
        wait_for(status.phase == Phase::waiting ? "Somebody has to let this program in."
                                                : "There is no connection to the session.");
        return false;
    }
    if (!session::may(status.standing.role, session::Right::manage))
        throw Error("This link is not one of an operator. Take the host's link for operators.");
    if (status.joins != joins_) {  // the host knows nothing of what the connection before asked
        lose_person();
        joins_ = status.joins;
    }
    return true;
}

bool StudyLeader::free_person() {
    if (freed_ || !person_ || participant_.status().joins != joins_)
        return true;
    if (asked_ != Asked::free) {
        wire::SetCondition free;
        free.participant = *person_;
        if (!ask(Asked::free, participant_.set_condition(free)))
            return true;
    }
    while (const auto answer = participant_.take_managed())
        freed_ = freed_ || answer->number == number_;
    return freed_;
}

void StudyLeader::lose_person() {
    person_.reset();
    asked_ = Asked::nothing;
    set_.reset();
    shown_.reset();
    freed_ = false;
}

void StudyLeader::wait_for(const std::string& why) {
    if (waiting_ != why && events_.waits)
        events_.waits(why);
    waiting_ = why;
}

// The host knows the person whom this program has led before. If somebody else is here under the
// name, a person decides.
void StudyLeader::note_stranger() {
    const auto present = present_in(participant_.room());
    const bool is_here = std::any_of(present.begin(), present.end(),
                                     [&](const Present& one) { return one.id == person_; });
    if (!person_ || !is_here)
        return;
    strangers_.insert(*person_);
    wait_for(
        "Somebody else has come under the participant's name. If the questions are for them, "
        "stop, and start with --person '#" +
        std::to_string(std::uint32_t(*person_)) + "'.");
}

bool StudyLeader::find_person() {
    auto present = present_in(participant_.room());
    std::string problem;
    if (person_) {
        for (const Present& one : present)
            if (one.id == *person_)
                return true;
        lose_person();
    }
    std::erase_if(present, [&](const Present& one) { return strangers_.contains(one.id); });
    const auto found = choose_participant(present, who_, problem);
    if (!found) {
        if (problem.empty() && !strangers_.empty())
            return false;  // it has been said
        wait_for(!problem.empty() ? problem : "The participant is not in the session yet.");
        return false;
    }
    // The leader waits for this person from now on, and asks nobody else in between.
    who_ = found->name;
    person_ = found->id;
    waiting_.clear();
    if (events_.found)
        events_.found(*found);
    return true;
}

bool StudyLeader::ask(Asked what, std::uint32_t number) {
    if (number == 0) {
        // The connection may have been lost since the beginning of this tick.
        const client::Participant::Status status = participant_.status();
        if (status.phase == client::Participant::Phase::joined && status.joins == joins_)
            throw Error("The host is too old to show studies to participants; update it.");
        return false;
    }
    asked_ = what;
    number_ = number;
    return true;
}

void StudyLeader::take_answers(TimePoint now) {
    while (const auto answer = participant_.take_managed()) {
        if (asked_ == Asked::nothing || answer->number != number_)
            continue;
        const Asked asked = std::exchange(asked_, Asked::nothing);
        if (answer->refusal == ManageRefusal::no_such_participant) {
            note_stranger();
            lose_person();
            continue;
        }
        if (answer->refusal == ManageRefusal::too_often ||
            answer->refusal == ManageRefusal::other_study ||
            answer->refusal == ManageRefusal::draws_flat) {
            shown_.reset();
            set_.reset();
            next_try_ = now + retry_after;
            // Without its condition no step is shown.
            if (answer->refusal != ManageRefusal::too_often)
                wait_for(wire::text_of(answer->refusal));
            continue;
        }
        if (answer->refusal == ManageRefusal::role)
            throw Error("This link is not one of an operator. Take the host's link for operators.");
        if (answer->refusal != ManageRefusal::none)
            throw Error(wire::text_of(answer->refusal));
        if (asked == Asked::condition && run_.state() == StudyRun::State::running) {
            const Step step = run_.current();
            if (step.kind == Step::Kind::condition)
                keep(run_.reply("done", now), step.id);
        }
        freed_ = freed_ || asked == Asked::free;
        ended_ = ended_ || asked == Asked::end;
    }
}

void StudyLeader::take_replies(TimePoint now) {
    while (const auto replied = participant_.take_study_reply()) {
        if (replied->participant != person_ || run_.state() != StudyRun::State::running ||
            shown_ != run_.position() || replied->reply.step != run_.position() + 1)
            continue;
        const Step step = run_.current();
        keep(run_.reply(reply_text(step, replied->reply), now, 2 * added_latency()), step.id);
    }
}

// On the way to the participant, and on the way back.
Duration StudyLeader::added_latency() const {
    return set_ ? std::chrono::milliseconds(protocol_.conditions[std::size_t(*set_)].latency_ms)
                : Duration(0);
}

void StudyLeader::keep(const StudyRun::Answer& answer, const std::string& id) {
    problem_ = answer.problem;
    shown_.reset();
    if (!answer.problem.empty())
        return;
    events_.keep(answer.line);
    if (events_.kept)
        events_.kept(id);
}

void StudyLeader::go_on(TimePoint now) {
    if (asked_ != Asked::nothing)
        return;
    if (run_.state() != StudyRun::State::running) {
        if (!freed_) {
            wire::SetCondition free;
            free.participant = *person_;
            ask(Asked::free, participant_.set_condition(free));
        } else {
            ask(Asked::end,
                participant_.show_study(*person_, end_message(run_, protocol_.break_off)));
        }
        return;
    }
    const Step& step = run_.current();
    if (step.condition >= 0 && set_ != step.condition) {
        if (step.kind == Step::Kind::condition) {
            run_.show(now);
            if (events_.shown && std::exchange(first_seen_, run_.position()) != run_.position())
                events_.shown();
        }
        return set_condition(protocol_.conditions[std::size_t(step.condition)]);
    }
    if (step.condition < 0 && set_)  // behind the block
        return set_condition({});
    if (shown_ != run_.position())
        show(now);
}

void StudyLeader::set_condition(const study::Condition& condition) {
    wire::SetCondition message = condition_message(condition);
    message.participant = *person_;
    message.locked = !is_as_usual(condition);
    if (!ask(Asked::condition, participant_.set_condition(message)))
        return;
    set_ = run_.current().condition;
    if (*set_ < 0)
        set_.reset();
}

void StudyLeader::show(TimePoint now) {
    const bool is_first = first_seen_ != run_.position();
    if (is_first)
        shown_at_ = now;
    wire::StudyStep message = step_message(run_, now - shown_at_);
    message.problem = problem_;
    if (!ask(Asked::step, participant_.show_study(*person_, message)))
        return;
    shown_ = first_seen_ = run_.position();
    run_.show(now);
    if (is_first && events_.shown)
        events_.shown();
}

}  // namespace theatron::lead
