// SPDX-License-Identifier: Apache-2.0
#include "cases/case_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "files/file_bytes.h"
#include "testing/temporary_folder.h"

namespace theatron::cases {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
namespace fs = std::filesystem;

medical::Mesh tetrahedron() {
    medical::Mesh mesh;
    mesh.positions = {{0, 0, 0}, {60, 0, 0}, {0, 60, 0}, {0, 0, 60}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    medical::compute_normals(mesh);
    return mesh;
}

medical::Volume cube() {
    medical::Volume volume;
    volume.grid = {8, 8, 8, {0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0, 0, 8}};
    volume.samples.resize(volume.grid.size());
    return volume;
}

// A whole case that a test damages.
class CaseFolder : public ::testing::Test {
protected:
    CaseFolder() {
        manifest_.name = "test";
        manifest_.deidentified = true;
        manifest_.license = "CC0";
        manifest_.parts = {{"liver", medical::Role::shell, "liver.thmesh", {1, 2, 3}, 0.4}};
        manifest_.series = {{"CT", "CT", "ct.thvolume", {}}};
        write();
        files::write_file(folder() / "liver.thmesh", medical::encode_mesh(tetrahedron()));
        files::write_file(folder() / "ct.thvolume", medical::encode_volume(cube()));
    }
    const fs::path& folder() const { return folder_.path(); }
    void write() { files::write_file(folder() / "case.json", as_bytes(manifest_text(manifest_))); }

    std::string first_problem() {
        const CheckReport report = check_case(folder());
        EXPECT_THROW(read_case(folder()), Error);
        return report.problems.empty() ? "" : report.problems[0];
    }

    medical::Case manifest_;
    testing::TemporaryFolder folder_;
};

TEST_F(CaseFolder, AWholeCaseIsReadWithoutProblems) {
    const CheckReport report = check_case(folder());
    EXPECT_THAT(report.problems, IsEmpty());
    EXPECT_THAT(report.remarks, IsEmpty());
    const LoadedCase loaded = read_case(folder());
    EXPECT_EQ(loaded.manifest, manifest_);
    EXPECT_EQ(loaded.meshes.at(0), tetrahedron());
    EXPECT_EQ(loaded.volumes.at(0).samples.size(), 512u);
}

TEST_F(CaseFolder, AMissingMeshIsNamed) {
    fs::remove(folder() / "liver.thmesh");
    EXPECT_THAT(first_problem(), HasSubstr("lacks the file 'liver.thmesh'"));
}

TEST_F(CaseFolder, ATruncatedVolumeIsNamed) {
    fs::resize_file(folder() / "ct.thvolume", 500);
    EXPECT_THAT(first_problem(), HasSubstr("ct.thvolume' is truncated"));
}

TEST_F(CaseFolder, AMeshOfAnotherFormatIsToBeImported) {
    manifest_.parts[0].file = "liver.stl";
    write();
    std::ofstream(folder() / "liver.stl") << "solid";
    EXPECT_THAT(first_problem(), HasSubstr("make one with 'theatron case import"));
}

TEST_F(CaseFolder, ANewerManifestIsRefused) {
    std::ofstream(folder() / "case.json") << R"({"theatron_case": 3, "organs": {}})";
    EXPECT_THAT(first_problem(), HasSubstr("a newer version of Theatron"));
}

TEST_F(CaseFolder, LinksAreNotFollowed) {
    fs::remove(folder() / "liver.thmesh");
    fs::create_symlink("/etc/passwd", folder() / "liver.thmesh");
    EXPECT_THAT(first_problem(), HasSubstr("is not a regular file"));
}

TEST_F(CaseFolder, IdentifiersThatOthersCanReadAreAProblem) {
    std::ofstream(folder() / "identifiers.json") << R"({"series": []})";
    fs::permissions(folder() / "identifiers.json", fs::perms(0644));
    EXPECT_THAT(check_case(folder()).problems, ElementsAre(HasSubstr("chmod 600")));
    fs::permissions(folder() / "identifiers.json", fs::perms(0600));
    EXPECT_THAT(check_case(folder()).problems, IsEmpty());
}

TEST_F(CaseFolder, IdentifiersThatAreDamagedAreAProblem) {
    std::ofstream(folder() / "identifiers.json") << R"({"series": [{"PatientName": "Doe^)";
    fs::permissions(folder() / "identifiers.json", fs::perms(0600));
    EXPECT_THAT(
        check_case(folder()).problems,
        ElementsAre(AllOf(HasSubstr("identifiers.json' is not what"), Not(HasSubstr("Doe")))));
}

TEST_F(CaseFolder, PartsThatLieBesideTheImagesAreAProblem) {
    medical::Mesh far = tetrahedron();
    for (medical::Vec3f& p : far.positions)
        p.z += 500;
    files::write_file(folder() / "liver.thmesh", medical::encode_mesh(far));
    EXPECT_THAT(check_case(folder()).problems, ElementsAre(HasSubstr("outside of all images")));
}

TEST_F(CaseFolder, WhatIsUnusualIsRemarked) {
    medical::Mesh open = tetrahedron();
    open.triangles.pop_back();
    files::write_file(folder() / "liver.thmesh", medical::encode_mesh(open));
    manifest_.deidentified = false;
    manifest_.series[0].missing_slices = {3};
    write();
    std::ofstream(folder() / "notes.txt") << "x";
    EXPECT_THAT(check_case(folder()).remarks,
                ElementsAre(HasSubstr("not said to be de-identified"), HasSubstr("lacks 1 of 8"),
                            HasSubstr("is not closed"), HasSubstr("1 file that")));
}

}  // namespace
}  // namespace theatron::cases
