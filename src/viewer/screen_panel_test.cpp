// SPDX-License-Identifier: Apache-2.0
#include "viewer/screen_panel.h"

#include <gtest/gtest.h>

#include "session/shared_screen.h"

namespace theatron::viewer {
namespace {

using What = ChangeScreen::What;
constexpr ParticipantId onlooker{1}, other_sharer{2};
constexpr session::ObjectId scope{7};

session::RoomObject shared_by(ParticipantId by, bool pinned = false,
                              std::optional<CameraId> camera = CameraId{3}) {
    session::RoomObject object;
    object.kind = session::ObjectKind::screen;
    object.creator = by;
    object.scale = 1.2;
    object.properties = session::encode_shared_screen(
        {camera, pinned, {1920, 1080}, by == onlooker ? "Anna" : "Ben", "scope"});
    return object;
}

struct Shown {
    std::string detail;
    std::vector<std::string> labels;
    std::vector<ChangeScreen> commands;
};
// The row of the only screen; nothing: there is no panel.
std::optional<Shown> shown(const session::RoomObject& object, wire::Role role) {
    const session::RoomObjects objects{{scope, object}};
    RoomPanel panel;
    panel.commands.push_back(Call{});  // of another panel
    add_screen_panel({&objects, onlooker, role, {{other_sharer, "Ben"}}}, panel);
    if (panel.panels.empty())
        return std::nullopt;
    const window::PanelRow& row = panel.panels.at(0).rows.at(0);
    EXPECT_EQ(row.text, "scope");
    Shown result{row.detail, {}, {}};
    for (const window::PanelButton& button : row.buttons) {
        result.labels.push_back(button.label);
        if (std::holds_alternative<ShowScreen>(panel.commands.at(std::size_t(button.command))))
            continue;
        result.commands.push_back(
            std::get<ChangeScreen>(panel.commands.at(std::size_t(button.command))));
        EXPECT_EQ(result.commands.back().screen, scope);
    }
    return result;
}

using Labels = std::vector<std::string>;

TEST(ScreenPanel, TheSharerPinsAndEndsTheirShare) {
    const auto own = shown(shared_by(onlooker), wire::Role::publisher);
    ASSERT_TRUE(own);
    EXPECT_EQ(own->detail, "you share it, 1.20 m wide");
    EXPECT_EQ(own->labels, (Labels{"Smaller", "Larger", "Pin in place", "End share"}));
    EXPECT_EQ(own->commands[2].what, What::pin);
    EXPECT_EQ(own->commands[3].what, What::end);
    const auto pinned = shown(shared_by(onlooker, true), wire::Role::publisher);
    EXPECT_EQ(pinned->detail, "you share it, 1.20 m wide, pinned");
    EXPECT_EQ(pinned->labels, (Labels{"Unpin", "End share"}));
    EXPECT_EQ(pinned->commands[0].what, What::unpin);
}

TEST(ScreenPanel, OthersScaleItAndOperatorsDoAll) {
    EXPECT_EQ(shown(shared_by(other_sharer), wire::Role::expert)->labels,
              (Labels{"Show", "Smaller", "Larger"}));
    EXPECT_EQ(shown(shared_by(other_sharer), wire::Role::operator_)->labels,
              (Labels{"Show", "Smaller", "Larger", "Pin in place", "End share"}));
    EXPECT_EQ(shown(shared_by(other_sharer), wire::Role::observer)->labels, Labels{"Show"});
    EXPECT_EQ(shown(shared_by(other_sharer, true), wire::Role::expert)->labels, Labels{"Show"});
}

TEST(ScreenPanel, AHeldScreenSaysByWhom) {
    session::RoomObject held = shared_by(other_sharer);
    held.grip.holder = other_sharer;
    const auto row = shown(held, wire::Role::expert);
    EXPECT_EQ(row->detail, "shared by Ben, 1.20 m wide, Ben holds it");
    EXPECT_EQ(row->labels, Labels{"Show"});
}

TEST(ScreenPanel, ShowGoesWhereTheWholeScreenIsSeen) {
    for (const double aspect : {16.0 / 9, 9.0 / 16}) {
        const Pose room_from_screen{Quat{0, 1, 0, 0}, {0.5, 1.6, -1}};  // it faces z
        const ScreenPlace screen{room_from_screen, 1.2, 1.2 / aspect};
        const Pose eye = in_front_of(screen);
        const Vec3 middle = inverse(eye) * room_from_screen.translation;
        EXPECT_NEAR(middle.x, 0, 1e-9);
        EXPECT_NEAR(middle.y, 0, 1e-9);
        EXPECT_GT(eye.translation.z, room_from_screen.translation.z);
        // Within 60 degrees of height and of width.
        EXPECT_LE(screen.width_m / 2, middle.z * 0.58);
        EXPECT_LE(screen.height_m / 2, middle.z * 0.58);
    }
}

TEST(ScreenPanel, AScreenWhoseSourceIsAwayIsNotListed) {
    EXPECT_FALSE(shown(shared_by(other_sharer, false, std::nullopt), wire::Role::operator_));
}

}  // namespace
}  // namespace theatron::viewer
