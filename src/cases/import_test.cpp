// SPDX-License-Identifier: Apache-2.0
// Foreign files from one end to the other: through their readers in a process of its own.
#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmImageWriter.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "base/error.h"
#include "cases/case_folder.h"
#include "cases/dicom_writer.h"
#include "cases/foreign_files.h"
#include "cases/import_case.h"
#include "files/file_bytes.h"
#include "files/png_file.h"
#include "medical/mesh_measures.h"
#include "medical/window.h"
#include "sandbox/filter.h"
#include "testing/temporary_folder.h"

namespace theatron::cases {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
namespace fs = std::filesystem;

constexpr auto no_progress = [](std::string_view, double) {};

template <class Action>
std::string sentence(Action action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing was thrown";
}

DicomSlice image(int number) {
    DicomSlice slice;
    slice.series_uid = "1.2.3.4";
    slice.frame_uid = "1.2.3.5";
    slice.modality = "CT";
    slice.columns = 40;
    slice.rows = 30;
    slice.right = {1, 0, 0};
    slice.down = {0, 1, 0};
    slice.position_mm = {-20, -15, 2.5 * number};
    slice.has_place = true;
    slice.intercept = -1024;
    slice.has_window = true;
    slice.window = {40, 400};
    for (int i = 0; i < 40 * 30; ++i)
        slice.samples.push_back(std::int16_t((i * 37 + number * 101) % 3000 - 200));
    return slice;
}

void write_image(const fs::path& file, const DicomSlice& slice, int number,
                 const std::string& name = "Mustermann^Erika", const std::string& id = "4711") {
    DicomTexts texts;
    texts.instance_uid = "1.2.3.4.5." + std::to_string(number);
    texts.study_uid = "1.2.3";
    texts.patient_name = name;
    texts.patient_id = id;
    texts.instance = number;
    files::write_file(file, write_dicom(slice, texts));
}

void write_series(const fs::path& folder, int count = 5) {
    fs::create_directories(folder);
    for (int i = 0; i < count; ++i)
        write_image(folder / ("image" + std::to_string(i) + ".dcm"), image(i), i);
}

// A cube of 40 mm as a text, with a corner at `low`.
void write_cube_stl(const fs::path& file, double low) {
    std::ofstream out(file);
    out << "solid cube\n";
    const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& q : quads)
        for (const auto& t : {std::array{q[0], q[1], q[2]}, std::array{q[0], q[2], q[3]}}) {
            out << "facet normal 0 0 0\nouter loop\n";
            for (const int corner : t)
                out << "vertex " << low + 40 * (corner & 1) << ' ' << low + 40 * (corner >> 1 & 1)
                    << ' ' << low + 40 * (corner >> 2 & 1) << '\n';
            out << "endloop\nendfacet\n";
        }
    out << "endsolid\n";
}

class Import : public ::testing::Test {
protected:
    fs::path source() const { return folder_.path() / "source"; }
    fs::path target() const { return folder_.path() / "case"; }
    ImportReport import(const ImportOptions& options = {}) {
        return import_case(source(), target(), options, no_progress);
    }
    std::string refusal(const ImportOptions& options = {}) {
        const std::string text = sentence([&] { import(options); });
        EXPECT_FALSE(fs::exists(target())) << "nothing half made stays";
        EXPECT_THAT(text, Not(HasSubstr("Mustermann")));
        return text;
    }

    testing::TemporaryFolder folder_;
};

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

            const std::optional<DicomSlice> read = DicomFiles().read(packed);
            ASSERT_TRUE(read) << gdcm::TransferSyntax::GetTSString(syntax);
            EXPECT_EQ(read->samples, slice.samples) << gdcm::TransferSyntax::GetTSString(syntax);
            EXPECT_EQ(read->position_mm, original.position_mm);
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

TEST_F(Import, MixedOrientationsAreRefused) {
    write_series(source());
    DicomSlice turned = image(7);
    turned.right = {0, 1, 0};
    turned.down = {0, 0, -1};
    write_image(source() / "turned.dcm", turned, 7);
    const std::string text = refusal();
    EXPECT_THAT(text, HasSubstr("mixed orientations"));
    EXPECT_THAT(text, HasSubstr("image0.dcm'"));
}

TEST_F(Import, ImagesOfTwoPatientsAreRefused) {
    write_series(source());
    write_image(source() / "image2.dcm", image(2), 2, "Mustermann^Erika", "4712");
    const std::string text = refusal();
    EXPECT_THAT(text, HasSubstr("more than one patient"));
    EXPECT_THAT(text, HasSubstr("image0.dcm'"));
    EXPECT_THAT(text, HasSubstr("image2.dcm'"));
    DicomSlice other = image(0);
    other.series_uid = "1.2.3.9";
    write_image(source() / "image2.dcm", image(2), 2);
    write_image(source() / "z.dcm", other, 9, "Beispiel^Max", "");
    EXPECT_THAT(refusal(), HasSubstr("more than one patient"));
    write_image(source() / "z.dcm", other, 9, "MUSTERMANN^ERIKA", "");
    EXPECT_EQ(import().manifest.series.size(), 2u) << "the same, as another program writes it";
}

