// SPDX-License-Identifier: Apache-2.0
#include "cases/patient_words.h"

#include <gtest/gtest.h>

#include "cases/dicom_text.h"

namespace theatron::cases {
namespace {

PatientWords words_of(std::vector<Identifier> identifiers) {
    PatientWords words;
    for (const Identifier& identifier : identifiers)
        words.add(identifier);
    return words;
}

TEST(PatientWords, AreFoundHoweverTheyAreWritten) {
    const PatientWords words =
        words_of({{"PatientName", "Müller-Lüdtke^Jörg^Hans"}, {"PatientBirthDate", "19610203"}});
    for (const char* text :
         {"müller leber", "Müller", "Mueller", "MULLER_liver", "muellerjoerg", "Leber Jörg",
          "Luedtke", "mu\xcc\x88ller", "liver 19610203", "03.02.1961", "tumour_610203", "hans2"})
        EXPECT_TRUE(words.occur_in(text)) << text;
    for (const char* text : {"liver", "portal vein", "Segment 5", "label 19", "", "Mülle", "ü"})
        EXPECT_FALSE(words.occur_in(text)) << text;
}

TEST(PatientWords, NumbersCountWholeWithAnySeparators) {
    const PatientWords words =
        words_of({{"PatientID", "AB-4711"}, {"OtherPatientIDs", "12345678\\77"}});
    for (const char* text : {"liver AB4711", "ab 4711", "1234-5678"})
        EXPECT_TRUE(words.occur_in(text)) << text;
    for (const char* text : {"liver 4711", "Segment 77", "1234"})
        EXPECT_FALSE(words.occur_in(text)) << text;
}

TEST(PatientWords, ShortNamesCountAsWholeWordsOnly) {
    const PatientWords words = words_of({{"PatientName", "Ng^A"}});
    EXPECT_TRUE(words.occur_in("Ng liver"));
    EXPECT_FALSE(words.occur_in("lung"));
    EXPECT_FALSE(words.occur_in("phase a"));
}

TEST(PatientWords, OfOtherScriptsAreFoundAsTheyAre) {
    const PatientWords words = words_of({{"PatientName", "山田^太郎"}});
    EXPECT_TRUE(words.occur_in("肝臓 山田"));
    EXPECT_FALSE(words.occur_in("肝臓"));
}

TEST(DicomText, IsReadInItsCharacterSet) {
    EXPECT_EQ(utf8_of_dicom("M\xfcller", "ISO_IR 100"), "Müller");
    EXPECT_EQ(utf8_of_dicom("M\xfcller", "ISO 2022 IR 100\\ISO 2022 IR 87"), "Müller");
    EXPECT_EQ(utf8_of_dicom("\xbe\xf3\xb3\xe6", "ISO_IR 101 "), "žółć");
    EXPECT_EQ(utf8_of_dicom("Müller", "ISO_IR 192"), "Müller");
    // Without a set, or with bytes that are not of it.
    EXPECT_EQ(utf8_of_dicom("Müller", ""), "Müller");
    EXPECT_EQ(utf8_of_dicom("M\xfcller", ""), "Müller");
    EXPECT_EQ(utf8_of_dicom("M\xfcller", "ISO_IR 192"), "Müller");
    EXPECT_EQ(utf8_of_dicom("M\xfcller", "nonsense"), "Müller");
}

}  // namespace
}  // namespace theatron::cases
