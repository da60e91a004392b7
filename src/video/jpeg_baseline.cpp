// SPDX-License-Identifier: Apache-2.0
#include "video/jpeg_baseline.h"

#include "video/jpeg_header.h"

namespace theatron::video {
namespace {

using namespace jpeg_marker;

constexpr int slots = 4;  // tables of a kind that a picture may keep

// The tables of the segments that were read so far.
struct Tables {
    std::array<std::array<std::uint8_t, 64>, slots> steps{};
    std::array<bool, slots> has_steps{};
    std::array<JpegHuffmanCode, slots> dc, ac;
};

Status read_quantization(ByteReader in, Tables& tables) {
    while (!in.rest().empty()) {
        const auto kind = in.get<std::uint8_t>();
        const int slot = kind & 15;
        if (slot >= slots)
            return Status::malformed;
        if (kind >> 4 != 0)
            return Status::unsupported;  // steps of 16 bits
        for (std::uint8_t& step : tables.steps[std::size_t(slot)])
            step = in.get<std::uint8_t>();
        if (!in.ok())
            return Status::malformed;
        tables.has_steps[std::size_t(slot)] = true;
    }
    return Status::ok;
}

// True if a prefix code with these lengths exists in which no code consists of
// ones alone: T.81 forbids that code.
bool is_possible(const JpegHuffmanCode& code) {
    unsigned next = 0;
    for (std::size_t length = 1; length <= 16; ++length) {
        next = 2 * next + std::to_integer<unsigned>(code.counts[length - 1]);
        if (next >= 1u << length)
            return false;
    }
    return true;
}

Status read_huffman(ByteReader in, Tables& tables) {
    while (!in.rest().empty()) {
        const auto kind = in.get<std::uint8_t>();
        const int slot = kind & 15;
        JpegHuffmanCode code;
        code.counts = in.get_bytes(16);
        std::size_t symbols = 0;
        for (const std::byte count : code.counts)
            symbols += std::to_integer<std::size_t>(count);
        code.symbols = in.get_bytes(symbols);
        const bool is_ac = kind >> 4 == 1;
        if (!in.ok() || slot >= slots || kind >> 4 > 1 || symbols > 256 || !is_possible(code))
            return Status::malformed;
        if (!is_ac)
            for (const std::byte symbol : code.symbols)
                if (symbol > std::byte{15})
                    return Status::malformed;
        (is_ac ? tables.ac : tables.dc)[std::size_t(slot)] = code;
    }
    return Status::ok;
}

struct Frame {
    Size size;
    std::array<std::uint8_t, 3> ids{}, factors{}, steps{};
};

Result<Frame> read_frame(ByteReader in) {
    Frame frame;
    in.get<std::uint8_t>();  // bits
    frame.size.height = get_be16(in);
    frame.size.width = get_be16(in);
    if (in.get<std::uint8_t>() != 3)
        return Status::unsupported;
    for (std::size_t i = 0; i < 3; ++i) {
        frame.ids[i] = in.get<std::uint8_t>();
        frame.factors[i] = in.get<std::uint8_t>();
        frame.steps[i] = in.get<std::uint8_t>();
    }
    if (!in.ok() || !in.rest().empty())
        return Status::malformed;
    return frame;
}

// Without a marker that says so, these names mean that the picture holds RGB.
bool is_named_rgb(const Frame& frame) {
    return frame.ids == std::array<std::uint8_t, 3>{'R', 'G', 'B'};
}

Result<BaselineJpeg> put_together(const Frame& frame, const Tables& tables, ByteReader scan) {
    BaselineJpeg jpeg;
    jpeg.size = frame.size;
    const bool halves_x = frame.factors[0] >> 4 == 2, halves_y = (frame.factors[0] & 15) == 2;
    jpeg.chroma_shift_x = halves_x;
    jpeg.chroma_shift_y = halves_y;
    if ((frame.factors[0] != 0x11 && frame.factors[0] != 0x21 && frame.factors[0] != 0x22) ||
        frame.factors[1] != 0x11 || frame.factors[2] != 0x11 || is_named_rgb(frame))
        return Status::unsupported;

    if (scan.get<std::uint8_t>() != 3)
        return Status::unsupported;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto id = scan.get<std::uint8_t>();
        const auto codes = scan.get<std::uint8_t>();
        const std::size_t dc = codes >> 4, ac = codes & 15, steps = frame.steps[i];
        if (id != frame.ids[i] || dc >= slots || ac >= slots || steps >= slots ||
            !tables.has_steps[steps] || !tables.dc[dc].defined() || !tables.ac[ac].defined())
            return Status::unsupported;
        jpeg.components[i] = {tables.steps[steps], tables.dc[dc], tables.ac[ac]};
    }
    // Sequential coding has all coefficients in one scan, with all their bits.
    if (scan.get<std::uint8_t>() != 0 || scan.get<std::uint8_t>() != 63 ||
        scan.get<std::uint8_t>() != 0 || !scan.ok() || !scan.rest().empty())
        return Status::malformed;
    return jpeg;
}

}  // namespace

