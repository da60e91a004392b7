// SPDX-License-Identifier: Apache-2.0
// A study over a session: its program, the participant, and links that break.
#include <gmock/gmock.h>

#include "lead/study_leader.h"
#include "study/built_in.h"
#include "world/acts.h"

namespace theatron::world {
namespace {

using lead::StudyLeader;
using study::StudyRun;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using wire::StudyAction;
using wire::StudyKind;

constexpr const char* protocol_text = R"(study = Splats or mesh
order = as-written
condition = slow
  renderer = mesh
  latency-ms = 200
condition = usual
phase = agree
  kind = consent
  text = Do you agree?
phase = opinion
  kind = questionnaire
  each-condition = yes
  questionnaire = own-presence
phase = thanks
  kind = instruction
  text = Thank you.
)";

// The program that leads, which may be killed and started again, and what it has kept on its disk.
class Study {
public:
    explicit Study(World& world) : world_(world), person_(world.person("study")) {
        person_.options.sends_only = true;
        person_.options.knows_studies = true;
        protocol_ = study::parse_protocol(protocol_text).protocol;
        known_ = study::built_in_questionnaires();
    }
    // As the command does: with the journal of the run before.
    void start(const std::string& who = "") {
        kill();
        run_ = std::make_unique<StudyRun>(protocol_, known_, 1);
        const auto read = study::parse_journal(study::journal_head("P01", 1) + journal);
        EXPECT_EQ(read.problem, "");
        EXPECT_EQ(run_->resume(read.journal), "");
        person_.join(wire::Role::operator_);
        StudyLeader::Events events;
        events.keep = [this](const std::string& line) { journal += line; };
        events.waits = [this](const std::string& why) { waited.push_back(why); };
        leader_ =
            std::make_unique<StudyLeader>(*run_, protocol_, who, person_.participant(), events);
    }
    void kill() {
        leader_.reset();
        run_.reset();
        person_.leave();
    }
    Person& person() { return person_; }
    StudyRun& run() { return *run_; }
    bool has_ended() const { return leader_->has_ended(); }
    bool free_person() { return leader_->free_person(); }
    void tick() {
        if (leader_)
            leader_->on_tick(world_.now());
    }
    // Lets time pass with the program at work.
    bool until(const std::function<bool()>& condition, Duration patience = 5min) {
        for (const TimePoint end = world_.now() + patience; world_.now() < end;) {
            tick();
            if (condition())
                return true;
            world_.advance(20ms);
        }
        return false;
    }
    std::vector<std::string> kept() const {
        std::vector<std::string> steps;
        const auto read = study::parse_journal(study::journal_head("P01", 1) + journal);
        for (const auto& entry : read.journal.entries)
            steps.push_back(entry.step);
        return steps;
    }

    std::string journal;
    std::vector<std::string> waited;

private:
    World& world_;
    Person& person_;
    study::Protocol protocol_;
    study::Questionnaires known_;
    std::unique_ptr<StudyRun> run_;
    std::unique_ptr<StudyLeader> leader_;
};

class WorldStudy : public ::testing::Test {
protected:
    Person& participant(const std::string& name) {
        world.person(name).options.knows_studies = true;
        return world.joined(name);
    }
    std::uint32_t step_of(Person& person) {
        const auto study = person.is_here() ? person->study() : std::nullopt;
        return study && study->step.kind != StudyKind::interrupted ? study->step.step : 0;
    }
    bool sees(Study& study, Person& person, std::uint32_t step) {
        return study.until([&] { return step_of(person) == step; });
    }
    // Replies to the step that the person sees, and waits until it is kept.
    void reply(Study& study, Person& person, int value = 1) {
        EXPECT_TRUE(study.until(
            [&] { return study.run().current().kind != study::Step::Kind::condition; }));
        const std::size_t before = study.run().position();
        EXPECT_TRUE(study.until([&] { return step_of(person) == before + 1; }));
        EXPECT_TRUE(
            person->reply_to_study({std::uint32_t(before + 1), StudyAction::answer, value}));
        EXPECT_TRUE(study.until([&] {
            return study.run().state() != StudyRun::State::running ||
                   study.run().position() > before;
        }));
    }

