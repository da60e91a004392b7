// SPDX-License-Identifier: Apache-2.0
#include "cases/dicom_pixels.h"

#include <gdcmFragment.h>
#include <gdcmImage.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTransferSyntax.h>

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include "base/outside_text.h"
#include "cases/dicom_rle.h"

namespace theatron::cases {
namespace {

std::uint32_t little(ByteView bytes, std::size_t at) {
    return load_le<std::uint32_t>(bytes.data() + at);
}

Answer read_plain(const DicomFile& file, const DicomElement& pixels, const DicomImage& image,
                  int frame, std::vector<int>& values) {
    const std::size_t width = std::size_t(image.bits.allocated / 8);
    const std::size_t begin = std::size_t(frame) * values.size() * width;
    if (pixels.value.size() < begin || pixels.value.size() - begin < values.size() * width)
        return Answer::cut_off;
    const ByteView bytes = pixels.value.subspan(begin, values.size() * width);
    // Old scanners of GE swap the bytes of their pixels alone.
    const bool big_endian = file.set.encoding().big_endian ||
                            (width == 2 && file.transfer_syntax == "1.2.840.113619.5.2");
    const bool in_words = pixels.representation != std::array{'O', 'B'};
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (width == 1) {
            // In a word of the other order the second byte comes first.
            const std::size_t at = big_endian && in_words ? std::min(i ^ 1, values.size() - 1) : i;
            values[i] = std::to_integer<int>(bytes[at]);
        } else {
            const int first = std::to_integer<int>(bytes[2 * i]);
            const int second = std::to_integer<int>(bytes[2 * i + 1]);
            values[i] = big_endian ? first << 8 | second : second << 8 | first;
        }
    }
    return Answer::content;
}

// The fragments of one frame. False where it cannot be told which ones are.
bool fragments_of(const std::vector<ByteView>& all, const DicomImage& image, int frame,
                  std::vector<ByteView>& out) {
    if (all.size() < 2)
        return false;
    const std::size_t count = all.size() - 1;
    if (image.frames == 1) {
        out.assign(all.begin() + 1, all.end());
        return true;
    }
    if (count == std::size_t(image.frames)) {
        out = {all[std::size_t(frame) + 1]};
        return true;
    }
    const ByteView offsets = all[0];
    if (offsets.size() < 4 * std::size_t(image.frames))
        return false;
    const std::size_t begin = little(offsets, 4 * std::size_t(frame));
    const std::size_t end =
        frame + 1 < image.frames ? little(offsets, 4 * std::size_t(frame) + 4) : std::size_t(-1);
    std::size_t at = 0;
    for (std::size_t i = 1; i < all.size(); ++i) {
        if (at >= begin && at < end)
            out.push_back(all[i]);
        constexpr std::size_t head_of_item = 8;
        at += head_of_item + all[i].size();
    }
    return !out.empty();
}

// The kind of JPEG that a stream is: its frame's marker says it.
gdcm::TransferSyntax::TSType kind_of_jpeg(ByteView stream) {
    std::size_t at = 2;
    while (at + 4 <= stream.size() && stream[at] == std::byte(0xff)) {
        const int marker = std::to_integer<int>(stream[at + 1]);
        switch (marker) {
            case 0xc0:
                return gdcm::TransferSyntax::JPEGBaselineProcess1;
            case 0xc1:
                return gdcm::TransferSyntax::JPEGExtendedProcess2_4;
            case 0xc3:
                return gdcm::TransferSyntax::JPEGLosslessProcess14_1;
            case 0xf7:
                return gdcm::TransferSyntax::JPEGLSLossless;
            default:
                break;
        }
        at += 2 + (std::to_integer<std::size_t>(stream[at + 2]) << 8 |
                   std::to_integer<std::size_t>(stream[at + 3]));
    }
    return gdcm::TransferSyntax::TS_END;
}

gdcm::TransferSyntax syntax_of(const DicomFile& file, ByteView first) {
    const gdcm::TransferSyntax said(gdcm::TransferSyntax::GetTSType(file.transfer_syntax.c_str()));
    if (said != gdcm::TransferSyntax::TS_END && said.IsEncapsulated())
        return said;
    // Programs that unpack files and pack them again forget to change it.
    constexpr unsigned char jpeg[] = {0xff, 0xd8, 0xff}, jpeg2000[] = {0xff, 0x4f, 0xff, 0x51};
    const auto begins = [&](const auto& with) {
        return first.size() > sizeof(with) && std::memcmp(first.data(), with, sizeof(with)) == 0;
    };
    if (begins(jpeg))
        return kind_of_jpeg(first);
    if (begins(jpeg2000))
        return gdcm::TransferSyntax::JPEG2000;
    if (first.size() > 64 && little(first, 0) >= 1 && little(first, 0) <= 2 &&
        little(first, 4) == 64)
        return gdcm::TransferSyntax::RLELossless;
    return gdcm::TransferSyntax::TS_END;
}

Answer read_packed(const DicomFile& file, const DicomElement& pixels, const DicomImage& image,
                   int frame, std::vector<int>& values, StoredBits& bits) {
    bool is_cut_off = false;
    const std::vector<ByteView> all = file.set.fragments(pixels, is_cut_off);
    if (is_cut_off || all.size() < 2)
        return Answer::cut_off;
    std::vector<ByteView> parts;
    if (!fragments_of(all, image, frame, parts))
        return Answer::compression;
    const gdcm::TransferSyntax syntax = syntax_of(file, parts[0]);
    if (syntax == gdcm::TransferSyntax::TS_END)
        return Answer::compression;
    if (syntax == gdcm::TransferSyntax::RLELossless) {
        Bytes whole;
        for (const ByteView part : parts)
            whole.insert(whole.end(), part.begin(), part.end());
        return unpack_rle(whole, bits.allocated / 8, values) ? Answer::content
                                                             : Answer::compression;
    }
    gdcm::Image packed;
    packed.SetNumberOfDimensions(2);
    packed.SetDimension(0, unsigned(image.columns));
    packed.SetDimension(1, unsigned(image.rows));
    packed.SetPixelFormat(gdcm::PixelFormat(1, std::uint16_t(bits.allocated),
                                            std::uint16_t(bits.stored),
                                            std::uint16_t(bits.stored - 1), bits.is_signed));
    packed.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
    packed.SetTransferSyntax(syntax);
    const gdcm::SmartPointer<gdcm::SequenceOfFragments> sequence = gdcm::SequenceOfFragments::New();
    for (const ByteView part : parts) {
        gdcm::Fragment fragment;
        fragment.SetByteValue(reinterpret_cast<const char*>(part.data()),
                              gdcm::VL(std::uint32_t(part.size())));
        sequence->AddFragment(fragment);
    }
    gdcm::DataElement element(gdcm::Tag(0x7fe0, 0x0010));
    element.SetVR(gdcm::VR::OB);
    element.SetValue(*sequence);
    packed.SetDataElement(element);
    std::vector<char> buffer(packed.GetBufferLength());
    if (!packed.GetBuffer(buffer.data()))
        return Answer::compression;
    const gdcm::PixelFormat& format = packed.GetPixelFormat();
    const std::size_t width = std::size_t(bits.allocated / 8);
    if (format.GetSamplesPerPixel() != 1 || format.GetBitsAllocated() != bits.allocated ||
        buffer.size() < values.size() * width)
        return Answer::compression;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (width == 1)
            values[i] = std::uint8_t(buffer[i]);
        else
            values[i] = load_le<std::uint16_t>(reinterpret_cast<std::byte*>(buffer.data()) + 2 * i);
    // These formats know the values' own bits and sign.
    if (bits.high != bits.stored - 1)
        return Answer::compression;
    bits.stored = format.GetBitsStored();
    bits.high = bits.stored - 1;
    bits.is_signed = format.GetPixelRepresentation() != 0;
    const bool possible = bits.stored >= 1 && bits.stored <= bits.allocated;
    return possible ? Answer::content : Answer::compression;
}

// Some programs give the length of packed pixels.
bool is_packed(const DicomElement& pixels) {
    constexpr unsigned char item[] = {0xfe, 0xff, 0x00, 0xe0};
    return pixels.is_open || (pixels.value.size() > sizeof(item) &&
                              std::memcmp(pixels.value.data(), item, sizeof(item)) == 0);
}

// How a packing that is not read is called.
std::string name_of_packing(const std::string& syntax) {
    constexpr std::pair<std::string_view, const char*> known[] = {
        {"1.2.840.10008.1.2.4.20", "HTJ2K"},
        {"1.2.840.10008.1.2.4.11", "JPEG XL"},
        {"1.2.840.10008.1.2.4.10", "a film"},
        {"1.2.840.10008.1.2.4.9", "JPIP or JPEG 2000, part 2"},
        {"1.2.840.10008.1.2.8", "deflate"},
    };
    for (const auto& [begin, name] : known)
        if (syntax.starts_with(begin))
            return name;
    return clean_text(syntax, 64);
}

}  // namespace

std::string packing_problem(const DicomFile& file) {
    const DicomElement* const pixels = file.set.find(pixel_data_tag);
    if (!pixels || !is_packed(*pixels))
        return "";
    bool is_cut_off = false;
    const std::vector<ByteView> all = file.set.fragments(*pixels, is_cut_off);
    if (is_cut_off || all.size() < 2 || syntax_of(file, all[1]) != gdcm::TransferSyntax::TS_END)
        return "";
    return "has its pixels packed as " + name_of_packing(file.transfer_syntax) +
           ", which is not read; export it uncompressed";
}

Answer read_stored_values(const DicomFile& file, const DicomImage& image, int frame,
                          std::vector<int>& values, StoredBits& bits) {
    const DicomElement* pixels = file.set.find(pixel_data_tag);
    if (!pixels)
        return Answer::cut_off;
    bits = image.bits;
    values.resize(std::size_t(image.columns) * std::size_t(image.rows));
    if (is_packed(*pixels))
        return read_packed(file, *pixels, image, frame, values, bits);
    return read_plain(file, *pixels, image, frame, values);
}

}  // namespace theatron::cases
