// SPDX-License-Identifier: Apache-2.0
// Buffers, versions and hidden nodes of glTF. tests/foreign imports many more of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "cases/foreign_files.h"
#include "cases/mesh_files.h"
#include "testing/temporary_folder.h"

namespace theatron::cases {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Three corners, the first of them at 0, 0, 0, in base64.
const std::string corners = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";

std::string triangle(const std::string& uri, const std::string& more = "",
                     const std::string& node = "") {
    return R"({"buffers": [{"byteLength": 36, "uri": ")" + uri +
           R"("}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
           "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
           "meshes": [{"name": "vein", "primitives": [{"attributes": {"POSITION": 0}}]}],
           "nodes": [{"mesh": 0}, {"mesh": 0, "name": "tumour")" +
           node + "}]" + more + "}";
}

struct Found {
    Answer what = Answer::end;
    std::string said;
    std::vector<std::string> names;
    std::vector<std::string> asked;
};

Found read(const std::string& file, const std::optional<Bytes>& beside = std::nullopt) {
    Found found;
    const TakeMesh take = [&](const NamedMesh& mesh) {
        EXPECT_EQ(mesh.mesh.positions.at(1), (medical::Vec3f{1, 0, 0}));
        found.names.push_back(mesh.name);
        return true;
    };
    found.what = read_gltf(as_bytes(file), take, found.said, [&](const std::string& name) {
        found.asked.push_back(name);
        return beside;
    });
    return found;
}

TEST(Gltf, BuffersAreInItsTextOrBesideIt) {
    const Found within = read(triangle("data:application/octet-stream;base64," + corners));
    EXPECT_EQ(within.what, Answer::end);
    EXPECT_THAT(within.names, ElementsAre("vein", "tumour"));
    EXPECT_TRUE(within.asked.empty());

    const std::optional<Bytes> bytes = glb::bytes_of_data_uri("data:;base64," + corners);
    ASSERT_TRUE(bytes);
    const Found beside = read(triangle("./the%20vein.bin"), bytes);
    EXPECT_EQ(beside.what, Answer::end);
    EXPECT_EQ(beside.names.size(), 2u);
    EXPECT_THAT(beside.asked, ElementsAre("the vein.bin")) << "once for both nodes";

    const Found missing = read(triangle("vein.bin"));
    EXPECT_EQ(missing.what, Answer::other_buffer);
    EXPECT_EQ(missing.said, "vein.bin");
    EXPECT_EQ(read(triangle("vein.bin"), Bytes(35)).what, Answer::lacks);
    EXPECT_EQ(read(triangle("data:;base64,****")).what, Answer::property);
}

TEST(Gltf, Base64IsWholeOrNothing) {
    const auto text = [](const std::string& digits) {
        const std::optional<Bytes> bytes = glb::bytes_of_data_uri("data:;base64," + digits);
        return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size())
                     : "none";
    };
    EXPECT_EQ(text("TWFu"), "Man");
    EXPECT_EQ(text("TWE="), "Ma");
    EXPECT_EQ(text("TQ=="), "M");
    EXPECT_EQ(text("TQ"), "M");
    EXPECT_EQ(text(""), "");
    for (const char* wrong : {"T", "TWFuT", "TW u", "TW=u", "TW-_"})
        EXPECT_EQ(text(wrong), "none") << wrong;
    EXPECT_FALSE(glb::bytes_of_data_uri("data:,TWFu"));
    EXPECT_FALSE(glb::bytes_of_data_uri("data:;base64"));
}

TEST(Gltf, AddressesAreNamesOfFiles) {
    EXPECT_EQ(glb::name_of_uri("a%20b%C3%BC.bin"), "a b\xc3\xbc.bin");
    EXPECT_EQ(glb::name_of_uri("%2E%2e%2fx"), "../x");
    EXPECT_EQ(glb::name_of_uri("5%.bin"), "5%.bin");
    EXPECT_EQ(glb::name_of_uri("5%4"), "5%4");
    EXPECT_EQ(glb::name_of_uri("%zz%4g"), "%zz%4g");
}

TEST(Gltf, AnotherVersionIsNamed) {
    const auto version = [](const std::string& asset) {
        const Found found =
            read(triangle("data:;base64," + corners, R"(, "asset": {)" + asset + "}"));
        return found.what == Answer::version ? found.said
                                             : std::to_string(found.names.size()) + " are read";
    };
    EXPECT_EQ(version(R"("version": "2.0", "minVersion": "3.0")"), "3.0");
    EXPECT_EQ(version(R"("version": "2.1", "minVersion": "2.1")"), "2.1");
    EXPECT_EQ(version(R"("version": "1.0")"), "1.0");
    EXPECT_EQ(version(R"("version": "2.1", "minVersion": "2.0")"), "2 are read");
    EXPECT_EQ(version(R"("version": 2)"), "2 are read");
}

