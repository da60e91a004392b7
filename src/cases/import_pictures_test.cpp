// SPDX-License-Identifier: Apache-2.0
// Pictures on their way into a case.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "cases/case_folder.h"
#include "cases/import_testing.h"
#include "files/file_bytes.h"
#include "files/png_file.h"

namespace theatron::cases {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

TEST_F(Import, PicturesBecomePartOfTheCaseWithoutTheirFiles) {
    write_series(source() / "ct");
    ColorImage picture({30, 20});
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        picture.pixels[i] = {std::uint8_t(i), std::uint8_t(i / 3), 9};
    files::write_png(source() / "b_plan.png", picture.view());
    files::write_png(source() / "a Mustermann.PNG", picture.view());
    const ImportReport report = import();
    EXPECT_THAT(report.remarks, ElementsAre(HasSubstr("look for names and dates in the pixels"),
                                            HasSubstr("became 'picture 1'")));
    EXPECT_THAT(check_case(target()).problems, IsEmpty());
    const LoadedCase loaded = read_case(target());
    ASSERT_EQ(loaded.pictures.size(), 2u);
    EXPECT_EQ(loaded.manifest.pictures[0].name, "picture 1");
    EXPECT_EQ(loaded.manifest.pictures[1].name, "b plan");
    EXPECT_EQ(loaded.pictures[1], picture);
    fs::resize_file(target() / "picture_2.thpicture", 50);
    EXPECT_THAT(check_case(target()).problems,
                ElementsAre(HasSubstr("picture_2.thpicture' is truncated")));
    fs::remove(target() / "picture_1.thpicture");
    EXPECT_THAT(check_case(target()).problems,
                ElementsAre(HasSubstr("lacks the file 'picture_1.thpicture'"), HasSubstr("is")));
}

TEST_F(Import, PicturesAloneAreACaseAndCanBeLeftOut) {
    fs::create_directories(source());
    files::write_png(source() / "wound.png", ColorImage({8, 8}).view());
    EXPECT_THAT(refusal({.without_pictures = true}), HasSubstr("neither images nor surfaces"));
    EXPECT_EQ(import().manifest.pictures.size(), 1u);
    EXPECT_THAT(check_case(target()).problems, IsEmpty());
}

TEST_F(Import, APictureThatIsDamagedOrNoneIsNamed) {
    fs::create_directories(source());
    std::ofstream(source() / "x.jpg") << "GIF89a";
    EXPECT_THAT(refusal(), HasSubstr("x.jpg' is left out: it is neither PNG nor JPEG"));
    Bytes damaged(1 << 16);
    damaged[0] = damaged[2] = std::byte(0xff);
    damaged[1] = std::byte(0xd8);  // as JPEG begins
    damaged[3] = std::byte(0xe0);
    files::write_file(source() / "x.jpg", damaged);
    EXPECT_THAT(refusal(), HasSubstr("x.jpg' is left out: it is damaged"));
    fs::resize_file(source() / "x.jpg", 200 << 20);
    EXPECT_THAT(refusal(), HasSubstr("at most 128 MiB are read; save it with fewer pixels"));
    fs::remove(source() / "x.jpg");
    for (int i = 0; i < 65; ++i)
        files::write_png(source() / (std::to_string(i) + ".png"), ColorImage({1, 1}).view());
    EXPECT_THAT(refusal(), HasSubstr("65 pictures (PNG, JPEG), and a case has at most 64"));
}

}  // namespace
}  // namespace theatron::cases
