// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/gl.h"
#include "render/test_context.h"
#include "window/entry_form_native.h"

namespace theatron::window {
namespace {

class Form : public ::testing::Test {
protected:
    void SetUp() override {
        render::test_context();
        glGenRenderbuffers(1, &picture);
        glBindRenderbuffer(GL_RENDERBUFFER, picture);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, window.width, window.height);
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, picture);
        form.emplace(EntryFields{},
                     EntryForm::Clipboard{[] { return std::string(); }, [](const std::string&) {}});
        form->set_recents({{"OR 3", "expert, or-3:4400"}, {"OR 4", "observer, or-3:4400"}});
        for (int i = 0; i < 3; ++i)
            look(std::nullopt, false);
    }
    void TearDown() override {
        form.reset();
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glDeleteFramebuffers(1, &framebuffer);
        glDeleteRenderbuffers(1, &picture);
    }
    void look(std::optional<Vec2> pointer, bool is_down) {
        FormInput input;
        input.pointer = pointer;
        input.is_down = is_down;
        form->draw({}, input, window, 8, now, framebuffer);
    }
    // One for the mouse to arrive, one pressed, one released.
    std::optional<RecentAnswer> press(Vec2 place) {
        for (const bool is_down : {false, true, false})
            look(place, is_down);
        return form->take_recent();
    }

    // Keys and letters that all come at once, and pictures until the form has used them up.
    EntryAnswer type(std::vector<FormKeyPress> keys, const EntryFacts& facts = {}) {
        FormInput input;
        input.keys = std::move(keys);
        EntryAnswer answer = form->draw(facts, input, window, 8, now, framebuffer);
        for (int i = 0; i < 100; ++i)
            if (const auto next = form->draw(facts, {}, window, 8, now, framebuffer);
                next != EntryAnswer::none)
                answer = next;
        return answer;
    }
    static FormKeyPress letters(const std::string& text) {
        return {FormKey::letters, false, false, text};
    }

    static constexpr Size window{400, 300};
    unsigned picture = 0, framebuffer = 0;
    std::optional<EntryForm> form;
    TimePoint now{std::chrono::seconds(100)};
};

TEST_F(Form, ASessionIsForgottenByASecondPressAndByNoOther) {
    std::optional<Vec2> forget;
    for (double y = 0.2; y < 0.8 && !forget; y += 0.015)
        for (double x = 0.55; x < 0.95 && !forget; x += 0.03) {
            const auto first = press({x, y});
            ASSERT_FALSE(first && first->forgets) << "the first press";
            if (const auto second = press({x, y}); second && second->forgets)
                forget = Vec2{x, y};
        }
    ASSERT_TRUE(forget);
    ASSERT_FALSE(press(*forget));
    look(Vec2{0.01, 0.01}, false);
    ASSERT_FALSE(press(*forget)) << "the mouse has left it";
    now += EntryForm::sure_within + std::chrono::milliseconds(1);
    look(*forget, false);
    ASSERT_FALSE(press(*forget)) << "too late";
    const auto sure = press(*forget);
    ASSERT_TRUE(sure && sure->forgets);
    EXPECT_EQ(sure->index, 0u);
}

TEST_F(Form, LettersThatComeAtOnceReachTheirFieldsInOrder) {
    type({letters("https:"),
          letters("//h"),
          {FormKey::tab},
          letters("e"),
          letters("va"),
          {FormKey::tab, false, true},
          {FormKey::end},
          letters("/#")});
    EXPECT_EQ(form->fields().link, "https://h/#");
    EXPECT_EQ(form->fields().name, "eva");
}

TEST_F(Form, ANewFormKeepsTheFirstLetters) {
    form.emplace(EntryFields{},
                 EntryForm::Clipboard{[] { return std::string(); }, [](const std::string&) {}});
    type({letters("ab"), letters("c")});
    EXPECT_EQ(form->fields().link, "abc");
}

TEST_F(Form, TabReachesEveryFieldAndBox) {
    const FormKeyPress tab{FormKey::tab}, space{FormKey::space};
    EXPECT_TRUE(form->fields().hears);
    type({tab, letters("eva"), tab, space, tab, space, tab, space, tab, space});
    EXPECT_EQ(form->fields().name, "eva");
    EXPECT_FALSE(form->fields().hears);
    EXPECT_TRUE(form->fields().speaks);
    EXPECT_TRUE(form->fields().voice_may_record);
    EXPECT_TRUE(form->fields().shows_face);
    EXPECT_EQ(type({tab, {FormKey::enter}}), EntryAnswer::leave) << "the button that closes";
}

TEST_F(Form, EnterEntersAfterAClickOnASessionAlsoBeforeTheHostHasAnswered) {
    type({{FormKey::tab}, letters("eva")});
    std::optional<RecentAnswer> chosen;
    for (double y = 0.2; y < 0.8 && !chosen; y += 0.015)
        for (double x = 0.3; x < 0.6 && !chosen; x += 0.05)
            chosen = press({x, y});
    ASSERT_TRUE(chosen && !chosen->forgets);
    form->set_hidden_link("https://or-3/#join=x");
    EXPECT_EQ(type({{FormKey::enter}}), EntryAnswer::none) << "no answer yet";
    EntryFacts open;
    open.can_enter = true;
    EXPECT_EQ(type({}, open), EntryAnswer::enter);
}

TEST_F(Form, EnterDoesNotWaitForAnotherLinkThanTheOneThatIsThere) {
    type({letters("https://wrong"), {FormKey::tab}, letters("eva"), {FormKey::enter}});
    EntryFacts open;
    open.can_enter = true;
    type({{FormKey::tab, false, true}, {FormKey::end}, letters("er")});
    EXPECT_EQ(type({}, open), EntryAnswer::none);
    EXPECT_EQ(type({{FormKey::enter}}, open), EntryAnswer::enter);
}

}  // namespace
}  // namespace theatron::window
