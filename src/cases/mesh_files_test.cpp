// SPDX-License-Identifier: Apache-2.0
// Surfaces as programs write them. tests/foreign imports many more of them.
#include "cases/mesh_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "cases/polygon.h"
#include "medical/mesh_measures.h"

namespace theatron::cases {
namespace {

struct Found {
    Answer what = Answer::end;
    std::vector<NamedMesh> meshes;
    std::string extension;
};

template <class Read>
Found read(const std::string& file, Read reader) {
    Found found;
    found.what = reader(as_bytes(file), [&](const NamedMesh& mesh) {
        found.meshes.push_back(mesh);
        return true;
    });
    return found;
}

Found read_glb_text(const std::string& file) {
    std::string extension;
    Found found = read(file, [&](ByteView bytes, const TakeMesh& take) {
        return read_gltf(bytes, take, extension);
    });
    found.extension = extension;
    return found;
}

// One facet in binary, announced `count` times.
std::string facet(std::uint32_t count, const std::string& tail = "") {
    std::string file("solid by an exporter");
    file.resize(84 + 50);
    std::memcpy(&file[80], &count, 4);
    const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::memcpy(&file[96], corners, sizeof(corners));
    return file + tail;
}

TEST(Stl, BinaryIsReadAlsoWithBytesBehindAndNotWithTooFew) {
    for (const std::string& tail : {std::string(), std::string(7, 'x'), std::string(50, '\0')}) {
        const Found found = read(facet(1, tail), read_stl);
        ASSERT_EQ(found.what, Answer::end);
        ASSERT_EQ(found.meshes.size(), 1u);
        EXPECT_EQ(found.meshes[0].mesh.positions[1], (medical::Vec3f{1, 0, 0}));
    }
    EXPECT_EQ(read(facet(2), read_stl).what, Answer::lacks);
    EXPECT_EQ(read(facet(0x3fffffff), read_stl).what, Answer::lacks);
    // Written to a pipe, whose end the program did not know.
    for (const std::uint32_t count : {0u, 0xffffffffu}) {
        EXPECT_EQ(read(facet(count), read_stl).meshes.size(), 1u);
        EXPECT_EQ(read(facet(count, "x"), read_stl).meshes.size(), 0u);
    }
    EXPECT_EQ(read(facet(1, facet(1).substr(84)), read_stl).what, Answer::more);
    EXPECT_EQ(read(facet(0).substr(0, 84), read_stl).what, Answer::no_triangles);
    EXPECT_EQ(read("", read_stl).what, Answer::no_mesh);
}

TEST(Stl, TextIsReadInAnyCaseAndSolidsAreMeshes) {
    const std::string text =
        "\nSOLID vertex of A\rFACET NORMAL -1.#IND 0 0\rOUTER LOOP\rVERTEX 0 0 0\rVERTEX 1,5 0 0\r"
        "VERTEX 0 1 0\rENDLOOP\rENDFACET\rENDSOLID\rsolid b\rfacet normal 0 0 0 outer loop "
        "vertex 0 0 0 vertex 2 0 0 vertex 0 2 0 endloop endfacet";
    const Found found = read(text, read_stl);
    ASSERT_EQ(found.what, Answer::end);
    ASSERT_EQ(found.meshes.size(), 2u);
    EXPECT_EQ(found.meshes[0].name, "vertex of A");
    EXPECT_EQ(found.meshes[0].mesh.positions[1].x, 1.5f);
    EXPECT_EQ(found.meshes[1].name, "b");
    EXPECT_EQ(read("solid x\nvertex 0 0 0\nvertex 1 1 1\n", read_stl).what, Answer::lacks);
    EXPECT_EQ(read("solid x\nvertex 0 0 up\n", read_stl).what, Answer::unreadable);
}

TEST(Ply, StripsAndPolygonsBecomeTriangles) {
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
        "property float y\nproperty float z\n";
    const std::string corners = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
    const Found strip = read(head +
                                 "element tristrips 1\nproperty list int int vertex_indices\n"
                                 "end_header\n" +
                                 corners + "9 0 1 2 3 -1 0 1 2 -1\n",
                             read_ply);
    ASSERT_EQ(strip.what, Answer::end);
    EXPECT_THAT(strip.meshes.at(0).mesh.triangles,
                ::testing::ElementsAre(medical::Triangle{0, 1, 2}, medical::Triangle{2, 1, 3},
                                       medical::Triangle{0, 1, 2}));
    EXPECT_EQ(read(head + "element cell 1\nproperty list int int vertex_indices\nend_header\n" +
                       corners + "3 0 1 2\n",
                   read_ply)
                  .what,
              Answer::no_mesh)
        << "an element that is not known and has corners is no surface that can be shown";
    EXPECT_EQ(read(head + "end_header\n" + corners, read_ply).what, Answer::no_triangles);
}

TEST(Polygon, OneThatIsNotConvexIsCoveredOnce) {
    // An L of three unit squares, in both directions and all planes.
    const float flat[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (int plane = 0; plane < 3; ++plane)
        for (const bool turns_back : {false, true}) {
            medical::Mesh mesh;
            for (const auto& p : flat) {
                float v[3] = {5, 5, 5};
                v[plane] = p[0];
                v[(plane + 1) % 3] = p[1];
                mesh.positions.push_back({v[0], v[1], v[2]});
            }
            std::vector<std::uint32_t> corners{0, 1, 2, 3, 4, 5};
            if (turns_back)
                std::reverse(corners.begin(), corners.end());
            add_polygon(corners, mesh.positions, mesh.triangles);
            ASSERT_EQ(mesh.triangles.size(), 4u);
            double area = 0;
            for (const medical::Triangle& t : mesh.triangles) {
                const auto p = [&](int i) { return medical::to_double(mesh.positions[t[i]]); };
                const Vec3 n = cross(p(1) - p(0), p(2) - p(0));
                const double along = plane == 0 ? n.z : plane == 1 ? n.x : n.y;
                EXPECT_EQ(along > 0, !turns_back);
                area += length(n) / 2;
            }
            EXPECT_NEAR(area, 3, 1e-9);
        }
}

std::string glb(std::string json) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string file = "glTF";
    const std::uint32_t numbers[] = {2, std::uint32_t(20 + json.size()),
                                     std::uint32_t(json.size())};
    file.append(reinterpret_cast<const char*>(numbers), sizeof(numbers));
    return file + "JSON" + json;
}

TEST(Glb, WhatItNeedsAndIsNotKnownIsNamed) {
    const Found found = read_glb_text(glb(R"({"extensionsRequired": ["VENDOR_shape"]})"));
    EXPECT_EQ(found.what, Answer::extension);
    EXPECT_EQ(found.extension, "VENDOR_shape");
    EXPECT_EQ(read_glb_text(glb(R"({"extensionsRequired": ["KHR_materials_unlit"]})")).what,
              Answer::no_triangles);
    EXPECT_EQ(read_glb_text(glb("{")).what, Answer::unreadable);
    EXPECT_EQ(
        read_glb_text(glb(R"({"nodes": [{"mesh": 0}], "accessors": [5], "meshes": [{"primitives":
                                [{"attributes": {"POSITION": 0}}]}]})"))
            .what,
        Answer::unreadable);
    EXPECT_EQ(
        read_glb_text(glb(R"({"nodes": [{"children": [0]}], "scenes": [{"nodes": [0]}]})")).what,
        Answer::unreadable)
        << "a node that holds itself";
}

