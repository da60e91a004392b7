// SPDX-License-Identifier: Apache-2.0
// A real liver CT with surfaces and a label map, where this checkout has it beside it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "cases/case_folder.h"
#include "cases/import_case.h"
#include "cases/import_parts.h"
#include "cases/label_surface.h"
#include "files/png_file.h"
#include "image/image.h"
#include "medical/mesh_cut.h"
#include "medical/mesh_measures.h"
#include "medical/slice.h"
#include "medical/window.h"
#include "sandbox/filter.h"
#include "testing/temporary_folder.h"

namespace theatron::cases {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

// The folder of cases: $THEATRON_CASES or ../shared/cases.
fs::path shared_case(const char* name) {
    const char* set = std::getenv("THEATRON_CASES");
    return fs::path(set ? set : "../shared/cases") / name;
}

#define THEATRON_REQUIRE_CASE(name)     \
    if (!fs::exists(shared_case(name))) \
    GTEST_SKIP() << "no " << shared_case(name) << ": set THEATRON_CASES to a folder with cases"

constexpr auto no_progress = [](std::string_view, double) {};

// The mean distance from points on the outline of a surface in each slice to the border of the
// label map there: a side of a pixel with a neighbour on the other side.
double mean_distance_mm(const medical::Mesh& mesh, const LabelMap& map,
                        const std::vector<int>& labels) {
    const auto is_inside = [&](int i, int j, int k) {
        const int label = i < 0 || j < 0 || i >= map.grid.columns || j >= map.grid.rows
                              ? 0
                              : map.labels[map.grid.index(i, j, k)];
        return std::find(labels.begin(), labels.end(), label) != labels.end();
    };
    double sum = 0;
    std::size_t count = 0;
    for (int k = 3; k < map.grid.slices - 3; k += 12) {
        std::vector<Vec3> border;
        for (int j = 0; j < map.grid.rows; ++j)
            for (int i = 0; i < map.grid.columns; ++i)
                for (const auto& [di, dj] : {std::pair{1, 0}, {0, 1}})
                    if (is_inside(i, j, k) != is_inside(i + di, j + dj, k))
                        border.push_back(map.grid.point_at(i + di * 0.5, j + dj * 0.5, k));
        const Vec3 point = map.grid.point_at(0, 0, k);
        for (const medical::Segment& s : medical::cut_mesh(mesh, point, {0, 0, 1})) {
            double nearest = 1e9;
            const Vec3 middle = (s.a + s.b) * 0.5;
            for (const Vec3& b : border)
                nearest = std::min(nearest, dot(b - middle, b - middle));
            sum += std::sqrt(nearest);
            ++count;
        }
    }
    return count > 0 ? sum / double(count) : 1e9;
}

TEST(RealCase, ASeriesWithItsSurfacesIsImportedAndItsSurfacesLieWhereTheImagesShowThem) {
    THEATRON_REQUIRE_CASE("hcc-tace-048");
    testing::TemporaryFolder folder;
    const fs::path target = folder.path() / "case";
    const ImportReport report = import_case(shared_case("hcc-tace-048"), target, {}, no_progress);
    EXPECT_THAT(report.remarks, ::testing::ElementsAre(HasSubstr("--from-labels"),
                                                       HasSubstr("The picture is shown"),
                                                       HasSubstr("3 files were not read")));
    EXPECT_TRUE(report.manifest.deidentified);
    EXPECT_THAT(check_case(target).problems, IsEmpty());

    const LoadedCase loaded = read_case(target);
    ASSERT_EQ(loaded.pictures.size(), 1u) << "preview.png";
    ASSERT_EQ(loaded.volumes.size(), 1u);
    const medical::Volume& volume = loaded.volumes[0];
    EXPECT_EQ(volume.grid.columns, 512);
    EXPECT_EQ(volume.grid.slices, 89);
    EXPECT_NEAR(volume.grid.origin_mm.z, -396, 1e-9);
    EXPECT_NEAR(volume.grid.slice_step_mm.z, 2.5, 1e-9);
    EXPECT_EQ(volume.intercept, -1024);
    EXPECT_EQ(volume.window, (medical::Window{40, 400}));

    std::map<medical::Role, std::string> roles;
    for (const medical::Part& part : loaded.manifest.parts)
        roles[part.role] = part.name;
    EXPECT_EQ(roles[medical::Role::shell], "liver");
    EXPECT_EQ(roles[medical::Role::portal_vein], "portal vein");
    EXPECT_EQ(roles[medical::Role::artery], "aorta");
    EXPECT_EQ(roles[medical::Role::tumour], "lesion candidate");

    const LabelMap map = read_label_map(shared_case("hcc-tace-048") / "labels.nii.gz");
    EXPECT_NEAR(length(map.grid.origin_mm - volume.grid.origin_mm), 0, 1e-3);
    for (std::size_t i = 0; i < loaded.meshes.size(); ++i)
        if (loaded.manifest.parts[i].role == medical::Role::shell) {
            const double distance = mean_distance_mm(loaded.meshes[i], map, {1, 2, 4});
            std::printf("liver's surface to the label map's border: %.2f mm\n", distance);
            EXPECT_LE(distance, 1.5);
        }
}

TEST(RealCase, ALabelMapBecomesClosedManifoldSurfacesOfItsVolume) {
    THEATRON_REQUIRE_CASE("hcc-tace-048");
    if (sandbox::has_sanitizer)
        GTEST_SKIP() << "takes minutes with a sanitizer";
    const LabelMap map = read_label_map(shared_case("hcc-tace-048") / "labels.nii.gz");
    const std::vector<LabelCount> labels = labels_in(map);
    ASSERT_EQ(labels.size(), 4u);
    for (const LabelCount& label : labels) {
        SurfaceBudget budget;
        const medical::Mesh mesh = surface_of_label(map, label, 60'000, budget);
        const medical::MeshShape shape = medical::shape_of(mesh);
        const double volume = double(label.samples) * sample_volume_mm3(map.grid);
        std::printf("label %d: %zu triangles, volume off by %.2f %%\n", label.value,
                    mesh.triangles.size(), 100 * (shape.volume_mm3 / volume - 1));
        EXPECT_TRUE(shape.closed && shape.manifold) << label.value;
        EXPECT_NEAR(shape.volume_mm3, volume, 0.02 * volume) << label.value;
    }
}

// Compares with the picture that dcmj2pnm (of DCMTK) makes of the same file in the same window.
TEST(RealCase, WindowedSlicesAreThoseOfDcmtk) {
    THEATRON_REQUIRE_CASE("hcc-tace-048");
    if (std::system("command -v dcm2pnm dcmj2pnm >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "no dcmj2pnm: install dcmtk";
    testing::TemporaryFolder folder;
    const fs::path series = shared_case("hcc-tace-048") / "dicom";
    const fs::path target = folder.path() / "case", picture = folder.path() / "slice.png";
    import_case(series, target, {}, no_progress);
    const medical::Volume volume = read_case(target).volumes.at(0);
    const medical::Window window{60, 350};
    const medical::GreyTable greys(window, volume);
    // DCMTK decodes JPEG-LS only with another program first.
    const fs::path raw = folder.path() / "raw.dcm";
    const std::string unpack = "dcmdjpls '" + (series / "00000040.dcm").string() + "' '" +
                               raw.string() + "' && dcmj2pnm +Ww 60 350 +on '" + raw.string() +
                               "' '" + picture.string() + "'";
    ASSERT_EQ(std::system(unpack.c_str()), 0);
    const ColorImage expected = files::read_color_png(picture);
    ASSERT_EQ(expected.size, (Size{512, 512}));
    int best = 255;
    // File names need not be in the order of places.
    for (int k = 0; k < volume.grid.slices && best > 1; ++k) {
        int worst = 0;
        for (std::size_t i = 0; i < 512 * 512 && worst < best; ++i)
            worst = std::max(worst,
                             std::abs(int(greys[volume.samples[std::size_t(k) * 512 * 512 + i]]) -
                                      int(expected.pixels[i].r)));
        best = std::min(best, worst);
    }
    EXPECT_LE(best, 1);
}

TEST(RealCase, AnAtlasInGlbBecomesNamedPartsInPatientCoordinates) {
    if (sandbox::has_sanitizer)
        GTEST_SKIP() << "a sanitizer ends the child in another way";
    THEATRON_REQUIRE_CASE("hra-liver-vhf");
    testing::TemporaryFolder folder;
    const fs::path target = folder.path() / "case";
    import_case(shared_case("hra-liver-vhf"), target, {}, no_progress);
    const LoadedCase loaded = read_case(target);
    EXPECT_EQ(loaded.meshes.size(), 37u);
    for (const medical::Part& part : loaded.manifest.parts) {
        const bool is_region = part.name.find("impression") != std::string::npos;
        EXPECT_TRUE(!is_region || part.opacity < 0.3) << part.name << " would hide the vessels";
    }
    for (std::size_t i = 0; i < loaded.meshes.size(); ++i)
        if (loaded.manifest.parts[i].role == medical::Role::shell) {
            const medical::Box box = medical::box_of(loaded.meshes[i]);
            EXPECT_LT((box.low_mm.x + box.high_mm.x) / 2, 0) << "on the patient's right";
            EXPECT_GT(box.high_mm.x - box.low_mm.x, 100);
            EXPECT_LT(box.high_mm.x - box.low_mm.x, 300);
        }
}

}  // namespace
}  // namespace theatron::cases
