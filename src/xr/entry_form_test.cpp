// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <optional>

#include "render/gl.h"
#include "render/test_context.h"
#include "xr/entry_form_native.h"

namespace theatron::xr {
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

}  // namespace
}  // namespace theatron::xr