TEST(Gltf, HiddenNodesAreNamedAndNotShown) {
    const std::string uri = "data:;base64," + corners;
    const auto visible = [](const char* value) {
        return std::string(R"(, "extensions": {"KHR_node_visibility": {"visible": )") + value +
               "}}";
    };
    const Found one = read(triangle(uri, "", visible("false")));
    EXPECT_EQ(one.what, Answer::end);
    EXPECT_THAT(one.names, ElementsAre("vein"));
    EXPECT_EQ(one.said, "tumour\n");
    EXPECT_EQ(read(triangle(uri, "", visible("true"))).names.size(), 2u);
    const Found none = read(triangle(uri, R"(, "scenes": [{"nodes": [1]}])", visible("false")));
    EXPECT_EQ(none.what, Answer::hidden);
    EXPECT_TRUE(none.names.empty());
}

TEST(Gltf, HiddenNodesWithoutNamesAreNumberedAndAllAreCounted) {
    const std::string hidden = R"({"mesh": 0, "extensions":
                                  {"KHR_node_visibility": {"visible": false}}})";
    std::string nodes = R"({"mesh": 0})";
    for (int i = 0; i < 300; ++i)
        nodes += ", " + hidden;
    const Found found =
        read(R"({"buffers": [{"byteLength": 36, "uri": "data:;base64,)" + corners + R"("}],
                "bufferViews": [{"buffer": 0, "byteLength": 36}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3,
                               "type": "VEC3"}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                "nodes": [)" +
             nodes + "]}");
    EXPECT_EQ(found.what, Answer::end);
    EXPECT_EQ(found.names.size(), 1u);
    EXPECT_TRUE(found.said.starts_with("node 1\nnode 2\n")) << found.said;
    EXPECT_EQ(std::count(found.said.begin(), found.said.end(), '\n'), 300);
}

// A surface each in as many files, b0.bin and so on, that lie beside the file.
std::filesystem::path with_buffers(const std::filesystem::path& folder, int count) {
    const std::optional<Bytes> bytes = glb::bytes_of_data_uri("data:;base64," + corners);
    std::string buffers, views, accessors, meshes, nodes;
    for (int i = 0; i < count; ++i) {
        const std::string n = std::to_string(i), comma = i > 0 ? "," : "";
        std::ofstream(folder / ("b" + n + ".bin"), std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes->data()), std::streamsize(bytes->size()));
        buffers += comma + R"({"byteLength": 36, "uri": "b)" + n + R"(.bin"})";
        views += comma + R"({"byteLength": 36, "buffer": )" + n + "}";
        accessors += comma + R"({"componentType": 5126, "count": 3, "type": "VEC3",
                                 "bufferView": )" +
                     n + "}";
        meshes += comma + R"({"primitives": [{"attributes": {"POSITION": )" + n + "}}]}";
        nodes += comma + R"({"mesh": )" + n + "}";
    }
    const std::filesystem::path file = folder / "o.gltf";
    std::ofstream(file) << R"({"buffers": [)" << buffers << R"(], "bufferViews": [)" << views
                        << R"(], "accessors": [)" << accessors << R"(], "meshes": [)" << meshes
                        << R"(], "nodes": [)" << nodes << "]}";
    return file;
}

std::string reason_left_out(const std::filesystem::path& file) {
    try {
        return std::to_string(read_mesh_file(file).meshes.size()) + " are read";
    } catch (const NotForUs& error) {
        return error.reason();
    }
}

TEST(Gltf, ABufferBesideItThatIsNotTakenSaysWhy) {
    const testing::TemporaryFolder folder;
    EXPECT_EQ(reason_left_out(with_buffers(folder.path(), 64)), "64 are read");
    EXPECT_EQ(reason_left_out(with_buffers(folder.path(), 65)),
              "needs more than 64 files of corners; store it as one .glb");
    const std::filesystem::path file = with_buffers(folder.path(), 2);
    std::filesystem::remove(folder.path() / "b1.bin");
    EXPECT_THAT(reason_left_out(file), HasSubstr("'b1.bin', which must lie beside it"));
    std::filesystem::create_symlink("b0.bin", folder.path() / "b1.bin");
    EXPECT_THAT(reason_left_out(file), HasSubstr("'b1.bin', which is a link and not followed"));
}

}  // namespace
}  // namespace theatron::cases