// Three corners and a triangle, as meshoptimizer packs them in the plainest way.
Bytes packed_corners(const std::vector<float>& numbers) {
    constexpr std::size_t stride = 12, group = 16;
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(numbers.data());
    const std::size_t count = numbers.size() / 3;
    Bytes out{std::byte{0xa0}};
    for (std::size_t k = 0; k < stride; ++k) {
        out.push_back(std::byte{0xff});
        for (std::size_t i = 0; i < group; ++i) {
            const auto before = std::int8_t(bytes[(i == 0 || i >= count ? 0 : i - 1) * stride + k]);
            const auto here = i < count ? std::int8_t(bytes[i * stride + k]) : before;
            const auto step = std::int8_t(here - before);
            out.push_back(std::byte(std::uint8_t((step << 1) ^ (step >> 7))));
        }
    }
    out.insert(out.end(), 32 - stride, std::byte{});
    const auto first = as_bytes(std::span(numbers)).first(stride);
    out.insert(out.end(), first.begin(), first.end());
    return out;
}

TEST(GlbPacked, CornersOfMeshoptimizerAreExactAndEachTruncationIsRefused) {
    const std::vector<float> numbers = {0, 0, 0, 0.25f, -7, 1e-3f, 3, 0.1f, 2};
    const Bytes packed = packed_corners(numbers);
    const glb::MeshoptView about{"ATTRIBUTES", "", 3, 12};
    const std::optional<Bytes> unpacked = glb::unpack_meshopt(packed, about);
    ASSERT_TRUE(unpacked);
    EXPECT_TRUE(
        std::equal(unpacked->begin(), unpacked->end(), as_bytes(std::span(numbers)).begin()));
    for (std::size_t n = 0; n < packed.size(); ++n) {
        const Bytes part(packed.begin(), packed.begin() + std::ptrdiff_t(n));
        EXPECT_FALSE(glb::unpack_meshopt(part, about)) << n << " bytes";
    }
}

