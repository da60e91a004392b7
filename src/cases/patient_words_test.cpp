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

TEST(PatientWords, ShortNamesAreAlsoFoundWrittenAsOne) {
    const PatientWords words = words_of({{"PatientName", "Xu^Li"}});
    for (const char* text :
         {"xuli", "XuLi_CT", "XULI-2019", "lixu", "LiXu liver", "xuli2", "CT Xu"})
        EXPECT_TRUE(words.occur_in(text)) << text;
    for (const char* text : {"liver", "line", "external iliac", "luxury", "label 2"})
        EXPECT_FALSE(words.occur_in(text)) << text;
}

TEST(PatientWords, ShortIdentifiersCountAsWholeWords) {
    const PatientWords words =
        words_of({{"PatientID", "P7"}, {"OtherPatientIDs", "A-12\\77\\815"}});
    for (const char* text : {"liver P7", "p-7", "P7_liver", "A12", "a 12", "case 77", "CT_815"})
        EXPECT_TRUE(words.occur_in(text)) << text;
    for (const char* text : {"P70", "VP7", "ca 12 mm", "Segment 77", "label 815", "1815", "770"})
        EXPECT_FALSE(words.occur_in(text)) << text;
}

TEST(PatientWords, TheDateOfBirthIsFoundInAllUsualForms) {
    const PatientWords words = words_of({{"PatientBirthDate", "19610203"}});
    for (const char* text :
         {"3.2.61", "03.02.61", "2/3/61", "61-02-03", "020361", "3 Feb 1961", "Feb 3rd, 1961",
          "03-FEB-61", "03FEB1961", "3. Februar 1961", "3 février 61", "3 de febrero de 1961",
          "February 3, 1961 liver", "1961 Feb 3"})
        EXPECT_TRUE(words.occur_in(text)) << text;
    for (const char* text :
         {"3.2.62", "4 Feb 1961", "3 Mar 1961", "phase 3 2", "CT 2019-02-03", "3 Feb", "13.2.61"})
        EXPECT_FALSE(words.occur_in(text)) << text;
    EXPECT_FALSE(words_of({{"PatientBirthDate", "196102"}}).occur_in("1961 02"));
}

TEST(PatientWords, NamesThatArePartsOfUsualWordsLeaveThose) {
    const PatientWords words =
        words_of({{"PatientName", "Ong^Rena"}, {"OtherPatientNames", "Lee"}});
    for (const char* text : {"Ong", "ong_liver", "Rena", "renaong", "Lee liver", "leeCT", "CTlee"})
        EXPECT_TRUE(words.occur_in(text)) << text;
    for (const char* text :
         {"long axis", "renal artery", "sleeve", "left renal vein", "congestion"})
        EXPECT_FALSE(words.occur_in(text)) << text;
    EXPECT_TRUE(words_of({{"PatientBirthName", "Kowalski"}}).occur_in("Frau Kowalski, geb"));
    // Unless the patient is called so.
    EXPECT_TRUE(words_of({{"PatientName", "Herz^Anna"}}).occur_in("Herz"));
    EXPECT_TRUE(words_of({{"PatientID", "liver-01"}}).occur_in("liver 01"));
}

TEST(PatientWords, OfOtherScriptsAreFoundAsTheyAre) {
    const PatientWords words = words_of({{"PatientName", "山田^太郎"}});
    EXPECT_TRUE(words.occur_in("肝臓 山田"));
    EXPECT_FALSE(words.occur_in("肝臓"));
    EXPECT_TRUE(words_of({{"PatientName", "李^明"}}).occur_in("肝李明"));
}

TEST(PatientWords, OfAddressesAndGuardiansAreFound) {
    const PatientWords words = words_of({{"PatientAddress", "Lindenstrasse 17"},
                                         {"PatientTelephoneNumbers", "0171-2345678"},
                                         {"ResponsiblePerson", "Vormund^Vera"},
                                         {"AdmissionID", "ADM332211"}});
    for (const char* text : {"Lindenstraße 17", "0171 2345678", "Liver of Vormund", "adm332211"})
        EXPECT_TRUE(words.occur_in(text)) << text;
    EXPECT_FALSE(words.occur_in("Liver 17"));
}

TEST(DicomText, IsReadInItsCharacterSet) {
    EXPECT_EQ(utf8_of_dicom("M\xfcller", "ISO_IR 100"), "Müller");
    EXPECT_EQ(utf8_of_dicom("M\xfcller", "ISO 2022 IR 100\\ISO 2022 IR 87"), "Müller");
    EXPECT_EQ(utf8_of_dicom("\xbe\xf3\xb3\xe6", "ISO_IR 101 "), "žółć");
    EXPECT_EQ(utf8_of_dicom("Müller", "ISO_IR 192"), "Müller");
    // Escape sequences of several sets.
    EXPECT_EQ(utf8_of_dicom("Yamada^Tarou=\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B", "\\ISO 2022 IR 87"),
              "Yamada^Tarou=山田^太郎");
    EXPECT_EQ(utf8_of_dicom("\xd4\xcf\xc0\xde^\xc0\xdb\xb3=\x1b$B;3ED\x1b(J",
                            "ISO 2022 IR 13\\ISO 2022 IR 87"),
              "ﾔﾏﾀﾞ^ﾀﾛｳ=山田");
    EXPECT_EQ(utf8_of_dicom("\xd4\xcf\xc0\xde", "ISO_IR 13"), "ﾔﾏﾀﾞ");
    EXPECT_EQ(
        utf8_of_dicom("Hong^Gildong=\x1b$)C\xfb\xf3^\x1b$)C\xd1\xce\xd4\xd7", "\\ISO 2022 IR 149"),
        "Hong^Gildong=洪^吉洞");
    EXPECT_EQ(utf8_of_dicom("Wang=\x1b$)A\xcd\xf5", "\\ISO 2022 IR 58"), "Wang=王");
    EXPECT_EQ(utf8_of_dicom("a\x1b$Bz", ""), "a\x1b$Bz");
    // Without a set, or with bytes that are not of it.
    EXPECT_EQ(utf8_of_dicom("Müller", ""), "Müller");
    EXPECT_EQ(utf8_of_dicom("M\xfcller", ""), "Müller");
    EXPECT_EQ(utf8_of_dicom("M\xfcller", "ISO_IR 192"), "Müller");
    EXPECT_EQ(utf8_of_dicom("M\xfcller", "nonsense"), "Müller");
}

}  // namespace
}  // namespace theatron::cases
