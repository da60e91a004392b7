// SPDX-License-Identifier: Apache-2.0
// Surfaces on their way into a case.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "cases/case_folder.h"
#include "cases/import_testing.h"
#include "medical/mesh_measures.h"

namespace theatron::cases {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

TEST_F(Import, SurfacesOfAllFormatsAndAxesComeToTheSamePlace) {
    fs::create_directories(source());
    write_cube_stl(source() / "a.stl", 10);
    std::ofstream(source() / "b.obj") << "mtllib secret.mtl\nv 10 10 10\nv 50 10 10\nv 10 50 10\n"
                                         "v 10 10 50\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    std::ofstream(source() / "c.ply")
        << "ply\nformat ascii 1.0\ncomment SPACE=RAS\nelement vertex 4\nproperty float x\n"
           "property float y\nproperty float z\nelement face 4\n"
           "property list uchar int vertex_indices\nend_header\n-10 -10 10\n-50 -10 10\n"
           "-10 -50 10\n-10 -10 50\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    import();
    const LoadedCase loaded = read_case(target());
    ASSERT_EQ(loaded.meshes.size(), 3u);
    for (const medical::Mesh& mesh : loaded.meshes) {
        EXPECT_TRUE(medical::shape_of(mesh).manifold);
        EXPECT_GT(medical::shape_of(mesh).volume_mm3, 0);
        const medical::Box box = medical::box_of(mesh);
        EXPECT_NEAR(length(box.low_mm - Vec3{10, 10, 10}), 0, 1e-3);
        EXPECT_NEAR(length(box.high_mm - Vec3{50, 50, 50}), 0, 1e-3);
    }
}

TEST_F(Import, RegionsOfAnOrganWithAShellDoNotHideWhatIsInIt) {
    fs::create_directories(source());
    write_cube_stl(source() / "liver_segment_4.stl", 0);
    write_cube_stl(source() / "spleen.stl", 50);
    EXPECT_EQ(import().manifest.parts.at(0).opacity, 1);
    fs::remove_all(target());
    write_cube_stl(source() / "liver.stl", 0);
    for (const medical::Part& part : import().manifest.parts)
        EXPECT_EQ(part.opacity, part.name == "liver"    ? 0.35
                                : part.name == "spleen" ? 1
                                                        : 0.15)
            << part.name;
}

TEST_F(Import, ASizeThatNoOrganHasIsRemarkedOn) {
    fs::create_directories(source());
    write_cube_stl(source() / "a.stl", 1);
    ImportOptions options;
    options.unit = medical::Unit::m;
    EXPECT_THAT(import(options).remarks,
                ElementsAre(HasSubstr("4e+04 mm long, which no organ is; check the unit")));
}

TEST_F(Import, A2GigabyteStlIsRefusedUnread) {
    fs::create_directories(source());
    write_cube_stl(source() / "huge.stl", 0);
    fs::resize_file(source() / "huge.stl", std::uintmax_t(2) << 30);
    EXPECT_THAT(refusal(), HasSubstr("huge.stl' is 2.1 GB large, and at most 256 MiB are read"));
}

TEST_F(Import, AMeshThatAnnouncesMoreThanItHoldsEndsInASentence) {
    fs::create_directories(source());
    // Binary STL: 80 bytes, then how many triangles follow.
    std::string lie(84 + 50, '\0');
    std::memcpy(&lie[80], "\xff\xff\xff\x3f", 4);
    std::ofstream(source() / "lie.stl") << lie;
    EXPECT_THAT(refusal(), HasSubstr("lie.stl' holds fewer triangles than it announces"));
    fs::remove(source() / "lie.stl");
    std::ofstream(source() / "lie.ply")
        << "ply\nformat ascii 1.0\nelement vertex 2000000000\nproperty float x\nend_header\n";
    EXPECT_THAT(refusal(), HasSubstr("lie.ply' holds fewer triangles than it announces"));
    fs::remove(source() / "lie.ply");
    std::ofstream(source() / "noise.glb") << "glTF" << std::string(1000, '\xff');
    EXPECT_THAT(refusal(), HasSubstr("noise.glb' is left out: it is no surface"));
}

TEST_F(Import, ASimplifiedSurfaceKeepsToItsBudget) {
    fs::create_directories(source());
    std::ofstream out(source() / "sheet.obj");
    const int side = 60;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            out << "v " << x << ' ' << y << ' ' << (x * x + y * y) % 7 * 0.05 << '\n';
    for (int y = 0; y + 1 < side; ++y)
        for (int x = 1; x < side; ++x) {
            const int i = y * side + x;
            out << "f " << i << ' ' << i + 1 << ' ' << i + side << '\n';
            out << "f " << i + 1 << ' ' << i + side + 1 << ' ' << i + side << '\n';
        }
    out.close();
    ImportOptions options;
    options.max_triangles = 1000;
    EXPECT_THAT(import(options).remarks, Contains(HasSubstr("was simplified from 6962")));
    EXPECT_LE(read_case(target()).meshes.at(0).triangles.size(), 1000u);
}

}  // namespace
}  // namespace theatron::cases