TEST_F(Import, APatientIsOneHoweverProgramsWriteTheName) {
    DicomSlice other = image(0);
    other.series_uid = "1.2.3.9";
    const auto series_of = [&](const std::string& name, const std::string& as) {
        fs::remove_all(folder_.path());
        fs::create_directories(source());
        write_image(source() / "a.dcm", image(0), 0, name, "");
        write_image(source() / "z.dcm", other, 9, as, "");
        return import().manifest.series.size();
    };
    for (const char* as : {"M\xdcLLER^ANNA", "MUELLER^ANNA", "Muller Anna", "Mueller, Anna^^^",
                           "M\xfcller^Anna=\xa4^\xa4", ""})
        EXPECT_EQ(series_of("M\xfcller^Anna", as), 2u) << as;
    for (const char* as : {"M\xfcller^Hanna", "Miller^Anna", "Moeller^Anna"})
        EXPECT_THAT(sentence([&] { series_of("M\xfcller^Anna", as); }),
                    HasSubstr("more than one patient"))
            << as;
}

// The bytes of a picture of a dose report, as scanners put it beside the series.
Bytes picture_in_colour() {
    DicomSlice slice = image(0);
    slice.series_uid = "1.2.3.9";
    slice.rows = 3;
    slice.columns = 20;
    slice.samples.resize(60);
    DicomTexts texts;
    texts.instance_uid = "1.2.3.4.5.9";
    Bytes bytes = write_dicom(slice, texts);
    // 2 rows of 20 pixels, each 3 bytes.
    const auto set = [&](std::uint16_t element, std::uint16_t value) {
        std::byte tag[] = {std::byte(0x28), std::byte(0),   std::byte(0),
                           std::byte(0),    std::byte('U'), std::byte('S')};
        store_le(tag + 2, element);
        const auto at = std::search(bytes.begin(), bytes.end(), std::begin(tag), std::end(tag));
        store_le(&*at + 8, value);
    };
    set(0x02, 3);
    set(0x10, 2);
    set(0x100, 8);
    set(0x101, 8);
    set(0x102, 7);
    set(0x103, 0);
    constexpr std::string_view grey = "MONOCHROME2 ", color = "RGB         ";
    const auto at =
        std::search(bytes.begin(), bytes.end(), as_bytes(grey).begin(), as_bytes(grey).end());
    std::copy(as_bytes(color).begin(), as_bytes(color).end(), at);
    return bytes;
}

TEST_F(Import, PicturesInColourBesideASeriesAreLeftOut) {
    write_series(source());
    files::write_file(source() / "dose.dcm", picture_in_colour());
    const ImportReport report = import();
    EXPECT_EQ(report.manifest.series.size(), 1u);
    EXPECT_THAT(report.remarks, ElementsAre(AllOf(HasSubstr("1 DICOM file is no slice"),
                                                  HasSubstr("dose.dcm' is a picture in colour"))));
    fs::remove_all(target());
    fs::remove_all(source());
    fs::create_directories(source());
    files::write_file(source() / "dose.dcm", picture_in_colour());
    EXPECT_THAT(refusal(), HasSubstr("dose.dcm' is a picture in colour"));
}

TEST_F(Import, ImagesThatAreThereTwiceAreTakenOnce) {
    write_series(source());
    fs::copy(source(), source() / "copy");
    fs::remove(source() / "copy" / "image1.dcm");
    const ImportReport report = import();
    EXPECT_THAT(report.remarks, ElementsAre(HasSubstr("4 images are in the series twice")));
    EXPECT_EQ(read_case(target()).volumes.at(0).grid.slices, 5);
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

TEST_F(Import, SeriesOfTwoFramesOfReferenceAreRemarkedOn) {
    write_series(source());
    DicomSlice other = image(0);
    other.series_uid = "1.2.3.9";
    other.frame_uid = "1.2.3.10";
    write_image(source() / "z.dcm", other, 9);
    EXPECT_THAT(import().remarks, ElementsAre(HasSubstr("another frame of reference than CT:")));
}

TEST_F(Import, ANameInLatin1StaysOutOfTextsThatEverybodySees) {
    fs::create_directories(source());
    for (int i = 0; i < 3; ++i)
        write_image(source() / (std::to_string(i) + ".dcm"), image(i), i, "M\xfcller^J\xf6rg",
                    "0815");
    write_cube_stl(source() / "mueller_liver.stl", 0);
    std::ofstream(source() / "case.json")
        << R"({"theatron_case": 1, "name": "Jörg M.", "units": "mm",
      "space": "LPS", "deidentified": true, "license": "CC0", "credit": "for Müller", "series": [], "parts": []})";
    ImportOptions options;
    options.name = "Joerg";
    EXPECT_THAT(refusal(options), HasSubstr("--name has a name or number of the patient"));
    const medical::Case made = import().manifest;
    EXPECT_EQ(made.name, "case");
    EXPECT_EQ(made.credit, "");
    EXPECT_EQ(made.license, "CC0");
    EXPECT_EQ(made.parts.at(0).name, "shell 1");
    const Bytes bytes = files::read_file(target() / identifiers_name);
    EXPECT_THAT(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
                HasSubstr("Müller^Jörg"));
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
    EXPECT_THAT(refusal(), HasSubstr("flat.dcm' is too short for a DICOM file"));
}