    World world;
};

TEST_F(WorldStudy, GoesFromConsentToTheEnd) {
    Person& anna = participant("Anna");
    Study study(world);
    study.start();
    while (study.run().state() == StudyRun::State::running) {
        const auto kind = study.run().current().kind;
        if (kind == study::Step::Kind::condition)
            EXPECT_TRUE(study.until(
                [&] { return study.run().current().kind != study::Step::Kind::condition; }));
        else
            reply(study, anna, kind == study::Step::Kind::consent ? 1 : 3);
    }
    EXPECT_EQ(study.run().state(), StudyRun::State::complete);
    EXPECT_TRUE(study.until([&] { return study.has_ended(); }));
    EXPECT_TRUE(study.until([&] { return anna->study()->step.kind == StudyKind::over; }));
    EXPECT_EQ(study.kept().size(), study.run().steps().size());
    EXPECT_EQ(anna.sees(), std::vector<std::string>{"Anna"}) << "the program is nobody in the room";
}

TEST_F(WorldStudy, AStepComesAgainAfterALostConnectionAndNothingIsKeptTwice) {
    Person& anna = participant("Anna");
    Study study(world);
    study.start();
    reply(study, anna);
    EXPECT_TRUE(sees(study, anna, 3));
    anna.path().reset();
    EXPECT_TRUE(study.until([&] { return anna->status().joins == 2 && anna.is_in(); }));
    EXPECT_TRUE(sees(study, anna, 3));
    EXPECT_TRUE(anna->reply_to_study({3, StudyAction::answer, 2}));
    EXPECT_TRUE(anna->reply_to_study({3, StudyAction::answer, 5}));
    EXPECT_TRUE(sees(study, anna, 4));
    EXPECT_THAT(study.kept(), ElementsAre("agree.consent", "opinion.slow.condition",
                                          "opinion.slow.own-presence.place1"));
    EXPECT_THAT(study.journal, HasSubstr("\t2\tok\n"));
    EXPECT_EQ(study.waited.back(), "The participant is not in the session yet.");
}

TEST_F(WorldStudy, AReplyThatWasOnItsWayWhenTheConnectionBrokeIsAskedForAgain) {
    Person& anna = participant("Anna");
    Study study(world);
    study.start();
    EXPECT_TRUE(sees(study, anna, 1));
    anna.path().cut();
    EXPECT_TRUE(anna->reply_to_study({1, StudyAction::answer, 1}));
    EXPECT_FALSE(study.until([&] { return study.run().position() > 0; }, 40s));
    EXPECT_THAT(study.kept(), ElementsAre());
    anna.path().mend();
    reply(study, anna);
    EXPECT_EQ(study.kept().front(), "agree.consent");
}

TEST_F(WorldStudy, AKilledProgramGoesOnWhereItWas) {
    Person& anna = participant("Anna");
    Study study(world);
    study.start();
    reply(study, anna);
    reply(study, anna);
    const std::uint32_t step = step_of(anna);
    study.kill();
    EXPECT_TRUE(world.until([&] { return anna->study()->step.kind == StudyKind::interrupted; }));
    EXPECT_TRUE(anna->reply_to_study({step, StudyAction::answer, 1}));  // nobody is there
    world.advance(2s);
    const auto before = study.kept();
    study.start("Anna");
    EXPECT_TRUE(sees(study, anna, std::uint32_t(before.size()) + 1));
    reply(study, anna);
    EXPECT_EQ(study.kept().size(), before.size() + 1);
}

TEST_F(WorldStudy, TheLostConnectionOfItsProgramIsMadeAgain) {
    Person& anna = participant("Anna");
    Study study(world);
    study.start();
    EXPECT_TRUE(sees(study, anna, 1));
    study.person().path().reset();
    EXPECT_TRUE(study.until([&] { return study.person()->status().joins == 2; }));
    reply(study, anna);
    EXPECT_EQ(study.kept().front(), "agree.consent");
}

TEST_F(WorldStudy, NobodyIsAskedInPlaceOfTheParticipant) {
    Person& anna = participant("Anna");
    Study study(world);
    study.start();
    EXPECT_TRUE(sees(study, anna, 1));
    anna.leave();
    Person& ben = participant("Ben");
    EXPECT_FALSE(study.until([&] { return step_of(ben) != 0; }, 5s));
    anna.join();
    EXPECT_TRUE(sees(study, anna, 1));
    EXPECT_EQ(step_of(ben), 0u);
}

TEST_F(WorldStudy, SomebodyElseOfTheSameNameIsAskedByDecisionAlone) {
    const auto known_as = [](int number) { return Bytes(wire::person_id_size, std::byte(number)); };
    world.person("Anna").options.person = known_as(1);
    Person& anna = participant("Anna");
    Study study(world);
    study.person().options.person = known_as(9);
    study.start();
    EXPECT_TRUE(sees(study, anna, 1));
    anna.leave();
    anna.options.person = known_as(2);
    anna.join();
    EXPECT_FALSE(study.until([&] { return step_of(anna) != 0; }, 5s));
    const std::string number = "#" + std::to_string(std::uint32_t(anna.number()));
    EXPECT_THAT(study.waited.back(), HasSubstr("--person '" + number + "'"));
    anna.leave();
    anna.options.person = known_as(1);
    anna.join();
    EXPECT_TRUE(sees(study, anna, 1)) << "the person from before is known again";
    anna.leave();
    anna.options.person = known_as(2);
    anna.join();
    EXPECT_TRUE(world.until([&] { return anna.is_in(); }));
    study.kill();
    study.person().options.person = known_as(10);  // of its next start
    study.start("#" + std::to_string(std::uint32_t(anna.number())));
    EXPECT_TRUE(sees(study, anna, 1));
}

TEST_F(WorldStudy, OfSeveralPeopleOneIsNamed) {
    Person& anna = participant("Anna");
    Person& ben = participant("Ben");
    Study study(world);
    study.start();
    EXPECT_FALSE(study.until([&] { return step_of(anna) + step_of(ben) != 0; }, 5s));
    EXPECT_THAT(study.waited.back(), HasSubstr("--person"));
    study.start("#" + std::to_string(std::uint32_t(ben.number())));
    EXPECT_TRUE(sees(study, ben, 1));
    EXPECT_EQ(step_of(anna), 0u);
}

TEST_F(WorldStudy, AnotherRoleLeadsNoStudy) {
    Person& anna = participant("Anna");
    Study study(world);
    study.kill();
    study.person().join(wire::Role::expert);
    study::StudyRun run(study::parse_protocol(protocol_text).protocol,
                        study::built_in_questionnaires(), 1);
    const study::Protocol protocol;
    StudyLeader leader(run, protocol, "Anna", study.person().participant(), {});
    std::string problem;
    const auto is_refused = [&] {
        try {
            leader.on_tick(world.now());
        } catch (const std::exception& error) {
            problem = error.what();
        }
        return !problem.empty();
    };
    for (int i = 0; i < 100 && !is_refused(); ++i)
        world.advance(50ms);
    EXPECT_THAT(problem, HasSubstr("operators"));
    EXPECT_EQ(step_of(anna), 0u);
}

// Everything from and to the participant is late, in both directions, and the clocks still agree.
TEST_F(WorldStudy, TheLatencyOfAConditionIsThatOfEverything) {
    Person& anna = participant("Anna");
    Person& ben = world.joined("Ben");
    Study study(world);
    study.start("Anna");
    const auto time_of_pose = [&](Person& from, Person& to, double x) {
        wire::PersonPose pose;
        pose.time = from->now();
        pose.head = wire::PartPose{{float(x), 1.7F, 0}, {1, 0, 0, 0}};
        const TimePoint sent = world.now();
        from->send_pose(pose);
        EXPECT_TRUE(world.until([&] {
            const auto poses = to->poses();
            const auto found = poses.find(from.number());
            return found != poses.end() && found->second.head->position[0] == float(x);
        }));
        return world.now() - sent;
    };
    EXPECT_TRUE(sees(study, anna, 1));
    EXPECT_LT(time_of_pose(anna, ben, 1), 150ms);
    reply(study, anna);
    EXPECT_TRUE(sees(study, anna, 3));  // the slow condition holds
    world.advance(5s);
    const Duration out = time_of_pose(anna, ben, 2), in = time_of_pose(ben, anna, 3);
    for (const Duration way : {out, in}) {
        EXPECT_GE(way, 200ms);
        EXPECT_LT(way, 350ms);
    }
    EXPECT_LT(to_ms(anna->now() - ben->now()), 20);
    EXPECT_GT(to_ms(anna->now() - ben->now()), -20);
    // A program that is killed leaves nobody late, and sets the condition again when it comes back.
    study.kill();
    world.advance(2s);
    EXPECT_LT(time_of_pose(anna, ben, 4), 150ms);
    study.start("Anna");
    EXPECT_TRUE(sees(study, anna, 3));
    world.advance(2s);
    EXPECT_GE(time_of_pose(anna, ben, 5), 200ms);
    EXPECT_TRUE(study.until([&] { return study.free_person(); }));
    world.advance(1s);
    EXPECT_LT(time_of_pose(anna, ben, 6), 150ms) << "before the program leaves";
    study.kill();
    world.advance(2s);
    study.start("Anna");
    EXPECT_TRUE(sees(study, anna, 3));
    EXPECT_TRUE(anna->reply_to_study({3, StudyAction::stop, 0}));
    EXPECT_TRUE(study.until([&] { return study.has_ended(); }));
    world.advance(1s);
    EXPECT_LT(time_of_pose(anna, ben, 7), 150ms) << "it ends with the study";
}

TEST_F(WorldStudy, TheTimeOfAReplyIsWithoutTheAddedLatency) {
    Person& anna = participant("Anna");
    Study study(world);
    study.start();
    reply(study, anna);
    EXPECT_TRUE(sees(study, anna, 3));
    world.advance(2s);
    reply(study, anna);
    const auto read = study::parse_journal(study::journal_head("P01", 1) + study.journal);
    EXPECT_GE(read.journal.entries.back().took_ms, 2000);
    EXPECT_LT(read.journal.entries.back().took_ms, 2300) << "twice 200 ms are the condition's";
}

TEST_F(WorldStudy, AProgramWaitsForTheEndOfAnotherOnesStudy) {
    Person& anna = participant("Anna");
    world.person("other").options.knows_studies = true;
    world.person("other").join(wire::Role::operator_);
    Person& other = world.person("other");
    EXPECT_TRUE(world.until([&] { return other.is_in(); }));
    wire::StudyStep step;
    step.step = 77;
    step.kind = StudyKind::read;
    EXPECT_NE(other->show_study(anna.number(), step), 0u);
    EXPECT_TRUE(world.until([&] { return step_of(anna) == 77; }));
    Study study(world);
    study.start("Anna");
    EXPECT_FALSE(study.until([&] { return step_of(anna) == 1; }, 5s));
    EXPECT_THAT(study.waited.back(), HasSubstr("another operator's program"));
    other.leave();
    EXPECT_TRUE(sees(study, anna, 1));
}

TEST_F(WorldStudy, TheEndOfTheSessionBehindTheEndOfTheRunIsNoProblem) {
    Person& anna = participant("Anna");
    Study study(world);
    study.start();
    EXPECT_TRUE(sees(study, anna, 1));
    EXPECT_TRUE(anna->reply_to_study({1, StudyAction::stop, 0}));
    EXPECT_TRUE(study.until([&] { return study.run().state() != StudyRun::State::running; }));
    world.end_host();
    EXPECT_TRUE(study.until([&] { return study.has_ended(); }));
}

}  // namespace
}  // namespace theatron::world
