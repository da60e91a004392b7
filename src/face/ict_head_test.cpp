// SPDX-License-Identifier: Apache-2.0
#include "face/ict_head.h"

#include <gtest/gtest.h>

#include "base/float_bytes.h"

namespace theatron::face {
namespace {

// Two squares of skin that meet in the texture's seam, one of the head, and an eye's shade, which
// is left out.
constexpr std::string_view small_mesh =
    "# a comment\nmtllib some.mtl\n"
    "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nv 2 0 1\r\nv 2 1 1\nv 0 2 0\nv 5 5 5\n"
    "vt 0.1 0.2\nvt 0.5 0.2\nvt 0.5 0.6\nvt 0.1 0.6\nvt 0.6 0.2\nvt 0.9 0.2\nvt 0.9 0.6\n"
    "vt 0.6 0.6\nvt 1.25 0.5\n"
    "usemtl M_Face\nf 1/1 2/2 3/3 4/4\nf 2/5 5/6 6/7 3/8\n"
    "usemtl M_EyeOcclusion\nf 8/1 1/1 2/2\n"
    "usemtl M_BackHead\nf 4/9 3/9 7/9\n";
constexpr std::uint32_t small_vertices = 8;

struct IctShape {
    std::string_view name;
    float scale;
    std::array<std::int16_t, 3> of_vertex_2;
};

Bytes shapes(std::initializer_list<IctShape> all, std::uint32_t vertices = small_vertices) {
    const ByteView magic = as_bytes("ICTFKL01");
    Bytes bytes(magic.begin(), magic.end());
    ByteWriter out(bytes);
    out.put(std::uint32_t(all.size()));
    out.put(vertices);
    out.put(std::uint32_t(0));
    for (const IctShape& shape : all) {
        out.put(std::uint16_t(shape.name.size()));
        out.put_bytes(as_bytes(shape.name));
        put_f32(out, shape.scale);
        for (std::uint32_t i = 0; i < vertices; ++i)
            for (const std::int16_t value : shape.of_vertex_2)
                out.put(i == 1 ? value : std::int16_t(0));
    }
    return bytes;
}

struct Small {
    Bytes expressions = shapes({{"browDown_L", 0.001F, {1000, -500, 0}},
                                {"cheekPuff_R", 0.001F, {0, 0, 300}},
                                {"jawOpen", 0.001F, {0, -1000, 0}}});
    Bytes identities = shapes({{"identity000", 0.001F, {1, 2, 3}}});
    std::string mesh = std::string(small_mesh);
    std::array<std::uint32_t, landmark_count> landmarks{};

    IctRead read() const { return read_ict_head({mesh, expressions, identities, landmarks}); }
    std::string problem() const { return read().problem; }
};

TEST(IctHead, IsReadInMillimetresWithItsPartsAndSeams) {
    Small small;
    small.landmarks[5] = 2;
    const IctRead read = small.read();
    ASSERT_EQ(read.problem, "");
    const MorphModel& model = read.model;
    EXPECT_EQ(model.part_sizes, (std::array<std::uint32_t, part_count>{4, 1}));
    // Vertices 2 and 3 of the mesh have two places each; vertex 8 belongs to nothing.
    ASSERT_EQ(model.vertex_count(), 9U);
    EXPECT_EQ(model.neutral[3], 10);
    EXPECT_EQ(model.landmarks[5], 2U);
    EXPECT_FLOAT_EQ(model.places[0], 0.1F);
    EXPECT_FLOAT_EQ(model.places[1], 0.8F);  // v points down
    // The head's triangle shares its corners with the skin.
    EXPECT_EQ(model.triangles[4], (std::array<std::uint32_t, 3>{3, 2, 8}));
    ASSERT_EQ(model.expressions.size(), 3U);
    EXPECT_EQ(model.expressions[0].channel, brow_down_left);
    EXPECT_EQ(model.expressions[1].channel, cheek_puff);
    EXPECT_EQ(model.expressions[2].channel, jaw_open);
    EXPECT_FLOAT_EQ(model.expressions[0].offsets[3], 10);
    EXPECT_FLOAT_EQ(model.expressions[0].offsets[4], -5);
    // Its other copy moves with it.
    const std::size_t copy = model.triangles[2][0];
    EXPECT_NE(copy, 1U);
    EXPECT_FLOAT_EQ(model.expressions[0].offsets[3 * copy], 10);
    EXPECT_FLOAT_EQ(model.identities[0][5], 0.03F);
    // The model that is written can be read.
    EXPECT_TRUE(parse_model(model_bytes(model)));
}

TEST(IctHead, OtherFilesAreRefusedWithAReason) {
    const auto with_mesh = [](std::string_view from, std::string_view to) {
        Small small;
        const std::size_t at = small.mesh.find(from);
        small.mesh.replace(at, from.size(), to);
        return small.problem();
    };
    EXPECT_EQ(with_mesh("v 1 0 1", "v 1 0 x"), "line 4 of its mesh is no vertex");
    EXPECT_EQ(with_mesh("v 1 0 1", "v 1 0 900"), "line 4 of its mesh is a vertex too far away");
    EXPECT_EQ(with_mesh("vt 0.5", "vt nan"), "line 12 of its mesh is no place in a texture");
    EXPECT_NE(with_mesh("M_BackHead", "M_Hat").find("does not have"), std::string::npos);
    EXPECT_NE(with_mesh("2/5", "9/5").find("are not there"), std::string::npos);
    EXPECT_NE(with_mesh("2/5", "0/5").find("are not there"), std::string::npos);
    EXPECT_NE(with_mesh("2/5", "2").find("without places"), std::string::npos);
    EXPECT_NE(with_mesh("M_Face", "M_Teeth").find("material M_Face"), std::string::npos);
    Small small;
    small.landmarks[3] = 7;  // of a part that is left out
    EXPECT_NE(small.problem().find("landmarks"), std::string::npos);
    small = {};
    small.expressions[0] = std::byte('X');
    EXPECT_EQ(small.problem(), "its file of expressions does not begin with ICTFKL01");
    small = {};
    small.identities.pop_back();
    EXPECT_EQ(small.problem(), "its file of identities ends early");
    small.identities.insert(small.identities.end(), 3, std::byte(0));
    EXPECT_EQ(small.problem(), "its file of identities has more bytes than shapes");
    small = {};
    small.identities = shapes({}, 7);
    EXPECT_EQ(small.problem(), "its file of identities is of another mesh");
    small = {};
    small.expressions = shapes({{"earWiggle_L", 1e-5F, {}}});
    EXPECT_NE(small.problem().find("none of ARKit's"), std::string::npos);
    small.expressions = shapes({{"jawOpen", 1e9F, {}}});
    EXPECT_NE(small.problem().find("too large"), std::string::npos);
    EXPECT_NE(read_ict_head({}).problem, "");
}

}  // namespace
}  // namespace theatron::face