TEST(GlbPacked, NumbersThatTheLibraryTrustsAreRefusedHere) {
    const Bytes packed = packed_corners({0, 0, 0, 1, 0, 0, 0, 1, 0});
    for (const glb::MeshoptView& about :
         std::vector<glb::MeshoptView>{{"ATTRIBUTES", "", 0, 12},
                                       {"ATTRIBUTES", "", 3, 0},
                                       {"ATTRIBUTES", "", 3, 10},
                                       {"ATTRIBUTES", "", 3, 260},
                                       {"ATTRIBUTES", "", std::size_t(1) << 60, 16},
                                       {"ATTRIBUTES", "OCTAHEDRAL", 3, 12},
                                       {"TRIANGLES", "", 4, 2},
                                       {"TRIANGLES", "", 3, 3},
                                       {"INDICES", "EXPONENTIAL", 3, 4},
                                       {"POINTS", "", 3, 12}})
        EXPECT_FALSE(glb::unpack_meshopt(packed, about)) << about.mode << " " << about.count;
}

TEST(GlbPacked, CornersInTheNewerFormOfMeshoptimizerAreToldApart) {
    Bytes packed = packed_corners({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const glb::MeshoptView corners{"ATTRIBUTES", "", 3, 12}, triangles{"TRIANGLES", "", 3, 2};
    EXPECT_FALSE(glb::needs_newer_meshopt(packed, corners));
    packed[0] = std::byte{0xa1};
    EXPECT_TRUE(glb::needs_newer_meshopt(packed, corners));
    EXPECT_FALSE(glb::needs_newer_meshopt(packed, triangles));
    EXPECT_FALSE(glb::needs_newer_meshopt({}, corners));
}

TEST(GlbPacked, BytesThatAreNoDracoAreNothing) {
    const std::string text = std::string("DRACO\2\2\1\0\0\0", 11) + "and no more";
    EXPECT_FALSE(glb::unpack_draco(as_bytes(text), 0));
    EXPECT_FALSE(glb::unpack_draco({}, 0));
}

TEST(GlbPacked, DracoIsNamedWhereItsLibraryMayNotRun) {
    const Found found = read_glb_text(glb(R"({"nodes": [{"mesh": 0}], "accessors": [
        {"componentType": 5126, "count": 3, "type": "VEC3"}], "meshes": [{"primitives": [{"attributes":
        {"POSITION": 0}, "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0}}}]}]})"));
    EXPECT_EQ(found.what, Answer::extension);
    EXPECT_EQ(found.extension, "KHR_draco_mesh_compression");
}

}  // namespace
}  // namespace theatron::cases
