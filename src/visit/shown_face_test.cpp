// SPDX-License-Identifier: Apache-2.0
#include "visit/shown_face.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "face/sent_face.h"
#include "video/jpeg_encoder_native.h"
#include "viewer/own_heads.h"
#include "wire/own_face.h"

namespace theatron::visit {
namespace {

// Noise has more bytes than any skin.
Bytes noise_jpeg(Size size, unsigned seed) {
    ColorImage picture(size);
    for (Rgb& pixel : picture.pixels) {
        seed = seed * 1664525 + 1013904223;
        pixel = {std::uint8_t(seed >> 24), std::uint8_t(seed >> 16), std::uint8_t(seed >> 8)};
    }
    video::JpegCompressor compressor(90, true);
    const ByteView jpeg = compressor.compress(picture.view());
    return {jpeg.begin(), jpeg.end()};
}

face::EnrolledFace some_face(Size size, std::size_t pictures) {
    face::EnrolledFace face = face::enrolled_person(face::generated_head(), {});
    for (std::size_t i = 0; i < pictures; ++i)
        face.textures[face::emotion_count - 1 - i] = noise_jpeg(size, unsigned(i));
    return face;
}

// Each triangle has vertices of its own, which are borders and stay.
face::EnrolledFace apart(const face::EnrolledFace& face) {
    face::EnrolledFace result = face;
    const auto copy = [&](const std::vector<float>& from, std::vector<float>& to, std::size_t n) {
        to.clear();
        for (const auto& corners : face.rest.triangles)
            for (const std::uint32_t corner : corners)
                to.insert(to.end(), from.begin() + std::ptrdiff_t(n * corner),
                          from.begin() + std::ptrdiff_t(n * (corner + 1)));
    };
    copy(face.rest.points, result.rest.points, 3);
    copy(face.rest.places, result.rest.places, 2);
    for (std::size_t i = 0; i < face::move_count; ++i)
        copy(face.moves[i], result.moves[i], 3);
    std::uint32_t next = 0;
    for (auto& corners : result.rest.triangles)
        for (std::uint32_t& corner : corners)
            corner = next++;
    return result;
}

void expect_refused(const face::EnrolledFace& face, const std::string& said) {
    try {
        (void)shown_face(face, "me.face");
        ADD_FAILURE() << said;
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr(said));
    }
}

TEST(ShownFace, IsWhatAReceiverTakes) {
    const Bytes bytes = shown_face(some_face({64, 64}, 6), "me.face");
    EXPECT_LE(bytes.size(), wire::max_own_face_bytes);
    const auto head = viewer::own_head_of(bytes);
    ASSERT_TRUE(head);
    EXPECT_EQ(head->texture_size(), (Size{64, 64}));
}

TEST(ShownFace, LargePicturesGetFewerPixelsAndBytes) {
    const Bytes bytes = shown_face(some_face({1024, 1024}, 2), "me.face");
    EXPECT_LE(bytes.size(), wire::max_own_face_bytes);
    const auto head = viewer::own_head_of(bytes);
    ASSERT_TRUE(head);
    EXPECT_EQ(head->texture_size(), (Size{512, 512}));
}

TEST(ShownFace, AFaceThatCannotBeShownIsNamed) {
    face::EnrolledFace face = some_face({64, 64}, 2);
    face.textures[0] = Bytes(100, std::byte(1));
    expect_refused(face, "A texture of the face in 'me.face' is damaged");
    face.textures[0] = noise_jpeg({32, 64}, 1);
    expect_refused(face, "differ in size");
    face.textures[0] = noise_jpeg({2048, 16}, 1);
    expect_refused(face, "is damaged");
    expect_refused(apart(some_face({64, 64}, 1)), "too detailed for a session");
}

}  // namespace
}  // namespace theatron::visit
