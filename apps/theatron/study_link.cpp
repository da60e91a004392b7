// SPDX-License-Identifier: Apache-2.0
#include "study_link.h"

#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "cli/stop_signal.h"
#include "client/person_id.h"
#include "lead/study_leader.h"
#include "link_argument.h"
#include "study_paths.h"

namespace theatron::app {
namespace {

// After the end of the run, for the participant's surface to be told.
constexpr Duration farewell_patience = std::chrono::seconds(5);
// The same where the program stops before, for the participant to be freed.
constexpr Duration freeing_patience = std::chrono::seconds(2);

client::Participant::Options options_of(const StudyRunFlags& flags, StudyPaths& paths) {
    client::Participant::Options options;
    options.link = parse_link_argument(flags.link);
    options.name = "study";
    // The host takes the connection before for this program's own when it comes back.
    options.person = client::load_or_make_person_id({});
    options.sends_only = true;  // it is nobody in the room
    options.keeps_room = true;
    options.knows_studies = true;
    options.remark = [](const std::string& text) { log::say(text); };
    options.pose = [&paths](ParticipantId person, const wire::PersonPose& pose) {
        paths.take(person, pose);
    };
    return options;
}

}  // namespace

void lead_study(const Study& study, const StudyRunFlags& flags, study::StudyRun& run,
                files::JournalFile& journal, const StudyTerminal& terminal) {
    cli::catch_stop_signals();
    StudyPaths paths(study.paths_of(flags.participant));
    client::Participant participant(options_of(flags, paths));
    const auto session_time = [&] { return participant.session_time(steady_now()); };
    lead::StudyLeader::Events events;
    events.keep = [&](const std::string& line) { journal.append(line); };
    events.shown = [&] {
        terminal.show(run, false);
        paths.note(session_time(), "step", run.current().id);
    };
    events.kept = [&](const std::string& id) {
        terminal.saved(id);
        paths.note(session_time(), "reply", id);
    };
    events.waits = [&](const std::string& why) { terminal.wait(why); };
    // Nobody but the person in charge knows who began the run before.
    const bool goes_on = run.position() > 0;
    events.found = [&](const lead::Present& one) {
        terminal.found(one.name, std::uint32_t(one.id), goes_on);
    };
    lead::StudyLeader leader(run, study.protocol, flags.person, participant, std::move(events));

    std::optional<TimePoint> over;
    bool is_full = false;
    while (!cli::stop_requested() && !leader.has_ended()) {
        (void)participant.wait_for_frame(std::chrono::milliseconds(20));
        const TimePoint now = steady_now();
        const auto status = participant.status();
        // The paths need the session's time.
        if (status.phase == client::Participant::Phase::joined && !status.clock_known)
            continue;
        leader.on_tick(now);
        if (status.clock_known) {
            // Nothing of the person before it has agreed, and nothing after the end.
            const bool may_follow =
                run.has_consent() && run.state() == study::StudyRun::State::running;
            paths.follow(may_follow ? leader.person() : std::nullopt, session_time());
            paths.compare(participant.room(), session_time());
        }
        if (!paths.on_tick(now) && !std::exchange(is_full, true))
            terminal.wait("The file of paths has its full size; nothing more is added to it.");
        if (run.state() == study::StudyRun::State::running)
            continue;
        if (!over)
            over = now;
        if (now - *over > farewell_patience)
            break;
    }
    for (const TimePoint end = steady_now() + freeing_patience;
         run.state() == study::StudyRun::State::running && !leader.free_person() &&
         steady_now() < end;)
        (void)participant.wait_for_frame(std::chrono::milliseconds(20));
    paths.write();
    if (run.state() == study::StudyRun::State::running)
        throw Error("The run was stopped: the same command goes on at step " +
                    std::to_string(run.position() + 1) + ".");
}

}  // namespace theatron::app
