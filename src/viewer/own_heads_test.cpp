// SPDX-License-Identifier: Apache-2.0
#include "viewer/own_heads.h"

#include <gtest/gtest.h>

#include "face/sent_face.h"
#include "video/jpeg_encoder_native.h"

namespace theatron::viewer {
namespace {

using face::Emotion;

Bytes jpeg_of(Size size) {
    ColorImage picture(size);
    std::fill(picture.pixels.begin(), picture.pixels.end(), Rgb{150, 120, 90});
    video::JpegCompressor compressor(80, true);
    const ByteView jpeg = compressor.compress(picture.view());
    return {jpeg.begin(), jpeg.end()};
}

face::EnrolledFace some_face() {
    face::EnrolledFace face = face::enrolled_person(face::generated_head(), {});
    face.textures[std::size_t(Emotion::neutral)] = jpeg_of({64, 64});
    face.textures[std::size_t(Emotion::anger)] = jpeg_of({64, 64});
    return face;
}

std::shared_ptr<const Bytes> shared(Bytes bytes) {
    return std::make_shared<const Bytes>(std::move(bytes));
}

TEST(OwnHeads, AreThereWhileTheirFacesAre) {
    OwnHeads heads;
    constexpr ParticipantId anna{1}, ben{2};
    client::FaceKeeper::Faces faces;
    EXPECT_FALSE(heads.take(faces));
    faces[anna] = shared(face::enrolled_bytes(some_face()));
    faces[ben] = shared(Bytes(100));
    EXPECT_TRUE(heads.take(faces));
    const auto head = heads.of(anna);
    ASSERT_TRUE(head);
    EXPECT_EQ(head->texture_size(), (Size{64, 64}));
    EXPECT_FALSE(heads.of(ben));
    EXPECT_EQ(heads.damaged(), 1u);
    EXPECT_FALSE(heads.take(faces));
    EXPECT_EQ(heads.damaged(), 1u);
    faces.erase(anna);
    EXPECT_TRUE(heads.take(faces));
    EXPECT_FALSE(heads.of(anna));
}

TEST(OwnHeads, OfATextureThatASessionDoesNotTakeThereIsNone) {
    face::EnrolledFace face = some_face();
    EXPECT_TRUE(own_head_of(face::enrolled_bytes(face)));
    face.textures[std::size_t(Emotion::anger)] = jpeg_of({32, 64});  // another size
    EXPECT_FALSE(own_head_of(face::enrolled_bytes(face)));
    face.textures[std::size_t(Emotion::anger)] = Bytes(50, std::byte(7));
    EXPECT_FALSE(own_head_of(face::enrolled_bytes(face)));
    face = some_face();
    face.textures[std::size_t(Emotion::neutral)] = jpeg_of({1024, 64});
    face.textures[std::size_t(Emotion::anger)] = {};
    EXPECT_FALSE(own_head_of(face::enrolled_bytes(face)));
}

TEST(OwnHeads, FurtherOnesAreNotDrawn) {
    OwnHeads heads;
    client::FaceKeeper::Faces faces;
    const auto face = shared(face::enrolled_bytes(some_face()));
    for (std::uint32_t i = 1; i <= OwnHeads::max_own_heads + 1; ++i)
        faces[ParticipantId{i}] = face;
    heads.take(faces);
    EXPECT_TRUE(heads.of(ParticipantId{1}));
    EXPECT_FALSE(heads.of(ParticipantId{OwnHeads::max_own_heads + 1}));
}

}  // namespace
}  // namespace theatron::viewer
