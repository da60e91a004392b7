// SPDX-License-Identifier: Apache-2.0
#include "client/attempts.h"

#include <gtest/gtest.h>

#include <set>

#include "wire/sentence.h"

namespace theatron::client {
namespace {

using wire::TextCode;
using Next = Attempts::Next;

// As in docs/formats/connection.md.
const std::set<TextCode> of_no_use_to_try = {
    TextCode::host_too_old,        TextCode::program_too_old, TextCode::wrong_token,
    TextCode::session_over,        TextCode::link_revoked,    TextCode::not_let_in,
    TextCode::removed_by_operator, TextCode::came_in_again,   TextCode::ended_by_operator,
    TextCode::session_has_ended};

std::vector<TextCode> refusals() {
    std::vector<TextCode> codes{TextCode::as_written, TextCode{199}};
    for (int code = 100; wire::is_known(TextCode(code)); ++code)
        codes.push_back(TextCode(code));
    return codes;
}

TEST(Attempts, SomebodyWhoWasInTriesAgainAfterEachRefusalThatIsForNow) {
    EXPECT_GT(refusals().size(), 20u);
    for (const TextCode code : refusals()) {
        Attempts attempts;
        attempts.came_in();
        const auto judged = attempts.after({{code, {"4"}}, {}, "", false});
        const bool is_final = of_no_use_to_try.contains(code);
        EXPECT_EQ(judged.next, is_final ? Next::refused : Next::again) << int(code);
        EXPECT_FALSE(judged.why.empty()) << int(code);
        EXPECT_EQ(judged.wait, Attempts::longest_wait) << int(code);
    }
}

TEST(Attempts, SomebodyWhoWasNeverInIsToldAtOnce) {
    for (const TextCode code : refusals())
        EXPECT_EQ(Attempts().after({{code}, {}, "", false}).next, Next::refused) << int(code);
}

TEST(Attempts, ABrokenConnectionIsTriedAgainSoonAndThenPatiently) {
    Attempts attempts;
    const Attempts::End broken{{}, {}, "The cable is out.", false};
    EXPECT_EQ(attempts.after(broken).wait, Attempts::first_wait);
    EXPECT_EQ(attempts.after(broken).wait, 2 * Attempts::first_wait);
    for (int i = 0; i < 10; ++i)
        EXPECT_EQ(attempts.after(broken).next, Next::again);
    EXPECT_EQ(attempts.after(broken).wait, Attempts::longest_wait);
    attempts.came_in();
    const auto judged = attempts.after(broken);
    EXPECT_EQ(judged.wait, Attempts::first_wait);
    EXPECT_EQ(judged.why, "The cable is out.");
}

TEST(Attempts, AnotherCertificateAndTheEndOfTheSessionAreFinal) {
    Attempts attempts;
    attempts.came_in();
    EXPECT_EQ(attempts.after({{}, {}, "Another certificate.", true}).next, Next::refused);
    EXPECT_EQ(attempts.after({{}, {TextCode::session_over}, "", false}).next, Next::ended);
    EXPECT_EQ(attempts.after({{TextCode::link_revoked}, {TextCode::session_over}, "", false}).next,
              Next::refused);
}

TEST(Attempts, AHostThatMayReturnIsWaitedFor) {
    Attempts attempts;
    attempts.came_in();
    for (int i = 0; i < 10; ++i) {
        const auto judged = attempts.after({{}, {TextCode::host_may_return}, "No network.", false});
        EXPECT_EQ(judged.next, Next::again);
        EXPECT_EQ(judged.why, i == 0 ? wire::sentence({TextCode::host_may_return}) : "No network.");
    }
    EXPECT_EQ(attempts.after({{}, {TextCode::ended_by_operator}, "", false}).next, Next::ended);
    EXPECT_EQ(attempts.after({{}, {TextCode{199}}, "", false}).next, Next::ended);
}

TEST(Attempts, AVisitEndsWhereTheHostDoesNotReturnForLong) {
    Attempts attempts(false, 20s);
    const Attempts::End gone{{}, {TextCode::host_may_return}, "No network.", false};
    for (int round = 0; round < 2; ++round) {
        attempts.came_in();
        Duration waited{};
        Attempts::Judged judged = attempts.after(gone);
        for (; judged.next == Next::again; judged = attempts.after(gone))
            waited += judged.wait;
        EXPECT_EQ(judged.next, Next::ended);
        EXPECT_GE(waited, 20s);
        EXPECT_LE(waited, 20s + Attempts::longest_wait);
    }
}

// The host's protocol is newer and then older; the numbers of the refusal change their places.
TEST(Attempts, APageOfAnotherVersionThanItsHostSaysThatItIsToBeLoadedAgain) {
    for (const bool was_in : {false, true}) {
        Attempts page(true), program(false);
        if (was_in) {
            page.came_in();
            program.came_in();
        }
        for (const auto& [code, host] :
             {std::pair(TextCode::program_too_old, "4"), std::pair(TextCode::host_too_old, "2")}) {
            const wire::Text refusal = code == TextCode::program_too_old
                                           ? wire::Text{code, {"3", host}}
                                           : wire::Text{code, {host, "3"}};
            const auto judged = page.after({refusal, {}, "", false});
            EXPECT_EQ(judged.next, Next::refused);
            EXPECT_TRUE(judged.is_outdated);
            EXPECT_EQ(judged.why,
                      "This page is from before its host was changed (it speaks protocol 3, the "
                      "host " +
                          std::string(host) + "); reload the page.");
            const auto updated = program.after({refusal, {}, "", false});
            EXPECT_FALSE(updated.is_outdated);
            EXPECT_NE(updated.why.find("update"), std::string::npos);
        }
        EXPECT_FALSE(page.after({{TextCode::link_revoked}, {}, "", false}).is_outdated);
        EXPECT_FALSE(page.after({{TextCode::program_too_old}, {}, "", false}).is_outdated)
            << "a refusal without the numbers says what it can";
    }
}

}  // namespace
}  // namespace theatron::client
