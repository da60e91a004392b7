// SPDX-License-Identifier: Apache-2.0
#include "medical/shared_case.h"

#include <gtest/gtest.h>

namespace theatron::medical {
namespace {

SharedCase liver() {
    SharedCase shared;
    shared.name = "Liver, portal phase";
    shared.deidentified = true;
    shared.license = "CC0";
    shared.middle_mm = {1, -20, 300.5};
    shared.parts = {{"liver", Role::shell, {178, 92, 74}, 89, {{{std::byte(1)}}, 1200}},
                    {"tumour", Role::tumour, {236, 204, 60}, 255, {{{std::byte(2)}}, 600}}};
    shared.series = {{"CT", "CT", {{{std::byte(3)}}, 4000}, 2}};
    return shared;
}

TEST(SharedCase, IsReadAsItWasWritten) {
    const auto read = decode_shared_case(encode_shared_case(liver()));
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, liver());
    EXPECT_EQ(read->content_bytes(), 5800u);
}

TEST(SharedCase, PicturesMakeItVersion2AndOlderOnesStayAsTheyWere) {
    EXPECT_EQ(encode_shared_case(liver())[4], std::byte(1));
    SharedCase shared = liver();
    shared.pictures = {{"wound", {{{std::byte(4)}}, 70}}, {"plan", {{{std::byte(5)}}, 30}}};
    const Bytes bytes = encode_shared_case(shared);
    EXPECT_EQ(bytes[4], std::byte(2));
    const auto read = decode_shared_case(bytes);
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, shared);
    EXPECT_EQ(read->content_bytes(), 5900u);
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(decode_shared_case(ByteView(bytes).first(size))) << size;
    shared.pictures[0].picture.size = 0;
    EXPECT_FALSE(decode_shared_case(encode_shared_case(shared)));
    Bytes newer = bytes;
    newer[4] = std::byte(3);
    EXPECT_EQ(decode_shared_case(newer).error(), Status::unsupported_version);
}

TEST(SharedCase, AnyMissingOrSurplusByteIsRefused) {
    const Bytes bytes = encode_shared_case(liver());
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(decode_shared_case(ByteView(bytes).first(size))) << size;
    Bytes longer = bytes;
    longer.push_back({});
    EXPECT_FALSE(decode_shared_case(longer));
}

TEST(SharedCase, ContentOfNoBytesAndPlacesOutsideOfAnyPatientAreRefused) {
    SharedCase shared = liver();
    shared.parts[1].mesh.size = 0;
    EXPECT_FALSE(decode_shared_case(encode_shared_case(shared)));
    shared = liver();
    shared.middle_mm.y = 1e9;
    EXPECT_FALSE(decode_shared_case(encode_shared_case(shared)));
}

}  // namespace
}  // namespace theatron::medical
