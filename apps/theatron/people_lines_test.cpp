// SPDX-License-Identifier: Apache-2.0
#include "people_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "wire/clear_objects.h"

namespace theatron::app {
namespace {

using ::testing::HasSubstr;
using wire::ManageAction;

const std::vector<SomePerson> people{{ParticipantId{1}, "Dr. Ada", false},
                                     {ParticipantId{2}, "Ben", false},
                                     {ParticipantId{3}, "Ben", true},
                                     {ParticipantId{4}, "Eve", false},
                                     {ParticipantId{5}, "Eve", false}};

PersonDecision parsed(const std::string& line) {
    return parse_people_line(line, people).value();
}
std::string problem_of(const std::string& line) {
    try {
        (void)parse_people_line(line, people);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(PeopleLines, NameAPersonWithSpacesAndARole) {
    const PersonDecision decision = parsed("role Dr. Ada  observer ");
    EXPECT_EQ(decision.action, ManageAction::set_role);
    EXPECT_EQ(decision.person, ParticipantId{1});
    EXPECT_EQ(decision.role, wire::Role::observer);
    EXPECT_THAT(problem_of("role Dr. Ada"), HasSubstr("Say 'role NAME ROLE'"));
    EXPECT_THAT(problem_of("role Dr. Ada viewer"), HasSubstr("operator, expert, observer"));
    EXPECT_THAT(problem_of("role observer"), HasSubstr("Say 'role NAME ROLE'"));
}

TEST(PeopleLines, TakeTheOneAtTheDoorForAdmissionAndTheOneInsideForTheRest) {
    EXPECT_EQ(parsed("admit Ben").person, ParticipantId{3});
    EXPECT_EQ(parsed("refuse Ben").action, ManageAction::turn_away);
    EXPECT_EQ(parsed("mute Ben").person, ParticipantId{2});
    EXPECT_EQ(parsed("remove #3").person, ParticipantId{3});
}

TEST(PeopleLines, ClearWhatSomebodyMadeWhoMayHaveLeft) {
    EXPECT_EQ(parsed("clear Dr. Ada").action, wire::clear_objects);
    EXPECT_EQ(parsed("clear Dr. Ada").person, ParticipantId{1});
    EXPECT_EQ(parsed("clear #77").person, ParticipantId{77});
    EXPECT_EQ(parsed("clear earlier").person, ParticipantId{});
    EXPECT_THAT(problem_of("clear Zoe"), HasSubstr("no 'Zoe' here"));
    EXPECT_THAT(problem_of("clear #0"), HasSubstr("no '#0' here"));
}

TEST(PeopleLines, SayWhoIsMeantWhereANameFitsTwoOrNobody) {
    EXPECT_THAT(problem_of("mute Eve"), HasSubstr("more than one 'Eve'; say the number"));
    EXPECT_THAT(problem_of("mute Eve"), Not(HasSubstr("Ada"))) << "only those of the name";
    EXPECT_EQ(parsed("mute #5").person, ParticipantId{5});
    EXPECT_THAT(problem_of("mute Zoe"), HasSubstr("no 'Zoe' here; there are #1 Dr. Ada, #2 Ben"));
    EXPECT_THAT(problem_of("mute"), HasSubstr("Say 'mute NAME'"));
}

TEST(PeopleLines, TakeTwoWindowsOfOnePersonForOneUnlessOneOfThemRecords) {
    const Bytes zoe(16, std::byte(1)), other(16, std::byte(2));
    const auto admitted = [](const std::vector<SomePerson>& waiting) {
        return parse_people_line("admit Zoe", waiting).value().person;
    };
    SomePerson first{ParticipantId{6}, "Zoe", true, zoe, false}, second = first;
    second.id = ParticipantId{7};
    EXPECT_EQ(admitted({first, second}), first.id);
    second.records = true;
    EXPECT_THROW(admitted({first, second}), Error);
    second.records = false;
    second.person = other;
    EXPECT_THROW(admitted({first, second}), Error) << "somebody else of that name";
    first.person = second.person = {};
    EXPECT_THROW(admitted({first, second}), Error) << "not known to be one";
}

TEST(PeopleLines, LeaveOtherLinesAlone) {
    EXPECT_FALSE(parse_people_line("remove", people)) << "the held object's";
    EXPECT_FALSE(parse_people_line("end", people));
    EXPECT_FALSE(parse_people_line("", people));
    EXPECT_FALSE(parse_people_line("depth rvl", people));
    EXPECT_EQ(parsed("end session").action, ManageAction::end_session);
}

}  // namespace
}  // namespace theatron::app
