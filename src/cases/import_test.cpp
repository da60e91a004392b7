// SPDX-License-Identifier: Apache-2.0
// Foreign files from one end to the other: through their readers in a process of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "cases/case_folder.h"
#include "cases/import_testing.h"
#include "files/file_bytes.h"
#include "medical/mesh_measures.h"

namespace theatron::cases {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
namespace fs = std::filesystem;

TEST_F(Import, ImagesAndSurfacesBecomeACaseWithoutTheirIdentifiers) {
    write_series(source() / "ct");
    write_cube_stl(source() / "Liver_Mustermann.stl", -20);
    const ImportReport report = import();
    EXPECT_THAT(report.remarks, ElementsAre(HasSubstr("name had the patient's in it")));
    EXPECT_THAT(check_case(target()).problems, IsEmpty());

    const LoadedCase loaded = read_case(target());
    ASSERT_EQ(loaded.volumes.size(), 1u);
    EXPECT_EQ(loaded.volumes[0].grid.slices, 5);
    EXPECT_EQ(loaded.volumes[0].window, (medical::Window{40, 400}));
    for (int k = 0; k < 5; ++k)
        for (int i = 0; i < 1200; ++i)
            ASSERT_EQ(loaded.volumes[0].samples[std::size_t(k * 1200 + i)],
                      image(k).samples[std::size_t(i)]);
    ASSERT_EQ(loaded.meshes.size(), 1u);
    EXPECT_EQ(loaded.meshes[0].positions.size(), 8u);
    EXPECT_NEAR(medical::shape_of(loaded.meshes[0]).volume_mm3, 64000, 1);
    EXPECT_EQ(loaded.manifest.parts[0].role, medical::Role::shell);
    EXPECT_FALSE(loaded.manifest.deidentified);

    // Texts that identify the patient are in one file, for this user alone, and nowhere else.
    for (const auto& entry : fs::directory_iterator(target())) {
        const Bytes bytes = files::read_file(entry.path());
        const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        if (entry.path().filename() == identifiers_name) {
            EXPECT_THAT(text, HasSubstr("Mustermann^Erika"));
            EXPECT_EQ(fs::status(entry.path()).permissions(), fs::perms(0600));
        } else {
            EXPECT_THAT(text, AllOf(Not(HasSubstr("Mustermann")), Not(HasSubstr("4711")),
                                    Not(HasSubstr("1.2.3.4"))))
                << entry.path();
        }
    }
}

TEST_F(Import, APartThatLiesBesideAllImagesIsRemarkedOn) {
    write_series(source());
    write_cube_stl(source() / "liver.stl", -20);
    write_cube_stl(source() / "spleen.stl", 500);
    EXPECT_THAT(import().remarks,
                ElementsAre(HasSubstr("'spleen' lies outside of all images; check")));
    EXPECT_THAT(check_case(target()).problems, ElementsAre(HasSubstr("'spleen' lies outside")));
}

TEST_F(Import, LinksAreFollowedWhereTheyAreTheSourceOnly) {
    write_cube_stl(folder_.path() / "cube.stl", 0);
    fs::create_directories(source());
    fs::create_symlink(folder_.path() / "cube.stl", source() / "linked.stl");
    EXPECT_THAT(refusal(), HasSubstr("links in it are not followed"));
    write_series(source());
    EXPECT_THAT(import().remarks, ElementsAre(HasSubstr("Links in the source are not followed")));
    fs::remove_all(target());
    EXPECT_EQ(import_case(source() / "linked.stl", target(), {}, no_progress).manifest.parts.size(),
              1u);
}

TEST_F(Import, ASourcesManifestNamesPartsUnitsAndAxes) {
    fs::create_directories(source());
    write_cube_stl(source() / "a.stl", 1);
    std::ofstream(source() / "case.json") << R"({"theatron_case": 1, "name": "Cube", "units": "cm",
      "space": "RAS", "deidentified": true, "license": "CC0", "credit": "", "series": [], "parts": [
      {"name": "growth", "role": "tumour", "file": "a.stl", "color": "#112233", "opacity": 0.5}]})";
    import();
    const LoadedCase loaded = read_case(target());
    EXPECT_EQ(loaded.manifest.name, "Cube");
    EXPECT_TRUE(loaded.manifest.deidentified);
    EXPECT_EQ(loaded.manifest.parts.at(0).role, medical::Role::tumour);
    EXPECT_EQ(loaded.manifest.parts[0].color, (Rgb{0x11, 0x22, 0x33}));
    EXPECT_NEAR(medical::box_of(loaded.meshes.at(0)).low_mm.x, -410, 1e-3);
}

TEST_F(Import, AFinishedCaseIsToldFromOtherFolders) {
    write_series(source());
    import();
    EXPECT_THAT(sentence([&] { import_case(target(), folder_.path() / "again", {}, no_progress); }),
                HasSubstr("case' is a finished case already"));
}

TEST_F(Import, AnEmptyLabelMapIsNamed) {
    fs::create_directories(source());
    std::ofstream(source() / "empty.nrrd", std::ios::binary)
        << "NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 2 2\n"
           "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: raw\n\n"
        << std::string(8, '\0');
    EXPECT_THAT(refusal(),
                HasSubstr("empty.nrrd' is left out: it marks nothing: there are no labels but 0"));
}

TEST_F(Import, AFolderThatIsThereStaysAsItIs) {
    write_series(source());
    fs::create_directories(target());
    std::ofstream(target() / "mine") << "x";
    EXPECT_THAT(sentence([&] { import(); }), HasSubstr("is there already"));
    EXPECT_TRUE(fs::exists(target() / "mine"));
}

}  // namespace
}  // namespace theatron::cases
