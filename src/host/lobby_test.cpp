// SPDX-License-Identifier: Apache-2.0
#include "host/lobby.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "files/png_file.h"
#include "host/thumbnail.h"

namespace theatron::host {
namespace {

HostFigures figures() {
    HostFigures figures;
    figures.name = "OR 3";
    HostFigures::Camera camera;
    camera.lane.name = "lamp";
    figures.cameras.push_back(camera);
    HostFigures::Participant ada;
    ada.name = "Ada";
    ada.role = wire::Role::observer;
    figures.participants.push_back(ada);
    return figures;
}

TEST(Lobby, NamesPeopleAndCameras) {
    const auto lobby = lobby_json(figures(), wire::Role::expert, false);
    EXPECT_EQ(lobby["role"], "expert");
    const auto& session = lobby["sessions"].at(0);
    EXPECT_EQ(session["name"], "OR 3");
    EXPECT_EQ(session["people"].at(0)["name"], "Ada");
    EXPECT_EQ(session["people"].at(0)["role"], "observer");
    EXPECT_EQ(session["cameras"].at(0)["name"], "lamp");
    EXPECT_EQ(session["thumbnail"], "/thumbnail");
}

TEST(Lobby, TellsSomeoneWhoMustAskOnlyTheNumberOfPeople) {
    const auto lobby = lobby_json(figures(), wire::Role::observer, true);
    EXPECT_EQ(lobby["sessions"].at(0)["people_count"], 1);
    EXPECT_TRUE(lobby["sessions"].at(0)["asks"]);
    EXPECT_EQ(lobby.dump().find("Ada"), std::string::npos);
    EXPECT_EQ(lobby.dump().find("lamp"), std::string::npos);
    EXPECT_EQ(lobby.dump().find("thumbnail"), std::string::npos);
}

FramePtr frame_of(Size size, Rgb color) {
    auto frame = std::make_shared<Frame>();
    frame->color.size = size;
    if (size != Size{}) {
        frame->color.pixels = ColorImage(size);
        for (Rgb& pixel : frame->color.pixels.pixels)
            pixel = color;
    }
    return frame;
}

TEST(Thumbnail, IsASmallPictureOfAFrameAndANewOneAfterTwoSeconds) {
    Thumbnail thumbnail;
    EXPECT_TRUE(thumbnail.png().empty());
    const TimePoint begin = from_us(1'000'000);
    thumbnail.on_frame(frame_of({}, {}), begin);
    EXPECT_TRUE(thumbnail.png().empty()) << "a camera without colour";
    const auto pixel_at = [&](TimePoint now, Rgb color) {
        thumbnail.on_frame(frame_of({1280, 721}, color), now);
        const std::string png = thumbnail.png();
        ColorImage picture;
        EXPECT_EQ(files::decode_png(as_bytes(png), picture), "");
        EXPECT_EQ(picture.size, (Size{213, 120}));
        return picture.pixels.at(0);
    };
    EXPECT_EQ(pixel_at(begin, {1, 2, 3}), (Rgb{1, 2, 3}));
    EXPECT_EQ(pixel_at(begin + Thumbnail::interval / 2, {9, 9, 9}), (Rgb{1, 2, 3}));
    EXPECT_EQ(pixel_at(begin + Thumbnail::interval, {9, 9, 9}), (Rgb{9, 9, 9}));
}

TEST(Thumbnail, KeepsAPictureThatIsSmallAlready) {
    const ColorImage picture(Size{7, 5});
    EXPECT_EQ(small_picture(picture.view(), Thumbnail::width), picture);
    EXPECT_TRUE(small_picture({}, Thumbnail::width).empty());
}

}  // namespace
}  // namespace theatron::host
