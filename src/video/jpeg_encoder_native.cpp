// SPDX-License-Identifier: Apache-2.0
#include "video/jpeg_encoder_native.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <utility>

#include "video/jpeg_zigzag.h"

namespace theatron::video {
namespace {

constexpr std::uint8_t end_marker[] = {0xff, 0xd9};

// Markers and their segments, whose numbers are big-endian.
class Header {
public:
    void put(std::initializer_list<int> values) {
        for (const int value : values)
            bytes_.push_back(std::byte(value));
    }
    void put_u16(int value) { put({value >> 8, value & 0xff}); }
    void begin_segment(int marker, int content_size) {
        put({0xff, marker});
        put_u16(content_size + 2);
    }
    template <class Table>
    void put_huffman_table(int id, const Table& table) {
        begin_segment(0xc4, 1 + int(table.size()));
        put({id});
        for (const int value : table)
            put({value});
    }
    Bytes take() { return std::move(bytes_); }

private:
    Bytes bytes_;
};

// Everything before the scan.
Bytes header_of(Size size, int quality, bool halve_chroma) {
    Header out;
    out.put({0xff, 0xd8});
    out.begin_segment(0xe0, 14);  // JFIF 1.1, square pixels, no thumbnail
    out.put({'J', 'F', 'I', 'F', 0, 1, 1, 0, 0, 1, 0, 1, 0, 0});
    for (const int kind : {0, 1}) {
        out.begin_segment(0xdb, 65);
        out.put({kind});
        for (const int place : jpeg_zigzag)
            out.put({jpeg::step_at(jpeg::standard_steps[kind][place], quality)});
    }
    out.begin_segment(0xc0, 15);  // baseline, eight bits
    out.put({8});
    out.put_u16(size.height);
    out.put_u16(size.width);
    out.put({3, 1, halve_chroma ? 0x22 : 0x11, 0, 2, 0x11, 1, 3, 0x11, 1});
    for (const int kind : {0, 1}) {
        out.put_huffman_table(kind, jpeg::dc_tables[kind]);
        out.put_huffman_table(0x10 | kind, jpeg::ac_tables[kind]);
    }
    out.begin_segment(0xda, 10);
    out.put({3, 1, 0x00, 2, 0x11, 3, 0x11, 0, 63, 0});
    return out.take();
}

}  // namespace

JpegCompressor::JpegCompressor(int quality, bool halve_chroma)
    : quality_(quality), halve_chroma_(halve_chroma), tables_(quality) {
    assert(quality >= 1 && quality <= 100);
}

void JpegCompressor::prepare(Size size) {
    size_ = size;
    const Bytes header = header_of(size, quality_, halve_chroma_);
    header_size_ = header.size();
    row_buffer_.reset(new std::uint8_t[jpeg::max_row_size(size.width, halve_chroma_)]);
    bytes_.reset(new std::uint8_t[header_size_ + jpeg::max_scan_size(size, halve_chroma_) +
                                  sizeof(end_marker)]);
    std::memcpy(bytes_.get(), header.data(), header_size_);
}

ByteView JpegCompressor::compress(ColorView image) & {
    assert(is_valid(image.size));
    if (image.size != size_)
        prepare(image.size);
    std::uint8_t* end = jpeg::encode_scan(image, halve_chroma_, tables_, row_buffer_.get(),
                                          bytes_.get() + header_size_);
    end = std::copy(std::begin(end_marker), std::end(end_marker), end);
    return std::as_bytes(std::span(bytes_.get(), end));
}

}  // namespace theatron::video
