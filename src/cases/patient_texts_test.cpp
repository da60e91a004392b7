// SPDX-License-Identifier: Apache-2.0
#include "cases/patient_texts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "cases/case_folder.h"
#include "testing/temporary_folder.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;

std::optional<PatientTexts> of_series(const std::string& series) {
    return parse_patient_texts(R"({"series": [)" + series + "]}");
}

TEST(PatientTexts, AreReadable) {
    const PatientTexts jane{"Doe, Jane Mary Dr.", "1961-02-03", "AB-4711", ""};
    EXPECT_EQ(of_series(R"({"file": "series_1.thvolume", "PatientName": "Doe^Jane^Mary^Dr.",
                            "PatientBirthDate": "19610203", "PatientID": " AB-4711 "})"),
              jane);
    EXPECT_EQ(of_series(R"({"PatientName": "Yamada^Tarou=山田^太郎=やまだ^たろう"})")->name,
              "Yamada, Tarou");
    EXPECT_EQ(of_series(R"({"PatientName": "^Jane"})")->name, "Jane");
    EXPECT_EQ(of_series(R"({"PatientName": "Doe^^Mary"})")->name, "Doe Mary");
    EXPECT_EQ(of_series(R"({"PatientBirthDate": "1961"})")->birth_date, "1961");
}

TEST(PatientTexts, AreOfOneSeriesTheFirstOfThoseThatSayMost) {
    EXPECT_EQ(of_series(R"({"PatientName": "", "PatientID": ""},
                           {"PatientName": "Doe", "PatientID": "1"},
                           {"PatientName": "DOE^", "PatientBirthDate": "19610203"})"),
              (PatientTexts{"Doe", "", "1", ""}));
    EXPECT_EQ(of_series(R"({"PatientID": "1"},
                           {"PatientName": "Roe", "PatientBirthDate": "19610203"})"),
              (PatientTexts{"Roe", "1961-02-03", "", ""}));
}

TEST(PatientTexts, HaveTheDatesOfAllStudies) {
    EXPECT_EQ(of_series(R"({"PatientName": "Doe", "StudyDate": "20260301"},
                           {"PatientName": "Doe", "StudyDate": "20251107"},
                           {"PatientName": "Doe", "StudyDate": "20260301"}, {"PatientName": "Doe"})")
                  ->study_dates,
              "2025-11-07, 2026-03-01");
    EXPECT_EQ(of_series(R"({"StudyDate": "20260301"})"), std::nullopt) << "a date names nobody";
}

TEST(PatientTexts, OfTwoPatientsNameNobody) {
    for (const char* two :
         {R"({"PatientName": "Doe", "PatientID": "1"}, {"PatientName": "Roe", "PatientID": "2"})",
          R"({"PatientName": "Doe"}, {}, {"PatientName": "Roe"})",
          R"({"PatientID": "1"}, {"PatientName": "Doe"}, {"PatientID": "2"})"})
        EXPECT_EQ(of_series(two), std::nullopt) << two;
}

TEST(PatientTexts, OtherContentNamesNobody) {
    for (const char* text : {"", "{", "[]", "5", "{}", R"({"series": 5})", R"({"series": [[]]})",
                             R"({"series": [{"PatientName": "^^"}]})", R"({"name": "Doe^Jane"})"})
        EXPECT_EQ(parse_patient_texts(text), std::nullopt) << text;
}

TEST(PatientTexts, AreReadFromAFileOfThisUserAlone) {
    const testing::TemporaryFolder folder;
    const fs::path file = folder.path() / identifiers_name;
    EXPECT_EQ(read_patient_texts(folder.path()), std::nullopt);
    std::ofstream(file) << R"({"series": [{"PatientName": "Doe^Jane"}]})";
    fs::permissions(file, fs::perms(0600));
    EXPECT_EQ(read_patient_texts(folder.path())->name, "Doe, Jane");
    const auto refusal = [&]() -> std::string {
        try {
            (void)read_patient_texts(folder.path());
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    for (const char* damaged :
         {"", "{", "7", "[]", R"({"name": "Doe^Jane"})", R"({"series": {"PatientName": "Doe"}})",
          R"({"series": ["Doe^Jane"]})", R"({"series": [{"PatientName": ["Doe^Jane"]}]})"}) {
        std::ofstream(file) << damaged;
        EXPECT_THAT(refusal(), ::testing::HasSubstr("import the case anew")) << damaged;
    }
    std::ofstream(file) << R"({"series": [{"PatientName": "Doe"}, {"PatientName": "Roe"}]})";
    EXPECT_THROW((void)read_patient_texts(folder.path()), MoreThanOnePatient);
    EXPECT_THAT(refusal(), ::testing::Not(::testing::HasSubstr("Doe")));
    fs::permissions(file, fs::perms(0640));
    EXPECT_THAT(refusal(), ::testing::HasSubstr("chmod 600"));
    EXPECT_THAT(refusal(), ::testing::Not(::testing::HasSubstr("Doe")));
    fs::rename(file, folder.path() / "elsewhere");
    fs::create_symlink(folder.path() / "elsewhere", file);
    EXPECT_THAT(refusal(), ::testing::HasSubstr("is not a regular file"));
}

}  // namespace
}  // namespace theatron::cases
