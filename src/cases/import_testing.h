// SPDX-License-Identifier: Apache-2.0
// Sources of tests that import them: DICOM images and surfaces in a folder of their own.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

#include "base/error.h"
#include "cases/dicom_writer.h"
#include "cases/import_case.h"
#include "files/file_bytes.h"
#include "testing/temporary_folder.h"

namespace theatron::cases {

class Import : public ::testing::Test {
protected:
    std::filesystem::path source() const { return folder_.path() / "source"; }
    std::filesystem::path target() const { return folder_.path() / "case"; }

    static void no_progress(std::string_view, double) {}

    ImportReport import(const ImportOptions& options = {}) const {
        return import_case(source(), target(), options, no_progress);
    }
    std::string refusal(const ImportOptions& options = {}) const {
        const std::string text = sentence([&] { import(options); });
        EXPECT_FALSE(std::filesystem::exists(target())) << "nothing half made stays";
        EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("Mustermann")));
        return text;
    }

    // The sentence with which an action fails.
    template <class Action>
    static std::string sentence(Action action) {
        try {
            action();
        } catch (const Error& error) {
            return error.what();
        }
        return "nothing was thrown";
    }

    static DicomSlice image(int number) {
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

    static DicomTexts texts_of_image(int number, const std::string& name = "Mustermann^Erika",
                                     const std::string& id = "4711") {
        DicomTexts texts;
        texts.instance_uid = "1.2.3.4.5." + std::to_string(number);
        texts.study_uid = "1.2.3";
        texts.patient_name = name;
        texts.patient_id = id;
        texts.instance = number;
        return texts;
    }
    static void write_image(const std::filesystem::path& file, const DicomSlice& slice, int number,
                            const std::string& name = "Mustermann^Erika",
                            const std::string& id = "4711") {
        files::write_file(file, write_dicom(slice, texts_of_image(number, name, id)));
    }
    static void write_series(const std::filesystem::path& folder, int count = 5) {
        std::filesystem::create_directories(folder);
        for (int i = 0; i < count; ++i)
            write_image(folder / ("image" + std::to_string(i) + ".dcm"), image(i), i);
    }

    // The bytes of a picture of a dose report, as scanners put it beside the series.
    static Bytes picture_in_colour(const DicomTexts& texts = texts_of_image(9)) {
        DicomSlice slice = image(0);
        slice.series_uid = "1.2.3.9";
        slice.rows = 3;
        slice.columns = 20;
        slice.samples.resize(60);
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

    // A cube of 40 mm as a text, with a corner at `low`.
    static void write_cube_stl(const std::filesystem::path& file, double low) {
        std::ofstream out(file);
        out << "solid cube\n";
        const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
        for (const auto& q : quads)
            for (const auto& t : {std::array{q[0], q[1], q[2]}, std::array{q[0], q[2], q[3]}}) {
                out << "facet normal 0 0 0\nouter loop\n";
                for (const int corner : t)
                    out << "vertex " << low + 40 * (corner & 1) << ' '
                        << low + 40 * (corner >> 1 & 1) << ' ' << low + 40 * (corner >> 2 & 1)
                        << '\n';
                out << "endloop\nendfacet\n";
            }
        out << "endsolid\n";
    }

    testing::TemporaryFolder folder_;
};

}  // namespace theatron::cases
