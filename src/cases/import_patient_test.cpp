// SPDX-License-Identifier: Apache-2.0
// An import tells patients apart and keeps what names them from everybody.
#include <gdcmReader.h>
#include <gdcmSequenceOfItems.h>
#include <gdcmWriter.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "cases/case_folder.h"
#include "cases/dicom_writer.h"
#include "cases/import_testing.h"
#include "files/file_bytes.h"

namespace theatron::cases {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

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

// As on a disc of a hospital: an index of its own beside folders of images.
void write_dicomdir(const fs::path& file, const fs::path& any_image) {
    gdcm::Reader reader;
    reader.SetFileName(any_image.c_str());
    ASSERT_TRUE(reader.Read());
    gdcm::DataSet& set = reader.GetFile().GetDataSet();
    const auto text = [](gdcm::Tag tag, gdcm::VR vr, const std::string& value) {
        gdcm::DataElement element(tag);
        element.SetVR(vr);
        element.SetByteValue(value.data(), std::uint32_t(value.size()));
        return element;
    };
    // Media Storage Directory Storage.
    set.Replace(text({0x0008, 0x0016}, gdcm::VR::UI, "1.2.840.10008.1.3.10"));
    reader.GetFile().GetHeader().Replace(
        text({0x0002, 0x0002}, gdcm::VR::UI, "1.2.840.10008.1.3.10"));
    // All that describes pixels.
    while (set.FindNextDataElement({0x0028, 0}).GetTag().GetGroup() == 0x0028)
        set.Remove(set.FindNextDataElement({0x0028, 0}).GetTag());
    set.Remove({0x7fe0, 0x0010});
    gdcm::SmartPointer<gdcm::SequenceOfItems> records = new gdcm::SequenceOfItems;
    records->SetLengthToUndefined();
    for (const char* id : {"4711", "4712"}) {
        gdcm::Item record;
        record.SetVLToUndefined();
        record.GetNestedDataSet().Insert(text({0x0004, 0x1430}, gdcm::VR::CS, "PATIENT "));
        record.GetNestedDataSet().Insert(text({0x0010, 0x0020}, gdcm::VR::LO, id));
        records->AddItem(record);
    }
    gdcm::DataElement sequence(gdcm::Tag(0x0004, 0x1220));
    sequence.SetVR(gdcm::VR::SQ);
    sequence.SetValue(*records);
    sequence.SetVLToUndefined();
    set.Replace(sequence);
    gdcm::Writer writer;
    writer.SetFileName(file.c_str());
    writer.SetFile(reader.GetFile());
    ASSERT_TRUE(writer.Write());
}

TEST_F(Import, ADiscOfTwoPatientsIsRefused) {
    write_series(source() / "IMAGES/P1");
    write_dicomdir(source() / "DICOMDIR", source() / "IMAGES/P1/image0.dcm");
    EXPECT_EQ(import().manifest.series.size(), 1u) << "the index is no image";
    fs::remove_all(target());
    fs::create_directories(source() / "IMAGES/P2");
    DicomSlice other = image(0);
    other.series_uid = "1.2.3.9";
    write_image(source() / "IMAGES/P2/I0000001", other, 9, "Beispiel^Max", "4712");
    const std::string text = refusal();
    EXPECT_THAT(text, HasSubstr("more than one patient"));
    EXPECT_THAT(text, HasSubstr("P1/image0.dcm'"));
    EXPECT_THAT(text, HasSubstr("P2/I0000001'"));
}

TEST_F(Import, FoldersOfTwoPatientsAreRefusedHoweverDeepTheyLie) {
    write_series(source() / "2026/march/Mustermann");
    fs::create_directories(source() / "2026/april/scan");
    DicomSlice other = image(0);
    other.series_uid = "1.2.3.9";
    write_image(source() / "2026/april/scan/1.dcm", other, 9);
    EXPECT_EQ(import().manifest.series.size(), 2u) << "two folders of one patient";
    fs::remove_all(target());
    write_image(source() / "2026/april/scan/1.dcm", other, 9, "Beispiel^Max", "4712");
    EXPECT_THAT(sentence([&] { import(); }), HasSubstr("more than one patient"));
    EXPECT_FALSE(fs::exists(target()));
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

TEST_F(Import, ANumberThatTwoHospitalsGaveIsNotOnePatient) {
    DicomSlice other = image(0);
    other.series_uid = "1.2.3.9";
    const auto write = [&](const char* file, const DicomSlice& slice, const char* name,
                           const char* born) {
        DicomTexts texts = texts_of_image(slice.series_uid == other.series_uid ? 9 : 0, name);
        texts.birth_date = born;
        files::write_file(source() / file, write_dicom(slice, texts));
    };
    fs::create_directories(source());
    write("a.dcm", image(0), "Mustermann^Erika", "19610203");
    write("z.dcm", other, "Beispiel^Erika", "19550101");
    EXPECT_THAT(refusal(), HasSubstr("more than one patient"));
    write("z.dcm", other, "Beispiel^Erika", "19610203");
    EXPECT_EQ(import().manifest.series.size(), 2u) << "she has taken another name";
    fs::remove_all(folder_.path());
    fs::create_directories(source());
    write("a.dcm", image(0), "Mustermann^Erika", "");
    write("z.dcm", other, "Beispiel^Erika", "");
    EXPECT_THAT(refusal(), HasSubstr("more than one patient")) << "a number that many have";
    write("a.dcm", image(0), "", "19610203");
    write("z.dcm", other, "", "19550101");
    EXPECT_THAT(refusal(), HasSubstr("more than one patient"));
    write("a.dcm", image(0), "Mustermann^Erika", "19610203");
    write("z.dcm", other, "Mustermann^Erika", "19610302");
    EXPECT_EQ(import().manifest.series.size(), 2u) << "a date that was written wrongly";
}

TEST_F(Import, NamesOfFilesThatAreLeftOutStayOutOfTextsThatEverybodySees) {
    write_series(source());
    DicomTexts texts = texts_of_image(9, "Beispiel^Otto", "M-778899");
    texts.birth_name = "Vorher^Otto";
    files::write_file(source() / "dose.dcm", picture_in_colour(texts));
    DicomSlice same_place = image(0);  // as another image, so that the series is left out
    same_place.series_uid = "1.2.3.8";
    write_image(source() / "y.dcm", same_place, 7);
    same_place.samples[0] += 1;
    write_image(source() / "z.dcm", same_place, 8, "Mustermann^Erika=\xc4nders^Rike");
    write_cube_stl(source() / "liver_beispiel.stl", -20);
    write_cube_stl(source() / "liver_vorher.stl", -20);
    write_cube_stl(source() / "liver_778899.stl", -20);
    write_cube_stl(source() / "liver_m778899.stl", -20);
    write_cube_stl(source() / "liver_aenders.stl", -20);
    std::vector<std::string> names;
    for (const medical::Part& part : import().manifest.parts)
        names.push_back(part.name);
    EXPECT_THAT(names, ElementsAre("liver 778899", "shell 2", "shell 3", "shell 4", "shell 5"));
}

TEST_F(Import, NamesInSequencesOfAFileStayOutOfTextsThatEverybodySees) {
    write_series(source());
    gdcm::Reader reader;
    reader.SetFileName((source() / "image0.dcm").c_str());
    ASSERT_TRUE(reader.Read());
    gdcm::DataElement number(gdcm::Tag(0x0010, 0x0020));
    number.SetVR(gdcm::VR::LO);
    number.SetByteValue("QX-5501 ", 8);
    gdcm::Item item;
    item.SetVLToUndefined();
    item.GetNestedDataSet().Insert(number);
    gdcm::SmartPointer<gdcm::SequenceOfItems> sequence = new gdcm::SequenceOfItems;
    sequence->SetLengthToUndefined();
    sequence->AddItem(item);
    gdcm::DataElement other_numbers(gdcm::Tag(0x0010, 0x1002));
    other_numbers.SetVR(gdcm::VR::SQ);
    other_numbers.SetValue(*sequence);
    other_numbers.SetVLToUndefined();
    reader.GetFile().GetDataSet().Insert(other_numbers);
    gdcm::Writer writer;
    writer.SetFileName((source() / "image0.dcm").c_str());
    writer.SetFile(reader.GetFile());
    ASSERT_TRUE(writer.Write());
    write_cube_stl(source() / "liver qx5501.stl", -20);
    EXPECT_EQ(import().manifest.parts.at(0).name, "shell 1");
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

}  // namespace
}  // namespace theatron::cases
