// SPDX-License-Identifier: Apache-2.0
// The elements of a DICOM file (PS3.5, 7 and PS3.10), as devices write them and not only as the
// standard has them: with or without a preamble, packed, with the wrong transfer syntax, with
// unusual value representations, with bytes behind the pixels.
//
// Pure, safe for any bytes, bounded by them. Values are views of the bytes that were parsed.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/bytes.h"

namespace theatron::cases {

// Group and element as one number.
using DicomTag = std::uint32_t;
inline constexpr DicomTag pixel_data_tag = 0x7fe00010;

struct DicomEncoding {
    bool has_representations = true;  // "explicit VR"
    bool big_endian = false;
};

struct DicomElement {
    DicomTag tag = 0;
    std::array<char, 2> representation{};  // zeros: the file does not say it
    // Its length is undefined: `value` holds items up to their end.
    bool is_open = false;
    bool is_cut_off = false;  // `value` is shorter than announced
    ByteView value;
};

class DicomSet {
public:
    // Elements up to the end, to one that delimits an item, or to bytes that are no elements.
    DicomSet(ByteView bytes, DicomEncoding encoding);
    DicomSet() = default;

    const std::vector<DicomElement>& elements() const { return elements_; }
    DicomEncoding encoding() const { return encoding_; }
    // The first element of this tag that is not empty; null where there is none.
    const DicomElement* find(DicomTag tag) const;
    bool has(DicomTag tag) const { return find(tag) != nullptr; }
    // The element is there more than once, with other bytes.
    bool has_two_values(DicomTag tag) const;
    // A text without blanks and zeros at its ends.
    std::string text(DicomTag tag, std::size_t most = 1024) const;
    // A whole number, in binary or as text; `fallback` where there is none.
    int integer(DicomTag tag, int fallback) const;
    // Binary numbers of 16 bits.
    std::vector<int> words(DicomTag tag, bool is_signed) const;
    // The items of a sequence; none where the element is not there or is no sequence.
    std::vector<DicomSet> items(DicomTag tag) const;
    std::vector<DicomSet> items(const DicomElement& element) const;
    // The fragments of packed pixels; the first one is a table of offsets.
    std::vector<ByteView> fragments(const DicomElement& element, bool& is_cut_off) const;
    // True if an element before the pixels is longer than the rest of the file.
    bool is_cut_off() const { return is_cut_off_; }

private:
    std::vector<DicomElement> elements_;
    DicomEncoding encoding_;
    bool is_cut_off_ = false;
};

struct DicomFile {
    enum class Kind : std::uint8_t { good, no_dicom, cut_off, too_large, damaged };
    Kind kind = Kind::no_dicom;
    std::string transfer_syntax;  // as the file says; empty where it does not
    DicomSet set;
    Bytes unpacked;  // where `set` lies, if the file is packed
};

// `file` must outlive the result. Packed files (gzip, deflate) are unpacked to at most `most`
// bytes.
DicomFile parse_dicom(ByteView file, std::size_t most);

// True if these first bytes of a file (at least 132 where it has them) begin as DICOM does, with a
// preamble or with an element of the groups that come first.
bool begins_as_dicom(ByteView head);

}  // namespace theatron::cases
