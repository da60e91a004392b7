// SPDX-License-Identifier: Apache-2.0
#include "cases/manifest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::cases {
namespace {

using medical::Role;
using ::testing::HasSubstr;

const std::string example = R"({
  "theatron_case": 1, "name": "Liver, portal phase", "units": "mm", "space": "LPS",
  "deidentified": true, "license": "CC BY 4.0", "credit": "A collection",
  "parts": [{"name": "liver", "role": "shell", "file": "part_1.thmesh", "color": "#b25c4A",
             "opacity": 0.35}],
  "series": [{"name": "CT", "modality": "CT", "file": "series_1.thvolume",
              "missing_slices": [12, 13]}]
})";

std::string changed(const std::string& from, const std::string& to) {
    std::string text = example;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(Manifest, IsReadAndWritten) {
    const ParsedManifest parsed = parse_manifest(example);
    ASSERT_EQ(parsed.problem, "");
    EXPECT_EQ(parsed.value.name, "Liver, portal phase");
    EXPECT_TRUE(parsed.value.deidentified);
    ASSERT_EQ(parsed.value.parts.size(), 1u);
    EXPECT_EQ(parsed.value.parts[0].role, Role::shell);
    EXPECT_EQ(parsed.value.parts[0].color, (Rgb{0xb2, 0x5c, 0x4a}));
    EXPECT_EQ(parsed.value.parts[0].opacity, 0.35);
    ASSERT_EQ(parsed.value.series.size(), 1u);
    EXPECT_EQ(parsed.value.series[0].missing_slices, (std::vector<int>{12, 13}));

    const ParsedManifest again = parse_manifest(manifest_text(parsed.value));
    EXPECT_EQ(again.problem, "");
    EXPECT_EQ(again.value, parsed.value);
}

TEST(Manifest, PicturesNeedVersion2) {
    EXPECT_THAT(manifest_text(parse_manifest(example).value), HasSubstr("\"theatron_case\": 1"));
    EXPECT_EQ(parse_manifest(changed("\"theatron_case\": 1", "\"theatron_case\": 2")).problem,
              "lacks 'pictures'");
    const std::string list =
        R"("pictures": [{"name": "wound", "file": "picture_1.thpicture"}], "series")";
    EXPECT_EQ(parse_manifest(changed("\"series\"", list)).problem,
              "has the unknown key 'pictures'");
    std::string text = changed("\"theatron_case\": 1", "\"theatron_case\": 2");
    text.replace(text.find("\"series\""), 8, list);
    const ParsedManifest parsed = parse_manifest(text);
    ASSERT_EQ(parsed.problem, "");
    ASSERT_EQ(parsed.value.pictures.size(), 1u);
    EXPECT_EQ(parsed.value.pictures[0].name, "wound");
    const ParsedManifest again = parse_manifest(manifest_text(parsed.value));
    EXPECT_EQ(again.problem, "");
    EXPECT_EQ(again.value, parsed.value);
}

TEST(Manifest, EachProblemIsNamed) {
    const auto problem = [](const std::string& from, const std::string& to) {
        return parse_manifest(changed(from, to)).problem;
    };
    EXPECT_EQ(parse_manifest("liver").problem, "is not JSON");
    EXPECT_EQ(parse_manifest("[]").problem, "is not a JSON object");
    EXPECT_THAT(parse_manifest("{}").problem, HasSubstr("lacks 'theatron_case'"));
    EXPECT_THAT(parse_manifest(std::string(100000, '[')).problem, HasSubstr("too deeply"));
    EXPECT_THAT(parse_manifest(std::string(2 << 20, ' ')).problem, HasSubstr("1024 KiB"));
    EXPECT_EQ(problem("\"theatron_case\": 1", "\"theatron_case\": 7"),
              "is of version 7, which a newer version of Theatron wrote; this one reads version 2");
    EXPECT_EQ(problem("\"role\": \"shell\", ", ""), "lacks 'role' in part 1");
    EXPECT_EQ(problem("\"shell\"", "\"lung\""),
              "has 'lung' as 'role' in part 1; it is one of shell, artery, portal_vein, "
              "hepatic_vein, tumour, other");
    EXPECT_EQ(problem("\"mm\"", "\"inch\""), "has 'inch' as 'units'; it is one of mm, cm, m");
    EXPECT_EQ(problem("\"opacity\": 0.35", "\"opacity\": 35"),
              "holds no number from 0 to 1 as 'opacity' in part 1");
    EXPECT_EQ(problem("\"opacity\"", "\"opacty\""), "has the unknown key 'opacty' in part 1");
    EXPECT_EQ(problem("#b25c4A", "red"),
              "has 'red' as 'color' in part 1; a colour is written as #rrggbb");
    EXPECT_THAT(problem("#b25c4A", "#+1-2 3"), HasSubstr("a colour is written as"));
    EXPECT_EQ(problem("true", "\"yes\""), "holds neither true nor false as 'deidentified'");
    EXPECT_THAT(problem("[12, 13]", "[12, -1]"), HasSubstr("numbers of slices"));
    EXPECT_THAT(problem("Liver,", "Liver\\u001b[31m"), HasSubstr("control characters"));
}

TEST(Manifest, FilesLieInTheFolder) {
    for (const char* name : {"../part.thmesh", "/etc/passwd", "a/b", ".hidden", "", "a\\\\b"})
        EXPECT_THAT(parse_manifest(changed("part_1.thmesh", name)).problem,
                    HasSubstr("a file lies in the case's folder"))
            << name;
}

}  // namespace
}  // namespace theatron::cases