TEST_F(Import, ATruncatedImageIsNamed) {
    if (sandbox::has_sanitizer)
        GTEST_SKIP() << "a sanitizer ends the child in another way";
    write_series(source());
    const std::uintmax_t size = fs::file_size(source() / "image2.dcm");
    for (const std::uintmax_t kept :
         {size - 1, size - 1000, std::uintmax_t(700), std::uintmax_t(400), std::uintmax_t(140)}) {
        write_image(source() / "image2.dcm", image(2), 2);
        fs::resize_file(source() / "image2.dcm", kept);
        // The library ends its process at some places; then the sentence is about that.
        EXPECT_THAT(refusal(), AnyOf(HasSubstr("image2.dcm' is cut off"),
                                     HasSubstr("image2.dcm' made its reader crash")))
            << kept << " bytes";
    }
}

TEST_F(Import, BytesThatAreNoImageAreNamed) {
    if (sandbox::has_sanitizer)
        GTEST_SKIP() << "a sanitizer ends the child in another way";
    fs::create_directories(source());
    std::ofstream(source() / "noise.dcm") << std::string(5000, 'x');
    EXPECT_THAT(refusal(), HasSubstr("noise.dcm' is damaged"));
    fs::remove(source() / "noise.dcm");
    std::ofstream(source() / "notes.txt") << "nothing to import";
    EXPECT_THAT(refusal(), HasSubstr("holds neither DICOM images nor surfaces"));
}

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
    if (sandbox::has_sanitizer)
        GTEST_SKIP() << "a sanitizer ends the child in another way";
    fs::create_directories(source());
    // Binary STL: 80 bytes, then how many triangles follow.
    std::string lie(84 + 50, '\0');
    std::memcpy(&lie[80], "\xff\xff\xff\x3f", 4);
    std::ofstream(source() / "lie.stl") << lie;
    EXPECT_THAT(refusal(), HasSubstr("lie.stl"));
    fs::remove(source() / "lie.stl");
    std::ofstream(source() / "lie.ply")
        << "ply\nformat ascii 1.0\nelement vertex 2000000000\nproperty float x\nend_header\n";
    EXPECT_THAT(refusal(), HasSubstr("lie.ply' announces more than it has bytes for"));
    fs::remove(source() / "lie.ply");
    std::ofstream(source() / "noise.glb") << "glTF" << std::string(1000, '\xff');
    EXPECT_THAT(refusal(), HasSubstr("noise.glb' is damaged"));
}

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
    EXPECT_THAT(refusal(), HasSubstr("x.jpg' is damaged or neither PNG nor JPEG"));
    files::write_file(source() / "x.jpg", Bytes(1 << 16, std::byte(0xff)));
    EXPECT_THAT(refusal(), HasSubstr("x.jpg' is damaged or neither PNG nor JPEG"));
    fs::resize_file(source() / "x.jpg", 200 << 20);
    EXPECT_THAT(refusal(), HasSubstr("at most 128 MiB are read; save it with fewer pixels"));
    fs::remove(source() / "x.jpg");
    for (int i = 0; i < 65; ++i)
        files::write_png(source() / (std::to_string(i) + ".png"), ColorImage({1, 1}).view());
    EXPECT_THAT(refusal(), HasSubstr("65 pictures (PNG, JPEG), and a case has at most 64"));
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
    EXPECT_THAT(refusal(), HasSubstr("empty.nrrd' has no labels but 0"));
}

TEST_F(Import, AFolderThatIsThereStaysAsItIs) {
    write_series(source());
    fs::create_directories(target());
    std::ofstream(target() / "mine") << "x";
    EXPECT_THAT(sentence([&] { import(); }), HasSubstr("is there already"));
    EXPECT_TRUE(fs::exists(target() / "mine"));
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
