// SPDX-License-Identifier: Apache-2.0
// DICOM files as devices write them. tests/foreign imports many more of them.
#include "cases/dicom_elements.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "cases/dicom_image.h"
#include "cases/dicom_number.h"
#include "cases/dicom_pixels.h"
#include "cases/dicom_writer.h"

namespace theatron::cases {
namespace {

using ::testing::HasSubstr;

constexpr std::size_t most = 1 << 24;

Bytes plain_file(DicomTexts texts = {}) {
    DicomSlice slice;
    slice.series_uid = "1.2.3";
    slice.modality = "CT";
    slice.columns = 4;
    slice.rows = 3;
    slice.right = {1, 0, 0};
    slice.down = {0, 1, 0};
    slice.has_place = true;
    for (int i = 0; i < 12; ++i)
        slice.samples.push_back(std::int16_t(100 * i));
    texts.instance_uid = "1.2.3.4";
    texts.study_uid = "1.2";
    texts.patient_name = "Doe^Jane";
    return write_dicom(slice, texts);
}

// Replaces the first occurrence of a text by one of the same length.
void replace(Bytes& bytes, std::string_view from, std::string_view to) {
    const auto at =
        std::search(bytes.begin(), bytes.end(), as_bytes(from).begin(), as_bytes(from).end());
    ASSERT_NE(at, bytes.end());
    std::copy(as_bytes(to).begin(), as_bytes(to).end(), at);
}

std::vector<int> values_of(ByteView bytes) {
    const DicomFile file = parse_dicom(bytes, most);
    const DicomImage image = describe_image(file);
    EXPECT_EQ(image.what, Answer::content);
    std::vector<int> values;
    StoredBits bits;
    EXPECT_EQ(read_stored_values(file, image, 0, values, bits), Answer::content);
    return values;
}

TEST(DicomElements, APreambleAndBytesBehindThePixelsDoNotMatter) {
    const Bytes whole = plain_file();
    Bytes longer = whole;
    longer.resize(whole.size() + 511, std::byte(0x12));
    const std::vector<int> values = values_of(whole);
    EXPECT_EQ(values[11], 1100);
    EXPECT_EQ(values_of(longer), values);
    EXPECT_EQ(values_of(ByteView(whole).subspan(132)), values);
}

TEST(DicomElements, EveryTruncationIsNoticed) {
    const Bytes whole = plain_file();
    for (std::size_t size = 140; size < whole.size(); ++size) {
        const DicomFile file = parse_dicom(ByteView(whole).first(size), most);
        const DicomImage image = describe_image(file);
        std::vector<int> values;
        StoredBits bits;
        // Between two elements of the head it may be another kind of file.
        const bool is_noticed = image.what == Answer::cut_off || image.what == Answer::no_image ||
                                read_stored_values(file, image, 0, values, bits) == Answer::cut_off;
        EXPECT_TRUE(is_noticed) << size;
    }
}

TEST(DicomElements, ATransferSyntaxThatDoesNotHoldIsNotBelieved) {
    Bytes file = plain_file();
    replace(file, "1.2.840.10008.1.2.1", std::string_view("1.2.840.10008.1.2\0\0", 19));
    EXPECT_EQ(values_of(file)[11], 1100);
}

TEST(DicomElements, DecimalsAreWholeOrNone) {
    for (const char* good : {"1.5", " 1.5 ", "+1.5", "15e-1", "1.50"})
        EXPECT_EQ(dicom_decimal(good), 1.5) << good;
    EXPECT_EQ(dicom_decimal(std::string_view("1.5\0\0", 5)), 1.5);
    for (const char* bad :
         {"", " ", "1,5", "1.5x", "x", "0x10", "inf", "nan", "1.5 HU", "--1", "+-1"})
        EXPECT_FALSE(dicom_decimal(bad)) << bad;
}

TEST(DicomElements, AFieldThatIsNoNumberIsNamed) {
    Bytes bytes = plain_file();
    replace(bytes, "1.000000", "1,000000");  // the direction comes first
    const DicomFile file = parse_dicom(bytes, most);
    const DicomSlice slice = describe_frame(file, describe_image(file), 0);
    EXPECT_THAT(slice.problem, HasSubstr("'1,000000"));
}

TEST(DicomElements, ABombIsBounded) {
    Bytes packed(1 << 16);
    z_stream stream{};
    deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 9, Z_DEFAULT_STRATEGY);
    const Bytes zeros(1 << 22);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(zeros.data()));
    stream.avail_in = uInt(zeros.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = uInt(packed.size());
    ASSERT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    EXPECT_EQ(parse_dicom(packed, 1 << 20).kind, DicomFile::Kind::too_large);
    EXPECT_EQ(parse_dicom(packed, 1 << 23).kind, DicomFile::Kind::no_dicom);
    packed.resize(packed.size() / 2);
    EXPECT_EQ(parse_dicom(packed, 1 << 23).kind, DicomFile::Kind::damaged);
}

}  // namespace
}  // namespace theatron::cases
