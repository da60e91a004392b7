// SPDX-License-Identifier: Apache-2.0
// DICOM images on their way into a case.
#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmImageWriter.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "cases/case_folder.h"
#include "cases/dicom_writer.h"
#include "cases/foreign_files.h"
#include "cases/import_testing.h"
#include "files/file_bytes.h"
#include "files/png_file.h"
#include "medical/window.h"

namespace theatron::cases {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

TEST_F(Import, EveryCompressionGivesTheStoredValues) {
    const DicomSlice original = image(0);
    const fs::path plain = folder_.path() / "plain.dcm";
    for (const bool is_signed : {true, false}) {
        DicomSlice slice = original;
        if (!is_signed)
            for (std::int16_t& sample : slice.samples)
                sample = std::int16_t(sample + 200);
        write_image(plain, slice, 0);
        for (const auto syntax :
             {gdcm::TransferSyntax::RLELossless, gdcm::TransferSyntax::JPEGLosslessProcess14_1,
              gdcm::TransferSyntax::JPEGLSLossless, gdcm::TransferSyntax::JPEG2000Lossless,
              gdcm::TransferSyntax::ImplicitVRLittleEndian}) {
            gdcm::ImageReader reader;
            reader.SetFileName(plain.c_str());
            ASSERT_TRUE(reader.Read());
            gdcm::PixelFormat format = reader.GetImage().GetPixelFormat();
            if (!is_signed) {
                format.SetPixelRepresentation(0);
                reader.GetImage().SetPixelFormat(format);
            }
            gdcm::ImageChangeTransferSyntax change;
            change.SetTransferSyntax(syntax);
            change.SetInput(reader.GetImage());
            ASSERT_TRUE(change.Change()) << gdcm::TransferSyntax::GetTSString(syntax);
            gdcm::ImageWriter writer;
            const fs::path packed = folder_.path() / "packed.dcm";
            writer.SetFileName(packed.c_str());
            writer.SetFile(reader.GetFile());
            writer.SetImage(change.GetOutput());
            ASSERT_TRUE(writer.Write());

            const std::vector<DicomSlice> read = DicomFiles().read(packed);
            ASSERT_EQ(read.size(), 1u) << gdcm::TransferSyntax::GetTSString(syntax);
            EXPECT_EQ(read[0].samples, slice.samples) << gdcm::TransferSyntax::GetTSString(syntax);
            EXPECT_EQ(read[0].position_mm, original.position_mm);
        }
    }
}

TEST_F(Import, Monochrome1IsShownTheOtherWayRound) {
    fs::create_directories(source());
    for (int i = 0; i < 3; ++i) {
        DicomSlice slice = image(i);
        slice.inverted = true;
        write_image(source() / (std::to_string(i) + ".dcm"), slice, i);
    }
    import();
    const LoadedCase loaded = read_case(target());
    EXPECT_TRUE(loaded.volumes.at(0).inverted);
    EXPECT_EQ(loaded.volumes[0].samples[5], image(0).samples[5]);
}

// Compares with the pictures that dcmj2pnm (of DCMTK) makes of the same files in the same window.
TEST_F(Import, GreysOfBothPhotometricInterpretationsAreThoseOfDcmtk) {
    if (std::system("command -v dcmj2pnm >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "no dcmj2pnm: install dcmtk";
    const fs::path picture = folder_.path() / "slice.png";
    for (const bool inverted : {false, true}) {
        fs::remove_all(source());
        fs::remove_all(target());
        fs::create_directories(source());
        for (int i = 0; i < 3; ++i) {
            DicomSlice slice = image(i);
            slice.inverted = inverted;
            write_image(source() / (std::to_string(i) + ".dcm"), slice, i);
        }
        import();
        const medical::Volume volume = read_case(target()).volumes.at(0);
        const medical::GreyTable greys({60, 350}, volume);
        const std::string draw = "dcmj2pnm +Ww 60 350 +on '" + (source() / "1.dcm").string() +
                                 "' '" + picture.string() + "'";
        ASSERT_EQ(std::system(draw.c_str()), 0);
        const ColorImage expected = files::read_color_png(picture);
        ASSERT_EQ(expected.size, (Size{40, 30}));
        for (std::size_t i = 0; i < 1200; ++i)
            ASSERT_NEAR(int(greys[volume.samples[1200 + i]]), int(expected.pixels[i].r), 1)
                << (inverted ? "MONOCHROME1" : "MONOCHROME2");
    }
}

TEST_F(Import, MissingSlicesAreReported) {
    write_series(source(), 8);
    fs::remove(source() / "image3.dcm");
    const auto remarks = import().remarks;
    EXPECT_THAT(remarks, ElementsAre(HasSubstr("lacks 1 of 8 slices")));
    EXPECT_THAT(remarks, ElementsAre(HasSubstr("image0.dcm'")));
    EXPECT_THAT(read_manifest(target()).series.at(0).missing_slices, ElementsAre(3));
}

TEST_F(Import, AScoutBesideASeriesIsLeftOut) {
    write_series(source());
    DicomSlice turned = image(7);
    turned.right = {0, 1, 0};
    turned.down = {0, 0, -1};
    write_image(source() / "turned.dcm", turned, 7);
    const ImportReport report = import();
    EXPECT_THAT(report.remarks, ElementsAre(AllOf(HasSubstr("1 image of the series with another"),
                                                  HasSubstr("image0.dcm'"))));
    EXPECT_EQ(report.manifest.series.size(), 1u);
    EXPECT_EQ(read_case(target()).volumes.at(0).grid.slices, 5);
}

TEST_F(Import, PicturesInColourBesideASeriesAreLeftOut) {
    write_series(source());
    files::write_file(source() / "dose.dcm", picture_in_colour());
    const ImportReport report = import();
    EXPECT_EQ(report.manifest.series.size(), 1u);
    EXPECT_THAT(report.remarks,
                ElementsAre(HasSubstr("dose.dcm' is left out: it is a picture in colour")));
    fs::remove_all(target());
    fs::remove_all(source());
    fs::create_directories(source());
    files::write_file(source() / "dose.dcm", picture_in_colour());
    EXPECT_THAT(refusal(), HasSubstr("dose.dcm' is left out: it is a picture in colour"));
}

TEST_F(Import, AnImageOfColoursInATableIsLeftOutAlsoWithoutItsTable) {
    write_series(source());
    DicomSlice slice = image(9);
    slice.series_uid = "1.2.3.9";
    Bytes bytes = write_dicom(slice, texts_of_image(9));
    constexpr std::string_view grey = "MONOCHROME2 ", palette = "PALETTE COLOR ";
    const auto at =
        std::search(bytes.begin(), bytes.end(), as_bytes(grey).begin(), as_bytes(grey).end());
    store_le(&*at - 2, std::uint16_t(palette.size()));
    bytes.insert(bytes.erase(at, at + long(grey.size())), as_bytes(palette).begin(),
                 as_bytes(palette).end());
    files::write_file(source() / "colours.dcm", bytes);
    const ImportReport report = import();
    EXPECT_EQ(report.manifest.series.size(), 1u);
    EXPECT_THAT(report.remarks,
                ElementsAre(HasSubstr("colours.dcm' is left out: it is a picture")));
}

TEST_F(Import, ImagesThatAreThereTwiceAreTakenOnce) {
    write_series(source());
    fs::copy(source(), source() / "copy");
    fs::remove(source() / "copy" / "image1.dcm");
    const ImportReport report = import();
    EXPECT_THAT(report.remarks, ElementsAre(HasSubstr("4 images are in the series twice")));
    EXPECT_EQ(read_case(target()).volumes.at(0).grid.slices, 5);
}

TEST_F(Import, SeriesOfTwoFramesOfReferenceAreRemarkedOn) {
    write_series(source());
    DicomSlice other = image(0);
    other.series_uid = "1.2.3.9";
    other.frame_uid = "1.2.3.10";
    write_image(source() / "z.dcm", other, 9);
    EXPECT_THAT(import().remarks, ElementsAre(HasSubstr("another frame of reference than CT:")));
}

TEST_F(Import, AnImageWithFewerPixelsThanItSaysIsNamed) {
    write_series(source());
    Bytes bytes = files::read_file(source() / "image2.dcm");
    const std::size_t pixels = 2 * 40 * 30;
    store_le(bytes.data() + bytes.size() - pixels - 4, std::uint32_t(100));
    bytes.resize(bytes.size() - pixels + 100);
    files::write_file(source() / "image2.dcm", bytes);
    EXPECT_THAT(refusal(), HasSubstr("image2.dcm' is cut off before its pixels end"));
}

TEST_F(Import, AnImageWhoseValuesMeanNothingIsNamed) {
    fs::create_directories(source());
    DicomSlice slice = image(0);
    slice.slope = 0;
    write_image(source() / "flat.dcm", slice, 0);
    EXPECT_THAT(refusal(), HasSubstr("flat.dcm' has a rescale slope of 0"));
    std::ofstream(source() / "flat.dcm") << "hello";
    EXPECT_THAT(refusal(), HasSubstr("flat.dcm' is left out: it is too short for a DICOM file"));
    std::ofstream(source() / "flat.dcm", std::ios::trunc).close();
    EXPECT_THAT(refusal(), HasSubstr("flat.dcm' is left out: it is empty; copy it again"));
}

TEST_F(Import, ATruncatedImageIsNamed) {
    write_series(source());
    const std::uintmax_t size = fs::file_size(source() / "image2.dcm");
    for (const std::uintmax_t kept :
         {size - 1, size - 1000, std::uintmax_t(700), std::uintmax_t(400), std::uintmax_t(140)}) {
        write_image(source() / "image2.dcm", image(2), 2);
        fs::resize_file(source() / "image2.dcm", kept);
        EXPECT_THAT(refusal(), HasSubstr("image2.dcm' is cut off")) << kept << " bytes";
    }
}

TEST_F(Import, BytesThatAreNoImageAreNamed) {
    fs::create_directories(source());
    std::ofstream(source() / "noise.dcm") << std::string(5000, 'x');
    EXPECT_THAT(refusal(), HasSubstr("noise.dcm' is left out: it is no DICOM file"));
    fs::remove(source() / "noise.dcm");
    std::ofstream(source() / "notes.txt") << "nothing to import";
    EXPECT_THAT(refusal(), AllOf(HasSubstr("holds neither DICOM images nor surfaces"),
                                 HasSubstr("notes.txt'")));
}

}  // namespace
}  // namespace theatron::cases