Result<BaselineJpeg> read_baseline_jpeg(ByteView jpeg) {
    if (const Result<Size> size = read_jpeg_size(jpeg); !size)
        return size.error();

    ByteReader in(jpeg);
    while (in.get<std::uint8_t>() != start_of_image) {
    }
    Frame frame;
    Tables tables;
    int restart_interval = 0;
    while (true) {
        const Result<JpegSegment> segment = next_jpeg_segment(in);
        if (!segment)
            return segment.error();
        ByteReader content(segment->content);
        Status status = Status::ok;
        switch (segment->marker) {
            case jpeg_marker::quantization_tables:
                status = read_quantization(content, tables);
                break;
            case jpeg_marker::huffman_tables:
                status = read_huffman(content, tables);
                break;
            case jpeg_marker::restart_interval:
                restart_interval = get_be16(content);
                if (!content.ok() || !content.rest().empty())
                    status = Status::malformed;
                break;
            case jpeg_marker::baseline:
            case jpeg_marker::extended_sequential: {
                const Result<Frame> found = read_frame(content);
                if (!found)
                    return found.error();
                frame = *found;
                break;
            }
            case jpeg_marker::adobe:  // may say that the picture holds RGB
            case jpeg_marker::arithmetic_tables:
                return Status::unsupported;
            case jpeg_marker::start_of_scan: {
                Result<BaselineJpeg> result = put_together(frame, tables, content);
                if (result) {
                    result->restart_interval = restart_interval;
                    result->coded = in.rest();
                }
                return result;
            }
            default:;
        }
        if (status != Status::ok)
            return status;
    }
}

JpegMarker find_jpeg_marker(ByteView coded, std::size_t from) {
    constexpr std::byte mark{0xff};
    for (std::size_t i = from; i < coded.size(); ++i) {
        if (coded[i] != mark)
            continue;
        std::size_t after = i;
        while (after < coded.size() && coded[after] == mark)
            ++after;
        if (after == coded.size())
            return {i, after, 0};
        if (coded[after] != std::byte{0})
            return {i, after + 1, std::to_integer<std::uint8_t>(coded[after])};
        i = after;
    }
    return {coded.size(), coded.size(), 0};
}

bool ends_as_jpeg(ByteView coded, JpegMarker marker) {
    while (true) {
        switch (marker.code) {
            case end_of_image:
                return true;
            case 0:
            case start_of_image:
            case start_of_scan:
            case baseline:
            case extended_sequential:
                return false;
            default:;
        }
        std::size_t from = marker.after;
        const bool stands_alone = marker.code == temporary ||
                                  (marker.code >= first_restart && marker.code <= last_restart);
        if (!stands_alone) {
            ByteReader in(coded.subspan(from));
            const std::uint16_t length = get_be16(in);
            if (length < 2 || length > coded.size() - from)
                return false;
            from += length;
        }
        marker = find_jpeg_marker(coded, from);
    }
}

}  // namespace theatron::video
